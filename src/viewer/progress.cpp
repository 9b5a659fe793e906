#include "viewer/progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra::viewer {

std::string text_of(const Progress& progress) {
  if (progress.wanted <= 1) return progress.refines && progress.frames == 1 ? "smoothing shadows" : "drawing";
  if (progress.frames == 0) return "history reset";
  return fmt::format("{}accumulating {}/{}", progress.began ? "history reset, " : "",
                     std::min(progress.frames, progress.wanted), progress.wanted);
}

}  // namespace penumbra::viewer
