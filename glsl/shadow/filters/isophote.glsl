// bilateral_separable with a narrower kernel, which does not reach from a wide penumbra into a narrow one, and then a
// mean along the line of equal visibility through the pixel. The first blurs the penumbra's profile less; the
// second averages noise where the profile has none to lose. Neither changes a pixel that is lit or dark with its
// neighbours on its plane.
#include "shadow/drivers/filter.glsl"

// Standard deviations of the kernels, as shares of that of filter.width: of the first two passes, and of the last one.
const float across = 0.35, lengthwise = 0.7;
// The first two are not made narrower than this, pixels of the picture.
const float least_across = 0.8;
// Difference of visibility at which a neighbour on the line weighs e^-1/2: a line that bends is left there.
const float range = 0.05;

// Visibility of a neighbour; the pixel's own in its place as far as the neighbour lies off the receiver's plane.
float beside(ivec2 pixel, ivec2 to, Surface surface, float own) {
  ivec2 at = clamp(pixel + to, lowest_pixel(), highest_pixel());
  float depth = stored_depth_at(at);
  float off_plane = plane_distance(surface, at - pixel, depth);
  float weight = is_sky_depth(depth) ? 0.0 : exp(-0.5 * off_plane * off_plane);
  return mix(own, texel_visibility(texel_at(at)), weight);
}

// How visibility changes from one side of the pixel to the other, a standard deviation away along each axis.
vec2 gradient_at(ivec2 pixel, Surface surface, vec2 sigma, float own) {
  ivec2 to = ivec2(max(sigma + 0.5, 1.0));
  float a = beside(pixel, -to, surface, own), b = beside(pixel, ivec2(to.x, -to.y), surface, own);
  float c = beside(pixel, ivec2(-to.x, to.y), surface, own), d = beside(pixel, to, surface, own);
  return vec2(b + d - a - c, c + d - a - b);
}

float mean_on_isophote(ivec2 pixel, Surface surface, vec2 sigma, float own) {
  vec2 gradient = gradient_at(pixel, surface, sigma, own);
  float steepness = length(gradient);
  if (steepness < 1e-4) return own;
  vec2 line = vec2(-gradient.y, gradient.x) / steepness * sigma * lengthwise;  // to one standard deviation, pixels
  float pixels = max(abs(line.x), abs(line.y));
  float spacing = max(2.0 / float(filter_taps), 1.0 / pixels);
  float shift = (tap_noise(pixel, 0) - 0.5) * (spacing - 1.0 / pixels);
  int side = int(2.0 / spacing + 0.5);
  float sum = own, weights = 1.0;
  int i = -side;
  do {
    float at = float(i) * spacing + shift;
    ivec2 to = ivec2(roundEven(at * line));
    ivec2 neighbour = pixel + to;
    bool inside = all(greaterThanEqual(neighbour, lowest_pixel())) && all(lessThanEqual(neighbour, highest_pixel()));
    if (i == 0 || !inside) continue;
    float depth = stored_depth_at(neighbour), visibility = texel_visibility(texel_at(neighbour));
    vec3 off = vec3(at, plane_distance(surface, to, depth), (visibility - own) / range);
    float weight = is_sky_depth(depth) ? 0.0 : exp(-0.5 * dot(off, off));
    sum += weight * visibility;
    weights += weight;
  } while (++i <= side);
  return sum / weights;
}

// Between the passes, of a packed texel: no pass changes it. Until then the bit is the history's.
const uint settled_bit = 0x80000000u;
const float same_plane = 0.5;  // at most, of plane_distance()
const int least_alike = 4;     // pixels, of which one is the pixel itself

// Whether a pixel is taken to lie outside of the penumbra: it is wholly lit or wholly dark, as its neighbours are.
bool is_settled(ivec2 pixel, uint texel, Surface surface) {
  uint own = texel & visibility_bits;
  if (own != 0u && own != visibility_bits) return false;
  bool same = true;
  int alike = 0;
  for (int i = 0; same && i < 9; ++i) {
    ivec2 at = pixel + ivec2(i % 3, i / 3) - 1;
    if (any(lessThan(at, lowest_pixel())) || any(greaterThan(at, highest_pixel()))) continue;
    float depth = stored_depth_at(at);
    if (is_sky_depth(depth) || abs(plane_distance(surface, at - pixel, depth)) > same_plane) continue;
    same = (texel_at(at) & visibility_bits) == own;
    ++alike;
  }
  return same && alike >= least_alike;
}

uint filtered(ivec2 pixel) {
  uint texel = texel_at(pixel);
  if (filter_pass > 0 && (texel & settled_bit) != 0u) return texel;
  texel &= ~settled_bit;
  float distance_to = kernel_distance(pixel, texel);
  Surface surface = surface_at(pixel);
  if (filter_pass == 0 && distance_to > 0.0 && is_settled(pixel, texel, surface)) return texel | settled_bit;
  vec2 sigma = distance_to > 0.0 ? kernel_sigma(surface, distance_to) : vec2(0.0);
  if (filter_pass == 2) {
    if (min(sigma.x, sigma.y) < least_sigma) return texel;
    return with_visibility(texel, mean_on_isophote(pixel, surface, sigma, texel_visibility(texel)));
  }
  int axis = min(filter_pass, 1);
  float width = max(across * sigma[axis], min(sigma[axis], least_across / float(mask_scale)));
  return width < least_sigma ? texel : with_visibility(texel, mean_on_axis(axis, pixel, surface, width, distance_to));
}
