// The map's texels are occluders: each is projected from the receiver onto the light, where bit masks gather which of
// the light's points are hidden. See docs/techniques.md.
#include "shadow/search.glsl"
#include "shadow/sampling.glsl"

float read_radius(Receiver receiver, Light light) { return fine_search_radius(receiver, light); }

// Points of the light.

// The masks' points together are a rank-1 lattice on the torus: of n points, the one of number i is at (i, 19 i) / n.
// Every backprojection_masks-th of them belongs to the same mask, so that masks differ by a shift. Of the odd factors
// from 3 to 127, 19 has the second least error at random straight edges with 8 masks, and no great one with fewer.
const int points_in_mask = 32;
const float lattice_factor = 19.0;

// For each of 32 numbers, the points k of which 19 k, modulo 32, is less.
const uint below_number[points_in_mask] = uint[](
    0x00000000u, 0x00000001u, 0x08000001u, 0x08400001u, 0x08420001u, 0x08421001u, 0x08421081u, 0x08421085u,
    0x28421085u, 0x29421085u, 0x294a1085u, 0x294a5085u, 0x294a5285u, 0x294a5295u, 0xa94a5295u, 0xad4a5295u,
    0xad6a5295u, 0xad6b5295u, 0xad6b5a95u, 0xad6b5ad5u, 0xad6b5ad7u, 0xbd6b5ad7u, 0xbdeb5ad7u, 0xbdef5ad7u,
    0xbdef7ad7u, 0xbdef7bd7u, 0xbdef7bdfu, 0xfdef7bdfu, 0xffef7bdfu, 0xffff7bdfu, 0xfffffbdfu, 0xffffffdfu);

// A mask's shift of its points k / 32 and 19 k / 32, 0..1.
vec2 shift_of(int mask, vec2 noise) {
  return fract(noise + vec2(1.0, lattice_factor) * (float(mask) / float(points_in_mask * backprojection_masks)));
}

// The bits of the numbers, modulo 32, from one up to another that is greater by 0 to 32, if those below each have the
// bits `below_first` and `below_end`.
uint bits_between(int first, int end, uint below_first, uint below_end) {
  bool wraps = (first >> 5) != (end >> 5);
  return below_first ^ below_end ^ (wraps ? ~0u : 0u);
}

// The points of a mask between two corners in the light's square, of which the coordinates go from 0 to 32.
uint points_in(vec2 low, vec2 high, vec2 shift) {
  vec2 moved = float(points_in_mask) * shift;
  ivec2 first = ivec2(ceil(low - moved)), end = ivec2(ceil(high - moved));
  uint across = bits_between(first.x, end.x, (1u << (first.x & 31)) - 1u, (1u << (end.x & 31)) - 1u);
  return across & bits_between(first.y, end.y, below_number[first.y & 31], below_number[end.y & 31]);
}

// Coordinates of the light's square, -1..1, in those of points_in().
vec2 in_square(vec2 at) { return clamp(0.5 * at + 0.5, 0.0, 1.0) * float(points_in_mask); }

// The points of a mask that belong to the light: to the disc within the square.
uint points_of_light(vec2 shift, Light light) {
  if (is_square(light)) return ~0u;
  uint inside = 0u;
  for (int k = 0; k < points_in_mask; ++k) {
    vec2 point = 2.0 * fract(vec2(1.0, lattice_factor) * (float(k) / float(points_in_mask)) + shift) - 1.0;
    if (dot(point, point) < 1.0) inside |= 1u << k;
  }
  return inside;
}

// Occluders.

// Reads along each side of the grid: odd, so that the receiver is in the middle of a cell.
const int reads_across = backprojection_reads | 1;

// The tip of the cone from the receiver to the light has this radius, for a square the half side. It smooths the
// texels' edges as filtering does.
float tip_radius(Receiver receiver, Light light) {
  return 0.62 * texel_size(receiver, light) / square_half(1.0, light);
}

// The part of the map that can hide a part of the light, as cells. Each is read as a block of 2 x 2 texels, which stand
// for its quarters. Where so few blocks suffice they are all read; else cells are larger, and may grow outwards.
struct Grid {
  float reach;    // metres from the receiver: beyond it nothing is read
  bool complete;  // a cell is as large as its block
  ivec2 first;    // texel, if complete
  ivec2 cells;
  vec2 begin;    // offset of that texel's corner from the receiver
  vec2 texel;    // metres
  float growth;  // exponent of a larger cell's number that gives its distance; 1: all are as large
};

Grid grid_of(Receiver receiver, float radius, Light light) {
  vec2 texel = texel_extent(receiver, light);
  float size = texel_size(receiver, light);
  float reach = radius + tip_radius(receiver, light);
  vec2 place = map_place(receiver.position, light);
  ivec2 first = ivec2(floor(place - reach / texel));
  ivec2 cells = (ivec2(floor(place + reach / texel)) + 2 - first) / 2;
  bool complete = max(cells.x, cells.y) <= reads_across;
  float growth = clamp(0.5 * log2(reach / (4.0 * size)), 1.0, 1.5);
  vec2 begin = texel_offset(receiver, first, light) - 0.5 * texel;
  return Grid(reach, complete, first, complete ? cells : ivec2(reads_across), begin, texel, growth);
}

