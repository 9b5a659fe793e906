#include "mask_scale.h"

#include <fmt/format.h>

#include "mask_pass.h"
#include "tiles.h"

namespace penumbra::shadow {

namespace {

glm::ivec2 scaled_size(const Rect& viewport, int scale) {
  return {(viewport.width + scale - 1) / scale, (viewport.height + scale - 1) / scale};
}

TextureView view_of(const gl::Texture& texture) { return {texture.id(), texture.width(), texture.height()}; }

// From the caller's NDC to those of a view that has only every scale-th pixel: x' = scale x + offset.
struct NdcMap {
  glm::dvec2 scale{1}, offset{0};
};

// Pixel i of such a view is pixel scale · i of the caller's: their centres are at (2 i + 1) / size - 1 there and
// (2 scale i + 1) / width - 1 here.
NdcMap ndc_map(const Rect& viewport, int scale) {
  const glm::dvec2 of_all(viewport.width, viewport.height);
  const glm::dvec2 covered = static_cast<double>(scale) * glm::dvec2(scaled_size(viewport, scale));
  return {of_all / covered, (of_all + static_cast<double>(scale - 1)) / covered - 1.0};
}

glm::mat4 mapped(const glm::mat4& projection, const NdcMap& map) {
  glm::dmat4 result(projection);
  for (int column = 0; column < 4; ++column) {
    glm::dvec4& values = result[column];
    values.x = map.scale.x * values.x + map.offset.x * values.w;
    values.y = map.scale.y * values.y + map.offset.y * values.w;
  }
  return glm::mat4(result);
}

}  // namespace

int mask_scale(const Technique& technique, const ParamSet& params, const gl::Texture& mask) {
  // Lists of pixels must fit into the storage buffers that OpenGL guarantees, 2^27 bytes.
  constexpr std::size_t most_pixels = 30'000'000;
  return technique.resolve || pixel_count(mask) > most_pixels ? 1 : params.get_int("mask.scale");
}

gl::ProgramDesc scaled_receivers_program() {
  return {.name = "scaled receivers",
          .vertex = "shared/full_screen.vert",
          .fragment = "shadow/drivers/scaled_receivers.frag"};
}

ScaledInputs scaled_inputs(const LightWork& work, const std::string& prefix, int scale) {
  const Inputs& inputs = work.inputs;
  gl::Device& device = work.device;
  const Rect viewport = viewport_of(inputs);
  const glm::ivec2 size = scaled_size(viewport, scale);
  const NdcMap map = ndc_map(viewport, scale);
  // As large as the textures need at most: a view whose viewport varies from frame to frame then keeps them.
  const glm::ivec2 of_all = scaled_size({0, 0, inputs.depth.width, inputs.depth.height}, scale);
  const auto target = [&](const char* name, GLenum format) -> const gl::Texture& {
    return device.target(prefix + name, {.format = format, .width = of_all.x, .height = of_all.y});
  };
  const gl::Texture& depth = target("depth", GL_R32F);
  const bool two_channels = !inputs.makes_normals() && inputs.conventions.octahedral_normals;
  const gl::Texture& normals = target("normals", two_channels ? GL_RG32F : GL_RGBA32F);
  ScaledInputs scaled{.inputs = inputs, .ndc = map.scale};
  scaled.inputs.depth = view_of(depth);
  scaled.inputs.normals = view_of(normals);
  scaled.inputs.conventions.shading_normals = false;  // what is copied are the normals that were made
  scaled.inputs.viewport = {0, 0, size.x, size.y};
  View& view = scaled.inputs.view;
  view.projection = mapped(view.projection, map);
  view.last_projection = mapped(view.last_projection, map);
  view.jitter *= scaled.ndc;
  gl::PassDesc desc{.name = "scaled receivers", .colors = {{.texture = &depth}, {.texture = &normals}}};
  if (inputs.motion.id != 0) {
    const gl::Texture& vectors = target("motion", GL_RG32F);
    scaled.inputs.motion = view_of(vectors);
    desc.colors.push_back({.texture = &vectors});
  }
  gl::Pass pass(device, desc);
  const gl::Program& program = pass.use(scaled_receivers_program());
  program.set("corner", glm::ivec2(viewport.x, viewport.y));
  program.set("scale", scale);
  program.set("ndc_scale", scaled.ndc);
  for (const GLuint unit : {unit_receiver_depth, unit_receiver_normal, unit_motion}) device.sampler({}).bind(unit);
  gl::glBindTextureUnit(unit_receiver_depth, inputs.depth.id);
  gl::glBindTextureUnit(unit_receiver_normal, normals_of(work));
  gl::glBindTextureUnit(unit_motion, inputs.motion.id);
  pass.set_viewport(0, 0, size.x, size.y);
  pass.draw_full_screen();
  return scaled;
}

namespace {

void filter_noisy_pixels(const LightWork& work, const gl::Buffer& list) {
  gl::Pass pass(work.device, {.name = "filter missing pixels"});
  for (const bool stores : {false, true}) {
    const gl::Program& program = pass.use(work.programs.filter_noisy(stores));
    bind_inputs(work, owner_of(*work.denoiser));
    program.set("mask_layer", work.frame.layer);
    work.device.sampler({}).bind(unit_texels);
    work.mask.bind(unit_texels);
    work.mask.bind_image(0, GL_WRITE_ONLY);
    list.bind_storage(tile_list_binding);
    pass.dispatch_indirect(list, noisy_dispatch_offset);
  }
}

}  // namespace

void upsample(const LightWork& work, const ScaledMask& scaled, int scale) {
  const PassOwner owner = owner_of(work.technique);
  const PassContext context(work, owner);
  const Rect& viewport = work.frame.viewport;
  const bool decides = work.tiles != nullptr;
  const gl::Buffer& list =
      decides ? work.tiles->list : begin_tile_list(context, "missing pixels", glm::ivec2(0), listed_pixels(work));
  {
    gl::Pass pass(work.device, {.name = "upsample mask"});
    const auto use = [&](Programs::UpsampledTiles of) {
      const gl::Program& program = pass.use(work.programs.upsample(of, work.mask.desc().format != GL_R16F));
      bind_inputs(work, owner);
      program.set("mask_layer", work.frame.layer);
      program.set("scale", scale);
      for (const GLuint unit : {unit_motion, unit_texels}) work.device.sampler({}).bind(unit);
      gl::glBindTextureUnit(unit_motion, scaled.depth);
      scaled.mask.bind(unit_texels);
      work.mask.bind_image(0, GL_WRITE_ONLY);
      list.bind_storage(tile_list_binding);
    };
    if (decides) {
      use(Programs::UpsampledTiles::listed);
      pass.dispatch_indirect(list, listed_dispatch_offset);
    } else {
      use(Programs::UpsampledTiles::all);
      pass.dispatch(viewport.width, viewport.height);
    }
    if (decides && lists_apart(work)) {
      use(Programs::UpsampledTiles::listed_apart);
      pass.dispatch_indirect(list, apart_dispatch_offset);
    }
  }
  run_for_pixels(work, list);
  if (listed_pixels(work) == ListedPixels::filtered) filter_noisy_pixels(work, list);
}

}  // namespace penumbra::shadow
