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

TEST(TechniqueLabel, SaysWhichPresetWasModified) {
  ParamSet params = selected("thesis");
  params.set("history.alpha", 0.2f);  // of a group that it sets, though not one of its values
  EXPECT_EQ(session::technique_label(params), "thesis (modified)");
  params = selected("thesis_8x8");
  params.set("pcss.filter_taps", 12);
  EXPECT_EQ(session::technique_label(params), "thesis_8x8 (modified)");
  EXPECT_EQ(session::selection_of(params).name, "thesis_8x8");
  EXPECT_EQ(session::unmodified(params).get_int("pcss.filter_taps"), 8);
}

TEST(TechniqueLabel, MapsAreNoPartOfAPresetButForWhatItSets) {
  ParamSet params = selected("slices_history");
  params.set("maps.keep", false);
  EXPECT_EQ(session::technique_label(params), "slices_history");
  params.set("maps.jitter", false);
  EXPECT_EQ(session::technique_label(params), "slices_history (modified)");
}

TEST(TechniqueLabel, CascadesAreNoPartOfAPresetButForWhatItSets) {
  ParamSet params = selected("hybrid_denoised");
  params.set("cascades.distance", 50.0f);
  EXPECT_EQ(session::technique_label(params), "hybrid_denoised");
  params.set("cascades.size", 512);
  EXPECT_EQ(session::technique_label(params), "hybrid_denoised (modified)");
}

TEST(TechniqueLabel, ChoosingAnotherTechniqueKeepsWhatWasChangedSince) {
  ParamSet params = selected("hybrid_denoised");
  params.set("cascades.size", 4096);
  session::choose_technique(params, session::all_techniques(), "pcss");
  EXPECT_EQ(params.get_int("cascades.size"), 4096);
  EXPECT_EQ(params.get_word("cascades.fit"), "stable");
}

TEST(TechniqueLabel, IsTheTechniqueWhereMostOfAPresetIsMissing) {
  ParamSet params = selected("pcss");
  params.set_text("filter.visibility", "bilateral_separable");
  EXPECT_EQ(session::technique_label(params), "pcss");
}

TEST(TechniqueLabel, ChoosingAnotherTechniqueTakesBackAModifiedPreset) {
  ParamSet params = selected("thesis_8x8");
  params.set("pcss.filter_taps", 12);
  session::choose_technique(params, session::all_techniques(), "hard");
  EXPECT_EQ(params.get_word("filter.visibility"), "none");
  EXPECT_EQ(session::technique_label(params), "hard");
}

}  // namespace
}  // namespace penumbra
