#pragma once

#include <compare>
#include <map>
#include <set>
#include <vector>

#include "gl/program.h"

namespace penumbra::scene {

// What a surface has that a shader would spend time on: the programs of surfaces are compiled for these.
struct SurfaceTraits {
  unsigned textures = 0;    // bit i: the material may have texture i of glsl/shared/scene_blocks.h
  unsigned transforms = 0;  // bit i: texture i may be read with a transform, or at the second texture coordinates
  bool colors = false;      // colours at its vertices
  bool masked = false;      // an alpha test cuts parts out of it
  bool triangles = true;    // false: lines or points

  auto operator<=>(const SurfaceTraits&) const = default;
};

// What a pass reads of a surface besides its depth and its colour.
struct SurfaceReads {
  bool normals = false;  // if not, it can read the index of the instance
  bool world = false;    // the position
  bool motion = false;   // the motion vector
};

// The constants of glsl/scene/surface.vert and surface.glsl: see surface_interface.glsl.
std::vector<gl::Define> surface_defines(const SurfaceTraits& traits, const SurfaceReads& reads);

// Which traits the program of each of these is made for, so that a scene needs fewer programs: a set of textures is
// served by one of the same scene that has one texture more, with or without a transform, or one transform more, or by
// what serves that one in turn. Its materials then sample up to four textures in vain. The normal map is not added so,
// as it costs more than a texture; its transform is.
using SharedTraits = std::map<SurfaceTraits, SurfaceTraits>;
SharedTraits share_programs(const std::set<SurfaceTraits>& all);

// Traits for listing programs: first all of them, then none, then each by itself.
std::vector<SurfaceTraits> sample_traits();

}  // namespace penumbra::scene
