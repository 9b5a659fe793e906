#include "tiles.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>

namespace penumbra::shadow {

namespace {

// Their lists must fit into the storage buffers that OpenGL guarantees, 2^27 bytes.
constexpr std::size_t most_filtered_pixels = 10'000'000;

int tiles_across(int pixels) { return (pixels + Tiles::size - 1) / Tiles::size; }

}  // namespace

std::size_t pixel_count(const gl::Texture& mask) {
  return static_cast<std::size_t>(mask.width()) * static_cast<std::size_t>(mask.height());
}

glm::ivec2 tile_count(const Rect& viewport) { return {tiles_across(viewport.width), tiles_across(viewport.height)}; }

ListedPixels listed_pixels(const LightWork& work) {
  if (work.denoiser == nullptr || pixel_count(work.mask) > most_filtered_pixels) return ListedPixels::computed;
  const std::string& name = work.params().get_word("filter.visibility");
  const bool has_kernel = name != "none" && work.registry.find_filter(name).keeps == Filter::Keeps::narrow;
  return has_kernel ? ListedPixels::filtered : ListedPixels::computed;
}

const gl::Buffer& begin_tile_list(const PassContext& context, std::string_view name, const glm::ivec2& tiles,
                                  ListedPixels pixels) {
  const std::size_t count = static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y);
  const TileListHead head{.capacity = static_cast<std::uint32_t>(count)};
  // A pixel to be filtered has a packed texel, too.
  const std::size_t words = pixels == ListedPixels::none ? 0 : pixels == ListedPixels::computed ? 1 : 3;
  const std::size_t entries = 2 * count + words * pixel_count(context.mask());
  const gl::Buffer& list = context.scratch(name, sizeof(head) + sizeof(std::uint32_t) * entries);
  list.write(std::as_bytes(std::span(&head, 1)));
  return list;
}

bool fits_tiles(const LightWork& work) {
  const Rect& viewport = work.frame.viewport;
  return viewport.width >= Tiles::size && viewport.height >= Tiles::size && work.programs.draws_tiles();
}

bool decides_tiles(const LightWork& work) {
  return work.technique.decides_tiles && fits_tiles(work) &&
         (work.params().get_bool("mask.tiles") || work.params().get_int("mask.scale") > 1);
}

void dispatch_decisions(gl::Pass& pass, const gl::Program& program, const glm::ivec2& tiles) {
  const int group = program.group_size().y, rows = (tiles.y + group - 1) / group;
  // About the golden ratio of the rows, with no factor in common with them: each row comes once.
  int step = std::max(rows * 5 / 8, 1);
  while (std::gcd(step, rows) != 1) ++step;
  program.set("row_step", step);
  pass.dispatch(tiles.x, tiles.y);
}

namespace {

struct TileNames {
  const char *decisions, *list;
};

constexpr TileNames usual_names{"tile decisions", "tile list"},
    names_of_all{"tile decisions of all pixels", "tile list of all pixels"};

// As large as the mask, not the viewport: a view whose size varies from frame to frame then keeps its texture.
Tiles undecided(const LightWork& work, const TileNames& names, ListedPixels pixels) {
  const PassContext context(work, owner_of(work.technique));
  const gl::TextureDesc of_mask{
      .format = GL_RGBA32UI, .width = tiles_across(work.mask.width()), .height = tiles_across(work.mask.height())};
  return {context.target(names.decisions, of_mask),
          begin_tile_list(context, names.list, {of_mask.width, of_mask.height}, pixels)};
}

Tiles decide(const LightWork& work, const TileNames& names, ListedPixels pixels, float wide_overlap) {
  const Tiles tiles = undecided(work, names, pixels);
  gl::Pass pass(work.device, {.name = "tile decisions"});
  const gl::Program& program = pass.use(work.programs.decide_tiles(
      work.technique,
      {.lamp = work.frame.shape.lamp, .second_layer = reads_second_layer(work.technique, work.params())}));
  bind_inputs(work, owner_of(work.technique));
  program.set("wide_overlap", wide_overlap);
  tiles.decisions.bind_image(0, GL_WRITE_ONLY);
  tiles.list.bind_storage(tile_list_binding);
  dispatch_decisions(pass, program, tile_count(work.frame.viewport));
  return tiles;
}

}  // namespace

Tiles decide_tiles(const LightWork& work, float wide_overlap) {
  return decide(work, usual_names, ListedPixels::none, wide_overlap);
}

std::uint32_t overlapping_tiles(const Tiles& tiles) {
  TileListHead head;
  gl::glGetNamedBufferSubData(tiles.list.id(), 0, sizeof(head), &head);
  return head.wide_overlaps;
}

Tiles decide_all_tiles(const LightWork& work) { return decide(work, names_of_all, listed_pixels(work), 0); }

Tiles scaled_tiles(const LightWork& scaled, const TilesOfAll& of_all) {
  const Tiles tiles = undecided(scaled, usual_names, ListedPixels::none);
  const Rect& viewport = scaled.frame.viewport;
  gl::Pass pass(scaled.device, {.name = "tile decisions"});
  const gl::Program& program = pass.use(scaled_tiles_program());
  program.set("size", glm::ivec2(viewport.width, viewport.height));
  program.set("size_of_all", glm::ivec2(of_all.viewport.width, of_all.viewport.height));
  program.set("scale", scaled.frame.scale);
  program.set("has_faces", of_all.has_faces ? 1 : 0);
  scaled.device.sampler({}).bind(unit_decisions);
  of_all.tiles.decisions.bind(unit_decisions);
  tiles.decisions.bind_image(0, GL_WRITE_ONLY);
  tiles.list.bind_storage(tile_list_binding);
  const glm::ivec2 count = tile_count(viewport);
  pass.dispatch(count.x, count.y);
  return tiles;
}

gl::ProgramDesc scaled_tiles_program() {
  return {.name = "scaled tiles", .compute = "shadow/drivers/scaled_tiles.comp"};
}

const gl::Buffer& list_filter_tiles(const LightWork& work, const BlockerDistances& distances, Filter::Keeps keeps) {
  const bool narrow = keeps == Filter::Keeps::narrow;
  const PassOwner owner = owner_of(*work.denoiser);
  const glm::ivec2 size = tile_count(work.frame.viewport);
  const gl::Buffer& list = begin_tile_list(PassContext(work, owner), narrow ? "filter tiles" : "blocked tiles",
                                           {tiles_across(work.mask.width()), tiles_across(work.mask.height())});
  gl::Pass pass(work.device, {.name = "filter tiles"});
  const gl::Program& program = pass.use(work.programs.filter_tiles(narrow));
  bind_inputs(work, owner);
  for (const GLuint unit : {unit_texels, unit_decisions}) work.device.sampler({}).bind(unit);
  distances.texels->bind(unit_texels);
  if (distances.decisions != nullptr) distances.decisions->bind(unit_decisions);
  program.set("has_decisions", distances.decisions != nullptr ? 1 : 0);
  program.set("decided_have_noise", work.technique.tells_noise ? 0 : 1);
  list.bind_storage(tile_list_binding);
  pass.dispatch(size.x, size.y);
  return list;
}

void draw_tiles(gl::Pass& pass, const gl::Buffer& list, std::size_t command) {
  list.bind_storage(tile_list_binding);
  pass.set_point_size(Tiles::size);
  pass.draw_arrays_indirect(GL_POINTS, {.buffer = list, .offset = command});
}

}  // namespace penumbra::shadow
