// The name of the selected technique in summaries and in the viewer.
#include <gtest/gtest.h>

#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra {
namespace {

ParamSet selected(const std::string& name) {
  const shadow::Registry& registry = session::all_techniques();
  ParamSet params(render::Renderer::params(registry));
  registry.select(params, name);
  return params;
}

TEST(TechniqueLabel, IsTheNameThatWasSelected) {
  for (const std::string& name : session::all_techniques().names())
    EXPECT_EQ(session::technique_label(selected(name)), name);
}

TEST(TechniqueLabel, IsThePresetsNameUntilOneOfItsValuesChanges) {
  for (const shadow::Preset& preset : session::all_techniques().presets()) {
    ParamSet params = selected(preset.name);
    params.set("sun.angle", 5.0f);
    EXPECT_EQ(session::technique_label(params), preset.name) << "a value that is not the preset's";
    for (const std::string& assignment : preset.assignments) params.reset(assignment.substr(0, assignment.find('=')));
    EXPECT_NE(session::technique_label(params), preset.name);
  }
}

}  // namespace
}  // namespace penumbra
