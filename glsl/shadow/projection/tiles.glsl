// Receivers of a tile of pixels, as a light sees all of them at once. In (x, y) / z and −1 / z, a lamp is a sun for
// every receiver that a face sees; scaled to metres at the depth of one of them, it is the sun that this one sees.
#include "shadow/projection/layers.glsl"

// A box in light space; and what bounds the receivers of a tile, as light_position() has its corners.
struct Box {
  vec3 low, high;
};

struct Hull {
  vec3 corners[8];
};

// Whether tiles are looked for on which the light does not shine at all: a lamp's cone and range end.
bool may_be_out_of_reach() { return is_lamp; }

// Whether a face of a lamp's cube reads any of the receivers.
bool may_see(Hull hull, int face) {
  vec3 low = vec3(1e30), high = vec3(-1e30);
  float along = -1e30;
  for (int i = 0; i < 8; ++i) {
    low = min(low, hull.corners[i]);
    high = max(high, hull.corners[i]);
    along = max(along, seen_by_face(hull.corners[i], face).z);
  }
  vec3 least = max(max(low, -high), 0.0);
  return along > 0.0 && along >= (1.0 - face_blend()) * max(least.x, max(least.y, least.z));
}

// The light spaces in which a tile is to be looked at, as bits: a cube has one for each face, a spot's map one, and a
// sun one for all layers.
int sights_of(Hull hull) {
  if (!is_lamp || shadow.layer_count == 1) return 1;
  int sights = 0;
  for (int face = 0; face < shadow.layer_count; ++face) sights |= int(may_see(hull, face)) << face;
  return sights;
}

Box box_around(Hull hull) {
  Box box = Box(hull.corners[0], hull.corners[0]);
  for (int i = 1; i < 8; ++i) {
    box.low = min(box.low, hull.corners[i]);
    box.high = max(box.high, hull.corners[i]);
  }
  return box;
}

// Their box in light space, of a lamp that of the receiver which is farthest along the face's axis; and the light as
// that one sees it, but as wide as it is for any of them. False where a part of the hull is not before the face.
bool box_of(Hull hull, int face, out Box box, inout Light light) {
  if (!is_lamp) {
    box = box_around(hull);
    return true;
  }
  for (int i = 0; i < 8; ++i) hull.corners[i] = seen_by_face(hull.corners[i], face);
  box = box_around(hull);
  float depth = box.high.z;
  if (box.low.z * shadow.layers[0].near_depth > -1.0) return false;  // nearer than the near plane
  for (int i = 0; i < 8; ++i) {
    vec3 corner = hull.corners[i];
    hull.corners[i] = vec3(corner.xy * (depth / corner.z), depth * (2.0 - depth / corner.z));
  }
  box = box_around(hull);
  light.depth = depth;
  light.extent = shadow.light_extent / depth;
  light = with_layer(light, face);
  // No receiver beyond the map reads it.
  vec2 most = 0.5 / light.map.widths_per_metre;
  box.low.xy = clamp(box.low.xy, -most, most);
  box.high.xy = clamp(box.high.xy, -most, most);
  // As far as the outline of light_at() reaches along each axis, for the receiver that is farthest along it.
  vec2 tangents = max(abs(box.low.xy), abs(box.high.xy)) / depth;
  light.outline = vec3(sqrt(1.0 + tangents * tangents), 0.0);
  // A normal offset may lead away from the lamp's plane.
  box.high.z += bias_normal_offset * light.map.texel;
  return true;
}

// Whether a disc of that radius, metres, about a receiver of a lamp's box ends less than so many texels before the rim
// of the face's map.
bool reaches_rim(Box box, float radius, float texels, Light light) {
  vec2 farthest = max(abs(box.low.xy), abs(box.high.xy));
  vec2 margin = texels * light.map.texel * light.map.texel_shares;
  return any(greaterThan(farthest + radius * outline_reach(light) + margin, 0.5 / light.map.widths_per_metre));
}

// A receiver at the box's centre, at this depth, as that light sees it.
Receiver receiver_in_box(Box box, float depth, Light light) {
  Receiver receiver;
  receiver.position = receiver.from_lamp = vec3(0.5 * (box.low.xy + box.high.xy), depth);
  receiver.normal = receiver.lamp_normal = vec3(0.0, 0.0, -1.0);
  receiver.gradient = vec2(0.0);
  receiver.surroundings = Surroundings(vec4(0.0), 0.0, 0.0, 0.0);
  receiver.pixel = vec2(0.0);
  receiver.depth_error = receiver.depth_tilt = 0.0;
  receiver.history_refused = false;
  receiver.layer = light.layer;
  return receiver;
}

// Whether a receiver is shaded by what the light's layer shows of it; of a sun's layers the tile's box decides.
bool reads_layer(Receiver receiver, Light light) {
  if (!is_lamp || receiver.layer == light.layer) return true;
  LayerChoice choice = choose_face(receiver, light_at(receiver));
  return (choice.fades.x > 0.0 && choice.others.x == light.layer) ||
         (choice.fades.y > 0.0 && choice.others.y == light.layer);
}

// Whether it lies outside of the map that sees it.
bool is_outside(Receiver receiver) { return is_lamp && choose_face(receiver, light_at(receiver)).outside; }

// The light as a receiver itself sees it, through the same layer.
Light own_light(Receiver seen, Light light) { return is_lamp ? light_at(seen) : light; }
