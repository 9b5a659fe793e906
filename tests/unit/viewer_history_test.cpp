// Undo and redo: what counts as one step, how far back they go, and what they bring back.
#include "viewer/history.h"

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "session/techniques.h"
#include "viewer/edit.h"

namespace penumbra {
namespace {

using Numbers = viewer::History<int>;

// A history at the last of these states, each a step.
Numbers stepped(std::initializer_list<int> states) {
  Numbers history;
  for (const int state : states) history.note(state, false);
  return history;
}

TEST(ViewerHistory, GoesBackAndForthStepByStep) {
  Numbers history = stepped({1, 2, 2, 3});
  EXPECT_EQ(history.undo(3), 2);
  EXPECT_EQ(history.undo(2), 1);
  EXPECT_FALSE(history.can_undo());
  EXPECT_FALSE(history.undo(1));
  EXPECT_EQ(history.redo(1), 2);
  EXPECT_EQ(history.redo(2), 3);
  EXPECT_FALSE(history.can_redo());
  EXPECT_FALSE(history.redo(3));
}

TEST(ViewerHistory, WhatChangesWhileItIsHeldIsOneStep) {
  Numbers history = stepped({1});
  for (int state = 2; state < 50; ++state) history.note(state, true);
  EXPECT_FALSE(history.can_undo()) << "the user still holds it";
  history.note(50, false);
  EXPECT_EQ(history.undo(50), 1);
  EXPECT_EQ(history.redo(1), 50);
}

TEST(ViewerHistory, WhatComesBackToWhereItWasIsNoStep) {
  Numbers history = stepped({1});
  history.note(2, true);
  history.note(1, false);
  EXPECT_FALSE(history.can_undo());
}

TEST(ViewerHistory, AChangeThatIsStillHeldIsUndoneAsAWhole) {
  Numbers history = stepped({1, 2});
  history.note(7, true);
  EXPECT_EQ(history.undo(8), 2);
  EXPECT_EQ(history.redo(2), 8);
}

TEST(ViewerHistory, AChangeAfterUndoTakesThePlaceOfWhatWasUndone) {
  Numbers history = stepped({1, 2, 3});
  EXPECT_EQ(history.undo(3), 2);
  history.note(9, false);
  EXPECT_FALSE(history.can_redo());
  EXPECT_EQ(history.undo(9), 2);
  EXPECT_EQ(history.undo(2), 1);
}

TEST(ViewerHistory, IsBounded) {
  Numbers history;
  const int last = 3 * static_cast<int>(Numbers::most);
  for (int state = 0; state <= last; ++state) history.note(state, false);
  int now = last, steps = 0;
  while (const std::optional<int> before = history.undo(now)) {
    now = *before;
    ++steps;
  }
  EXPECT_EQ(steps, static_cast<int>(Numbers::most));
  EXPECT_EQ(now, last - steps);
}

TEST(ViewerHistory, StartingAgainForgetsAll) {
  Numbers history = stepped({1, 2, 3});
  history.undo(3);
  history.start(5);
  EXPECT_FALSE(history.can_undo() || history.can_redo());
}

struct Shown {
  viewer::Document document{.options = {}, .params = ParamSet(render::Renderer::params(session::all_techniques()))};
  viewer::Comparison comparison;
  viewer::Bookmarks bookmarks;

  viewer::Edit edit() const { return edit_of(document, comparison, bookmarks); }
};

TEST(ViewerEdit, CameraBookmarksSunLightsAndParametersAreStepsAndComeBack) {
  using Change = void (*)(Shown&);
  const std::vector<Change> changes{
      [](Shown& s) { s.document.options.camera = "1"; },
      [](Shown& s) { s.document.options.eye = s.document.options.target = glm::vec3(1, 2, 3); },
      [](Shown& s) { s.document.options.fov = 30; },
      [](Shown& s) { s.document.options.sun = cli::Direction{.azimuth = 1, .elevation = 0.5f}; },
      [](Shown& s) { s.document.options.no_sun = true; },
      [](Shown& s) {
        s.document.options.lights = {{"0", "2"}};
      },
      [](Shown& s) {
        s.document.options.lamps.push_back({.position = {0, 1, 0}});
      },
      [](Shown& s) { s.document.params.set("sun.angle", 3.0f); },
      [](Shown& s) { s.document.params.set_text("technique", "none"); },
      [](Shown& s) { s.comparison.params.set("sun.angle", 4.0f); },
      [](Shown& s) {
        s.bookmarks[2] = {.eye = {1, 2, 3}, .target = {0, 0, 0}, .fov = 40};
      },
      [](Shown& s) { s.bookmarks[2].reset(); },
  };
  Shown shown;
  shown.comparison.params = shown.document.params;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE(i);
    const viewer::Edit before = shown.edit();
    changes[i](shown);
    const viewer::Edit after = shown.edit();
    EXPECT_NE(after, before);
    restore(before, shown.document, shown.comparison, shown.bookmarks);
    EXPECT_EQ(shown.edit(), before);
    restore(after, shown.document, shown.comparison, shown.bookmarks);
    EXPECT_EQ(shown.edit(), after);
  }
}

TEST(ViewerEdit, SceneSizeAndTimeAreNoStepsAndStay) {
  Shown shown;
  const viewer::Edit before = shown.edit();
  shown.document.options.scene = "other.glb";
  shown.document.options.size = {10, 20};
  shown.document.frame = 4;
  EXPECT_EQ(shown.edit(), before);
  shown.document.params.set("sun.angle", 3.0f);
  restore(before, shown.document, shown.comparison, shown.bookmarks);
  EXPECT_EQ(shown.document.options.scene, "other.glb");
  EXPECT_EQ(shown.document.options.size.height, 20);
  EXPECT_EQ(shown.document.frame, 4);
}

TEST(ViewerEdit, ThatBIsShownForTheFirstTimeIsNoStepButItsChangesAre) {
  Shown shown;
  viewer::History<viewer::Edit> history;
  history.note(shown.edit(), false);
  shown.document.params.set("sun.angle", 3.0f);
  history.note(shown.edit(), false);
  shown.comparison.params = shown.document.params;
  history.note(shown.edit(), false);
  restore(*history.undo(shown.edit()), shown.document, shown.comparison, shown.bookmarks);
  EXPECT_FALSE(history.can_undo());
  EXPECT_FALSE(shown.comparison.params.rows().empty());
  history.note(shown.edit(), false);
  EXPECT_TRUE(history.can_redo());
  shown.comparison.params.set("sun.angle", 5.0f);
  history.note(shown.edit(), false);
  restore(*history.undo(shown.edit()), shown.document, shown.comparison, shown.bookmarks);
  EXPECT_EQ(shown.comparison.params.get_float("sun.angle"), 3.0f);
}

}  // namespace
}  // namespace penumbra
