// Shadows of surfaces that are drawn forward.
#include "device.h"
#include "frame.h"
#include "structs.h"

using namespace penumbra::capi;

penumbra_result penumbra_forward_source(penumbra_device* device, const penumbra_settings* settings,
                                        const penumbra_light* light, char* text, size_t capacity, size_t* length) {
  return run("penumbra_forward_source", [&] {
    const DeviceCall call(device);
    const penumbra::ParamSet& params = params_of(settings);
    const penumbra::shadow::Light given = light == nullptr ? penumbra::shadow::Light() : light_of(read_struct(light));
    write_text(call.shadows().forward_source(params, given), text, capacity, length);
  });
}

penumbra_result penumbra_bind_forward(penumbra_device* device, int32_t view_id, size_t light_index) {
  return run("penumbra_bind_forward", [&] {
    const DeviceCall call(device);
    const auto mask = device->masks.find(view_id);
    if (mask == device->masks.end()) fail_with(PENUMBRA_ERROR_ARGUMENT, "the view {} has no mask", view_id);
    const size_t lights = mask->second.lights.size();
    if (light_index >= lights) {
      fail_with(PENUMBRA_ERROR_ARGUMENT, "'light_index' is {} and the mask has {} lights", light_index, lights);
    }
    call.shadows().bind_forward(mask->second, light_index);
  });
}

penumbra_result penumbra_unbind_forward(penumbra_device* device) {
  return run("penumbra_unbind_forward", [&] {
    const DeviceCall call(device);
    call.shadows().unbind_forward();
  });
}
