#include "frame.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "../core/error.h"
#include "../shadow/light_matrices.h"
#include "structs.h"

namespace penumbra::capi {

namespace {

constexpr std::size_t most_lights = 256;

glm::vec3 vec3_of(const float (&values)[3]) { return {values[0], values[1], values[2]}; }

glm::mat4 matrix_of(const float (&values)[16], const char* name) {
  require_finite(values, name);
  return glm::make_mat4(values);
}

// Of any length but 0: one that is not of unit length is made so.
glm::vec3 direction_of(const float (&values)[3], const char* name) {
  require_finite(values, name);
  const glm::dvec3 direction(vec3_of(values));
  const double squared = glm::dot(direction, direction);
  constexpr double rounding = 1e-5;
  if (squared == 0 || std::abs(squared - 1) < rounding) return direction;
  return direction / std::sqrt(squared);
}

shadow::Box box_of(const penumbra_box& box, const char* name) {
  require_finite(box.min, name);
  require_finite(box.max, name);
  return {vec3_of(box.min), vec3_of(box.max)};
}

shadow::TextureView texture_of(const penumbra_texture& texture, int32_t layer) {
  return {.id = texture.id, .width = texture.width, .height = texture.height, .layer = layer};
}

shadow::LightSource source_of(const penumbra_light& light) {
  if (light.kind == PENUMBRA_SUN) {
    return shadow::Sun{.to_light = direction_of(light.to_light, "penumbra_light.to_light")};
  }
  if (light.kind != PENUMBRA_LAMP) {
    fail_with(PENUMBRA_ERROR_ARGUMENT, "penumbra_light.kind is {}; it is PENUMBRA_SUN or PENUMBRA_LAMP", light.kind);
  }
  require_finite(light.position, "penumbra_light.position");
  const float numbers[] = {light.radius, light.cone, light.range};
  require_finite(numbers, "penumbra_light.radius, cone or range");
  return shadow::Lamp{.position = vec3_of(light.position),
                      .radius = light.radius,
                      .axis = direction_of(light.axis, "penumbra_light.axis"),
                      .cone = light.cone,
                      .range = light.range};
}

shadow::Conventions conventions_of(const penumbra_frame& frame) {
  if (frame.normals_encoding != PENUMBRA_NORMALS_OCTAHEDRAL && frame.normals_encoding != PENUMBRA_NORMALS_XYZ) {
    fail_with(PENUMBRA_ERROR_ARGUMENT,
              "penumbra_frame.normals_encoding is {}; it is PENUMBRA_NORMALS_OCTAHEDRAL or "
              "PENUMBRA_NORMALS_XYZ",
              frame.normals_encoding);
  }
  const float decoding[] = {frame.normals_scale, frame.normals_offset};
  require_finite(decoding, "penumbra_frame.normals_scale or normals_offset");
  return {.reversed_z = frame.reversed_z != 0,
          .depth_zero_to_one = frame.depth_zero_to_one != 0,
          .octahedral_normals = frame.normals_encoding == PENUMBRA_NORMALS_OCTAHEDRAL,
          .normals_scale = frame.normals_scale,
          .normals_offset = frame.normals_offset,
          .shading_normals = frame.normals_are_shading != 0};
}

int32_t kind_of(shadow::CasterKind kind) {
  switch (kind) {
    case shadow::CasterKind::depth:
      return PENUMBRA_PASS_DEPTH;
    case shadow::CasterKind::depth_and_moved:
      return PENUMBRA_PASS_DEPTH_AND_MOVED;
    case shadow::CasterKind::moved_now:
      return PENUMBRA_PASS_MOVED_NOW;
    case shadow::CasterKind::moved_last:
      return PENUMBRA_PASS_MOVED_LAST;
    case shadow::CasterKind::second_depth:
      return PENUMBRA_PASS_SECOND_DEPTH;
    case shadow::CasterKind::geometry:
      break;
  }
  return PENUMBRA_PASS_GEOMETRY;
}

const CasterProgram& texts_of(const gl::ProgramDesc& desc, penumbra_device& device) {
  const auto found = device.caster_programs.find(desc);
  if (found != device.caster_programs.end()) return found->second;
  const auto text = [&](const std::string& file) {
    if (file.empty()) return std::string();
    return gl::load_shader_source(device.objects->device.shaders.files(), file, desc.defines).text;
  };
  CasterProgram program{.geometry = text(desc.geometry), .fragment = text(desc.fragment)};
  std::uint64_t last_id = 0;
  for (const auto& [other_desc, other] : device.caster_programs) {
    if (other.geometry == program.geometry && other.fragment == program.fragment) program.id = other.id;
    last_id = std::max(last_id, other.id);
  }
  if (program.id == 0) program.id = last_id + 1;
  return device.caster_programs.emplace(desc, std::move(program)).first->second;
}

penumbra_caster_pass pass_of(const shadow::CasterPass& casters, penumbra_device& device) {
  penumbra_caster_pass pass{};
  pass.struct_size = sizeof pass;
  pass.kind = kind_of(casters.kind);
  pass.layer = casters.layer;
  std::copy_n(glm::value_ptr(casters.world_to_clip), 16, pass.world_to_clip);
  std::copy_n(glm::value_ptr(casters.anchored.to_clip), 16, pass.anchored_to_clip);
  std::copy_n(glm::value_ptr(casters.anchored.anchor), 3, pass.anchor);
  for (std::size_t i = 0; i < casters.cull.planes.size(); ++i) {
    std::copy_n(glm::value_ptr(casters.cull.planes[i]), 4, pass.cull_planes[i]);
  }
  const glm::vec4 place = shadow::place_of(casters.source);
  std::copy_n(glm::value_ptr(place), 4, pass.light_place);
  pass.second_depth_gap = casters.gap;
  if (casters.kind == shadow::CasterKind::geometry) {
    const CasterProgram& program = texts_of(casters.program, device);
    pass.program_id = program.id;
    pass.geometry_shader = program.geometry.empty() ? nullptr : program.geometry.c_str();
    pass.fragment_shader = program.fragment.empty() ? nullptr : program.fragment.c_str();
  }
  return pass;
}

glm::vec3 camera_of(const glm::mat4& view) { return glm::vec3(glm::inverse(glm::dmat4(view))[3]); }

// Of the maps of a light that brings some.
shadow::LightProjection map_projection_of(const penumbra_light& light, const shadow::Inputs& inputs) {
  const int most = light.kind == PENUMBRA_LAMP ? 1 : shadow::max_layers;
  if (light.maps_count < 1 || light.maps_count > most) {
    fail_with(PENUMBRA_ERROR_ARGUMENT, "penumbra_light.maps_count is {}; it is 1{}", light.maps_count,
              most == 1 ? " for a lamp" : fmt::format(" to {}", most));
  }
  const auto count = static_cast<std::size_t>(light.maps_count);
  required(light.maps_world_to_clip, "penumbra_light.maps_world_to_clip");
  std::vector<glm::mat4> matrices;
  for (std::size_t i = 0; i < count; ++i) {
    float values[16];
    std::copy_n(light.maps_world_to_clip + 16 * i, 16, values);
    matrices.push_back(matrix_of(values, "penumbra_light.maps_world_to_clip"));
  }
  if (light.kind == PENUMBRA_LAMP)
    return shadow::spot_projection({.world_to_clip = matrices[0],
                                    .depth_zero_to_one = light.maps_depth_zero_to_one != 0,
                                    .reversed = light.maps_reversed != 0,
                                    .lamp = std::get<shadow::Lamp>(source_of(light)),
                                    .size = light.maps_size});
  return shadow::sun_projection({.world_to_clip = matrices,
                                 .depth_zero_to_one = light.maps_depth_zero_to_one != 0,
                                 .reversed = light.maps_reversed != 0,
                                 .to_light = direction_of(light.to_light, "penumbra_light.to_light"),
                                 .size = light.maps_size,
                                 .camera = camera_of(inputs.view.view),
                                 .casters = inputs.casters});
}

shadow::FinishedMaps maps_of(const penumbra_light& light, const shadow::Inputs& inputs) {
  shadow::FinishedMaps maps{.depth = texture_of(light.maps, 0),
                            .projection = map_projection_of(light, inputs),
                            .reversed = light.maps_reversed != 0};
  if (light.maps_atlas == nullptr) return maps;
  const auto count = static_cast<std::size_t>(light.maps_count);
  for (std::size_t i = 0; i < count; ++i) maps.atlas.emplace_back(light.maps_atlas[2 * i], light.maps_atlas[2 * i + 1]);
  return maps;
}

}  // namespace

shadow::Light light_of(const penumbra_light& light) {
  if (light.reserved != 0) fail_with(PENUMBRA_ERROR_ARGUMENT, "penumbra_light.reserved is not 0");
  shadow::Light made{.id = light.id, .source = source_of(light), .overrides = {}, .maps = {}};
  if (light.output_texture != 0) {
    made.output = shadow::OutputTexture{.id = light.output_texture,
                                        .level = light.output_level,
                                        .layer = light.output_layer,
                                        .channel = light.output_channel};
  }
  if (light.override_count == 0) return made;
  required(light.overrides, "penumbra_light.overrides");
  for (std::size_t i = 0; i < light.override_count; ++i) {
    made.overrides.emplace_back(&required(light.overrides[i], "penumbra_light.overrides[]"));
  }
  return made;
}

std::vector<shadow::Light> lights_of(const penumbra_light* lights, std::size_t count, const shadow::Inputs* inputs) {
  if (count > most_lights) fail_with(PENUMBRA_ERROR_ARGUMENT, "{} lights: at most {}", count, most_lights);
  std::vector<shadow::Light> made;
  if (count == 0) return made;
  required(lights, "lights");
  const std::size_t size = lights->struct_size;
  check_size<penumbra_light>(size);
  const auto* bytes = reinterpret_cast<const unsigned char*>(lights);
  for (std::size_t i = 0; i < count; ++i) {
    const auto* light = reinterpret_cast<const penumbra_light*>(bytes + i * size);
    if (light->struct_size != size) {
      fail_with(PENUMBRA_ERROR_ARGUMENT, "penumbra_light.struct_size is {} in lights[{}] and {} in lights[0]",
                light->struct_size, i, size);
    }
    const penumbra_light known = read_struct(light);
    made.push_back(light_of(known));
    if (inputs != nullptr && known.maps.id != 0) made.back().maps = maps_of(known, *inputs);
  }
  return made;
}

shadow::Inputs inputs_of(const penumbra_frame& frame) {
  if (frame.reserved != 0) fail_with(PENUMBRA_ERROR_ARGUMENT, "penumbra_frame.reserved is not 0");
  if (frame.reserved_2 != 0) fail_with(PENUMBRA_ERROR_ARGUMENT, "penumbra_frame.reserved_2 is not 0");
  if (frame.reserved_3 != 0) fail_with(PENUMBRA_ERROR_ARGUMENT, "penumbra_frame.reserved_3 is not 0");
  require_finite(frame.jitter, "penumbra_frame.jitter");
  shadow::Inputs inputs;
  inputs.view = {.view = matrix_of(frame.view, "penumbra_frame.view"),
                 .projection = matrix_of(frame.projection, "penumbra_frame.projection"),
                 .last_view = matrix_of(frame.last_view, "penumbra_frame.last_view"),
                 .last_projection = matrix_of(frame.last_projection, "penumbra_frame.last_projection"),
                 .jitter = {frame.jitter[0], frame.jitter[1]},
                 .id = frame.view_id,
                 .cut = frame.cut != 0,
                 .restart = frame.restart != 0};
  inputs.conventions = conventions_of(frame);
  inputs.depth = texture_of(frame.depth, frame.depth_layer);
  inputs.normals = texture_of(frame.normals, frame.normals_layer);
  inputs.motion = texture_of(frame.motion, frame.motion_layer);
  inputs.viewport = {frame.viewport[0], frame.viewport[1], frame.viewport[2], frame.viewport[3]};
  inputs.casters = box_of(frame.casters, "penumbra_frame.casters");
  inputs.receivers = box_of(frame.receivers, "penumbra_frame.receivers");
  inputs.exact_bounds = frame.exact_bounds != 0;
  inputs.forward_receivers = box_of(frame.forward_receivers, "penumbra_frame.forward_receivers");
  if (frame.moved_is_known != 0) inputs.moved = box_of(frame.moved, "penumbra_frame.moved");
  inputs.mask_details = frame.mask_details != 0;
  inputs.binds_forward = frame.no_forward_surfaces == 0;
  return inputs;
}

shadow::DrawCasters casters_of(const penumbra_frame& frame, penumbra_device& device) {
  if (frame.draw == nullptr) return {};
  return [draw = frame.draw, user = frame.draw_user, view = frame.view_id, &device](const shadow::CasterPass& casters,
                                                                                    gl::Pass&) {
    penumbra_caster_pass pass = pass_of(casters, device);
    pass.view_id = view;
    const int32_t answer = draw(user, &pass);
    if (answer != 0) fail_with(PENUMBRA_ERROR_CALLBACK, "the caster callback returned {}", answer);
  };
}

namespace {

// Runs what draws a frame of a view, within one call with the device. If it fails, the view's next frame begins anew,
// since what moved in this one will not be said again; and unless an argument was wrong, the view has no mask.
template <class Draw>
void draw_view(penumbra_device& device, int view, const Draw& draw) {
  const OneCall one(device);
  const auto interrupt = [&] {
    if (device.objects != nullptr) device.objects->shadows.interrupt_view(view);
  };
  const auto drop = [&] {
    device.masks.erase(view);
    interrupt();
  };
  try {
    draw(DeviceCall(device, one));
  } catch (const Failure& failure) {
    failure.result() == PENUMBRA_ERROR_ARGUMENT ? interrupt() : drop();
    throw;
  } catch (...) {
    drop();
    throw;
  }
}

}  // namespace

}  // namespace penumbra::capi

