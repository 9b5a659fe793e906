// What the passes of the technique hybrid write.
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/shadowed.glsl"

layout(binding = 0, rgba16f) uniform writeonly restrict image2DArray mask;
uniform int mask_layer;

void store(ivec2 pixel, Visibility seen, int layer) {
  imageStore(mask, ivec3(pixel, mask_layer), mask_texel(Shadowed(seen, layer, false)));
}

// A pixel for which no rays are traced.
void store_decided(ivec2 pixel, bool is_lit, float blocker_distance, Light light) {
  Visibility seen = fully_lit();
  if (!is_lit) {
    vec3 position = light_position(view_position_at(pixel));
    float radius = packed_radius(position, blocker_distance);
    bool under_texel = blocker_distance > 0.0 && radius < texel_size_at(position, light);
    seen = Visibility(0.0, radius, blocker_distance, under_texel, false);
  }
  store(pixel, seen, light.layer);
}

// The pixels that are left to rays, and the triangles that they show. std430; read and filled in truth/hybrid.cpp.
struct LeftPixel {
  uint at;        // x in the lower 16 bits, y in the upper ones
  uint surface;   // as the surface id pass numbers them
  uint triangle;
};

layout(std430, binding = 6) restrict buffer LeftPixels {
  uint count;
  LeftPixel pixels[];
} left;
