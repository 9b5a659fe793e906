#include "visible_receivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <string>

#include "light_frame.h"
#include "tiles.h"

namespace penumbra::shadow {

namespace {

constexpr GLuint found_binding = 7;  // must match glsl/shadow/visible_receivers.comp
constexpr int slices = 32;
constexpr int measures = measured_directions + 1;  // the last one: depths
static_assert(measured_directions > 0 && measured_directions % 4 == 0, "the shader measures along four and between");

// std430, as in the shader.
struct Found {
  std::uint32_t least, greatest;
  std::array<std::uint32_t, slices> pixels;
  std::array<std::array<std::uint32_t, measures>, slices> low, high;
};

Found nothing_found() {
  Found found{.least = ~0u, .greatest = 0, .pixels = {}, .low = {}, .high = {}};
  for (auto& low : found.low) low.fill(~0u);
  return found;
}

float value_of(std::uint32_t code) {
  constexpr std::uint32_t sign = 0x80000000u;
  return std::bit_cast<float>((code & sign) != 0 ? code & ~sign : ~code);
}

gl::ProgramDesc program(bool bounds) {
  return {.name = bounds ? "bounds of visible receivers" : "depths of visible receivers",
          .compute = "shadow/visible_receivers.comp",
          .defines = {{"BOUNDS", bounds ? "1" : "0"}, {"DIRECTIONS", std::to_string(measured_directions)}}};
}

// Read where all tiles count: programs that read no decisions would be compiled besides, which takes longer than this.
// As large as the depth texture needs, not the viewport: a view whose size varies from frame to frame keeps it.
const gl::Texture& nothing_decided(gl::Device& device, const std::string& prefix, const TextureView& depth) {
  constexpr glm::uvec4 no_decision(0, 0, 0, ~0u);  // must match glsl/shadow/drivers/decisions.glsl
  const glm::ivec2 tiles = tile_count({.width = depth.width, .height = depth.height});
  const gl::Texture& decisions =
      device.target(prefix + "nothing decided", {.format = GL_RGBA32UI, .width = tiles.x, .height = tiles.y});
  gl::glClearTexImage(decisions.id(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, &no_decision);
  return decisions;
}

// From x and y in texels and the stored depth to view space, before the division by w.
glm::mat4 texel_to_view(const Inputs& inputs) {
  const Rect viewport = viewport_of(inputs);
  const glm::dvec2 size(viewport.width, viewport.height), corner(viewport.x, viewport.y);
  const bool zero_to_one = inputs.conventions.depth_zero_to_one;
  const glm::dvec3 scale(2.0 / size, zero_to_one ? 1.0 : 2.0);
  const glm::dvec3 shift(-2.0 * corner / size - 1.0 - glm::dvec2(inputs.view.jitter), zero_to_one ? 0.0 : -1.0);
  const glm::dmat4 texel_to_clip = glm::scale(glm::translate(glm::dmat4(1), shift), scale);
  return glm::mat4(glm::inverse(glm::dmat4(inputs.view.projection)) * texel_to_clip);
}

VisibleReceivers visible_of(const Found& found) {
  VisibleReceivers visible;
  for (std::size_t slice = 0; slice < slices; ++slice) {
    if (found.pixels[slice] == 0) continue;
    const auto range = [&](std::size_t measure) {
      return glm::dvec2(value_of(found.low[slice][measure]), value_of(found.high[slice][measure]));
    };
    ReceiverSlice& to = visible.emplace_back();
    to.pixels = found.pixels[slice];
    for (std::size_t k = 0; k < measured_directions; ++k) to.extents[k] = range(k);
    to.depths = range(measured_directions);
  }
  return visible;
}

}  // namespace

std::optional<VisibleReceivers> find_visible_receivers(gl::Device& device, const Inputs& inputs, const Light& light,
                                                       const ParamSet& params, const std::string& prefix,
                                                       const gl::Texture* decisions) {
  if (light.maps || !fits_to_view(light.source) || !fits_to_view(params)) return {};
  const Rect viewport = viewport_of(inputs);
  const glm::dmat3 world_to_view(glm::dmat4(inputs.view.view));
  const glm::ivec2 tiles = tile_count(viewport);
  const gl::Buffer& buffer = device.scratch(prefix + "visible receivers", sizeof(Found));
  Found found = nothing_found();
  gl::write_value(buffer, found);
  {
    gl::Pass pass(device, {.name = "visible receivers"});
    device.sampler({}).bind(unit_receiver_depth);
    gl::glBindTextureUnit(unit_receiver_depth, inputs.depth.id);
    device.sampler({}).bind(unit_decisions);
    (decisions != nullptr ? *decisions : nothing_decided(device, prefix, inputs.depth)).bind(unit_decisions);
    buffer.bind_storage(found_binding);
    for (const bool bounds : {false, true}) {
      const gl::Program& reduce = pass.use(program(bounds));
      reduce.set("viewport", glm::vec4(viewport.x, viewport.y, viewport.width, viewport.height));
      reduce.set("sky_depth", inputs.conventions.reversed_z ? 0.0f : 1.0f);
      if (bounds) {
        reduce.set("texel_to_view", texel_to_view(inputs));
        reduce.set("view_to_light", glm::mat4(light_axes(light.source) * glm::inverse(world_to_view)));
        reduce.set("distance_limit", params.get_float("cascades.distance"));
      }
      pass.dispatch(tiles.x, tiles.y);
    }
  }
  gl::glGetNamedBufferSubData(buffer.id(), 0, sizeof(found), &found);
  VisibleReceivers visible = visible_of(found);
  if (visible.empty()) return {};
  return visible;
}

std::vector<gl::ProgramDesc> visible_receivers_programs() { return {program(false), program(true)}; }

}  // namespace penumbra::shadow
