// Before the window closes it asks about exactly what would be lost.
#include "viewer/unsaved.h"

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra {
namespace {

using viewer::Edit;
using viewer::SavedState;
using viewer::unsaved;

Edit plain() {
  Edit edit;
  edit.a = ParamSet(render::Renderer::params(session::all_techniques()));
  return edit;
}

SavedState saved_as(const Edit& edit) { return {.view = edit, .preset = "", .params = edit.a}; }

TEST(ViewerUnsaved, NothingIsWhereNothingChanged) { EXPECT_FALSE(unsaved(saved_as(plain()), plain()).any()); }

TEST(ViewerUnsaved, EachPropertyOfTheLightsIs) {
  const SavedState saved = saved_as(plain());
  for (const auto& change : std::vector<void (*)(cli::SceneOptions&)>{
           [](auto& options) { options.sun = cli::Direction{.azimuth = 0.1f, .elevation = 1}; },
           [](auto& options) { options.no_sun = true; },
           [](auto& options) { options.lights = std::vector<std::string>{"0"}; },
           [](auto& options) { options.lamp_radius = 0.2; },
           [](auto& options) { options.lamps.push_back({}); },
       }) {
    Edit now = plain();
    change(now.view);
    EXPECT_TRUE(unsaved(saved, now).view);
    EXPECT_FALSE(unsaved(saved, now).preset);
    EXPECT_FALSE(unsaved(saved_as(now), now).any());
  }
}

TEST(ViewerUnsaved, AnotherCameraIsNone) {
  Edit now = plain();
  now.view.eye = {1, 2, 3};
  now.view.target = {0, 0, 0};
  now.view.fov = 30;
  EXPECT_FALSE(unsaved(saved_as(plain()), now).any());
}

TEST(ViewerUnsaved, ABookmarkIs) {
  Edit now = plain();
  now.bookmarks[8] = viewer::Bookmark{.eye = {1, 2, 3}, .target = {0, 0, 0}, .fov = 40};
  EXPECT_TRUE(unsaved(saved_as(plain()), now).view);
  EXPECT_FALSE(unsaved(saved_as(now), now).any());
}

TEST(ViewerUnsaved, ParametersAreOnlyWhereAPresetIsOpen) {
  SavedState saved = saved_as(plain());
  Edit now = plain();
  now.a.set("sun.angle", 3.0f);
  EXPECT_FALSE(unsaved(saved, now).any());
  saved.preset = "mine.toml";
  EXPECT_TRUE(unsaved(saved, now).preset);
  EXPECT_FALSE(unsaved(saved, now).view);
  now.a.reset("sun.angle");
  EXPECT_FALSE(unsaved(saved, now).any());
}

}  // namespace
}  // namespace penumbra
