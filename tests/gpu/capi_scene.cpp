#include "capi_scene.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

namespace penumbra::test {

namespace {

void copy(const glm::mat4& from, float (&to)[16]) { std::copy_n(glm::value_ptr(from), 16, to); }
void copy(const glm::vec3& from, float (&to)[3]) { std::copy_n(glm::value_ptr(from), 3, to); }

void copy(const shadow::Box& from, penumbra_box& to) {
  copy(from.min, to.min);
  copy(from.max, to.max);
}

penumbra_texture texture(const shadow::TextureView& view) { return {view.id, view.width, view.height}; }

penumbra_light light_of(const shadow::Light& from) {
  penumbra_light light;
  EXPECT_EQ(penumbra_light_init(&light, sizeof light), PENUMBRA_OK);
  light.id = from.id;
  if (const auto* sun = std::get_if<shadow::Sun>(&from.source)) {
    copy(sun->to_light, light.to_light);
  } else {
    const auto& lamp = std::get<shadow::Lamp>(from.source);
    light.kind = PENUMBRA_LAMP;
    copy(lamp.position, light.position);
    copy(lamp.axis, light.axis);
    light.radius = lamp.radius;
    light.cone = lamp.cone;
    light.range = lamp.range;
  }
  if (!from.output) return light;
  light.output_texture = from.output->id;
  light.output_level = from.output->level;
  light.output_layer = from.output->layer;
  light.output_channel = from.output->channel;
  return light;
}

void attach(GLuint program, GLenum kind, const std::string& text) {
  const GLuint shader = gl::glCreateShader(kind);
  const char* start = text.c_str();
  gl::glShaderSource(shader, 1, &start, nullptr);
  gl::glCompileShader(shader);
  gl::glAttachShader(program, shader);
  gl::glDeleteShader(shader);
}

}  // namespace

CInterface::CInterface(gl::GetProcAddress get_proc_address) : get_proc_address_(get_proc_address) {
  Geometry::put_shaders(files_);
  penumbra_device_desc desc;
  EXPECT_EQ(penumbra_device_desc_init(&desc, sizeof desc), PENUMBRA_OK);
  desc.get_proc = [](void* user, const char* name) {
    return reinterpret_cast<penumbra_proc>(static_cast<CInterface*>(user)->get_proc_address_(name));
  };
  desc.get_proc_user = this;
  desc.log = [](void* user, int32_t level, const char* message) {
    static_cast<CInterface*>(user)->messages.push_back(fmt::format("{} {}", level, message));
  };
  desc.log_user = this;
  EXPECT_EQ(penumbra_device_create(&desc, &device), PENUMBRA_OK) << penumbra_last_error();
  EXPECT_EQ(penumbra_settings_create(&settings), PENUMBRA_OK);
}

CInterface::~CInterface() {
  penumbra_settings_destroy(settings);
  penumbra_device_destroy(device);
  for (const auto& [name, program] : programs_) gl::glDeleteProgram(program);
}

void CInterface::set(const ParamSet& params) {
  for (const Param& param : params.rows()) {
    EXPECT_EQ(penumbra_settings_set(settings, param.name.c_str(), to_text(params.value(param.name)).c_str()),
              PENUMBRA_OK)
        << penumbra_last_error();
  }
}

penumbra_frame CInterface::frame_of(const shadow::Inputs& inputs, const Geometry& geometry) {
  geometry_ = &geometry;
  lights_.clear();
  overrides_.clear();
  for (const shadow::Light& light : inputs.lights) {
    lights_.push_back(light_of(light));
    overrides_.emplace_back();
    for (const std::string& text : light.overrides) overrides_.back().push_back(text.c_str());
  }
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    lights_[i].overrides = overrides_[i].data();
    lights_[i].override_count = overrides_[i].size();
  }
  penumbra_frame frame;
  EXPECT_EQ(penumbra_frame_init(&frame, sizeof frame), PENUMBRA_OK);
  frame.view_id = inputs.view.id;
  frame.cut = inputs.view.cut ? 1 : 0;
  frame.restart = inputs.view.restart ? 1 : 0;
  frame.reversed_z = inputs.conventions.reversed_z ? 1 : 0;
  frame.depth_zero_to_one = inputs.conventions.depth_zero_to_one ? 1 : 0;
  frame.normals_encoding = inputs.conventions.octahedral_normals ? PENUMBRA_NORMALS_OCTAHEDRAL : PENUMBRA_NORMALS_XYZ;
  copy(inputs.view.view, frame.view);
  copy(inputs.view.projection, frame.projection);
  copy(inputs.view.last_view, frame.last_view);
  copy(inputs.view.last_projection, frame.last_projection);
  std::copy_n(glm::value_ptr(inputs.view.jitter), 2, frame.jitter);
  frame.depth = texture(inputs.depth);
  frame.normals = texture(inputs.normals);
  frame.motion = texture(inputs.motion);
  const shadow::Rect& viewport = inputs.viewport;
  std::copy_n(std::to_array({viewport.x, viewport.y, viewport.width, viewport.height}).begin(), 4, frame.viewport);
  frame.mask_details = inputs.mask_details ? 1 : 0;
  copy(inputs.casters, frame.casters);
  copy(inputs.receivers, frame.receivers);
  copy(inputs.forward_receivers, frame.forward_receivers);
  frame.moved_is_known = inputs.moved ? 1 : 0;
  if (inputs.moved) copy(*inputs.moved, frame.moved);
  frame.lights = lights_.data();
  frame.light_count = lights_.size();
  frame.draw = draw;
  frame.draw_user = this;
  frame.exact_bounds = inputs.exact_bounds ? 1 : 0;
  frame.normals_scale = inputs.conventions.normals_scale;
  frame.normals_offset = inputs.conventions.normals_offset;
  frame.normals_are_shading = inputs.conventions.shading_normals ? 1 : 0;
  frame.no_forward_surfaces = inputs.binds_forward ? 0 : 1;
  frame.depth_layer = inputs.depth.layer;
  frame.normals_layer = inputs.normals.layer;
  frame.motion_layer = inputs.motion.layer;
  return frame;
}

