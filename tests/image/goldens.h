#pragma once

#include <array>
#include <span>
#include <vector>

namespace penumbra::test {

// How far a picture may differ from its golden picture: no channel by more than `steps` of 255, except in a share
// `share` of the pixels in which the golden picture shows something. Those are the pixels that differ by more than
// `steps` from its background, which is its most frequent colour. So a picture that shows little may differ in few
// pixels only.
struct Tolerance {
  int steps;
  double share;
  const char* reason;
};

// Where a picture is taken from.
struct GoldenView {
  std::array<float, 3> eye, target;  // metres
  float fov;                         // of the picture's height, degrees
};

// A golden picture: an AOV of 160 × 90 pixels, kept with 8 bits a channel in tests/image/golden/NAME.png. One line of
// goldens.cpp makes one; scripts/goldens.sh records them again.
struct Golden {
  const char* name;                   // of the file
  const char* scene;                  // of scenes/, without .glb
  const char* technique;              // or preset
  std::vector<const char*> settings;  // "name=value"
  const Tolerance* tolerance;         // on the renderer that recorded it
  // Settings each of which switches off something that the picture is there to show, the most important one first: a
  // picture drawn with it must fail the comparison. Empty where no setting does that, as for depth and normals.
  std::vector<const char*> without;
  const char* aov = "shadow";
  int frames = 1;                    // drawn, a 24th of a second apart; the last one is the picture
  float black = 0, white = 1;        // the AOV's values that are 0 and 255 in the file
  const GoldenView* view = nullptr;  // null: the scene's first camera
};

std::span<const Golden> goldens();

// On a software renderer of another version than the one that recorded the picture.
const Tolerance& tolerance_of_other_versions();

}  // namespace penumbra::test
