#pragma once

#include <map>
#include <string>
#include <vector>

#include "capi/penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {

// A device and settings of the C interface in the current context, and the scenes of triangle_scene.h as a program of
// an engine would draw them: with programs of its own, by what the C interface tells.
class CInterface {
 public:
  explicit CInterface(gl::GetProcAddress get_proc_address);
  ~CInterface();
  CInterface(const CInterface&) = delete;
  CInterface& operator=(const CInterface&) = delete;

  penumbra_device* device = nullptr;
  penumbra_settings* settings = nullptr;
  std::vector<std::string> messages;  // of the log, each with its level in front: "2 text"

  // `inputs` as a frame that draws `geometry`; lights and overrides stay valid until the next call.
  penumbra_frame frame_of(const shadow::Inputs& inputs, const Geometry& geometry);
  // The mask of a frame, 4 values a pixel and layer after layer; fails the test if there is none.
  std::vector<float> render(const penumbra_frame& frame);
  // All values of the library's parameters.
  void set(const ParamSet& params);

  std::map<int32_t, int> passes;            // how often each kind of pass was drawn
  std::vector<penumbra_caster_pass> drawn;  // all passes, in order

 private:
  static int32_t draw(void* user, const penumbra_caster_pass* pass);
  GLuint program_of(const penumbra_caster_pass& pass);

  gl::GetProcAddress get_proc_address_;
  gl::ShaderFiles files_;
  const Geometry* geometry_ = nullptr;
  std::map<std::string, GLuint> programs_;
  std::vector<penumbra_light> lights_;
  std::vector<std::vector<const char*>> overrides_;
};

}  // namespace penumbra::test
