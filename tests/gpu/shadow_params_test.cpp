// Every parameter of a technique and of what it needs, of the library and of its denoisers changes the mask for at
// least one of its values, and none of them makes it anything but shares of light.

#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"
#include "shadow/library_params.h"

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

  std::vector<float> draw(const ParamSet& params) { return checked(renderer_->render(scene_, params)); }

  // The third frame of a view whose camera and narrowest caster move.
  std::vector<float> draw_moving(const ParamSet& params) {
    std::vector<float> mask;
    TriangleScene scene = scene_;
    const glm::mat4 first_view = scene.view;
    for (int frame = 0; frame < 3; ++frame) {
      const glm::mat4 last_view = scene.view;
      scene.view = first_view * glm::translate(glm::mat4(1), glm::vec3(0.1f, 0, 0.05f) * static_cast<float>(frame));
      if (frame > 0) scene.move_from(26, glm::vec3(0.1f, 0, 0));
      mask = checked(renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
        inputs.view.last_view = last_view;
        inputs.view.last_projection = inputs.view.projection;
        inputs.view.cut = frame == 0;
      }));
    }
    return mask;
  }

  // Those of `rows` of which no value changes the mask that `params` give.
  static std::set<std::string> idle_of(const std::vector<Param>& rows, const ParamSet& params,
                                       const std::function<std::vector<float>(const ParamSet&)>& draw) {
    std::set<std::string> idle;
    const std::vector<float> usual = draw(params);
    for (const Param& param : rows) {
      bool changed = false;
      for (const ParamValue& value : values_of(param)) {
        if (value == params.value(param.name)) continue;
        SCOPED_TRACE(param.name + "=" + to_text(value));
        ParamSet other = params;
        other.set(param.name, value);
        changed = draw(other) != usual || changed;
      }
      if (!changed) idle.insert(param.name);
    }
    return idle;
  }

  static std::vector<float> checked(const Shadowed& shadowed) {
    std::vector<float> mask = shadowed.visibilities();
    EXPECT_TRUE(std::ranges::all_of(mask, [](float seen) { return seen >= 0 && seen <= 1; }));
    return mask;
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
    std::vector<Param> rows = technique.params;
    for (const std::string& need : technique.needs) {
      if (need == "shadow_map") continue;
      const std::vector<Param>& more = registry.find_recipe(need).params;
      rows.insert(rows.end(), more.begin(), more.end());
    }
    idle.merge(idle_of(rows, params, [&](const ParamSet& other) { return draw(other); }));
  }
  EXPECT_EQ(idle, (std::set<std::string>{"maps.gap",                // of a second layer, which is not drawn here
                                         "maps.overlap",            // the same
                                         "pcss.disocclusion_taps",  // where a history is refused; here is none
                                         "pcss.early_exit"}));      // changes the cost alone
}

TEST_F(ShadowParams, OfTheLibraryAndDenoisersChangeTheMask) {
  const shadow::Registry& registry = renderer_->shadows().registry();
  std::vector<Param> rows = shadow::library_params();
  for (const std::vector<Param>& more : {shadow::movement_params(), shadow::filter_params(registry.filters())})
    rows.insert(rows.end(), more.begin(), more.end());
  rows.push_back(shadow::denoiser_param(registry.denoisers()));
  for (const shadow::Denoiser& denoiser : registry.denoisers())
    rows.insert(rows.end(), denoiser.params.begin(), denoiser.params.end());
  ParamSet params = renderer_->params();
  params.set("sun.angle", 6.0f);
  params.set("cascades.size", 128);
  params.set("history.reuse", true);
  params.set("filter.visibility", "bilateral");
  params.set("filter.width", 0.5f);
  // Without a lamp and a rest of the view. The others change the stage, the cost or the passes alone.
  const std::set<std::string> may_be_idle = {"lamps.near", "lamps.size", "maps.jitter",     "driver",
                                             "maps.keep",  "mask.tiles", "movement.present"};
  for (const std::string& name : idle_of(rows, params, [&](const ParamSet& other) { return draw_moving(other); }))
    EXPECT_TRUE(may_be_idle.contains(name)) << name;
}

}  // namespace
}  // namespace penumbra::test
