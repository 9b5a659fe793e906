// Reads a mask and writes it: the least that any pass from mask to mask does.
layout(binding = 8) uniform sampler2DArray source;

layout(location = 0) out vec4 mask;

void main() { mask = texelFetch(source, ivec3(ivec2(gl_FragCoord.xy), 0), 0); }
