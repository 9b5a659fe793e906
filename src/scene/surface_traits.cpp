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
          {"COLORS", flag(traits.colors)},
          {"MASKED", flag(traits.masked)},
          {"TRIANGLES", flag(traits.triangles)},
          {"NORMALS", flag(reads.normals)},
          {"WORLD", flag(reads.world)},
          {"MOTION", flag(reads.motion)}};
}

SharedTraits share_programs(const std::set<SurfaceTraits>& all) {
  // The largest sets of textures first, so that what serves a set has found its own program before.
  std::vector<SurfaceTraits> ordered(all.begin(), all.end());
  std::ranges::stable_sort(ordered, std::greater{}, [](const SurfaceTraits& t) { return std::popcount(t.textures); });
  SharedTraits shared;
  for (const SurfaceTraits& traits : ordered) {
    SurfaceTraits program = traits;
    for (unsigned texture = 0; texture < TEXTURE_COUNT && program == traits; ++texture) {
      SurfaceTraits more = traits;
      more.textures |= 1u << texture;
      if (texture == TEXTURE_NORMAL || more == traits) continue;
      if (const auto found = shared.find(more); found != shared.end()) program = found->second;
    }
    shared.emplace(traits, program);
  }
  return shared;
}

std::vector<SurfaceTraits> sample_traits() {
  constexpr unsigned all = (1u << TEXTURE_COUNT) - 1;
  std::vector<SurfaceTraits> samples{
      {.textures = all, .colors = true}, {}, {.triangles = false}, {.textures = all, .colors = true, .masked = true}};
  for (unsigned texture = 0; texture < TEXTURE_COUNT; ++texture) samples.push_back({.textures = 1u << texture});
  return samples;
}

}  // namespace penumbra::scene
