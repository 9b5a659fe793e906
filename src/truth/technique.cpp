#include "truth/technique.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "core/error.h"
#include "gl/api.h"
#include "render/passes.h"
#include "shadow/pass_context.h"
#include "truth/background_tracer.h"
#include "truth/picture_request.h"

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

Light light_of(const shadow::PassContext& frame, const TechniqueOptions& options, double seconds) {
  if (options.local_light) return options.local_light(seconds);
  return Sun{.to_light = glm::dvec3(std::get<shadow::Sun>(frame.light().source).to_light),
             .angle = glm::radians(static_cast<double>(frame.params().get_float("sun.angle"))),
             .square = frame.params().get_word("sun.shape") == "square"};
}

// 1 for receivers that have the whole light above their surface, else 0: part of a light at grazing angles is below the
// surface.
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

// The mask without occlusion: 1 where the light's centre is above the surface or there is no surface, else 0.
std::vector<float> unshadowed(std::span<const Receiver> receivers, const Light& light) {
  std::vector<float> facing;
  facing.reserve(receivers.size());
  for (const Receiver& receiver : receivers) {
    const bool lit = !receiver.there || glm::dot(receiver.normal, seen_from(light, receiver.position).center) > 0;
    facing.push_back(lit ? 1.0f : 0.0f);
  }
  return facing;
}

// Writes visibility only: ray tracing gives no penumbra radius.
void fill_mask(const shadow::PassContext& frame, const std::vector<float>& visibility) {
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
  explicit State(TechniqueOptions how) : options(std::move(how)), cache(options.cache) {}

  TechniqueOptions options;
  Cache cache;
  PictureTracer tracer;
  Last last;

  // For background tracing. Only the frame's thread uses the cache, because creating files briefly changes the umask,
  // which belongs to the whole process.
  BackgroundTracer worker{tracer};
  std::optional<Key> shown;    // the picture in `last`
  std::optional<Key> awaited;  // the picture that the last frame requested
  std::optional<Key> failed;

  void resolve(const shadow::PassContext& frame);
  PictureRequest request(const shadow::PassContext& frame, const render::FrameScene& user) const;
  void show(const PictureRequest& wanted, TracedPicture picture, bool from_cache);
  bool find(const PictureRequest& wanted);
  void resolve_now(const shadow::PassContext& frame, const PictureRequest& wanted);
  void resolve_later(const shadow::PassContext& frame, PictureRequest wanted);
  void take(const PictureRequest& wanted, const std::optional<Key>& waited);
  void stop();
};

PictureRequest TruthTechnique::State::request(const shadow::PassContext& frame, const render::FrameScene& user) const {
  PictureRequest request{.scene = &user.scene.scene(),
                         .geometry = user.scene.posed_geometry(),
                         .width = frame.mask().width(),
                         .light = light_of(frame, options, user.time),
                         .options = trace_options(frame.params(), options)};
  request.receivers = receivers_of(frame.device(), user, request.geometry);
  request.casters = key_of(*request.scene, request.geometry);
  request.key = key_of(request.casters, request.receivers, request.width, request.light, request.options);
  return request;
}

void TruthTechnique::State::show(const PictureRequest& wanted, TracedPicture picture, bool from_cache) {
  last = {.traced = std::move(picture.traced),
          .receiver = before_light(wanted.receivers, wanted.light),
          .from_cache = from_cache,
          .build = picture.build};
  shown = wanted.key;
}

// Looks for the picture in the cache.
bool TruthTechnique::State::find(const PictureRequest& wanted) {
  std::optional<Traced> kept = cache.find(wanted.key, wanted.receivers.size());
  if (kept) show(wanted, {.key = wanted.key, .traced = std::move(*kept), .build = {}}, /*from_cache=*/true);
  return kept.has_value();
}

