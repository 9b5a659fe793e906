// Appends to the lists of tiles. Included after tiles.glsl.
void list_tile(ivec2 tile) {
  uint index = atomicAdd(tile_list.listed.count, 1u);
  atomicMax(tile_list.groups_y, index / list_row + 1u);
  tile_list.tiles[index] = packed_tile(tile);
}

void list_rim_tile(ivec2 tile) {
  uint index = atomicAdd(tile_list.rim.count, 1u);
  atomicMax(tile_list.rim_groups_y, index / list_row + 1u);
  tile_list.tiles[tile_list.capacity + index] = packed_tile(tile);
}

void list_decided(ivec2 tile) {
  uint index = atomicAdd(tile_list.decided.count, 1u);
  tile_list.tiles[tile_list.capacity - 1u - index] = packed_tile(tile);
}
