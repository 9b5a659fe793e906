#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>

#include "denoise_context.h"
#include "light_work.h"
#include "pass_context.h"

namespace penumbra::shadow {

// The mask's pixels in tiles of 8 × 8. Tiles that no penumbra reaches are decided by one look at the shadow map and its
// edges; only the others are left to the technique. See docs/adr/0018-tiles.md.
struct Tiles {
  static constexpr int size = 8;  // pixels along each side

  // RGBA32UI, one texel a tile: its Decision (see glsl/shadow/drivers/decisions.glsl), or no_decision.
  const gl::Texture& decisions;
  // See TileList in glsl/shadow/drivers/tiles.glsl.
  const gl::Buffer& list;
};

constexpr GLuint tile_list_binding = 7;  // storage buffer

// The beginning of TileList there, of a list without tiles.
struct TileListHead {
  gl::DispatchCommand dispatch_listed{256, 0, 1};
  gl::DrawArraysCommand draw_listed, draw_decided;
  gl::DispatchCommand dispatch_apart{256, 0, 1};
  gl::DrawArraysCommand draw_apart;
  gl::DispatchCommand dispatch_pixels{0, 0, 1};
  std::uint32_t pixel_count = 0;
  gl::DispatchCommand dispatch_noisy{0, 0, 1};
  std::uint32_t noisy_count = 0;
  std::uint32_t wide_overlaps = 0;
  std::uint32_t capacity = 0;
};

static_assert(sizeof(TileListHead) == 112, "must match TileList in glsl/shadow/drivers/tiles.glsl");

// Where the commands are in the list, bytes.
constexpr std::size_t listed_dispatch_offset = offsetof(TileListHead, dispatch_listed);
constexpr std::size_t listed_draw_offset = offsetof(TileListHead, draw_listed);
constexpr std::size_t decided_draw_offset = offsetof(TileListHead, draw_decided);
constexpr std::size_t apart_dispatch_offset = offsetof(TileListHead, dispatch_apart);
constexpr std::size_t apart_draw_offset = offsetof(TileListHead, draw_apart);
constexpr std::size_t pixels_dispatch_offset = offsetof(TileListHead, dispatch_pixels);
constexpr std::size_t noisy_dispatch_offset = offsetof(TileListHead, dispatch_noisy);

std::size_t pixel_count(const gl::Texture& mask);
// How many tiles cover a viewport along each axis.
glm::ivec2 tile_count(const Rect& viewport);
// Which pixels a list has room for, besides tiles: none, all of the mask, and all once more to be filtered.
enum class ListedPixels : std::uint8_t { none, computed, filtered };
// Those that a light needs whose mask has fewer pixels than the view: in masks of more than ten million none are
// filtered, nor where the filter of visibility has no kernel.
ListedPixels listed_pixels(const LightWork& work);
// A list without tiles, with room for so many. As large as the mask needs, not the viewport: a view whose size varies
// from frame to frame then keeps its buffer.
const gl::Buffer& begin_tile_list(const PassContext& context, std::string_view name, const glm::ivec2& tiles,
                                  ListedPixels pixels = ListedPixels::none);

// Whether tiles can be drawn. Not in viewports smaller than a tile: they are points, whose centres must lie inside.
bool fits_tiles(const LightWork& work);
// Whether, moreover, the technique and the parameters allow to decide them.
bool decides_tiles(const LightWork& work);

// Runs a program that decides tiles: its main function asks tile_of_invocation() (glsl/shadow/decide_tile.glsl).
void dispatch_decisions(gl::Pass& pass, const gl::Program& program, const glm::ivec2& tiles);

// In a pass of its own. `wide_overlap`: see overlapping_tiles().
Tiles decide_tiles(const LightWork& work, float wide_overlap = 0);
// In how many of these tiles casters overlap in penumbrae of at least `wide_overlap` pixels. Waits for the GPU.
std::uint32_t overlapping_tiles(const Tiles& tiles);
// The same for all pixels of a view of which every n-th is computed (mask_scale.h); their list has room for all pixels.
Tiles decide_all_tiles(const LightWork& work);
// Those of every n-th pixel: decided where all tiles of all pixels that they lie in are, unless one of these faces away
// and another is blocked. The others are listed apart where one of these is, and all of
// them where the light has several faces.
struct TilesOfAll {
  const Tiles& tiles;
  const Rect& viewport;
  bool has_faces = false;
};
Tiles scaled_tiles(const LightWork& scaled, const TilesOfAll& of_all);
gl::ProgramDesc scaled_tiles_program();

// In a pass of its own, the list of the tiles whose packed texels filters that keep these can change. Not for
// Keeps::nothing.
const gl::Buffer& list_filter_tiles(const LightWork& work, const BlockerDistances& distances, Filter::Keeps keeps);

// Draws the tiles of one of a list's two commands, as points: the current program's vertex shader is tile.vert.
void draw_tiles(gl::Pass& pass, const gl::Buffer& list, std::size_t command);

}  // namespace penumbra::shadow
