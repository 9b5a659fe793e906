#include "movement_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace penumbra::shadow {

namespace {

constexpr int levels_a_step = 2;  // of movement_pyramid.comp

// Lowest and highest texel of a cascade's map between which something can have moved; none when they cross.
using Region = glm::vec4;
constexpr Region no_region{1, 1, 0, 0};

Region region_of(const Cascades& cascades, int index, const std::optional<Box>& moved) {
  const auto last = static_cast<float>(cascades.size - 1);
  if (!moved) return {0, 0, last, last};
  if (!may_hold_moved(cull_volume(cascades, index), moved)) return no_region;
  glm::dvec2 low(1e30);
  glm::dvec2 high(-1e30);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 world{(corner & 1) != 0 ? moved->max.x : moved->min.x,
                           (corner & 2) != 0 ? moved->max.y : moved->min.y,
                           (corner & 4) != 0 ? moved->max.z : moved->min.z, 1};
    const glm::dvec2 clip(cascades.items[static_cast<size_t>(index)].world_to_clip * world);
    const glm::dvec2 texel = (clip * 0.5 + 0.5) * static_cast<double>(cascades.size);
    low = glm::min(low, texel);
    high = glm::max(high, texel);
  }
  // A texel more than what the box covers, for rounding.
  const glm::vec2 first = glm::clamp(glm::vec2(glm::floor(low)) - 1.0f, 0.0f, last);
  return {first, glm::clamp(glm::vec2(glm::floor(high)) + 1.0f, 0.0f, last)};
}

bool is_none(const Region& region) { return region.z < region.x; }

void clear_layer(const gl::Texture& map, int layer) {
  gl::glClearTexSubImage(map.id(), 0, 0, 0, layer, map.width(), map.height(), 1, GL_RED, GL_FLOAT, nullptr);
}

void draw_pose(gl::Device& device, const MovementInputs& inputs, CasterKind kind, int cascade, bool clear) {
  const bool last = kind == CasterKind::moved_last;
  gl::PassDesc desc{.name = last ? "movement map, last" : "movement map",
                    .colors = {{.texture = &inputs.map, .layer = cascade}},
                    // Where it was may lie before the present scene, to which the map's range is fitted.
                    .depth_clamp = last};
  if (clear) desc.colors[0].clear = glm::vec4(0);
  if (inputs.depth != nullptr) {
    desc.depth = gl::Attachment{.texture = inputs.depth, .layer = cascade};
    desc.depth_test = gl::DepthTest::less_equal;
  }
  gl::Pass pass(device, desc);
  const glm::mat4 world_to_clip(inputs.cascades.items[static_cast<size_t>(cascade)].world_to_clip);
  inputs.draw({kind, cascade, world_to_clip, cull_volume(inputs.cascades, cascade)}, pass);
}

void build_pyramid(gl::Device& device, const MovementInputs& inputs, const std::array<Region, max_cascades>& regions) {
  const gl::TextureDesc& desc = inputs.map.desc();
  gl::Pass pass(device, {.name = "movement pyramid"});
  for (int level = 1; level < desc.levels; ++level) {
    gl::glClearTexImage(inputs.map.id(), level, GL_RED, GL_FLOAT, nullptr);
  }
  glm::vec2 widest(0);
  for (const Region& region : regions)
    widest = glm::max(widest, glm::vec2(region.z, region.w) - glm::vec2(region) + 1.0f);
  const gl::Program& program =
      pass.use(movement_pyramid_program(inputs.form, !std::has_single_bit(static_cast<unsigned>(desc.width))));
  for (size_t i = 0; i < regions.size(); ++i) program.set(fmt::format("regions[{}]", i), regions[i]);
  program.set("size", desc.width);
  for (int below = 0; below + 1 < desc.levels; below += levels_a_step) {
    const int second = std::min(below + 2, desc.levels - 1);
    program.set("below", below);
    inputs.map.bind_image(0, GL_READ_ONLY, below);
    inputs.map.bind_image(1, GL_WRITE_ONLY, below + 1);
    inputs.map.bind_image(2, GL_WRITE_ONLY, second);
    const glm::ivec2 groups = (glm::ivec2(widest) >> (below + 2)) + 2;
    pass.dispatch(groups.x, groups.y, desc.layers);
  }
}

}  // namespace

const gl::Texture& movement_target(gl::Device& device, std::string_view name, int size, int layers, MovementForm form) {
  return device.target(name, {.target = GL_TEXTURE_2D_ARRAY,
                              .format = form == MovementForm::average ? GLenum{GL_R16} : GLenum{GL_R8},
                              .width = size,
                              .height = size,
                              .layers = layers,
                              .levels = static_cast<int>(std::bit_width(static_cast<unsigned>(size)))});
}

void draw_movement(gl::Device& device, const MovementInputs& inputs) {
  if (nothing_moved(inputs.moved)) {
    for (int level = 0; level < inputs.map.desc().levels; ++level) {
      gl::glClearTexImage(inputs.map.id(), level, GL_RED, GL_FLOAT, nullptr);
    }
    return;
  }
  const int count = static_cast<int>(inputs.cascades.items.size());
  std::array<Region, max_cascades> regions;
  regions.fill(no_region);
  for (int i = 0; i < count; ++i) {
    Region& region = regions[static_cast<size_t>(i)] = region_of(inputs.cascades, i, inputs.moved);
    if (is_none(region)) {
      clear_layer(inputs.map, i);
      continue;
    }
    if (!inputs.present_is_drawn) draw_pose(device, inputs, CasterKind::moved_now, i, /*clear=*/true);
    draw_pose(device, inputs, CasterKind::moved_last, i, /*clear=*/false);
  }
  build_pyramid(device, inputs, regions);
}

bool nothing_moved(const std::optional<Box>& moved) {
  return moved && glm::any(glm::greaterThan(moved->min, moved->max));
}

bool may_hold_moved(const CullVolume& volume, const std::optional<Box>& moved) {
  return !moved || (!nothing_moved(moved) && volume.holds(*moved));
}

gl::ProgramDesc movement_pyramid_program(MovementForm form, bool any_size) {
  const bool average = form == MovementForm::average;
  return {.name = average ? "movement pyramid, average" : "movement pyramid, maximum",
          .compute = "shadow/movement_pyramid.comp",
          .defines = {{"AVERAGE", average ? "1" : "0"}, {"ANY_SIZE", any_size ? "1" : "0"}}};
}

}  // namespace penumbra::shadow
