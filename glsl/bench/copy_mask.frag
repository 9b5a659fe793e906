// Copies a light's layer of a mask: the lower bound for the cost of any pass that reads and writes one.
layout(binding = 8) uniform sampler2DArray source;
uniform int layer;

layout(location = 0) out vec4 mask;

void main() { mask = texelFetch(source, ivec3(ivec2(gl_FragCoord.xy), layer), 0); }
