// Smooths the stairs of a picture that has one sample of each pixel. After the idea of T. Lottes, FXAA (NVIDIA 2009):
// where a pixel and its neighbours differ in brightness, they are blended along the edge between them, and as far along
// it as the edge is close to a row or a column of pixels.
layout(binding = 0) uniform sampler2D picture;

layout(location = 0) out vec4 display;

// Of display values, 0 to 1.
const float least_contrast = 0.04;      // below which a difference is no edge
const float relative_contrast = 0.125;  // of the brightest neighbour: the same for bright pixels
const float longest = 8.0;              // pixels along the edge
const float least_slope = 1.0 / 128.0;  // keeps the division below finite

float brightness(vec3 color) { return dot(color, vec3(0.299, 0.587, 0.114)); }

float corner(ivec2 pixel, ivec2 offset, ivec2 last) {
  return brightness(texelFetch(picture, clamp(pixel + offset, ivec2(0), last), 0).rgb);
}

vec3 along(vec2 at, vec2 way) { return textureLod(picture, at + way, 0.0).rgb; }

void main() {
  ivec2 size = textureSize(picture, 0), pixel = ivec2(gl_FragCoord.xy);
  vec3 color = texelFetch(picture, pixel, 0).rgb;
  ivec2 last = size - 1;
  float low_left = corner(pixel, ivec2(-1, -1), last), low_right = corner(pixel, ivec2(1, -1), last);
  float high_left = corner(pixel, ivec2(-1, 1), last), high_right = corner(pixel, ivec2(1, 1), last);
  float own = brightness(color);
  float least = min(own, min(min(low_left, low_right), min(high_left, high_right)));
  float most = max(own, max(max(low_left, low_right), max(high_left, high_right)));
  if (most - least >= max(least_contrast, relative_contrast * most)) {
    // Across the gradient.
    vec2 edge = vec2(low_left + low_right - high_left - high_right, high_right + low_right - high_left - low_left);
    float slope = min(abs(edge.x), abs(edge.y)) + least_slope;
    vec2 way = clamp(edge / slope, -longest, longest) / vec2(size);
    vec2 at = gl_FragCoord.xy / vec2(size);
    vec3 near = 0.5 * (along(at, -way / 6.0) + along(at, way / 6.0));
    vec3 far = 0.5 * near + 0.25 * (along(at, -0.5 * way) + along(at, 0.5 * way));
    // What lies farther along belongs to another edge if it is brighter or darker than all that is around.
    float mean = brightness(far);
    color = mean < least || mean > most ? near : far;
  }
  display = vec4(color, 1.0);
}