using namespace penumbra::capi;

penumbra_result penumbra_render(penumbra_device* device, const penumbra_settings* settings, const penumbra_frame* frame,
                                penumbra_mask* mask) {
  return run("penumbra_render", [&] {
    required(device, "device");
    const penumbra_frame given = read_struct(&required(frame, "frame"));
    draw_view(*device, given.view_id, [&](const DeviceCall& call) {
      const penumbra::ParamSet& params = params_of(settings);
      check_size<penumbra_mask>(required(mask, "mask").struct_size);
      penumbra::shadow::Inputs inputs = inputs_of(given);
      const std::vector<penumbra::shadow::Light> lights = lights_of(given.lights, given.light_count, &inputs);
      inputs.lights = lights;
      inputs.draw = casters_of(given, *device);
      constexpr std::size_t most_idle_programs = 512;  // so that all that was warmed up stays
      device->objects->device.shaders.keep_idle(most_idle_programs);
      device->objects->device.shaders.next_frame();
      device->masks.erase(given.view_id);
      const penumbra::shadow::Mask& made = device->masks[given.view_id] = call.shadows().render(inputs, params);
      const penumbra::gl::TextureDesc& desc = made.texture->desc();
      penumbra_mask out{};
      out.texture = made.texture->id();
      out.format = desc.format;
      out.width = desc.width;
      out.height = desc.height;
      out.layers = desc.layers;
      out.view_id = given.view_id;
      write_struct(mask, out);
    });
  });
}

