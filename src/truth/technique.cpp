#include "truth/technique.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "core/error.h"
#include "gl/api.h"
#include "render/passes.h"
#include "shadow/technique_frame.h"

namespace penumbra::truth {

namespace {

// The receivers of a frame's pixels.
std::vector<Receiver> receivers_of(gl::Device& device, const render::FrameScene& frame,
                                   const scene::PosedGeometry& geometry) {
  const gl::Texture& ids = render::draw_surface_ids(device, {.scene = frame.scene, .view = frame.view});
  const std::vector<unsigned> values = gl::read_uints(ids, 2);
  std::vector<glm::uvec2> drawn;
  drawn.reserve(values.size() / 2);
  for (std::size_t i = 0; i < values.size(); i += 2)
    drawn.emplace_back(values[i] == 0 ? no_surface : values[i] - 1, values[i + 1]);
  const EyeRays rays{.clip_to_world = glm::inverse(glm::dmat4(frame.view.world_to_clip)),
                     .width = ids.width(),
                     .height = ids.height()};
  return receivers_of(geometry, rays, drawn);
}

TraceOptions trace_options(const ParamSet& params, const TechniqueOptions& options) {
  return {.samples = params.get_int("truth.samples"),
          .error = params.get_float("truth.error"),
          .seed = static_cast<std::uint32_t>(params.get_int("truth.seed")),
          .threads = options.threads,
          .progress = options.progress};
}

Light light_of(const shadow::TechniqueFrame& frame, const TechniqueOptions& options, double seconds) {
  if (options.local_light) return options.local_light(seconds);
  return Sun{.to_light = glm::dvec3(frame.light().to_light),
             .angle = glm::radians(static_cast<double>(frame.params().get_float("sun.angle"))),
             .square = frame.params().get_word("sun.shape") == "square"};
}

// Of surfaces that the light only grazes, a part of it lies behind them.
std::vector<float> before_light(std::span<const Receiver> receivers, const Light& light) {
  std::vector<float> before;
  before.reserve(receivers.size());
  for (const Receiver& receiver : receivers) {
    bool all = receiver.there;
    if (all) {
      const SeenLight seen = seen_from(light, receiver.position);
      const double radius = glm::length(seen.side_x), distance = glm::length(seen.center);
      all = glm::dot(receiver.normal, seen.center) > distance * radius / std::hypot(distance, radius);
    }
    before.push_back(all ? 1.0f : 0.0f);
  }
  return before;
}

// Visibility alone: a ray tells no penumbra radius.
void fill_mask(const shadow::TechniqueFrame& frame, const std::vector<float>& visibility) {
  const gl::Texture& mask = frame.mask();
  [[maybe_unused]] const shadow::Rect whole{0, 0, mask.width(), mask.height()};
  assert(frame.frame().viewport == whole);
  std::vector<glm::vec4> texels;
  texels.reserve(visibility.size());
  for (const float v : visibility) texels.emplace_back(v, 0.0f, 0.0f, 0.0f);
  mask.upload(GL_RGBA, GL_FLOAT, std::as_bytes(std::span(texels)), 0, frame.frame().layer);
}

}  // namespace

struct TruthTechnique::State {
  TechniqueOptions options;
  Cache cache;
  std::optional<Tracer> tracer;
  Key casters;  // that the tracer has
  Last last;

  void resolve(const shadow::TechniqueFrame& frame);
  const Tracer& tracer_of(const Key& key, const scene::Scene& scene, const scene::PosedGeometry& geometry);
};

const Tracer& TruthTechnique::State::tracer_of(const Key& key, const scene::Scene& scene,
                                               const scene::PosedGeometry& geometry) {
  if (!tracer || casters != key) {
    tracer.reset();  // two would take twice the memory
    tracer.emplace(scene, geometry);
    casters = key;
    last.build = tracer->stats();
  }
  return *tracer;
}

void TruthTechnique::State::resolve(const shadow::TechniqueFrame& frame) {
  const auto* user = static_cast<const render::FrameScene*>(frame.inputs().user);
  if (user == nullptr) fail("technique 'truth' traces a renderer's scene, and Inputs::user has none");
  const scene::Scene& scene = user->scene.scene();
  const scene::PosedGeometry geometry = user->scene.posed_geometry();
  const std::vector<Receiver> receivers = receivers_of(frame.device(), *user, geometry);
  const gl::Pass pass(frame.device(), {.name = "ray trace"});
  const Light light = light_of(frame, options, user->time);
  const TraceOptions how = trace_options(frame.params(), options);
  const Key casters_key = key_of(scene, geometry);
  const Key key = key_of(casters_key, receivers, frame.mask().width(), light, how);
  last = {};
  if (std::optional<Traced> kept = cache.find(key, receivers.size())) {
    last.traced = std::move(*kept);
    last.from_cache = true;
  } else {
    last.traced = tracer_of(casters_key, scene, geometry).trace(receivers, frame.mask().width(), light, how);
    cache.keep(key, last.traced);
  }
  last.receiver = before_light(receivers, light);
  fill_mask(frame, last.traced.visibility);
}

TruthTechnique::TruthTechnique(TechniqueOptions options)
    : state_(std::make_shared<State>(State{std::move(options), Cache({}), {}, {}, {}})) {
  state_->cache = Cache(state_->options.cache);
}

TruthTechnique::~TruthTechnique() = default;

shadow::Registry TruthTechnique::registry(const shadow::Registry& base) const {
  using enum ParamBinding;
  std::vector<shadow::Technique> techniques(base.techniques().begin(), base.techniques().end());
  techniques.push_back({
      .name = "truth",
      .summary = "Ray traced: the share of the light that a receiver sees. What the others are measured against.",
      .source = "the visibility integral, Deligiannis 2019, 2.6; Owen-scrambled Sobol points, Embree",
      .needs = shadow::needs_nothing,
      .params =
          {
              {"truth.samples", 256, 8, max_samples, "rays",
               "Rays of each pixel, rounded up to a multiple of eight; eight times a power of two is best.", host},
              {"truth.error", 0.0f, 0, 1, "",
               "Standard error to reach in 99.9 % of pixels; truth.samples are then the first round. 0: one round.",
               host},
              {"truth.seed", 0, 0, 1 << 30, "", "Another number gives other points.", host},
          },
      .resolve = [state = state_](const shadow::TechniqueFrame& frame) { state->resolve(frame); },
      .stand_in = "brute_force",
  });
  return {std::move(techniques),
          {base.aliases().begin(), base.aliases().end()},
          base.default_technique(),
          {base.filters().begin(), base.filters().end()}};
}

const TruthTechnique::Last& TruthTechnique::last() const { return state_->last; }

}  // namespace penumbra::truth
