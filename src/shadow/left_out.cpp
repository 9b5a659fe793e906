#include "left_out.h"

namespace penumbra::shadow {

namespace {

// Must match glsl/shadow/mark_frame.comp.
constexpr GLuint marks_binding = 7;
constexpr std::uint32_t places = 256;  // for numbers of drawn frames, which take turns with them

constexpr std::size_t last_frame = places;  // the word after them: stored for each frame, also if it was left out

// Numbers of frames start again at 0 after the greatest one.
std::int32_t later_by(std::uint32_t frame, std::uint32_t other) { return static_cast<std::int32_t>(frame - other); }

}  // namespace

gl::ProgramDesc mark_frame_program() { return {.name = "mark frame", .compute = "shadow/mark_frame.comp"}; }

void LeftOut::mark_frame(gl::Device& device) {
  if (!marks_) marks_.emplace("marks of frames", places + 1);
  ++frames_;
  const gl::Program& program = device.shaders.get(mark_frame_program());
  program.use();
  program.set("frame", static_cast<int>(frames_));
  marks_->bind_storage(marks_binding);
  gl::glDispatchCompute(1, 1, 1);
  marks_->write(last_frame, frames_);
}

bool LeftOut::found() {
  if (!marks_) return false;
  const std::uint32_t last = marks_->word(last_frame);
  bool left_out = false;
  // Not the last one, whose dispatch need not be complete yet.
  while (!left_out && later_by(last, checked_) > 1) {
    ++checked_;
    left_out = is_missing(checked_) && is_missing_for_sure(checked_);
  }
  if (left_out) checked_ = frames_;
  return left_out;
}

bool LeftOut::is_missing(std::uint32_t frame) const { return later_by(marks_->word(frame % places), frame) < 0; }

// Waits for the GPU, which no frame does in which nothing is amiss.
bool LeftOut::is_missing_for_sure(std::uint32_t frame) const {
  gl::glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
  gl::glFinish();
  return is_missing(frame);
}

}  // namespace penumbra::shadow
