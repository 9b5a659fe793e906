#include "near_penumbrae.h"

#include <algorithm>
#include <array>
#include <memory>

#include "depth_normals.h"
#include "light_fit.h"
#include "light_maps.h"
#include "products.h"
#include "tiles.h"
#include "uploads.h"
#include "visible_receivers.h"

namespace penumbra::shadow {

namespace {

// The first maps have a quarter of the side, but not less than that, where the light's have as much.
constexpr int side_divisor = 4, least_side = 512;

// Degrees. Under a narrower sun, texels that large show only the edges of casters that are high above what they shadow.
constexpr float least_angle = 2;

bool asks_for_penumbrae(const LightWork& work) {
  const ParamSet& params = work.params();
  return params.get_word("cascades.fit") == "penumbrae" && params.get_int("cascades.count") > 1 && !work.light.maps &&
         fits_to_view(work.light.source) && work.technique.decides_tiles && fits_tiles(work);
}

void release_first_maps(const LightWork& work) {
  if (work.state.first == nullptr) return;
  work.device.drop(work.state.first->prefix);
  work.state.first.reset();
}

// The second layer shows what overlaps. Nobody asks for that without maps.overlap, or where programs of blended
// surfaces read two layers anyway.
ParamSet params_of_first_maps(ParamSet params, int asked_layers, bool binds_forward) {
  const int side = params.get_int("cascades.size");
  params.set("cascades.size", std::max(side / side_divisor, std::min(side, least_side)));
  params.set("sun.angle", std::max(params.get_float("sun.angle"), least_angle));
  if (params.contains("maps.layers"))
    params.set("maps.layers", params.get_float("maps.overlap") > 0 && !binds_forward ? asked_layers : 1);
  return params;
}

LightState& state_of_first_maps(const LightWork& work) {
  std::unique_ptr<LightState>& first = work.state.first;
  if (first == nullptr) {
    first = std::make_unique<LightState>();
    first->prefix = work.prefix() + "first maps/";
    first->params = params_of_first_maps(work.params(), work.state.asked_layers, work.frame.binds_forward);
  }
  first->follows = work.state.follows;
  begin_frame(work.view, *first, work.light, layer_count(work.light, first->params), /*same_params=*/false);
  return *first;
}

// Tiles at the border of the picture reach beyond what it shows, and are undecided where a map does not hold them.
VisibleReceivers widened(VisibleReceivers visible) {
  constexpr double share = 1.0 / 16;
  for (ReceiverSlice& slice : visible) {
    for (glm::dvec2& extent : slice.extents) extent += share * (extent.y - extent.x) * glm::dvec2(-1, 1);
  }
  return visible;
}

// Of what the frame's recipes make, tile decisions read these alone.
void build_pyramids(const LightWork& first, const std::vector<const Recipe*>& recipes) {
  constexpr std::array read{"least_depth_pyramid", "second_layer", "second_layer_edges"};
  for (const Recipe* recipe : recipes) {
    if (std::ranges::find(read, recipe->name) != read.end()) {
      build_products(first, {recipe});
    } else {
      first.frame.products.push_back({.name = recipe->name, .texture = nullptr, .sampler = recipe->sampler});
    }
  }
}

// The width in pixels that penumbrae as wide as maps.overlap says have under the first maps' sun; 0: nothing is asked.
float wide_overlap(const LightWork& work, const LightWork& first) {
  if (!reads_second_layer(first.technique, first.params())) return 0;
  const float widened = first.frame.shape.extent / std::max(shape_of(work.light.source, work.params()).extent, 1e-6f);
  return work.params().get_float("maps.overlap") * static_cast<float>(work.frame.viewport.height) * widened;
}

// What fills less of the picture is hardly seen, and drawing a second layer for it takes as long.
bool are_many(std::uint32_t tiles, const glm::ivec2& of) {
  constexpr double least_share = 0.001;
  return static_cast<double>(tiles) > least_share * static_cast<double>(of.x) * static_cast<double>(of.y);
}

}  // namespace

NearPenumbrae find_near_penumbrae(const LightWork& work, const std::optional<VisibleReceivers>& visible,
                                  const std::vector<const Recipe*>& recipes, ViewState& view) {
  const bool asks = asks_for_penumbrae(work);
  if (!asks || work.state.changed) release_first_maps(work);
  if (!asks) return {};
  if (!visible) {
    // What moves in this frame would not be known in the next one.
    if (work.state.first != nullptr) work.state.first->map = {};
    return {};
  }
  LightFrame frame{.view = work.frame.view,
                   .light = work.frame.light,
                   .layer = work.frame.layer,
                   .viewport = work.frame.viewport,
                   .binds_forward = work.frame.binds_forward,
                   .borders_are_edges = false};
  const LightWork first{.device = work.device,
                        .registry = work.registry,
                        .programs = work.programs,
                        .samples = work.samples,
                        .inputs = work.inputs,
                        .light = work.light,
                        .mask = work.mask,
                        .view = work.view,
                        .state = state_of_first_maps(work),
                        .frame = frame,
                        .technique = work.technique,
                        .forward = work.forward};
  frame.shape = shape_of(work.light.source, first.params());
  take_shape(first.state, frame.shape);
  frame.projection = projection_of(first, {.visible = widened(*visible)}, recipes);
  draw_maps(first);
  upload_blocks(first);
  make_normals(first, view);
  build_pyramids(first, recipes);
  const float wide = wide_overlap(work, first);
  const Tiles tiles = decide_tiles(first, wide);
  return {.receivers = find_visible_receivers(work.device, work.inputs, work.light, work.params(), first.prefix(),
                                              &tiles.decisions),
          .wide_overlap = wide > 0 && are_many(overlapping_tiles(tiles), tile_count(frame.viewport))};
}

}  // namespace penumbra::shadow
