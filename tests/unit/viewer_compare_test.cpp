// What picture B of the viewer shares with picture A.
#include <gtest/gtest.h>

#include "render/renderer.h"
#include "session/techniques.h"
#include "viewer/state.h"

namespace penumbra {
namespace {

class ViewerCompare : public testing::Test {
 protected:
  ViewerCompare() { state_.document.params = ParamSet(render::Renderer::params(session::all_techniques())); }

  viewer::UiState state_;
};

TEST_F(ViewerCompare, BIsLitAsAIs) {
  state_.compare(true);
  const std::vector<std::string> shared{"sun.angle=3", "casters.skies=on", "lamps.near=0.5", "exposure.ev=1"};
  for (const std::string& assignment : shared) state_.document.params.assign(assignment);
  state_.document.params.set("lamps.size", 64);
  const ParamSet b = state_.document_b().params;
  for (const std::string& assignment : shared) {
    const std::string name = assignment.substr(0, assignment.find('='));
    EXPECT_FALSE(b.is_default(name)) << name;
    EXPECT_EQ(b.value(name), state_.document.params.value(name)) << name;
  }
  EXPECT_TRUE(b.is_default("lamps.size")) << "maps are those of a side";
}

TEST_F(ViewerCompare, AReferenceIsOfAllPixels) {
  state_.document.params.set("mask.scale", 4);
  state_.compare(true);
  EXPECT_EQ(state_.document_b().params.get_word("technique"), "truth");
  EXPECT_EQ(state_.document_b().params.get_int("mask.scale"), 1);
}

}  // namespace
}  // namespace penumbra
