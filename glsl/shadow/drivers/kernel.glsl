// The size of a visibility filter's kernel. Included after gbuffer.glsl.
#include "lib/packed_texel.glsl"

// Whether texels hold how many frames they average.
bool counts_frames() { return history_reuse != 0 && history_mean != 0; }

// Whether filters keep a texel as it is. One that was blended with a history has the noise of other frames.
bool is_noise_free(uint texel) { return history_reuse == 0 && texel_noise_free(texel); }

// Kernels below this are narrower than a pixel: a neighbour would weigh under 0.004.
const float least_sigma = 0.3;

// Standard deviation of the kernel along x and y, pixels: filter.width of the penumbra's full width at a position in
// light space. `pixels`: pixels a metre along x and along y, see pixels_on_plane().
vec2 sigma_for(vec3 position, vec2 pixels, float blocker_distance) {
  return min(filter_width * 2.0 * packed_radius(position, blocker_distance) * pixels, filter_max_sigma);
}
