// Reads filtered maps: products whose texels hold means of functions of depth over a kernel of constant radius.
#include "shadow/light.glsl"
#include "lib/prefilter.glsl"

// How far a position on the receiver's plane moves across the light where the picture moves by a pixel, metres.
struct PixelSteps {
  vec2 right, up;
};

// Of planes at a grazing angle to the view this is cut: their pixels would reach over the silhouettes of what is near.
const float least_view_cosine = 1.0 / 8.0;

PixelSteps pixel_steps(Receiver receiver) {
  vec3 position = view_position_of(receiver);
  vec3 ray = view_ray(position);
  vec3 normal = view_normal_of(receiver);
  float cosine = dot(normal, ray);
  cosine = abs(cosine) < least_view_cosine ? (cosine < 0.0 ? -least_view_cosine : least_view_cosine) : cosine;
  float width = pixel_width(position);
  vec3 right = vec3(width, 0.0, 0.0) - ray * (width * normal.x / cosine);
  vec3 up = vec3(0.0, width, 0.0) - ray * (width * normal.y / cosine);
  return PixelSteps(move_in_light(receiver, right).xy, move_in_light(receiver, up).xy);
}

// Radius around a receiver, metres, of what a kernel and the pixel's own width read.
float filter_reach(Receiver receiver, float radius) {
  PixelSteps steps = pixel_steps(receiver);
  return radius + max(length(steps.right), length(steps.up));
}

// Standard deviation, metres, of the depths that a kernel of the light's read radius holds of the receiver's plane.
float plane_deviation(Receiver receiver, Light light) { return 0.5 * light.read_radius * length(receiver.gradient); }

// Where a filtered map is read for a pixel: points in a row along the longer side of the pixel's outline, at the level
// whose texels are as wide as its shorter side, but not a finer one than that which holds the kernel.
struct FilteredPlace {
  vec2 first, next;  // texture coordinates of the first point, and from each point to the next
  int points;
  float level;
};

const int most_points_in_a_row = 8;

// `shrink`: texels of the shadow map along each side of one of the filtered map.
FilteredPlace filtered_place(sampler2DArray map, Receiver receiver, float radius, int shrink, Light light) {
  float side = float(textureSize(map, 0).x);
  vec2 texel = texel_extent(receiver, light) * float(shrink);
  int levels = textureQueryLevels(map);
  float texels = radius / min(texel.x, texel.y);
  // A little more than the radius: rounding must not lead to a finer level than the one that was filtered.
  float finest = float(kernel_level(1.0001 * texels, levels)), spacing = 1.0;
  if (texels_vary()) {
    vec2 largest = largest_texel_extent(receiver, light) * float(shrink);
    float fewest = radius / min(largest.x, largest.y);
    finest = level_of_kernel(texels, fewest, levels);
    // Every level is filtered, so that points may lie half of its kernel's radius apart.
    spacing = 0.5 * kernel_texels(fewest, kernel_level(fewest, levels), true);
  }
  PixelSteps steps = pixel_steps(receiver);
  vec2 right = map_offset(steps.right, light) / float(shrink), up = map_offset(steps.up, light) / float(shrink);
  vec2 longer = length(right) > length(up) ? right : up;
  float across = max(min(length(right), length(up)), spacing * exp2(floor(finest)));
  int points = clamp(int(ceil(length(longer) / across)), 1, most_points_in_a_row);
  across = max(across, length(longer) / float(points));
  vec2 next = longer / (float(points) * side);
  vec2 at = map_place(receiver.position, light) / (float(shrink) * side);
  float level = clamp(log2(across / spacing), finest, float(levels - 1));
  return FilteredPlace(at - 0.5 * float(points - 1) * next, next, points, level);
}

// By a shift: software renderers answer textureSize() for one level in all pixels that they shade together.
ivec2 last_of_level(sampler2DArray map, int level) { return ivec2((textureSize(map, 0).x >> level) - 1); }

// Bilinear, in a level. Not by a sampler: GPUs round its weights to 8 bits, which shows in differences of moments, and
// llvmpipe takes a hundred times as long.
vec4 level_texel(sampler2DArray map, vec2 at, int slice, int level) {
  ivec2 last = last_of_level(map, level);
  at = clamp(at * vec2(last + 1) - 0.5, vec2(0.0), vec2(last));
  ivec2 low = ivec2(at), high = min(low + 1, last);
  vec2 weight = at - vec2(low);
  vec4 below = mix(texelFetch(map, ivec3(low, slice), level), texelFetch(map, ivec3(high.x, low.y, slice), level),
                   weight.x);
  vec4 above = mix(texelFetch(map, ivec3(low.x, high.y, slice), level), texelFetch(map, ivec3(high, slice), level),
                   weight.x);
  return mix(below, above, weight.y);
}

// Filtered over the pixel too. `slice`: of so many of each layer.
vec4 filtered_texel(sampler2DArray map, FilteredPlace place, int slice, int slices, Light light) {
  slice += light.layer * slices;
  int level = int(place.level);
  float coarser = place.level - float(level);
  vec2 share = vec2(1.0 - coarser, coarser) / float(place.points);
  vec4 mean = vec4(0.0);
  int i = 0;
  do {
    vec2 at = place.first + float(i) * place.next;
    mean += share.x * level_texel(map, at, slice, level);
    if (coarser > 0.0) mean += share.y * level_texel(map, at, slice, level + 1);
  } while (++i < place.points);
  return mean;
}

// What a technique returns that filters with a kernel of constant radius.
Visibility of_constant_kernel(float lit, float radius, Receiver receiver, Light light) {
  return Visibility(lit, lit < 1.0 ? radius : 0.0, 0.0, radius < texel_size(receiver, light), false);
}
