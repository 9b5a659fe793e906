#include "scene/surface_traits.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <string>

#include "shared/scene_blocks.h"

namespace penumbra::scene {

std::vector<gl::Define> surface_defines(const SurfaceTraits& traits, const SurfaceReads& reads) {
  const auto flag = [](bool on) { return on ? "1" : "0"; };
  return {{"TEXTURES", std::to_string(traits.textures)},
          {"TRANSFORMS", std::to_string(traits.transforms)},
          {"COLORS", flag(traits.colors)},
          {"MASKED", flag(traits.masked)},
          {"TRIANGLES", flag(traits.triangles)},
          {"NORMALS", flag(reads.normals)},
          {"WORLD", flag(reads.world)},
          {"MOTION", flag(reads.motion)}};
}

SharedTraits share_programs(const std::set<SurfaceTraits>& all) {
  // What serves others first, so that it has found its own program before.
  std::vector<SurfaceTraits> ordered(all.begin(), all.end());
  std::ranges::stable_sort(ordered, std::greater{}, [](const SurfaceTraits& t) {
    return std::popcount(t.textures) + std::popcount(t.transforms);
  });
  SharedTraits shared;
  for (const SurfaceTraits& traits : ordered) {
    SurfaceTraits program = traits;
    for (unsigned i = 0; i < 2 * TEXTURE_COUNT && program == traits; ++i) {
      const unsigned texture = i / 2, bit = 1u << texture;
      const bool transform = i % 2 != 0, has = (traits.textures & bit) != 0;
      if (texture == TEXTURE_NORMAL && !has) continue;
      SurfaceTraits more = traits;
      more.textures |= bit;
      if (transform) more.transforms |= bit;
      if (const auto found = shared.find(more); found != shared.end()) program = found->second;
    }
    shared.emplace(traits, program);
  }
  return shared;
}

std::vector<SurfaceTraits> sample_traits() {
  constexpr unsigned all = (1u << TEXTURE_COUNT) - 1;
  std::vector<SurfaceTraits> samples{{.textures = all, .transforms = all, .colors = true},
                                     {},
                                     {.triangles = false},
                                     {.textures = all, .transforms = all, .colors = true, .masked = true}};
  for (unsigned texture = 0; texture < TEXTURE_COUNT; ++texture) samples.push_back({.textures = 1u << texture});
  return samples;
}

}  // namespace penumbra::scene
