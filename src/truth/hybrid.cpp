#include "truth/hybrid.h"

#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "gl/api.h"
#include "shadow/samples.h"
#include "shadow/tiles.h"
#include "truth/cache.h"
#include "truth/frame_rays.h"
#include "truth/masked_casters.h"
#include "truth/penumbra_trace.h"

namespace penumbra::truth {

namespace {

// As in glsl/shadow/techniques.
constexpr GLuint left_binding = 6, results_binding = 7, unit_surface_ids = shadow::first_pass_unit,
                 unit_masked = unit_surface_ids + 1;
struct LeftPixel {
  std::uint32_t at, surface, triangle;
};
constexpr std::size_t count_bytes = sizeof(std::uint32_t);
constexpr int results_row = 4096;  // OpenGL guarantees only 65,535 groups in a row

// The casters of the last frame, as rays see them.
struct KeptCasters {
  std::optional<EmbreeScene> scene;
  Key key;

  const EmbreeScene& of(const scene::Scene& from, const scene::PosedGeometry& geometry, int threads) {
    const Key wanted = key_of(from, geometry);
    if (!scene || key != wanted) {
      scene.reset();  // released first, so that two never exist at the same time
      scene.emplace(from, geometry, BuildOptions{.threads = threads});
      key = wanted;
    }
    return *scene;
  }
};

// One frame.
class HybridFrame {
 public:
  HybridFrame(const shadow::PassContext& context, KeptCasters& casters, int threads)
      : context_(context),
        user_(frame_scene(context, "hybrid")),
        casters_(casters),
        threads_(threads),
        geometry_(user_.scene.posed_geometry()),
        left_(context.scratch("left pixels", count_bytes + sizeof(LeftPixel) * pixel_count())) {}

  void resolve() const {
    const gl::Texture* masked = upload_masked();
    const gl::Texture& ids =
        render::draw_surface_ids(context_.device(), {.scene = user_.scene, .view = user_.view, .depth = user_.depth});
    const gl::Buffer& tiles = decide_tiles(masked);
    list_pixels(tiles, ids);
    const std::vector<DrawnPixel> left = read_left();
    if (!left.empty()) trace(left);
  }

 private:
  std::size_t pixel_count() const {
    return static_cast<std::size_t>(context_.mask().width()) * static_cast<std::size_t>(context_.mask().height());
  }

  const gl::Program& use(gl::Pass& pass, const char* name) const {
    const gl::Program& program = context_.use(pass, name);
    program.set("mask_layer", context_.frame().layer);
    context_.mask().bind_image(0, GL_WRITE_ONLY);
    return program;
  }

  // Null if there is none.
  const gl::Texture* upload_masked() const {
    if (!context_.params().get_bool("hybrid.masked_casters")) return nullptr;
    const gl::Pass pass(context_.device(), {.name = "masked casters"});
    const MaskedCasters casters = MaskedCasters::of(geometry_, context_.frame().projection);
    if (casters.side == 0) return nullptr;
    const gl::Texture& texture =
        context_.target("masked casters", {.target = GL_TEXTURE_2D_ARRAY,
                                           .format = GL_R32F,
                                           .width = casters.side,
                                           .height = casters.side,
                                           .layers = static_cast<int>(casters.layers.size()),
                                           .levels = static_cast<int>(casters.layers.front().size())});
    for (int layer = 0; layer < texture.desc().layers; ++layer) {
      const auto& levels = casters.layers[static_cast<std::size_t>(layer)];
      for (int level = 0; level < texture.desc().levels; ++level)
        texture.upload(GL_RED, GL_FLOAT, std::as_bytes(std::span(levels[static_cast<std::size_t>(level)])), level,
                       layer);
    }
    return &texture;
  }

  // Returns the list of the tiles that are not decided.
  const gl::Buffer& decide_tiles(const gl::Texture* masked) const {
    const glm::ivec2 tiles = shadow::tile_count(context_.frame().viewport);
    const auto capacity = static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y);
    const shadow::TileListHead head{.capacity = static_cast<std::uint32_t>(capacity)};
    const gl::Buffer& list = context_.scratch("tile list", sizeof(head) + sizeof(std::uint32_t) * capacity);
    list.write(std::as_bytes(std::span(&head, 1)));
    gl::Pass pass(context_.device(), {.name = "tile decisions"});
    const gl::Program& program = use(pass, "tiles");
    program.set("has_masked_casters", masked != nullptr ? 1 : 0);
    context_.device().sampler({.min_filter = GL_NEAREST_MIPMAP_NEAREST}).bind(unit_masked);
    if (masked != nullptr) masked->bind(unit_masked);
    list.bind_storage(shadow::tile_list_binding);
    left_.bind_storage(left_binding);
    shadow::dispatch_decisions(pass, program, tiles);
    return list;
  }

  void list_pixels(const gl::Buffer& tiles, const gl::Texture& ids) const {
    gl::write_value(left_, std::uint32_t{0});
    gl::Pass pass(context_.device(), {.name = "pixels for rays"});
    use(pass, "pixels");
    tiles.bind_storage(shadow::tile_list_binding);
    left_.bind_storage(left_binding);
    context_.device().sampler({}).bind(unit_surface_ids);
    ids.bind(unit_surface_ids);
    pass.dispatch_indirect(tiles);
  }

