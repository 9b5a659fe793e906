// Says that the caster has moved, to passes that ask.
layout(location = 0) out float moved;

void main() { moved = 1.0; }
