// The map's texels are occluders: each is projected from the receiver onto the light, where bit masks gather which of
// the light's points are hidden. See docs/techniques.md.
#include "shadow/search.glsl"
#include "shadow/sampling.glsl"

float read_radius(Receiver receiver, Light light) { return fine_search_radius(receiver, light); }

// Points of the light.

const int points_in_mask = 32;  // point k of a mask is at (k / 32, radical inverse of k) on the torus, plus a shift

// For each of 32 numbers, the points whose radical inverse, in 32nds, is less.
const uint inverse_below[points_in_mask] = uint[](
    0x00000000u, 0x00000001u, 0x00010001u, 0x00010101u, 0x01010101u, 0x01010111u, 0x01110111u, 0x01111111u,
    0x11111111u, 0x11111115u, 0x11151115u, 0x11151515u, 0x15151515u, 0x15151555u, 0x15551555u, 0x15555555u,
    0x55555555u, 0x55555557u, 0x55575557u, 0x55575757u, 0x57575757u, 0x57575777u, 0x57775777u, 0x57777777u,
    0x77777777u, 0x7777777fu, 0x777f777fu, 0x777f7f7fu, 0x7f7f7f7fu, 0x7f7f7fffu, 0x7fff7fffu, 0x7fffffffu);

// A mask's shift, 0..1: that of the pixel, and from mask to mask a step of the plastic number's lattice (Roberts 2018).
const vec2 plastic = vec2(0.75487767, 0.56984029);
const float golden = 0.61803399;
vec2 shift_of(int mask, vec2 noise) { return fract(noise + plastic * float(mask)); }

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
  return across & bits_between(first.y, end.y, inverse_below[first.y & 31], inverse_below[end.y & 31]);
}

// Coordinates of the light's square, -1..1, in those of points_in().
vec2 in_square(vec2 at) { return clamp(0.5 * at + 0.5, 0.0, 1.0) * float(points_in_mask); }

// The points of a mask that belong to the light: to the disc within the square.
uint points_of_light(vec2 shift, Light light) {
  if (is_square(light)) return ~0u;
  uint inside = 0u;
  for (int k = 0; k < points_in_mask; ++k) {
    vec2 point = 2.0 * fract(vec2(k, bitfieldReverse(uint(k)) >> 27) / float(points_in_mask) + shift) - 1.0;
    if (dot(point, point) < 1.0) inside |= 1u << k;
  }
  return inside;
}

// Occluders.

// Reads along each side of the grid: odd, so that the receiver is in the middle of a cell.
const int reads_across = backprojection_reads | 1;

// The part of the map that can hide a part of the light, as cells; each is one occluder with the depth of one texel.
// Where so few texels suffice, cells are texels; else they are larger, and grow outwards.
struct Grid {
  float reach;   // metres from the receiver: beyond it nothing is read
  ivec2 first;   // texel
  ivec2 blocks;  // of 2 x 2 texels from there on
  vec2 begin;    // offset of the first texel's corner from the receiver
  vec2 texel;    // metres
};

Grid grid_of(Receiver receiver, float radius, Light light) {
  vec2 texel = texel_extent(receiver, light);
  Grid grid = Grid(radius + 0.5 * texel_size(receiver, light), ivec2(0), ivec2(0), vec2(0.0), texel);
  vec2 place = map_place(receiver.position, light);
  grid.first = ivec2(floor(place - grid.reach / texel));
  grid.blocks = (ivec2(floor(place + grid.reach / texel)) + 2 - grid.first) / 2;
  grid.begin = texel_offset(receiver, grid.first, light) - 0.5 * texel;
  return grid;
}

// Whether what begins at that distance in x and y is too far from the receiver to be read.
bool is_beyond(Grid grid, vec2 distance_to, Light light) {
  if (is_square(light)) return max(distance_to.x, distance_to.y) >= grid.reach;
  return dot(distance_to, distance_to) >= grid.reach * grid.reach;
}

