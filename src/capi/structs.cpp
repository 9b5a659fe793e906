#include "structs.h"

namespace penumbra::capi {

namespace {

constexpr penumbra_box empty_box{{1, 1, 1}, {-1, -1, -1}};

void set_identity(float (&matrix)[16]) {
  for (std::size_t i = 0; i < 16; ++i) matrix[i] = i % 5 == 0 ? 1.0f : 0.0f;
}

}  // namespace

penumbra_device_desc StructTraits<penumbra_device_desc>::defaults() { return {}; }

penumbra_light StructTraits<penumbra_light>::defaults() {
  penumbra_light light{};
  light.kind = PENUMBRA_SUN;
  light.to_light[1] = 1;
  light.radius = 0.03f;
  light.maps_depth_zero_to_one = 1;
  return light;
}

penumbra_frame StructTraits<penumbra_frame>::defaults() {
  penumbra_frame frame{};
  frame.reversed_z = 1;
  frame.depth_zero_to_one = 1;
  frame.normals_encoding = PENUMBRA_NORMALS_OCTAHEDRAL;
  frame.normals_scale = 1;
  for (auto* matrix : {&frame.view, &frame.projection, &frame.last_view, &frame.last_projection}) set_identity(*matrix);
  for (penumbra_box* box : {&frame.casters, &frame.receivers, &frame.forward_receivers, &frame.moved}) *box = empty_box;
  return frame;
}

}  // namespace penumbra::capi

using namespace penumbra::capi;

penumbra_result penumbra_device_desc_init(penumbra_device_desc* desc, size_t struct_size) {
  return run("penumbra_device_desc_init", [&] { init_struct(&required(desc, "desc"), struct_size); });
}

penumbra_result penumbra_light_init(penumbra_light* light, size_t struct_size) {
  return run("penumbra_light_init", [&] { init_struct(&required(light, "light"), struct_size); });
}

penumbra_result penumbra_frame_init(penumbra_frame* frame, size_t struct_size) {
  return run("penumbra_frame_init", [&] { init_struct(&required(frame, "frame"), struct_size); });
}
