#include "copies.h"

#include <string>

#include "light_frame.h"
#include "light_matrices.h"
#include "shadow_map.h"

namespace penumbra::shadow {

namespace {

using Source = TextureChecks::Source;

static_assert(first_pass_unit == 8, "the shaders have this number");

std::string prefix_of(const ViewState& view) { return view.prefix + "receivers/"; }

gl::ProgramDesc copy_program(const Source& source) {
  const bool array = source.target == GL_TEXTURE_2D_ARRAY || source.target == GL_TEXTURE_2D_MULTISAMPLE_ARRAY;
  return {.name = "copy receivers",
          .vertex = "shared/full_screen.vert",
          .fragment = "shadow/drivers/copy_receivers.frag",
          .defines = {{"ARRAY", array ? "1" : "0"}, {"SAMPLES", source.has_samples() ? "1" : "0"}}};
}

gl::ProgramDesc maps_program(bool atlas, bool compose) {
  return {.name = compose ? "compose map" : "copy maps",
          .vertex = "shared/full_screen.vert",
          .fragment = "shadow/drivers/copy_maps.frag",
          .defines = {{"ATLAS", atlas ? "1" : "0"}, {"COMPOSE", compose ? "1" : "0"}}};
}

const gl::Program& use_maps(gl::Device& device, gl::Pass& pass, const FinishedMaps& maps, int layer, bool compose) {
  const bool atlas = !maps.atlas.empty();
  const gl::Program& program = pass.use(maps_program(atlas, compose));
  if (atlas) {
    program.set("corner", maps.atlas[static_cast<std::size_t>(layer)]);
  } else {
    program.set("layer", layer);
  }
  program.set("reversed", maps.reversed ? 1 : 0);
  device.sampler({}).bind(first_pass_unit);
  gl::glBindTextureUnit(first_pass_unit, maps.depth.id);
  return program;
}

// Into the last layer of a projection, which holds all others, the coarsest first: a finer one replaces what it shows.
void compose_map(gl::Device& device, const gl::Texture& target, const FinishedMaps& maps) {
  const int count = maps.projection.given_layers();
  for (int layer = count - 1; layer >= 0; --layer) {
    gl::Attachment depth{.texture = &target, .layer = count};
    if (layer == count - 1) depth.clear = glm::vec4(1);
    gl::Pass pass(device, {.name = "compose map", .depth = depth, .depth_write = true});
    const ComposedPart part = composed_part(maps.projection, layer);
    if (glm::any(glm::greaterThan(part.texels.first, part.texels.last))) continue;
    const gl::Program& program = use_maps(device, pass, maps, layer, true);
    program.set("place", part.place);
    program.set("last", glm::ivec2(maps.projection.size() - 1));
    program.set("depths", part.depths);
    program.set("spread", part.spread);
    const glm::ivec2 first = part.texels.first, size = part.texels.last - first + 1;
    pass.set_viewport(first.x, first.y, size.x, size.y);
    pass.draw_full_screen();
  }
}

// One of the textures, and the format of its copy.
struct Copied {
  const char* name;
  TextureView& view;
  GLenum format;
};

void copy(gl::Device& device, const ViewState& view, const Inputs& inputs, const Copied& texture) {
  const Source& source = view.checked.source_of(texture.view);
  const gl::Texture& target =
      device.target(prefix_of(view) + texture.name,
                    {.format = texture.format, .width = texture.view.width, .height = texture.view.height});
  gl::Pass pass(device, {.name = "copy receivers", .colors = {{.texture = &target}}});
  const gl::Program& program = pass.use(copy_program(source));
  program.set("layer", texture.view.layer);
  program.set("sample_number", source.sample);
  device.sampler({}).bind(first_pass_unit);
  gl::glBindTextureUnit(first_pass_unit, texture.view.id);
  const Rect viewport = viewport_of(inputs);
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  pass.draw_full_screen();
  texture.view = {.id = target.id(), .width = target.width(), .height = target.height()};
}

}  // namespace

Inputs with_copies(gl::Device& device, ViewState& view, const Inputs& inputs) {
  Inputs copies = inputs;
  const auto needs_copy = [&](const TextureView& texture) {
    return texture.id != 0 && !view.checked.source_of(texture).is_plain();
  };
  const GLenum normals_format = inputs.conventions.octahedral_normals ? GL_RG32F : GL_RGBA32F;
  bool copied = false;
  const Source of_depth = view.checked.source_of(inputs.depth);
  for (const Copied& texture : {Copied{"depth", copies.depth, GL_R32F},
                                {"normals", copies.normals, normals_format},
                                {"motion", copies.motion, GL_RG32F}}) {
    if (!needs_copy(texture.view)) continue;
    copy(device, view, copies, texture);
    copied = true;
  }
  if (view.has_copies && !copied) device.drop(prefix_of(view));
  view.has_copies = copied;
  // Receivers that are elsewhere in their pixels than at the centres are those of a view with another jitter.
  const Rect viewport = viewport_of(inputs);
  copies.view.jitter -= 2.0f * (of_depth.place - 0.5f) / glm::vec2(viewport.width, viewport.height);
  return copies;
}

const gl::Texture& copy_maps(gl::Device& device, std::string_view name, const FinishedMaps& maps) {
  const gl::Texture& target = shadow_map_target(device, name, maps.projection);
  for (int layer = 0; layer < maps.projection.given_layers(); ++layer) {
    gl::Pass pass(device, {.name = "copy maps",
                           .depth = gl::Attachment{.texture = &target, .layer = layer, .dont_care = true},
                           .depth_write = true});
    use_maps(device, pass, maps, layer, false);
    pass.draw_full_screen();
  }
  if (maps.projection.given_layers() < maps.projection.layers()) compose_map(device, target, maps);
  return target;
}

std::array<gl::ProgramDesc, 7> copy_programs() {
  return {copy_program({.target = GL_TEXTURE_2D_ARRAY}),
          copy_program({.target = GL_TEXTURE_2D_MULTISAMPLE}),
          copy_program({.target = GL_TEXTURE_2D_MULTISAMPLE_ARRAY}),
          maps_program(true, false),
          maps_program(false, false),
          maps_program(true, true),
          maps_program(false, true)};
}

}  // namespace penumbra::shadow
