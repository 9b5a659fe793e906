#pragma once

#include <glm/glm.hpp>
#include <string>

#include "cascades.h"
#include "volume.h"

namespace penumbra::shadow {

constexpr int cube_faces = 6;

// The shadow maps of a lamp, as seen from its centre: one for a spot, whose cone it contains, or one for each face of a
// cube. Each is a square whose middle lies in the direction of its axis.
//
// Space of a lamp: metres, origin at its centre, axes the rows of `world_to_lamp`, left-handed as a sun's light space;
// z is a spot's axis. Space of a face: the same, turned so that z is the face's axis (shared/cube_faces.h). The map
// stores a linear function of −1/z, 0 at the near plane and 1 at the far plane.
struct LampMaps {
  glm::dmat3 world_to_lamp{1};
  glm::dvec3 position{0};
  int size = 0;        // texels along a side
  int count = 1;       // 1, or cube_faces
  double tangent = 1;  // of half the angle that a map spans
  double near = 1e-2;  // z of the near plane: nearer casters cast no shadow; at least 1/2000 of `far`
  double far = 1;      // z of the far plane
  double radius = 0;   // of the lamp, metres
  double cone = -2;    // cosine of the half angle of a spot's cone; below -1: it shines in all directions
  double range = 0;    // metres; 0: unlimited
  // Whether casters are drawn with reversed clip-space depth, which the depth range turns back. Else a vertex far
  // beyond the far plane would have a z and a w of which only the last digits differ, and large triangles would get
  // wrong depths near the lamp.
  bool drawn_reversed = false;

  // z of clip space is the stored depth.
  glm::dmat4 world_to_clip(int face) const;
  // The part of the face's frustum between its near and its far plane.
  CullVolume cull_volume(int face) const;
  // The cube within which light reaches receivers.
  CullVolume cull_volume_of_all() const;
  // By how much a disc that faces a receiver is longer at most, seen along the face's axis: 1 over the cosine of the
  // angle between that axis and a corner of the map.
  double greatest_stretch() const;
  // See LightProjection::fault().
  std::string fault() const;
};

// Whether a spot with that axis (0: a lamp that shines in all directions) and that half angle of its cone has one map.
bool has_one_map(const glm::dvec3& axis, double cone);

struct LampInputs {
  glm::dvec3 position{0};
  glm::dvec3 axis{0};  // unit, world; 0: a lamp that shines in all directions
  double cone = 0;     // half angle of a spot's cone, radians
  double radius = 0;   // metres
  double range = 0;    // metres; 0: unlimited
  double nearest = 0;  // least z of the near plane, metres
  int size = 1024;
  Box casters, receivers;  // world bounds
};

// Maps as wide as receivers need whose blockers are beyond 2 radii, 20 cm and the near plane, from the nearest caster
// to the farthest receiver. Spots of up to 60 degrees from axis to rim get one map.
LampMaps fit_lamp(const LampInputs& inputs);

// Least distance of a box from a point along the axis of the face that sees it, metres.
double least_depth(const LampMaps& maps, const Box& box);

}  // namespace penumbra::shadow
