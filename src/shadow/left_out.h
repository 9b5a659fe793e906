#pragma once

#include <cstdint>
#include <optional>

#include "../gl/buffer.h"
#include "../gl/device.h"

namespace penumbra::shadow {

// Notices that OpenGL has left out what a frame drew, as it does while conditional rendering whose query found nothing
// or transform feedback is active. OpenGL can't be asked for the former, and a driver that works on another thread
// would have to wait to answer for the latter. So each frame ends with a dispatch that stores the frame's number and
// with a command that is never left out, which stores it in another place; the CPU reads both without a call. The
// dispatch is no gl::Pass, which ends with a memory barrier: software rasterisers finish at one what they draw.
class LeftOut {
 public:
  // At the end of a frame.
  void mark_frame(gl::Device& device);
  // Whether a frame since the last call that returned true was left out, as far as the GPU has completed them and the
  // frame after each.
  bool found();

 private:
  bool is_missing(std::uint32_t frame) const;
  bool is_missing_for_sure(std::uint32_t frame) const;

  std::optional<gl::ReadableBuffer> marks_;
  std::uint32_t frames_ = 0, checked_ = 0;
};

gl::ProgramDesc mark_frame_program();

}  // namespace penumbra::shadow