penumbra_result penumbra_reads_motion(penumbra_device* device, const penumbra_settings* settings,
                                      const penumbra_light* lights, size_t light_count, uint32_t* reads) {
  return run("penumbra_reads_motion", [&] {
    const DeviceCall call(device);
    const penumbra::ParamSet& params = params_of(settings);
    required(reads, "reads") = call.shadows().reads_motion(params, lights_of(lights, light_count)) ? 1 : 0;
  });
}

penumbra_result penumbra_forget_view(penumbra_device* device, int32_t view_id) {
  return run("penumbra_forget_view", [&] {
    DeviceCall call(device);
    call.look_for_context();  // else what is deleted without it would be lost
    call.shadows().forget_view(view_id);
    device->masks.erase(view_id);
  });
}

penumbra_result penumbra_warm_up(penumbra_device* device, const penumbra_settings* settings,
                                 const penumbra_frame* frame) {
  return run("penumbra_warm_up", [&] {
    const DeviceCall call(device);
    const penumbra::ParamSet& params = params_of(settings);
    const penumbra_frame given = read_struct(&required(frame, "frame"));
    call.shadows().warm_up({.conventions = conventions_of(given),
                            .lights = lights_of(given.lights, given.light_count),
                            .mask_details = given.mask_details != 0,
                            .binds_forward = given.no_forward_surfaces == 0,
                            .depth = {.id = given.depth.id},
                            .normals = {.id = given.normals.id},
                            .motion = {.id = given.motion.id}},
                           params);
  });
}