void TruthTechnique::State::resolve_now(const shadow::PassContext& frame, const PictureRequest& wanted) {
  if (!find(wanted)) {
    show(wanted, tracer.trace(wanted), /*from_cache=*/false);
    cache.keep(wanted.key, last.traced);
  }
  fill_mask(frame, last.traced.visibility);
}

// Collects a picture that the worker has finished.
void TruthTechnique::State::take(const PictureRequest& wanted, const std::optional<Key>& waited) {
  try {
    std::optional<TracedPicture> picture = worker.take();
    if (!picture) return;
    cache.keep(picture->key, picture->traced);
    if (picture->key == wanted.key) show(wanted, std::move(*picture), /*from_cache=*/false);
  } catch (...) {
    failed = waited;
    throw;
  }
}

void TruthTechnique::State::resolve_later(const shadow::PassContext& frame, PictureRequest wanted) {
  const std::optional<Key> waited = std::exchange(awaited, std::nullopt);
  take(wanted, waited);
  const Key key = wanted.key;
  if (failed != key) failed.reset();
  if (shown == key || (waited != key && find(wanted))) {
    worker.cancel();
    fill_mask(frame, last.traced.visibility);
    return;
  }
  fill_mask(frame, unshadowed(wanted.receivers, wanted.light));
  if (failed == key) return;
  if (waited != key) worker.start(std::move(wanted));
  awaited = key;
}

void TruthTechnique::State::resolve(const shadow::PassContext& frame) {
  const auto* user = static_cast<const render::FrameScene*>(frame.inputs().user);
  if (user == nullptr) fail("technique 'truth' traces a renderer's scene, and Inputs::user has none");
  PictureRequest wanted = request(frame, *user);
  const gl::Pass pass(frame.device(), {.name = "ray trace"});
  if (options.background) {
    resolve_later(frame, std::move(wanted));
  } else {
    resolve_now(frame, wanted);
  }
}

void TruthTechnique::State::stop() {
  worker.stop();
  awaited.reset();
  failed.reset();
}

TruthTechnique::TruthTechnique(TechniqueOptions options) : state_(std::make_shared<State>(std::move(options))) {}

// Registries may outlive this object and share the state. Later frames trace synchronously, since nobody could stop a
// background trace any more.
TruthTechnique::~TruthTechnique() {
  state_->stop();
  state_->options.background = false;
}

shadow::Registry TruthTechnique::registry(const shadow::Registry& base) const {
  using enum ParamBinding;
  shadow::Registry::Contents contents = base.contents();
  contents.techniques.push_back({
      .name = "truth",
      .summary = "Ray traced: the share of the light that a receiver sees. The reference for all other techniques.",
      .source = "the visibility integral, Deligiannis 2019, 2.6; Owen-scrambled Sobol points, Embree",
      .needs = {},
      .params =
          {
              {"truth.samples", 256, 8, max_samples, "rays",
               "Rays of each pixel, rounded up to a multiple of eight; eight times a power of two is best.", host},
              {"truth.error", 0.0f, 0, 1, "",
               "Standard error to reach in 99.9 % of pixels; truth.samples are then the first round. 0: no further "
               "rounds.",
               host},
              {"truth.seed", 0, 0, 1 << 30, "", "Seed of the sample points.", host},
          },
      .resolve = [state = state_](const shadow::PassContext& frame) { state->resolve(frame); },
      .denoisable = false,
      .stand_in = "brute_force",
  });
  return shadow::Registry(std::move(contents));
}

std::optional<TruthTechnique::Pending> TruthTechnique::pending() const {
  const std::optional<double> share = state_->awaited ? state_->worker.share_done() : std::nullopt;
  return share ? std::optional(Pending{*share}) : std::nullopt;
}

void TruthTechnique::cancel() {
  state_->worker.cancel();
  state_->awaited.reset();
}

void TruthTechnique::stop() { state_->stop(); }

const TruthTechnique::Last& TruthTechnique::last() const { return state_->last; }

}  // namespace penumbra::truth
