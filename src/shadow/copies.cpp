#include "copies.h"

#include <string>

#include "light_frame.h"
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

gl::ProgramDesc maps_program(bool atlas) {
  return {.name = "copy maps",
          .vertex = "shared/full_screen.vert",
          .fragment = "shadow/drivers/copy_maps.frag",
          .defines = {{"ATLAS", atlas ? "1" : "0"}}};
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
  const bool atlas = !maps.atlas.empty();
  for (int layer = 0; layer < maps.projection.layers(); ++layer) {
    gl::Pass pass(device, {.name = "copy maps",
                           .depth = gl::Attachment{.texture = &target, .layer = layer, .clear = glm::vec4(0)},
                           .depth_test = gl::DepthTest::greater_equal,
                           .depth_write = true});
    const gl::Program& program = pass.use(maps_program(atlas));
    if (atlas) {
      program.set("corner", maps.atlas[static_cast<std::size_t>(layer)]);
    } else {
      program.set("layer", layer);
    }
    program.set("reversed", maps.reversed ? 1 : 0);
    device.sampler({}).bind(first_pass_unit);
    gl::glBindTextureUnit(first_pass_unit, maps.depth.id);
    pass.draw_full_screen();
  }
  return target;
}

std::array<gl::ProgramDesc, 5> copy_programs() {
  return {copy_program({.target = GL_TEXTURE_2D_ARRAY}), copy_program({.target = GL_TEXTURE_2D_MULTISAMPLE}),
          copy_program({.target = GL_TEXTURE_2D_MULTISAMPLE_ARRAY}), maps_program(true), maps_program(false)};
}

}  // namespace penumbra::shadow