// Whether what begins at that distance in x and y is too far from the receiver to be read.
bool is_beyond(Grid grid, vec2 distance_to, Light light) {
  if (is_square(light)) return max(distance_to.x, distance_to.y) >= grid.reach;
  return dot(distance_to, distance_to) >= grid.reach * grid.reach;
}

// A cell, or a quarter of one.
struct Cell {
  vec2 begin, end;  // corners, as offsets from the receiver
  bool blocks;
  float depth;
};

// How near a cell comes to the receiver in x and y.
vec2 nearest_of(vec2 begin, vec2 end) { return max(max(begin, -end), 0.0); }

// What is known of the light's points, and the blockers that hid some of them.
struct Cover {
  uint inside[backprojection_masks];  // points that belong to the light
  uint hidden[backprojection_masks];
  float height_sum;  // metres along the light
  float blockers;
};

Cover uncovered(vec2 noise, Light light) {
  Cover cover;
  for (int mask = 0; mask < backprojection_masks; ++mask) {
    cover.inside[mask] = points_of_light(shift_of(mask, noise), light);
    cover.hidden[mask] = 0u;
  }
  cover.height_sum = cover.blockers = 0.0;
  return cover;
}

void hide(inout Cover cover, vec2 low, vec2 high, float height, vec2 noise) {
  vec2 from = in_square(low), to = in_square(high);
  uint any = 0u;
  for (int mask = 0; mask < backprojection_masks; ++mask) {
    uint points = cover.inside[mask] & points_in(from, to, shift_of(mask, noise));
    cover.hidden[mask] |= points;
    any |= points;
  }
  cover.height_sum += any != 0u ? height : 0.0;
  cover.blockers += any != 0u ? 1.0 : 0.0;
}

// The factor that projects offsets at a blocker of that height onto the light's square. The sum of third powers widens
// penumbrae as narrow as texels, of which the map's steps would show, and leaves wider ones as they are.
float projection(Receiver receiver, float height, Light light) {
  vec2 radii = vec2(penumbra_radius(receiver, height, light), tip_radius(receiver, light));
  return pow(dot(radii * radii, radii), -1.0 / 3.0);
}

// Hides what a cell hides, if it blocks. `left` and `below`: the projection() of its neighbours that block, else 0;
// it becomes the cell's own.
void add_cell(inout Cover cover, inout float left, inout float below, Cell cell, Grid grid, Receiver receiver,
              vec2 noise, Light light) {
  vec2 nearest = nearest_of(cell.begin, cell.end);
  if (!cell.blocks || is_beyond(grid, nearest, light)) {
    left = below = 0.0;
    return;
  }
  float height = receiver.position.z - cell.depth;
  float scale = projection(receiver, height, light);
  vec2 low = cell.begin * scale, high = cell.end * scale;
  // No gaps beside neighbours that block at other heights.
  if (left > 0.0) low.x = min(low.x, cell.begin.x * left);
  if (below > 0.0) low.y = min(low.y, cell.begin.y * below);
  // What blocks at the rim of what is read goes on blocking beyond it.
  const float far = 2.0;
  if (cell.begin.x <= 0.0 && is_beyond(grid, vec2(-cell.begin.x, nearest.y), light)) low.x = -far;
  if (cell.end.x >= 0.0 && is_beyond(grid, vec2(cell.end.x, nearest.y), light)) high.x = far;
  if (cell.begin.y <= 0.0 && is_beyond(grid, vec2(nearest.x, -cell.begin.y), light)) low.y = -far;
  if (cell.end.y >= 0.0 && is_beyond(grid, vec2(nearest.x, cell.end.y), light)) high.y = far;
  hide(cover, low, high, height, noise);
  left = below = scale;
}

// Adds a cell of which the quarters have the depths of a block of texels, the first of which is at that offset. `left`
// and `below`: as for add_cell(), of two rows and of two columns.
void add_block(inout Cover cover, inout vec2 left, inout vec2 below, vec2 begin, vec2 end, vec4 depths, vec2 offset,
               Grid grid, Receiver receiver, float bias, vec2 noise, Light light) {
  Offsets at = Offsets(offset.x + grid.texel.x * vec4(0.0, 1.0, 1.0, 0.0),
                       offset.y + grid.texel.y * vec4(1.0, 1.0, 0.0, 0.0));
  bvec4 blocking = lessThan(depths, blocking_depths_at(receiver, at, bias));
  bool whole = all(blocking);  // is one occluder, which costs a quarter of four
  int count = whole ? 1 : any(blocking) ? 4 : 0;
  if (count < 4) {
    left = count == 0 ? vec2(0.0) : vec2(max(left.x, left.y));
    below = count == 0 ? vec2(0.0) : vec2(max(below.x, below.y));
  }
  const int gathered[4] = int[](3, 2, 0, 1);  // rows from below, each from the left
  vec2 size = whole ? end - begin : 0.5 * (end - begin);
  for (int quarter = 0; quarter < count; ++quarter) {
    int column = quarter & 1, row = quarter >> 1, texel = gathered[quarter];
    vec2 corner = begin + vec2(column, row) * size;
    float depth = whole ? dot(depths, vec4(0.25)) : depths[texel];
    add_cell(cover, left[row], below[column], Cell(corner, corner + size, blocking[texel], depth), grid, receiver,
             noise, light);
  }
  if (whole) {
    left = left.xx;
    below = below.xx;
  }
}

