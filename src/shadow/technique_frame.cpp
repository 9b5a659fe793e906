#include "technique_frame.h"

#include <fmt/format.h>

#include <cassert>
#include <stdexcept>

#include "../core/error.h"
#include "light_state.h"
#include "programs.h"

namespace penumbra::shadow {

namespace {

void bind_receivers(gl::Device& device, const Inputs& inputs) {
  for (const GLuint unit : {unit_receiver_depth, unit_receiver_normal}) device.sampler({}).bind(unit);
  gl::glBindTextureUnit(unit_receiver_depth, inputs.depth.id);
  gl::glBindTextureUnit(unit_receiver_normal, inputs.normals.id);
}

}  // namespace

const ParamSet& TechniqueFrame::params() const { return parts_.state.params; }

int TechniqueFrame::age() const { return static_cast<int>(parts_.state.age); }

const gl::Texture& TechniqueFrame::target(std::string_view name, const gl::TextureDesc& desc) const {
  return parts_.device.target(fmt::format("{}{}", parts_.prefix, name), desc);
}

const gl::Buffer& TechniqueFrame::scratch(std::string_view name, std::size_t bytes) const {
  return parts_.device.scratch(fmt::format("{}{}", parts_.prefix, name), bytes);
}

History TechniqueFrame::history(std::string_view name, const gl::TextureDesc& desc) const {
  LightState& state = parts_.state;
  LightState::Ring& ring = state.rings[std::string(name)];
  assert(ring.filled != state.frames);
  const bool valid = state.age > 0 && ring.desc == desc && ring.filled + 1 == state.frames;
  ring = {.desc = desc, .now = 1 - ring.now, .filled = state.frames};
  const auto texture = [&](int index) -> const gl::Texture& {
    return target(fmt::format("{}{}", ring_prefix(name), index), desc);
  };
  return {texture(1 - ring.now), texture(ring.now), valid};
}

void TechniqueFrame::bind_inputs() const {
  bind_light(parts_.device, parts_.frame, parts_.state);
  bind_receivers(parts_.device, parts_.inputs);
}

gl::ProgramDesc TechniqueFrame::own_program(std::string_view name) const {
  for (gl::ProgramDesc& own : parts_.programs.own(parts_.technique, parts_.state.params, parts_.state.rotated)) {
    if (own.name == parts_.programs.own_name(parts_.technique, name)) return std::move(own);
  }
  throw std::logic_error(fmt::format("technique '{}' has no program '{}'", parts_.technique.name, name));
}

const gl::Program& TechniqueFrame::use(gl::Pass& pass, std::string_view program) const {
  const gl::Program& used = pass.use(own_program(program));
  bind_inputs();
  return used;
}

bool TechniqueFrame::uses_compute() const { return params().get_word("driver") == "compute"; }

void TechniqueFrame::cover(gl::Pass& pass) const {
  const Rect& viewport = parts_.frame.viewport;
  if (uses_compute()) {
    pass.dispatch(viewport.width, viewport.height);
  } else {
    pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
    pass.draw_full_screen();
  }
}

void TechniqueFrame::evaluate(const gl::Texture& target, int layer) const {
  gl::PassDesc desc{.name = "shadow mask"};
  if (!uses_compute()) desc.colors = {{.texture = &target, .layer = layer}};
  gl::Pass pass(parts_.device, desc);
  const gl::Program& program = pass.use(
      parts_.programs.mask(parts_.technique, params(), {.rotated = parts_.state.rotated, .compute = uses_compute()}));
  bind_inputs();
  if (uses_compute()) {
    program.set("mask_layer", layer);
    target.bind_image(0, GL_WRITE_ONLY);
  }
  cover(pass);
}

void TechniqueFrame::check_draws() const {
  if (!parts_.inputs.draw) fail("technique '{}' draws casters, and Inputs::draw is empty", parts_.technique.name);
}

void TechniqueFrame::draw_casters(gl::Pass& pass, CasterKind kind, int layer) const {
  assert(kind != CasterKind::geometry);
  check_draws();
  const LightProjection& projection = parts_.frame.projection;
  parts_.inputs.draw({.kind = kind,
                      .layer = layer,
                      .world_to_clip = projection.world_to_clip(layer),
                      .cull = projection.cull_volume(layer)},
                     pass);
}

void TechniqueFrame::draw_caster_geometry(gl::Pass& pass, std::string_view program,
                                          const glm::mat4& world_to_clip) const {
  check_draws();
  bind_inputs();
  parts_.inputs.draw({.kind = CasterKind::geometry,
                      .layer = 0,
                      .world_to_clip = world_to_clip,
                      .cull = parts_.frame.projection.cull_volume_of_all(),
                      .program = own_program(program)},
                     pass);
}

}  // namespace penumbra::shadow
