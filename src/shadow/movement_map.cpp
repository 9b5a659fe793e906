#include "movement_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace penumbra::shadow {

namespace {

constexpr int levels_a_step = 2;  // of movement_pyramid.comp

// The texels of a layer, lowest and highest, in which something may have moved; empty if lowest > highest.
using Region = glm::vec4;
constexpr Region no_region{1, 1, 0, 0};

Region region_of(const LightProjection& projection, int layer, const std::optional<Box>& moved) {
  const auto last = static_cast<float>(projection.size() - 1);
  if (!moved) return {0, 0, last, last};
  if (nothing_moved(moved)) return no_region;
  const std::optional<TexelRange> range = projection.texels_of(layer, *moved);
  return range ? Region(range->first, range->last) : no_region;
}

bool is_none(const Region& region) { return region.z < region.x; }

void clear_layer(const gl::Texture& map, int layer) {
  gl::glClearTexSubImage(map.id(), 0, 0, 0, layer, map.width(), map.height(), 1, GL_RED, GL_FLOAT, nullptr);
}

void draw_pose(gl::Device& device, const MovementInputs& inputs, CasterKind kind, int layer, bool clear) {
  const bool last = kind == CasterKind::moved_last;
  gl::PassDesc desc{.name = last ? "movement map, last" : "movement map",
                    .colors = {{.texture = &inputs.map, .layer = layer}},
                    // The last position may be in front of the near plane, which is fitted to the present scene.
                    .depth_clamp = last,
                    .depth_reversed = inputs.projection.drawn_reversed()};
  if (clear) desc.colors[0].clear = glm::vec4(0);
  if (inputs.depth != nullptr) {
    desc.depth = gl::Attachment{.texture = inputs.depth, .layer = layer};
    desc.depth_test = gl::DepthTest::less_equal;
  }
  gl::Pass pass(device, desc);
  inputs.draw({.kind = kind,
               .layer = layer,
               .world_to_clip = inputs.projection.casters_to_clip(layer),
               .anchored = inputs.projection.anchored_to_clip(layer),
               .cull = inputs.projection.cull_volume(layer),
               .source = inputs.source},
              pass);
}

void build_pyramid(gl::Device& device, const MovementInputs& inputs, const std::array<Region, max_layers>& regions) {
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
  const int count = inputs.projection.layers();
  std::array<Region, max_layers> regions;
  regions.fill(no_region);
  for (int i = 0; i < count; ++i) {
    Region& region = regions[static_cast<size_t>(i)] = region_of(inputs.projection, i, inputs.moved);
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
