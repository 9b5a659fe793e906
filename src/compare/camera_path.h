#pragma once

#include <optional>

#include "compare/options.h"
#include "render/renderer.h"
#include "session/prepared_scene.h"

namespace penumbra::compare {

// The camera and the time of each frame of a comparison: the file's animation, or an orbit about the target. The orbit
// starts at the requested view; halfway it jumps, so that it also ends at that view.
class CameraPath {
 public:
  CameraPath(const CompareOptions& options, const session::PreparedScene& prepared);

  // The renderer's inputs for a frame of the range; the first one is a cut. `again`: the same frame is drawn once more.
  render::FrameInputs frame(int frame, bool again = false) const;
  // The lights of a frame that cast shadows.
  std::vector<render::FrameLight> lights(int frame) const;
  // The point that the first camera looks at, and the centre of the orbit.
  const glm::vec3& target() const { return target_; }
  // Whether view or time jump before this frame. Not for the first one.
  bool cuts(int frame) const;

 private:
  void orbit(render::Camera& camera, int frame) const;

  const CompareOptions& options_;
  const session::PreparedScene& prepared_;
  cli::FrameRange range_;
  glm::vec3 target_;
  std::optional<int> cut_;
};

}  // namespace penumbra::compare