  std::vector<DrawnPixel> read_left() const {
    const gl::Pass pass(context_.device(), {.name = "rays"});
    std::uint32_t count = 0;
    gl::glGetNamedBufferSubData(left_.id(), 0, sizeof(count), &count);
    std::vector<LeftPixel> read(count);
    gl::glGetNamedBufferSubData(left_.id(), count_bytes, static_cast<GLsizeiptr>(sizeof(LeftPixel) * count),
                                read.data());
    std::vector<DrawnPixel> left;
    left.reserve(count);
    // Surface 0 is none: it becomes no_surface.
    for (const LeftPixel& pixel : read)
      left.push_back({.pixel = {pixel.at & 0xffffU, pixel.at >> 16U}, .drawn = {pixel.surface - 1, pixel.triangle}});
    return left;
  }

  // Of the points: another one in each frame where the parameters ask for other samples.
  std::uint32_t seed() const {
    constexpr std::uint32_t frames_apart = 65536;  // more than sampling.seed can be
    const ParamSet& params = context_.params();
    const auto shifts = [&](const char* sequence) { return params.get_word(sequence) == "shift"; };
    const bool any = shifts("sampling.blocker_sequence") || shifts("sampling.filter_sequence");
    const int frame = any ? context_.age() : shadow::set_number(params, context_.age());
    return static_cast<std::uint32_t>(params.get_int("sampling.seed")) +
           frames_apart * static_cast<std::uint32_t>(frame);
  }

  void trace(std::span<const DrawnPixel> left) const {
    gl::Pass pass(context_.device(), {.name = "rays"});
    const std::vector<PenumbraPixel> traced =
        trace_penumbrae(casters_.of(user_.scene.scene(), geometry_, threads_),
                        {.geometry = geometry_,
                         .eye = eye_rays(user_),
                         .pixels = left,
                         .sun = std::get<TracedSun>(traced_light(context_)),
                         .rays = (static_cast<std::uint32_t>(context_.params().get_int("hybrid.rays")) + 7) / 8 * 8,
                         .narrow = static_cast<float>(context_.params().get_int("hybrid.narrow")),
                         .seed = seed(),
                         .threads = threads_});
    std::vector<std::uint32_t> packed;
    packed.reserve(traced.size());
    for (const PenumbraPixel& pixel : traced)
      packed.push_back(glm::packHalf2x16({pixel.visibility, pixel.blocker_distance}));
    const gl::Buffer& results = context_.scratch("results", sizeof(std::uint32_t) * pixel_count());
    results.write(std::as_bytes(std::span(packed)));
    use(pass, "rays");
    left_.bind_storage(left_binding);
    results.bind_storage(results_binding);
    const int count = static_cast<int>(packed.size());
    pass.dispatch(results_row, (count + results_row - 1) / results_row);
  }

  const shadow::PassContext& context_;
  const render::FrameScene& user_;
  KeptCasters& casters_;
  int threads_;
  scene::PosedGeometry geometry_;
  const gl::Buffer& left_;
};

}  // namespace

shadow::Technique hybrid(int threads) {
  using enum ParamBinding;
  const auto casters = std::make_shared<KeptCasters>();
  return {
      .name = "hybrid",
      .summary =
          "The shadow map decides the tiles of pixels that no penumbra reaches; rays to the light decide the others. "
          "For renderers without a GPU.",
      .source = "edges of the map as in ADR 18; Owen-scrambled Sobol points, Embree",
      .needs = {"shadow_map", "least_depth_pyramid"},
      .params =
          {{"hybrid.rays", 16, 8, 4096, "rays", "Rays of each pixel in penumbra, rounded up to a multiple of eight.",
            host},
           {"hybrid.narrow", 0, 0, 64, "px",
            "Where a penumbra is narrower than this in the picture, twice as many rays are traced, since filters find "
            "few pixels to average there.",
            host},
           {"hybrid.masked_casters", true, 0, 1, "",
            "Leaves all pixels that casters with an alpha mask may shadow to rays, because the map can miss "
            "small parts of such casters.",
            host}},
      .resolve = [=](const shadow::PassContext& context) { HybridFrame(context, *casters, threads).resolve(); },
      .resolve_reads_motion = false,
      .programs =
          [](const ParamSet&) {
            return std::vector<gl::ProgramDesc>{{.name = "tiles", .compute = "shadow/techniques/hybrid_tiles.comp"},
                                                {.name = "pixels", .compute = "shadow/techniques/hybrid.comp"},
                                                {.name = "rays", .compute = "shadow/techniques/hybrid_rays.comp"}};
          },
      .suns_only = true,
      .stand_in = "pcss",
      .reads_light_discs = true,
      .sees_hidden_casters = true};
}

shadow::Preset hybrid_denoised() {
  return {"hybrid_denoised",
          "hybrid",
          "The technique hybrid with small maps, more rays in narrow penumbrae, and a filter that removes their noise.",
          {"cascades.fit=visible", "cascades.size=1024", "hybrid.rays=16", "hybrid.narrow=16",
           "denoiser=history_and_filters", "filter.penumbra=none", "filter.visibility=isophote", "filter.taps=8",
           "filter.width=0.14"}};
}

}  // namespace penumbra::truth
