#pragma once

#include <string>

namespace penumbra::viewer {

// How far a picture is that is not finished.
struct Progress {
  int frames = 0;        // drawn at full size since something changed
  int wanted = 1;        // until it is finished: more than 1 where a technique accumulates a history
  bool refines = false;  // it is drawn once more then, with shadows of their own for all samples
  bool began = false;    // this history has only just begun
};

// What the status line says of it.
std::string text_of(const Progress& progress);

}  // namespace penumbra::viewer