struct Cell {
  vec2 begin, end;  // corners, as offsets from the receiver
  vec2 offset;      // of the centre of the texel that was read
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

// The factor that projects offsets at a blocker of that height onto the light's square. The tip of the cone from the
// receiver to the light has a radius of half a texel, which smooths the texels' edges as filtering does.
float projection(Receiver receiver, float height, Light light) {
  vec2 radii = vec2(penumbra_radius(receiver, height, light), 0.5 * texel_size(receiver, light));
  return inversesqrt(dot(radii, radii));
}

// Hides what a cell hides, if it blocks. `left` and `below`: the projection() of its neighbours that block, else 0;
// it becomes the cell's own.
void add_cell(inout Cover cover, inout float left, inout float below, Cell cell, Grid grid, Receiver receiver,
              float bias, vec2 noise, Light light) {
  vec2 nearest = nearest_of(cell.begin, cell.end);
  float blocking = blocking_depths_at(receiver, Offsets(vec4(cell.offset.x), vec4(cell.offset.y)), bias).x;
  if (cell.depth >= blocking || is_beyond(grid, nearest, light)) {
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

// Adds every texel of the grid, by one gather for each block.
void add_texels(inout Cover cover, Grid grid, Receiver receiver, float bias, vec2 noise, Light light) {
  float below[2 * reads_across];
  for (int x = 0; x < 2 * grid.blocks.x; ++x) below[x] = 0.0;
  for (int y = 0; y < grid.blocks.y; ++y) {
    vec2 left = vec2(0.0);  // of both rows
    for (int x = 0; x < grid.blocks.x; ++x) {
      vec2 begin = grid.begin + 2.0 * vec2(x, y) * grid.texel;
      vec2 depths[2] = vec2[](vec2(1e30), vec2(1e30));
      if (!is_beyond(grid, nearest_of(begin, begin + 2.0 * grid.texel), light)) {
        vec4 gathered = depths_from(grid.first + 2 * ivec2(x, y), light);
        depths = vec2[](gathered.wz, gathered.xy);
      }
      for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 2; ++column) {
          vec2 corner = begin + vec2(column, row) * grid.texel;
          Cell cell = Cell(corner, corner + grid.texel, corner + 0.5 * grid.texel, depths[row][column]);
          add_cell(cover, left[row], below[2 * x + column], cell, grid, receiver, bias, noise, light);
        }
      }
    }
  }
}

// Where the cell of that number begins along an axis, if cells are larger than texels: metres from the receiver, around
// which a cell is 1.5 texels wide.
float cell_begin(Grid grid, float texel, int number) {
  float from_middle = float(2 * number - reads_across);  // odd
  float share = (abs(from_middle) - 1.0) / float(reads_across - 1);
  float least = 0.75 * texel;
  return sign(from_middle) * (least + (grid.reach - least) * share * sqrt(share));
}

// Adds cells with the depths of texels at random places in them.
void add_cells(inout Cover cover, Grid grid, Receiver receiver, float bias, vec2 noise, Light light) {
  vec2 jitter = pixel_noise(receiver, blocker_step);
  vec2 place = map_place(receiver.position, light);
  float below[reads_across];
  for (int x = 0; x < reads_across; ++x) below[x] = 0.0;
  vec2 begin, end = vec2(0.0, -grid.reach);
  for (int y = 0; y < reads_across; ++y) {
    begin.y = end.y;
    end.y = cell_begin(grid, grid.texel.y, y + 1);
    end.x = -grid.reach;
    float left = 0.0;
    for (int x = 0; x < reads_across; ++x) {
      begin.x = end.x;
      end.x = cell_begin(grid, grid.texel.x, x + 1);
      if (is_beyond(grid, nearest_of(begin, end), light)) {
        left = below[x] = 0.0;
        continue;
      }
      // Along a row and along a column, the places are spread evenly over both axes.
      vec2 at = mix(begin, end, fract(jitter + golden * vec2(y, x) + plastic * vec2(x, y)));
      if (!is_square(light)) at *= min(1.0, grid.reach / length(at));
      ivec2 texel = ivec2(floor(place + at / grid.texel));
      Cell cell = Cell(begin, end, texel_offset(receiver, texel, light), depth_at(texel, light));
      add_cell(cover, left, below[x], cell, grid, receiver, bias, noise, light);
    }
  }
}

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  receiver = with_surroundings(receiver, bias, cone_slope(receiver, light), light);
  // Cells of a narrower disc are texels.
  float radius = fine_edge_radius(receiver, float(reads_across) * texel_size(receiver, light), light);
  // The map can't show a penumbra so narrow. Where none is near, pixels of decided tiles are computed in this way too.
  if (radius < 0.5 * texel_size(receiver, light)) return centre_shadow(receiver, bias, light);
  vec2 noise = pixel_noise(receiver, filter_step);
  Cover cover = uncovered(noise, light);
  Grid grid = grid_of(receiver, radius, light);
  if (max(grid.blocks.x, grid.blocks.y) <= reads_across) {
    add_texels(cover, grid, receiver, bias, noise, light);
  } else {
    add_cells(cover, grid, receiver, bias, noise, light);
  }
  int points = 0, hidden = 0;
  for (int mask = 0; mask < backprojection_masks; ++mask) {
    points += bitCount(cover.inside[mask]);
    hidden += bitCount(cover.hidden[mask]);
  }
  if (hidden == 0) return fully_lit();
  float mean = max(cover.height_sum / cover.blockers, 0.0);
  float penumbra = penumbra_radius(receiver, mean, light);
  return Visibility(1.0 - float(hidden) / float(points), penumbra, mean, penumbra < texel_size(receiver, light));
}
