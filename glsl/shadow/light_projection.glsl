// What depends on the kind of light and the projection of its shadow map: the files of the folder shadow/projection,
// and no other GLSL. They convert positions to map coordinates and stored depths to metres, and give the sizes of
// texels and penumbrae. All other files work in light space:
//   - z is the depth along the light's rays, metres, growing away from the light; the map stores it. x and y are
//     perpendicular to z.
//   - Offsets and radii are metres in x and y at the receiver's depth, for every kind of projection.
//   - A light's shadow map has layers; a receiver reads one of them, or two where it blends between layers.
// A sun has parallel rays, and orthographic cascades as layers. A lamp has perspective maps, one or a cube's faces. For
// each receiver it is a sun: the projective map
//   (x, y, z) -> (x, y, 2 z - Z) · Z / z,   Z the receiver's depth,
// makes the rays through the lamp's centre parallel, keeps planes plane, leaves all points at the receiver's depth
// where they are, and turns a disc of radius R at the lamp into a sun of tangent R / Z. The depth that a perspective
// map stores is a linear function of the result. So the functions below differ in how they place a receiver and its
// map, and in little else. See ADR 24.
#include "shadow/projection/light_space.glsl"
#include "shadow/projection/penumbrae.glsl"
#include "shadow/projection/map.glsl"
#include "shadow/projection/layers.glsl"
#include "shadow/projection/pyramids.glsl"
