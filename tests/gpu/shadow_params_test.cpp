// Every parameter of a technique, and of what it needs, changes the mask for at least one of its values, and none of
// them makes it anything but shares of light.

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

// The ends of its range, or all words. Costs rise with numbers of taps: 64 will do.
std::vector<ParamValue> values_of(const Param& param) {
  if (std::holds_alternative<bool>(param.default_value)) return {false, true};
  if (std::holds_alternative<std::string>(param.default_value)) return {param.choices.begin(), param.choices.end()};
  if (std::holds_alternative<int>(param.default_value))
    return {static_cast<int>(param.min), static_cast<int>(std::min(param.max, 64.0))};
  return {static_cast<float>(param.min), static_cast<float>(param.max)};
}

class ShadowParams : public TriangleTest {
 protected:
  ShadowParams() {
    // Casters at several heights, of which one is narrower than a texel.
    scene_.add_box({-3, 1.5f, -1}, {-2, 1.7f, 3});
    scene_.add_box({1.5f, 3, 1}, {1.52f, 3.02f, 4});
    scene_.width = scene_.height = 64;
  }

  std::vector<float> draw(const ParamSet& params) {
    std::vector<float> mask = renderer_->render(scene_, params).visibilities();
    EXPECT_TRUE(std::ranges::all_of(mask, [](float seen) { return seen >= 0 && seen <= 1; }));
    return mask;
  }

  // Whether one of the parameter's values changes the mask that `params` give.
  bool changes(const Param& param, const ParamSet& params, const std::vector<float>& usual) {
    bool changed = false;
    for (const ParamValue& value : values_of(param)) {
      SCOPED_TRACE(param.name + "=" + to_text(value));
      ParamSet other = params;
      other.set(param.name, value);
      changed = draw(other) != usual || changed;
    }
    return changed;
  }

  TriangleScene scene_ = box_on_ground();
};

TEST_F(ShadowParams, OfTechniquesChangeTheMask) {
  std::set<std::string> idle;
  const shadow::Registry& registry = renderer_->shadows().registry();
  for (const shadow::Technique& technique : registry.techniques()) {
    ParamSet params = renderer_->params();
    params.set("technique", technique.name);
    params.set("sun.angle", 6.0f);
    params.set("cascades.size", 128);
    const std::vector<float> usual = draw(params);
    std::vector<Param> rows = technique.params;
    for (const std::string& need : technique.needs) {
      if (need == "shadow_map") continue;
      const std::vector<Param>& more = registry.find_recipe(need).params;
      rows.insert(rows.end(), more.begin(), more.end());
    }
    for (const Param& param : rows) {
      if (!changes(param, params, usual)) idle.insert(param.name);
    }
  }
  EXPECT_EQ(idle, (std::set<std::string>{"maps.gap",                // of a second layer, which is not drawn here
                                         "pcss.disocclusion_taps",  // where a history is refused; here is none
                                         "pcss.early_exit"}));      // changes the cost alone
}

}  // namespace
}  // namespace penumbra::test
