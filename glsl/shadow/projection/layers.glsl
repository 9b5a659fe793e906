// Which layers of the map a receiver reads.
#include "shadow/projection/map.glsl"
#include "shadow/projection/penumbrae.glsl"

// Largest distance of a disc's rim from the centre of a layer along either axis, in units of half the layer's width
// along it; above 1 the disc is not completely within the layer.
float layer_edge(int layer, vec3 position, float radius, Light light) {
  LayerBlock map = layer_map(layer, light);
  vec2 rim = abs(position.xy - map.center) + radius * outline_reach(light) + 1.5 * map.texel;
  vec2 inside = 2.0 * map.widths_per_metre * rim;
  return position.z - map.near_depth > map.depth_range * 1.0001 ? 2.0 : max(inside.x, inside.y);
}

// The finest layer that contains the whole disc, or the last layer if none does.
int finest_layer(Receiver receiver, float radius, Light light) {
  if (is_lamp) return receiver.layer;
  int layer = 0;
  while (layer < light.layers - 1 && layer_edge(layer, receiver.position, radius, light) > 1.0) ++layer;
  return layer;
}

// Of the layers after that one, the finest that contains the whole disc, or the last layer if none does.
int next_layer(int layer, vec3 position, float radius, Light light) {
  do {
    ++layer;
  } while (layer < light.layers - 1 && layer_edge(layer, position, radius, light) > 1.0);
  return layer;
}

struct LayerChoice {
  int layer;
  bool outside;  // no layer contains the position: it counts as lit
  ivec2 others;  // the layers to blend with
  vec2 fades;    // 0 to 1: their weights; if the first is 0, both are
};

// How far beside an edge of a lamp's cube two faces are blended, as a share of a receiver's depth: no further than the
// map of the face beyond shows the receiver and the texels next to it.
float face_blend() {
  const float texels_beside = 3.0;
  LayerBlock map = shadow.layers[0];
  return min(cascades_blend, 1.0 - 1.0 / (0.5 / map.widths_per_metre.x - texels_beside * map.texel));
}

// A lamp's receiver reads the face that contains it. Beside an edge of the cube it also reads the face beyond, and
// beside a corner both, with weights that are those of all on the edge and at the corner itself.
LayerChoice choose_face(Receiver receiver, Light light) {
  vec3 away = abs(receiver.from_lamp);
  float most = max(away.x, max(away.y, away.z)), least = min(away.x, min(away.y, away.z));
  float middle = away.x + away.y + away.z - most - least;
  bool outside = receiver.position.z <= 0.0 || layer_edge(receiver.layer, receiver.position, 0.0, light) > 1.0;
  if (light.layers == 1) return LayerChoice(receiver.layer, outside, ivec2(0), vec2(0.0));
  vec2 fades = vec2(0.0);
  if (cascades_seam != cascades_seam_none) {
    float width = face_blend() * most;
    fades = clamp((vec2(middle, least) - most + width) / width, 0.0, 1.0);
    // Multiples of a power of two, so that all weights add up to exactly 1: what all faces find lit is lit.
    fades = floor(4096.0 * fades / (1.0 + fades.x + fades.y)) / 4096.0;
  }
  return LayerChoice(receiver.layer, outside, faces_of(receiver.from_lamp).yz, fades);
}

// Chooses the layer from which a receiver reads a disc.
LayerChoice choose_layer(Receiver receiver, float radius, Light light) {
  if (is_lamp) return choose_face(receiver, light);
  int layer = finest_layer(receiver, radius, light);
  bool last = layer == light.layers - 1;
  float fade = 0.0;
  if (cascades_seam != cascades_seam_none && !last) {
    fade = clamp((layer_edge(layer, receiver.position, radius, light) - 1.0) / cascades_blend + 1.0, 0.0, 1.0);
  }
  bool outside = last && layer_edge(layer, receiver.position, 0.0, light) > 1.0;
  return LayerChoice(layer, outside, ivec2(next_layer(layer, receiver.position, radius, light)), vec2(fade, 0.0));
}

// The layer through which a receiver of a tile is seen, of which that one was named for all of them.
int layer_seen_through(Receiver receiver, int named) { return is_lamp ? receiver.layer : named; }

// The light with the layer that contains every caster which can block light from a receiver, and the least depth that
// the light's layer can store.
Light with_widest_layer(Receiver receiver, Light light) {
  if (is_lamp) return with_layer(light, receiver.layer);
  light.layer = light.layers - 1;
  light.map = shadow.widest;
  return light;
}

float least_depth(Light light) { return light.map.near_depth; }

// Upper bound, metres, of the distance from a receiver to what moved since the last frame, along the light.
float most_moved_distance(Receiver receiver) {
  if (is_lamp) return receiver.position.z * (receiver.position.z / shadow.moved_depth - 1.0);
  return receiver.position.z - shadow.moved_depth;
}
