#include "scene/surface_traits.h"

#include <string>

#include "shared/scene_blocks.h"

namespace penumbra::scene {

std::vector<gl::Define> surface_defines(const SurfaceTraits& traits, const SurfaceReads& reads) {
  const auto flag = [](bool on) { return on ? "1" : "0"; };
  return {{"TEXTURES", std::to_string(traits.textures)},
          {"COLORS", flag(traits.colors)},
          {"MASKED", flag(traits.masked)},
          {"TRIANGLES", flag(traits.triangles)},
          {"NORMALS", flag(reads.normals)},
          {"WORLD", flag(reads.world)},
          {"MOTION", flag(reads.motion)}};
}

std::vector<SurfaceTraits> sample_traits() {
  constexpr unsigned all = (1u << TEXTURE_COUNT) - 1;
  std::vector<SurfaceTraits> samples{
      {.textures = all, .colors = true}, {}, {.triangles = false}, {.textures = all, .colors = true, .masked = true}};
  for (unsigned texture = 0; texture < TEXTURE_COUNT; ++texture) samples.push_back({.textures = 1u << texture});
  return samples;
}

}  // namespace penumbra::scene
