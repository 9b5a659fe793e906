#include "outputs.h"

#include <algorithm>
#include <vector>

namespace penumbra::shadow {

namespace {

static_assert(first_pass_unit == 8, "glsl/shadow/drivers/output.frag has this number");

// A layer of a texture, and the lights that are written to it.
struct OutputLayer {
  OutputTexture place;        // its channel does not matter
  glm::ivec4 mask_layers{0};  // by channel
  unsigned channels = 0;      // that are written, as PassDesc::channels
};

bool same_layer(const OutputTexture& a, const OutputTexture& b) {
  return a.id == b.id && a.level == b.level && a.layer == b.layer;
}

std::vector<OutputLayer> layers_of(std::span<const Light> lights) {
  std::vector<OutputLayer> all;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!lights[i].output) continue;
    const OutputTexture& output = *lights[i].output;
    auto found = std::ranges::find_if(all, [&](const auto& layer) { return same_layer(layer.place, output); });
    if (found == all.end()) found = all.insert(found, {.place = output});
    found->mask_layers[output.channel] = static_cast<int>(i);
    found->channels |= 1u << static_cast<unsigned>(output.channel);
  }
  return all;
}

bool is_float(GLenum format) { return format == GL_R16F || format == GL_RG16F || format == GL_RGBA16F; }

}  // namespace

gl::ProgramDesc output_program() {
  return {.name = "output", .vertex = "shared/full_screen.vert", .fragment = "shadow/drivers/output.frag"};
}

void write_outputs(gl::Device& device, const Inputs& inputs, const TextureChecks& checked, const gl::Texture& mask) {
  const Rect viewport = viewport_of(inputs);
  for (const OutputLayer& layer : layers_of(inputs.lights)) {
    const OutputTexture& to = layer.place;
    const gl::TextureDesc& desc = checked.desc_of(to);
    const gl::Texture texture = gl::Texture::wrap(to.id, desc);
    gl::Pass pass(device, {.name = "output",
                           .colors = {{.texture = &texture, .level = to.level, .layer = to.layer}},
                           .channels = layer.channels});
    const gl::Program& program = pass.use(output_program());
    program.set("mask_layers", layer.mask_layers);
    program.set("steps", is_float(desc.format) ? 0.0f : 255.0f);
    device.sampler({}).bind(first_pass_unit);
    mask.bind(first_pass_unit);
    pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
    pass.draw_full_screen();
  }
}

}  // namespace penumbra::shadow
