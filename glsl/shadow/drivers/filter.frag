// A pass of a filter. Included after the filter.
#include "shadow/drivers/filter.glsl"
#include "shadow/drivers/filter_output.glsl"

layout(binding = 12) uniform usampler2D source_texels;

uint texel_at(ivec2 pixel) { return texelFetch(source_texels, pixel, 0).x; }
float stored_depth_at(ivec2 pixel) { return texelFetch(receiver_depth, pixel, 0).x; }

#if TO_MASK
layout(location = 0) out vec4 mask;

void main() { mask = unpacked(filtered(ivec2(gl_FragCoord.xy)), ivec2(gl_FragCoord.xy)); }
#else
layout(location = 0) out uint texel;

void main() { texel = filtered(ivec2(gl_FragCoord.xy)); }
#endif
