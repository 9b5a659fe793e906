// A caster for pictures that are drawn only to have programs compiled: near the light, over the half of the map below a
// diagonal, so that receivers lie in light, in shadow and in penumbra.
void main() { gl_Position = vec4(gl_VertexID == 1 ? 1.0 : -1.0, gl_VertexID == 2 ? 1.0 : -1.0, 0.0, 1.0); }
