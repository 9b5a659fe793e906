// No filter: used where the mask only has to be unpacked.
#include "shadow/drivers/filter.glsl"

uint filtered(ivec2 pixel) { return texel_at(pixel); }
