#pragma once

#include <optional>

#include "compare/options.h"
#include "render/renderer.h"
#include "session/prepared_scene.h"

namespace penumbra::compare {

// Where the camera is in each frame of a comparison, and when: the file's animation, or an orbit about the target that
// leaves the view that was asked for, is cut, and comes back to it from the other side.
class CameraPath {
 public:
  CameraPath(const CompareOptions& options, const session::PreparedScene& prepared);

  // What a renderer draws for a frame of the range; the first one follows none. `again`: the frame before showed the
  // same.
  render::FrameInputs frame(int frame, bool again = false) const;
  // What the first camera looks at, and what an orbit is about.
  const glm::vec3& target() const { return target_; }
  // Whether frame shows another view or time than the one before leads to. The first frame does not count.
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
