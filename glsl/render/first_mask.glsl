// The shadow mask at a further sample of a pixel. The mask is of the first samples, which are in the middles of the
// pixels: it is interpolated between those that show the same surface. The file that includes this has
// FURTHER_SAMPLE's textures.

uniform mat4 first_clip_to_world;
uniform vec2 offset;      // of the sample from the first, pixels
uniform vec2 pixel_size;  // of a pixel, metres: x, and y for each metre of distance

// A surface that a further sample shows.
struct SampleSurface {
  vec4 plane;   // in the first samples' clip space: times a point, its distance from the surface times w, in pixels
  vec3 normal;  // geometric, unit
};

SampleSurface sample_surface(vec3 position, vec3 normal) {
  float pixel = pixel_size.x + pixel_size.y * distance(position, view.camera.xyz);
  vec4 plane = vec4(normal, -dot(normal, position)) / pixel;
  return SampleSurface(plane * first_clip_to_world, normal);
}

// Four texels of the mask from `first` on, and the weight of each: left and right below, then above.
struct MaskTexels {
  ivec2 first;
  vec4 weights;
};

ivec2 in_picture(ivec2 texel) { return clamp(texel, ivec2(0), textureSize(first_depth, 0) - 1); }

const float no_surface = 1e4;

// How little a first sample shows the surface: 0 the same plane, from about 10 on another one.
float difference(ivec2 texel, SampleSurface s) {
  float depth = texelFetch(first_depth, texel, 0).x;
  vec4 clip = vec4((vec2(texel) + 0.5) * view.viewport.zw * 2.0 - 1.0, depth, 1.0);
  float w = first_clip_to_world[0].w * clip.x + first_clip_to_world[1].w * clip.y + first_clip_to_world[2].w * clip.z +
            first_clip_to_world[3].w;
  float out_of_plane = dot(s.plane, clip) / w;
  vec3 normal = octahedral_decode(texelFetch(first_normal, texel, 0).xy);
  float different = 4.0 * out_of_plane * out_of_plane + 64.0 * (1.0 - dot(normal, s.normal));
  return depth == 0.0 ? no_surface : min(different, no_surface);
}

// Of the first `count` of the nine texels around a pixel, the one that shows the nearest surface. Not always all nine:
// a software rasteriser would look at them for every pixel, wanted or not.
ivec2 nearest_surface(ivec2 pixel, int count, SampleSurface s) {
  ivec2 nearest = pixel;
  float least = 2.0 * no_surface;
  int i = 0;
  do {
    ivec2 texel = in_picture(pixel + ivec2(i % 3, i / 3) - 1);
    float found = difference(texel, s);
    nearest = found < least ? texel : nearest;
    least = min(found, least);
  } while (++i < count);
  return nearest;
}

MaskTexels mask_texels(ivec2 pixel, SampleSurface s) {
  vec2 place = vec2(pixel) + offset;
  ivec2 first = ivec2(floor(place));
  vec2 upper = place - vec2(first), lower = 1.0 - upper;
  vec4 weights = vec4(lower.x * lower.y, upper.x * lower.y, lower.x * upper.y, upper.x * upper.y);
  weights *= exp2(-vec4(difference(in_picture(first), s), difference(in_picture(first + ivec2(1, 0)), s),
                        difference(in_picture(first + ivec2(0, 1)), s), difference(in_picture(first + 1), s)));
  float sum = dot(weights, vec4(1.0));
  // Where no texel around the sample shows its surface, the nearest one stands in.
  bool alone = sum < 1e-3;
  ivec2 nearest = nearest_surface(pixel, alone ? 9 : 1, s);
  return alone ? MaskTexels(nearest, vec4(1.0, 0.0, 0.0, 0.0)) : MaskTexels(first, weights / sum);
}

float mask_of_first(ivec2 texel, int light) { return texelFetch(shadow_mask, ivec3(in_picture(texel), light), 0).r; }

float visibility_at(MaskTexels at, int light) {
  return dot(at.weights, vec4(mask_of_first(at.first, light), mask_of_first(at.first + ivec2(1, 0), light),
                              mask_of_first(at.first + ivec2(0, 1), light), mask_of_first(at.first + 1, light)));
}
