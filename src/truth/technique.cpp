#include "truth/technique.h"

#include <algorithm>
#include <cassert>
#include <glm/trigonometric.hpp>
#include <map>
#include <utility>
#include <variant>

#include "core/error.h"
#include "gl/api.h"
#include "render/passes.h"
#include "shadow/pass_context.h"
#include "truth/background_tracer.h"
#include "truth/facing.h"
#include "truth/frame_rays.h"
#include "truth/hybrid.h"
#include "truth/light_pictures.h"
#include "truth/picture_request.h"

namespace penumbra::truth {

namespace {

std::function<bool(double)> progress_of(const shadow::PassContext& frame, const TechniqueOptions& options) {
  if (!options.progress || options.background) return options.progress;
  const double light = frame.frame().layer, lights = static_cast<double>(frame.inputs().lights.size());
  return [=, report = options.progress](double share_done) { return report((light + share_done) / lights); };
}

TraceOptions trace_options(const shadow::PassContext& frame, const TechniqueOptions& options) {
  const ParamSet& params = frame.params();
  return {.samples = params.get_int("truth.samples"),
          .error = params.get_float("truth.error"),
          .seed = static_cast<std::uint32_t>(params.get_int("truth.seed")),
          .threads = options.threads,
          .progress = progress_of(frame, options)};
}

}  // namespace

struct TruthTechnique::State {
  explicit State(TechniqueOptions how) : options(std::move(how)), cache(options.cache, options.cache_bytes) {}

  TechniqueOptions options;
  Cache cache;
  PictureTracer tracer;
  std::map<LightId, LightPictures> lights;
  Last none;
  std::vector<const Last*> last;  // of each layer of the mask
  long long turn = 0;             // counts the lights drawn
  int last_layer = -1;            // of the mask that was filled last
  bool unfinished = false;        // a light of the present frame was filled without its picture

  // For background tracing. Only the frame's thread uses the cache, because creating files briefly changes the umask,
  // which belongs to the whole process.
  BackgroundTracer worker{tracer};
  struct Tracing {
    LightId light;
    Key key;
  };
  std::optional<Tracing> tracing;  // what the worker was last started for