// Where the cell of that number begins along an axis, if cells are larger than blocks: metres from the receiver, around
// which a cell is 1.5 texels wide.
float cell_begin(Grid grid, float texel, int number) {
  float from_middle = float(2 * number - reads_across);  // odd
  float share = (abs(from_middle) - 1.0) / float(reads_across - 1);
  float least = 0.75 * texel;
  return sign(from_middle) * (least + (grid.reach - least) * pow(share, grid.growth));
}

vec2 corner_of(Grid grid, ivec2 cell) {
  if (grid.complete) return grid.begin + 2.0 * vec2(cell) * grid.texel;
  return vec2(cell_begin(grid, grid.texel.x, cell.x), cell_begin(grid, grid.texel.y, cell.y));
}

// The first texel of the block that is read for a cell between those corners: at a random place in a larger cell.
ivec2 block_of(Grid grid, ivec2 cell, vec2 begin, vec2 end, Receiver receiver, vec2 jitter, Light light) {
  if (grid.complete) return grid.first + 2 * cell;
  // Along a row and along a column, the places are spread evenly over both axes.
  vec2 share = fract(jitter + golden * vec2(cell.yx) + plastic * vec2(cell)) - 0.5;
  vec2 middle = 0.5 * (begin + end) + share * max(end - begin - 2.0 * grid.texel, 0.0);
  if (!is_square(light)) middle *= min(1.0, grid.reach / length(middle));
  return ivec2(floor(map_place(receiver.position, light) + middle / grid.texel - 0.5));
}

void add_cells(inout Cover cover, Grid grid, Receiver receiver, float bias, vec2 noise, Light light) {
  vec2 jitter = pixel_noise(receiver, blocker_step);
  vec2 below[reads_across];
  for (int x = 0; x < grid.cells.x; ++x) below[x] = vec2(0.0);
  int y = 0;
  do {
    vec2 left = vec2(0.0);
    int x = 0;
    do {
      vec2 begin = corner_of(grid, ivec2(x, y)), end = corner_of(grid, ivec2(x + 1, y + 1));
      if (is_beyond(grid, nearest_of(begin, end), light)) {
        left = below[x] = vec2(0.0);
        continue;
      }
      ivec2 first = block_of(grid, ivec2(x, y), begin, end, receiver, jitter, light);
      add_block(cover, left, below[x], begin, end, depths_from(first, light), texel_offset(receiver, first, light),
                grid, receiver, bias, noise, light);
    } while (++x < grid.cells.x);
  } while (++y < grid.cells.y);
}

// The disc to read, of which `wide` metres can be read without gaps.
float radius_to_read(Receiver receiver, float wide, Light light) {
  return fine_edge_radius(receiver, radius_with_thin_casters(receiver, wide, light), wide, light);
}

// Where penumbrae are narrower than a texel: the bilinear shadow of the light's centre, as the mean of four points
// whose variance is that of the penumbra. Where the four texels around the receiver agree it is theirs, as in pixels of
// decided tiles.
Visibility narrow_shadow(Receiver receiver, float bias, Light light) {
  Visibility centre = centre_shadow(receiver, bias, light);
  if (centre.visibility == 0.0 || centre.visibility == 1.0) return centre;
  float apart = square_half(centre.penumbra_radius, light) * inversesqrt(3.0);
  float lit = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    vec2 side = vec2(2 * ivec2(corner & 1, corner >> 1) - 1);
    lit += lit_share(receiver, apart * side, bias, light);
  }
  centre.visibility = 0.25 * lit;
  return centre;
}

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  receiver = with_surroundings(receiver, bias, cone_slope(receiver, light), light);
  // Cells of a narrower disc are texels.
  float radius = radius_to_read(receiver, float(reads_across) * texel_size(receiver, light), light);
  if (radius < 0.5 * texel_size(receiver, light)) return narrow_shadow(receiver, bias, light);
  vec2 noise = pixel_noise(receiver, filter_step);
  Cover cover = uncovered(noise, light);
  Grid grid = grid_of(receiver, radius, light);
  add_cells(cover, grid, receiver, bias, noise, light);
  int points = 0, hidden = 0;
  for (int mask = 0; mask < backprojection_masks; ++mask) {
    points += bitCount(cover.inside[mask]);
    hidden += bitCount(cover.hidden[mask]);
  }
  if (hidden == 0) return fully_lit();
  float mean = max(cover.height_sum / cover.blockers, 0.0);
  float penumbra = penumbra_radius(receiver, mean, light);
  return Visibility(1.0 - float(hidden) / float(points), penumbra, mean, penumbra < texel_size(receiver, light), false);
}
