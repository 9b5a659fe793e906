// The viewer's image: one picture, or two, of which one is shown, both side by side, or their difference. With
// PICTURES 1, which is compiled apart because a software rasteriser runs all branches, the one is bound as A.
const int comparison_a = 0;
const int comparison_b = 1;
const int comparison_wipe = 2;
const int comparison_side_by_side = 3;
const int comparison_difference = 4;

layout(binding = 0) uniform sampler2D picture_a;
layout(binding = 2) uniform sampler2D tint_a;
#if PICTURES == 2
layout(binding = 1) uniform sampler2D picture_b;
layout(binding = 3) uniform sampler2D tint_b;
#endif

uniform int comparison;
uniform float wipe;         // x where the second picture begins, 0..1 of the window's width
uniform float gain;         // of the difference
uniform float tint;         // share of the tints in the pictures
uniform float zoom;         // window pixels for each pixel of the picture
uniform vec2 center;        // the picture's point in the middle of the window, pixels from its lower left
uniform vec2 picture_size;  // pixels at full resolution, however large the textures are
uniform vec2 window_size;   // pixels

layout(location = 0) out vec4 display;

vec3 tinted(sampler2D picture, sampler2D colors, vec2 at) {
  vec3 shown = textureLod(picture, at, 0.0).rgb;
#if TINTED
  shown = mix(shown, textureLod(colors, at, 0.0).rgb, tint);
#endif
  return shown;
}

vec3 shown(bool second, vec2 at) {
#if PICTURES == 2
  if (second) return tinted(picture_b, tint_b, at);
#endif
  return tinted(picture_a, tint_a, at);
}

void main() {
  vec2 pixel = gl_FragCoord.xy;
  vec2 middle = window_size * 0.5;
#if PICTURES == 2
  bool second = comparison == comparison_b || (comparison == comparison_wipe && pixel.x >= wipe * window_size.x);
  if (comparison == comparison_side_by_side) {
    second = pixel.x >= middle.x;
    middle.x *= second ? 1.5 : 0.5;
  }
#else
  const bool second = false;
#endif
  vec2 at = (center + (pixel - middle) / zoom) / picture_size;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) {
    display = vec4(vec3(0.07), 1.0);
#if PICTURES == 2
  } else if (comparison == comparison_difference) {
    display = vec4(abs(shown(false, at) - shown(true, at)) * gain, 1.0);
#endif
  } else {
    display = vec4(shown(second, at), 1.0);
  }
}
