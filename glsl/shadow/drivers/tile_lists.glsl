// Appends to the lists of tiles and of pixels. Included after tiles.glsl.
void list_tile(ivec2 tile) {
  uint index = atomicAdd(tile_list.listed.count, 1u);
  atomicMax(tile_list.groups_y, index / list_row + 1u);
  tile_list.tiles[index] = packed_tile(tile);
}

void list_tile_apart(ivec2 tile) {
  uint index = atomicAdd(tile_list.apart.count, 1u);
  atomicMax(tile_list.apart_groups_y, index / list_row + 1u);
  tile_list.tiles[tile_list.capacity + index] = packed_tile(tile);
}

void list_decided(ivec2 tile) {
  uint index = atomicAdd(tile_list.decided.count, 1u);
  tile_list.tiles[tile_list.capacity - 1u - index] = packed_tile(tile);
}

// Makes room for more pixels in their list; the index of the first.
uint extend_pixel_list(uint more) {
  uint first = atomicAdd(tile_list.pixel_count, more);
  uint groups = (first + more + pixel_group - 1u) / pixel_group;
  atomicMax(tile_list.pixel_groups_x, min(groups, list_row));
  atomicMax(tile_list.pixel_groups_y, (groups + list_row - 1u) / list_row);
  return first;
}

void list_pixel(uint index, ivec2 place) {
  tile_list.tiles[2u * tile_list.capacity + index] = packed_tile(place);
}

// `all`: how many pixels the viewport has.
void list_noisy_pixel(ivec2 place, uint texel, uint all) {
  uint index = atomicAdd(tile_list.noisy_count, 1u);
  if (index % pixel_group == 0u) {
    uint groups = index / pixel_group + 1u;
    atomicMax(tile_list.noisy_groups_x, min(groups, list_row));
    atomicMax(tile_list.noisy_groups_y, (groups + list_row - 1u) / list_row);
  }
  uint at = noisy_pixel_at(index, all);
  tile_list.tiles[at] = packed_tile(place);
  tile_list.tiles[at + 1u] = texel;
}
