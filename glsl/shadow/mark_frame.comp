// Stores a frame's number, unless OpenGL leaves out what is drawn: see src/shadow/left_out.h.
#include "shared/language.h"

layout(local_size_x = 1) in;

const uint places = 256u;

layout(std430, binding = 7) restrict writeonly buffer Marks { uint drawn[places]; } marks;

uniform int frame;

void main() { marks.drawn[uint(frame) % places] = uint(frame); }