GLuint CInterface::program_of(const penumbra_caster_pass& pass) {
  const std::string name = fmt::format("{} {}", pass.kind, pass.program_id);
  if (const auto found = programs_.find(name); found != programs_.end()) return found->second;
  const GLuint program = gl::glCreateProgram();
  attach(program, GL_VERTEX_SHADER, gl::load_shader_source(files_, "test/caster.vert", {}).text);
  const char* fragment = pass.kind == PENUMBRA_PASS_SECOND_DEPTH ? "test/behind.frag" : "test/caster.frag";
  if (pass.kind == PENUMBRA_PASS_GEOMETRY) {
    attach(program, GL_GEOMETRY_SHADER, pass.geometry_shader);
    if (pass.fragment_shader != nullptr) attach(program, GL_FRAGMENT_SHADER, pass.fragment_shader);
  } else if (pass.kind != PENUMBRA_PASS_DEPTH) {
    attach(program, GL_FRAGMENT_SHADER, gl::load_shader_source(files_, fragment, {}).text);
  }
  gl::glLinkProgram(program);
  GLint linked = 0;
  gl::glGetProgramiv(program, GL_LINK_STATUS, &linked);
  EXPECT_EQ(linked, GL_TRUE) << name;
  return programs_[name] = program;
}

int32_t CInterface::draw(void* user, const penumbra_caster_pass* pass) {
  auto& self = *static_cast<CInterface*>(user);
  ++self.passes[pass->kind];
  self.drawn.push_back(*pass);
  const GLuint program = self.program_of(*pass);
  const auto place = [program](const char* name) { return gl::glGetUniformLocation(program, name); };
  gl::glUseProgram(program);
  gl::glUniformMatrix4fv(place("world_to_clip"), 1, GL_FALSE, pass->world_to_clip);
  const bool last = pass->kind == PENUMBRA_PASS_MOVED_LAST;
  gl::glUniform1i(place("only_moved"), last || pass->kind == PENUMBRA_PASS_MOVED_NOW ? 1 : 0);
  gl::glUniform1f(place("poses_ago"), last ? 1.0f : 0.0f);
  if (pass->kind == PENUMBRA_PASS_SECOND_DEPTH) gl::glUniform1f(place("gap"), pass->second_depth_gap);
  self.geometry_->draw();
  return 0;
}

std::vector<float> CInterface::render(const penumbra_frame& frame) {
  penumbra_mask mask{};
  mask.struct_size = sizeof mask;
  const penumbra_result result = penumbra_render(device, settings, &frame, &mask);
  EXPECT_EQ(result, PENUMBRA_OK) << penumbra_last_error();
  if (result != PENUMBRA_OK) return {};
  const gl::Texture texture = gl::Texture::wrap(mask.texture, gl::describe("mask", mask.texture));
  EXPECT_EQ(mask.format, texture.desc().format);
  EXPECT_EQ(mask.width, texture.width());
  EXPECT_EQ(mask.height, texture.height());
  EXPECT_EQ(mask.layers, texture.desc().layers);
  EXPECT_EQ(mask.view_id, frame.view_id);
  std::vector<float> all;
  for (int layer = 0; layer < mask.layers; ++layer) {
    const std::vector<float> values = gl::read_floats(texture, 4, 0, layer);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

}  // namespace penumbra::test
