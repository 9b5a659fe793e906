// A list of pixels of the viewport, and the command that runs over it in groups of 64.
layout(std430, binding = 5) restrict buffer PixelList {
  uint groups_x, groups_y, groups_z;  // rows of `pixel_list_row` groups, and fewer where one row is enough
  uint count;
  uint pixels[];  // x in the lower 16 bits, y in the upper ones
} pixel_list;

const uint pixel_list_group = 64u, pixel_list_row = 256u;

// Makes room for more pixels; their first index.
uint extend_pixel_list(uint more) {
  uint first = atomicAdd(pixel_list.count, more);
  uint groups = (first + more + pixel_list_group - 1u) / pixel_list_group;
  atomicMax(pixel_list.groups_x, min(groups, pixel_list_row));
  atomicMax(pixel_list.groups_y, (groups + pixel_list_row - 1u) / pixel_list_row);
  return first;
}

uint packed_pixel_place(ivec2 place) { return uint(place.x) | uint(place.y) << 16; }
ivec2 listed_pixel(uint index) {
  uint place = pixel_list.pixels[index];
  return ivec2(place & 0xffffu, place >> 16);
}