  void resolve(const shadow::PassContext& frame);
  PictureRequest request(const shadow::PassContext& frame, const render::FrameScene& user) const;
  LightPictures& pictures_of(LightId id);
  void show(LightPictures& light, const PictureRequest& wanted, TracedPicture picture, bool from_cache);
  bool find(LightPictures& light, const PictureRequest& wanted);
  void fill(const shadow::PassContext& frame, const LightPictures& light);
  void resolve_now(const shadow::PassContext& frame, LightPictures& light, const PictureRequest& wanted);
  void resolve_later(const shadow::PassContext& frame, LightId id, PictureRequest wanted);
  void resolve_hidden(const shadow::PassContext& frame, LightId id, const PictureRequest& wanted);
  void collect();
  bool worker_is_free(LightId id, long long last_turn) const;
  void cancel();
  void stop();
};

PictureRequest TruthTechnique::State::request(const shadow::PassContext& frame, const render::FrameScene& user) const {
  PictureRequest request{.scene = &user.scene.scene(),
                         .geometry = user.scene.posed_geometry(),
                         .width = frame.mask().width(),
                         .light = traced_light(frame),
                         .options = trace_options(frame, options)};
  request.receivers = receivers_of(request.geometry, eye_rays(user), drawn_surfaces(frame.device(), user));
  request.casters = key_of(*request.scene, request.geometry);
  request.key = key_of(request.casters, request.receivers, request.width, request.light, request.options);
  return request;
}

// Forgets the light that was drawn longest ago when there are more than any frame has.
LightPictures& TruthTechnique::State::pictures_of(LightId id) {
  constexpr std::size_t most = 32;
  LightPictures& light = lights[id];
  light.turn = ++turn;
  if (lights.size() > most) {
    const auto oldest = std::ranges::min_element(lights, {}, [](const auto& entry) { return entry.second.turn; });
    std::ranges::replace(last, &oldest->second.last, &none);
    lights.erase(oldest);
  }
  return light;
}

void TruthTechnique::State::show(LightPictures& light, const PictureRequest& wanted, TracedPicture picture,
                                 bool from_cache) {
  light.last = {.traced = std::move(picture.traced),
                .receiver = before_light(wanted.receivers, wanted.light),
                .from_cache = from_cache,
                .build = picture.build};
  light.shown = wanted.key;
}

// Looks for the picture in the cache.
bool TruthTechnique::State::find(LightPictures& light, const PictureRequest& wanted) {
  std::optional<Traced> kept = cache.find(wanted.key, wanted.receivers.size());
  if (kept) show(light, wanted, {.key = wanted.key, .traced = std::move(*kept), .build = {}}, /*from_cache=*/true);
  return kept.has_value();
}

void TruthTechnique::State::fill(const shadow::PassContext& frame, const LightPictures& light) {
  const auto layer = static_cast<std::size_t>(frame.frame().layer);
  if (layer >= last.size()) last.resize(layer + 1, &none);
  last[layer] = &light.last;
  fill_mask(frame, light.last.traced.visibility);
}

void TruthTechnique::State::resolve_now(const shadow::PassContext& frame, LightPictures& light,
                                        const PictureRequest& wanted) {
  if (!find(light, wanted)) {
    show(light, wanted, tracer.trace(wanted), /*from_cache=*/false);
    cache.keep(wanted.key, light.last.traced);
  }
  fill(frame, light);
}

// Takes a picture that the worker has finished, or throws its error.
void TruthTechnique::State::collect() {
  const auto light = tracing ? lights.find(tracing->light) : lights.end();
  try {
    std::optional<TracedPicture> picture = worker.take();
    if (!picture) return;
    cache.keep(picture->key, picture->traced);
    if (light == lights.end() || tracing->key != picture->key) return;  // one that was cancelled as it finished
    light->second.finished = std::move(picture);
    tracing.reset();
  } catch (...) {
    if (light != lights.end()) light->second.failed = tracing->key;
    tracing.reset();
    throw;
  }
}

// Whether the worker traces nothing, or a picture that is no longer needed: of this light, or of one that was not drawn
// since this one's last turn. Lights of the same frame wait for each other.
bool TruthTechnique::State::worker_is_free(LightId id, long long last_turn) const {
  if (!tracing || tracing->light == id || !worker.share_done()) return true;
  const auto other = lights.find(tracing->light);
  return other == lights.end() || other->second.turn < last_turn;
}

void TruthTechnique::State::cancel() {
  worker.cancel();
  tracing.reset();
}

void TruthTechnique::State::resolve_later(const shadow::PassContext& frame, LightId id, PictureRequest wanted) {
  const auto known = lights.find(id);
  const long long last_turn = known == lights.end() ? 0 : known->second.turn;
  LightPictures& light = pictures_of(id);
  const std::optional<Key> waited = std::exchange(light.awaited, std::nullopt);
  collect();
  const Key key = wanted.key;
  if (light.finished && light.finished->key == key)
    show(light, wanted, std::move(*light.finished), /*from_cache=*/false);
  light.finished.reset();
  if (light.failed != key) light.failed.reset();
  if (light.shown == key || (waited != key && find(light, wanted))) {
    if (tracing && tracing->light == id) cancel();
    fill(frame, light);
    return;
  }
  fill_mask(frame, unshadowed(wanted.receivers, wanted.light));
  if (light.failed == key) return;
  const bool traced = tracing && tracing->light == id && tracing->key == key;
  if (!traced && worker_is_free(id, last_turn)) {
    worker.start(std::move(wanted));
    tracing = Tracing{id, key};
  }
  light.awaited = key;
  unfinished = true;
}

// Of a light that the ground hides from everything: no ray is traced.
void TruthTechnique::State::resolve_hidden(const shadow::PassContext& frame, LightId id, const PictureRequest& wanted) {
  LightPictures& light = pictures_of(id);
  if (tracing && tracing->light == id) cancel();
  light.awaited.reset();
  light.finished.reset();
  const std::vector<float> none_visible(wanted.receivers.size(), 0.0f);
  show(light, wanted,
       {.key = wanted.key,
        .traced = {.visibility = none_visible, .standard_error = none_visible, .hard = none_visible},
        .build = {}},
       /*from_cache=*/false);
  light.shown.reset();  // the same light's picture may be requested where there is no ground
  fill(frame, light);
}

void TruthTechnique::State::resolve(const shadow::PassContext& frame) {
  const render::FrameScene& user = frame_scene(frame, "truth");
  PictureRequest wanted = request(frame, user);
  const LightId id{.view = frame.inputs().view.id, .light = frame.light().id};
  const int layer = frame.frame().layer;
  // Nothing tells that a frame begins. If the last one was given up, or its lights were others, and this one's first
  // light has a higher layer, `unfinished` stays as it was: at worst one more frame is drawn.
  const bool first_of_frame = layer <= std::exchange(last_layer, layer);
  if (first_of_frame) unfinished = false;
  const gl::Pass pass(frame.device(), {.name = "ray trace"});
  if (user.hidden[static_cast<std::size_t>(layer)]) {
    resolve_hidden(frame, id, wanted);
  } else if (options.background) {
    resolve_later(frame, id, std::move(wanted));
  } else {
    resolve_now(frame, pictures_of(id), wanted);
  }
}

void TruthTechnique::State::stop() {
  worker.stop();
  tracing.reset();
  for (auto& [id, light] : lights) {
    light.awaited.reset();
    light.failed.reset();
  }
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
      .source = "the visibility integral, Deligiannis 2019, equation 2.6; Owen-scrambled Sobol points, Embree",
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
      .resolve_reads_motion = false,
      .denoisable = false,
      .stand_in = "brute_force",
  });
  contents.techniques.push_back(hybrid(state_->options.threads));
  contents.presets.push_back(hybrid_denoised());
  return shadow::Registry(std::move(contents));
}

std::optional<TruthTechnique::Pending> TruthTechnique::pending() const {
  const auto awaits = [](const auto& entry) { return entry.second.awaited.has_value(); };
  if (std::ranges::none_of(state_->lights, awaits)) return {};
  const std::optional<double> share = state_->worker.share_done();
  return share ? std::optional(Pending{*share}) : std::nullopt;
}

bool TruthTechnique::unfinished() const { return state_->unfinished; }

void TruthTechnique::cancel() {
  state_->cancel();
  for (auto& [id, light] : state_->lights) light.awaited.reset();
}

void TruthTechnique::stop() { state_->stop(); }

const TruthTechnique::Last& TruthTechnique::last(int layer) const {
  const auto at = static_cast<std::size_t>(layer);
  return at < state_->last.size() ? *state_->last[at] : state_->none;
}

}  // namespace penumbra::truth
