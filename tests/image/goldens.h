#pragma once

#include <span>
#include <vector>

namespace penumbra::test {

// How far a picture may differ from its golden picture on the renderer that recorded it: no channel by more than
// `steps` of 255, except in a share `share` of the pixels.
struct Tolerance {
  int steps;
  double share;
  const char* reason;
};

// A golden picture: an AOV of 160 × 90 pixels, kept with 8 bits a channel in tests/image/golden/NAME.png. One line of
// goldens.cpp makes one; scripts/goldens.sh records them again.
struct Golden {
  const char* name;                   // of the file
  const char* scene;                  // of scenes/, without .glb
  const char* technique;              // or preset
  std::vector<const char*> settings;  // "name=value"
  const Tolerance* tolerance;
  const char* aov = "shadow";
  int frames = 1;              // drawn, a 24th of a second apart; the last one is the picture
  float black = 0, white = 1;  // the AOV's values that are 0 and 255 in the file
};

std::span<const Golden> goldens();

}  // namespace penumbra::test
