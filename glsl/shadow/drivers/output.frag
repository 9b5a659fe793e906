// Copies the visibility of up to four lights from the mask to the channels of a texture of the caller's.
layout(binding = 8) uniform sampler2DArray mask;
uniform ivec4 mask_layers;  // by channel
uniform float steps;        // from 0 to 1 in a normalised format; 0: floats

layout(location = 0) out vec4 visibilities;

void main() {
  vec4 seen;
  for (int i = 0; i < 4; ++i) seen[i] = texelFetch(mask, ivec3(gl_FragCoord.xy, mask_layers[i]), 0).x;
  // OpenGL leaves it to the driver how it rounds.
  visibilities = steps > 0.0 ? floor(clamp(seen, 0.0, 1.0) * steps + 0.5) / steps : seen;
}
