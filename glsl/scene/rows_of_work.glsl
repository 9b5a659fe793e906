// Groups of 64 invocations, in as many rows as are needed: OpenGL guarantees only 65,535 groups in one.
layout(local_size_x = 64) in;

// The index of an invocation, row after row.
uint index_in_rows() {
  return gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) + gl_GlobalInvocationID.x;
}
