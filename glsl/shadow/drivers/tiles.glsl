// Tiles of 8 × 8 pixels: those that are decided at once, those whose pixels have to be computed one by one, and the
// commands that run over them.
#include "shadow/drivers/decisions.glsl"

// The commands are for the listed tiles in the compute driver, the listed tiles in the fragment driver, and the decided
// tiles. Tiles whose receivers may read what others do not, beyond the rim of a lamp's map or in the second layer, are
// listed apart, with commands for both drivers. The last two commands are for pixels that are listed one by one, in
// groups of 64, in compute shaders: those to be computed, and those of them that have noise and are filtered
// afterwards.
struct DrawPoints {
  uint count, instance_count, first_vertex, base_instance;
};

layout(std430, binding = 7) restrict buffer TileList {
  uint groups_x, groups_y, groups_z;  // rows of `list_row` tiles
  DrawPoints listed, decided;
  uint apart_groups_x, apart_groups_y, apart_groups_z;
  DrawPoints apart;
  uint pixel_groups_x, pixel_groups_y, pixel_groups_z;  // rows of `list_row` groups, and fewer in the only row
  uint pixel_count;
  uint noisy_groups_x, noisy_groups_y, noisy_groups_z;  // the same
  uint noisy_count;
  uint wide_overlaps;  // tiles in which casters overlap in penumbrae of a given width
  uint capacity;  // tiles, of each of both halves of `tiles`
  // x in the lower 16 bits, y in the upper ones; of the first half listed ones from the front, decided ones from the
  // end; of the second half those listed apart. Behind both, in the same way, the pixels of the viewport that are
  // listed, with room for all; and behind these, two by two, pixels with noise and their packed texels.
  uint tiles[];
} tile_list;

const uint list_row = 256u;
const uint pixel_group = 64u;  // listed pixels that a work group computes

uint packed_tile(ivec2 tile) { return uint(tile.x) | uint(tile.y) << 16; }
ivec2 unpacked_tile(uint tile) { return ivec2(tile & 0xffffu, tile >> 16); }

ivec2 listed_tile(uint index) { return unpacked_tile(tile_list.tiles[index]); }
ivec2 apart_tile(uint index) { return unpacked_tile(tile_list.tiles[tile_list.capacity + index]); }
ivec2 decided_tile(uint index) { return unpacked_tile(tile_list.tiles[tile_list.capacity - 1u - index]); }
ivec2 listed_pixel(uint index) { return unpacked_tile(tile_list.tiles[2u * tile_list.capacity + index]); }
// Where in `tiles` a pixel with noise is, in a viewport of so many pixels; its texel is next to it.
uint noisy_pixel_at(uint index, uint all) { return 2u * tile_list.capacity + all + 2u * index; }
