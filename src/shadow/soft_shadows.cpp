#include "soft_shadows.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <utility>

#include "../core/error.h"
#include "../core/log.h"
#include "../gl/compatibility.h"
#include "../gl/debug.h"
#include "check_inputs.h"
#include "copies.h"
#include "forward_source.h"
#include "frame.h"
#include "warm_up.h"

namespace penumbra::shadow {

namespace {

constexpr const char* subject = "soft shadows";

void check_nothing_is_left_out() {
  if (gl::conditional_rendering_is_active(subject))
    throw gl::ContextError(fmt::format("{}: conditional rendering is active; end it before", subject));
}

// Whether the caller has set clip space to z in 0..1. Nothing where that can't be told: after another frame, -1..1 may
// be what that one left.
std::optional<bool> clip_space_of_caller(bool first_frame_of_all) {
  GLint mode = 0;
  gl::glGetIntegerv(GL_CLIP_DEPTH_MODE, &mode);
  const bool zero_to_one = mode == GL_ZERO_TO_ONE;
  if (!zero_to_one && !first_frame_of_all) return {};
  return zero_to_one;
}

// The scope of a call: OpenGL's entry points are those of the device's driver.
class Call {
 public:
  explicit Call(gl::Device& device) : scope_(device) {
    if (!scope_.has_context())
      throw gl::ContextError(fmt::format("{}: the device's OpenGL context is not current on this thread", subject));
  }

 private:
  gl::DeviceScope scope_;
};

int next_number() {
  static std::atomic<int> last{0};
  return ++last;
}

// The scope of a call of render(), which would spoil its own frame if the caller's callback called it again.
class Rendering {
 public:
  explicit Rendering(bool& rendering) : rendering_(rendering) {
    if (rendering) fail("soft shadows: render() was called from within render()");
    rendering = true;
  }
  ~Rendering() { rendering_ = false; }
  Rendering(const Rendering&) = delete;
  Rendering& operator=(const Rendering&) = delete;

 private:
  bool& rendering_;
};

// Runs what draws. An error leaves OpenGL's state as a frame does, unless the context can't be drawn with.
template <class Draw>
auto with_initial_state_after_errors(const Draw& draw) {
  try {
    return draw();
  } catch (const gl::ContextError&) {
    throw;
  } catch (...) {
    gl::leave_initial_state();
    throw;
  }
}

// Deletes the targets and buffers of that prefix at the end of the scope.
class DroppedAtEnd {
 public:
  DroppedAtEnd(gl::Device& device, const std::string& prefix) : device_(device), prefix_(prefix) {}
  ~DroppedAtEnd() { device_.drop(prefix_); }
  DroppedAtEnd(const DroppedAtEnd&) = delete;
  DroppedAtEnd& operator=(const DroppedAtEnd&) = delete;

 private:
  gl::Device& device_;
  const std::string& prefix_;
};

}  // namespace

struct SoftShadows::State {
  State(gl::Device& device, const Registry& registry)
      : defaults(registry.params()), programs(device, registry), samples(device, fmt::format("shadow {}/", number)) {}

  // The registry's parameters with the caller's values and the light's overrides. Valid until the next call.
  const ParamSet& params_of(const Registry& registry, const ParamSet& params, const Light& light) {
    constexpr std::size_t most_lights = 256;  // of a frame
    if (forward.size() >= most_lights && !forward.contains(light.id)) forward.clear();
    LightState& state = forward[light.id];
    take_params(state, {.registry = registry, .defaults = defaults, .values = params}, light);
    return state.params;
  }

  const int number = next_number();  // unique for each SoftShadows object of a device
  const ParamSet defaults;
  Programs programs;
  Samples samples;
  LeftOut left_out;
  bool rendering = false;
  std::map<int, ViewState> views;
  std::map<int, LightState> forward;  // the parameters of the last forward programs, by the light's id
};

SoftShadows::SoftShadows(gl::Device& device, Registry registry)
    : device_(device), registry_(std::move(registry)), state_(std::make_unique<State>(device, registry_)) {}

SoftShadows::~SoftShadows() {
  const gl::DeviceScope scope(device_);
  device_.drop(fmt::format("shadow {}/", state_->number));
  state_.reset();
}

std::string SoftShadows::view_prefix(int id) const { return fmt::format("shadow {}/view {}/", state_->number, id); }

Mask SoftShadows::render(const Inputs& inputs, const ParamSet& params) {
  const Rendering rendering(state_->rendering);
  try {
    return render_view(inputs, params);
  } catch (...) {
    interrupt_view(inputs.view.id);
    throw;
  }
}

void SoftShadows::interrupt_view(int id) {
  if (const auto view = state_->views.find(id); view != state_->views.end()) view->second.drawn = false;
}

Mask SoftShadows::render_view(const Inputs& inputs, const ParamSet& params) {
  const Call call(device_);
  // A steady frame in the core profile asks OpenGL nothing: a driver that works on another thread would have to wait.
  check_earlier_frames();
  const auto known = state_->views.find(inputs.view.id);
  const bool is_new = known == state_->views.end(), first = is_new || !known->second.began;
  if (first || gl::has_legacy_state()) gl::check_context_is_ready(subject);
  if (first) check_nothing_is_left_out();
  const std::optional<bool> clip_space = is_new ? clip_space_of_caller(state_->views.empty()) : std::nullopt;
  const gl::InitialLegacyState legacy;
  ViewState& view = state_->views[inputs.view.id];
  if (is_new) {
    view.prefix = view_prefix(inputs.view.id);
    view.clip_space_of_caller = clip_space;
  }
  Mask mask = with_initial_state_after_errors([&] { return draw(inputs, params, view); });
  if (std::exchange(view.began, true) || !view.clip_space_of_caller) return mask;
  const std::string warning =
      clip_control_warning(inputs.view.projection, inputs.conventions, *view.clip_space_of_caller);
  if (!warning.empty()) log(LogLevel::warning, warning);
  return mask;
}

// Refuses this frame, so that the next one begins anew.
void SoftShadows::check_earlier_frames() {
  if (!state_->left_out.found()) return;
  for (auto& [id, view] : state_->views) view.drawn = false;
  gl::check_context_is_ready(subject);
  check_nothing_is_left_out();
  throw gl::ContextError(
      fmt::format("{}: OpenGL left out what an earlier frame drew: conditional rendering or transform feedback was "
                  "active, or the device's context was not current",
                  subject));
}

Mask SoftShadows::draw(const Inputs& inputs, const ParamSet& params, ViewState& view) {
  return draw_mask({.device = device_,
                    .registry = registry_,
                    .programs = state_->programs,
                    .samples = state_->samples,
                    .left_out = state_->left_out,
                    .defaults = state_->defaults,
                    .inputs = inputs,
                    .params = params},
                   view);
}

// Makes the points of all sets of a view's techniques: its frames have used the first ones.
void SoftShadows::make_tables(const ViewState& view) {
  for (const auto& [id, light] : view.lights) {
    for (const auto& [technique, tables] : light.samples) {
      for (int set = 0; set < tables.sets; ++set)
        state_->samples.tables(registry_.find(technique), light.params, {.set = set, .scramble = tables.scramble});
    }
  }
}

void SoftShadows::warm_up(const FrameKind& kind, const ParamSet& params) {
  const Rendering rendering(state_->rendering);
  const Call call(device_);
  gl::check_context_is_ready(subject);
  check_nothing_is_left_out();
  const gl::InitialLegacyState legacy;
  ViewState view;
  view.prefix = fmt::format("shadow {}/warm up/", state_->number);
  const DroppedAtEnd targets(device_, view.prefix);
  with_initial_state_after_errors([&] {
    for (const gl::ProgramDesc& program : copy_programs()) device_.shaders.get(program);
    const std::vector<Light> lights = warm_up_lights(device_, view.prefix, kind);
    FrameKind small = kind;
    small.lights = lights;
    // With maps.overlap a frame has a second layer or not. It always has one if surfaces are drawn forward.
    const bool asks_for_overlap = std::ranges::any_of(lights, [&](const Light& light) {
      const ParamSet& own = state_->params_of(registry_, params, light);
      return own.contains("maps.overlap") && own.get_float("maps.overlap") > 0 && own.get_int("maps.layers") > 1;
    });
    std::vector<bool> forward{kind.binds_forward};
    if (asks_for_overlap && !kind.binds_forward) forward.push_back(true);
    for (const bool binds_forward : forward) {
      const auto warm = [&](Inputs inputs) {
        inputs.binds_forward = binds_forward;
        draw(inputs, params, view);
      };
      // The second has a history, and casters that may have moved.
      for (int i = 0; i < 2; ++i) warm(warm_up_inputs(device_, view.prefix, small));
      warm(other_warm_up_inputs(device_, view.prefix, small));
    }
    make_tables(view);
  });
}

void SoftShadows::forget_view(int id) {
  const Call call(device_);
  state_->views.erase(id);
  device_.drop(view_prefix(id));
}

void SoftShadows::bind_forward(const Mask& mask, size_t light) {
  const Call call(device_);
  const LightFrame& frame = mask.lights.at(light);
  const LightState& state = state_->views.at(frame.view).lights.at(frame.light);
  const Technique& forward = forward_technique(registry_, state.params);
  const bool lacks_layer = needs_second_layer(forward) && state.params.get_int("maps.layers") != state.asked_layers;
  if (!frame.binds_forward && (forward.name != state.params.get_word("technique") || lacks_layer))
    fail(
        "soft shadows: light {} has no maps for surfaces drawn forward: its frame said that there are none "
        "(Inputs::binds_forward, penumbra_frame.no_forward_surfaces)",
        frame.light);
  bind_light(device_, frame, state, owner_of(forward));
}

void SoftShadows::unbind_forward() {
  const Call call(device_);
  gl::unbind_textures(first_pass_unit);
}

bool SoftShadows::reads_motion(const ParamSet& params, std::span<const Light> lights) const {
  return std::ranges::any_of(lights, [&](const Light& light) {
    const ParamSet& own = state_->params_of(registry_, params, light);
    const Technique& technique = registry_.find(own.get_word("technique"));
    if (technique.resolve && technique.resolve_reads_motion) return true;
    return !remembered_by(denoiser_for(registry_, technique, own), own).empty();
  });
}

ForwardProgram SoftShadows::forward_program(const ParamSet& params, const Light& light) const {
  const ParamSet& own = state_->params_of(registry_, params, light);
  const Technique& technique = forward_technique(registry_, own);
  const Programs::Compiled compiled = Programs::compiled_for(technique, own, shape_of(light.source, own));
  return {state_->programs.forward_file(technique), state_->programs.defines(technique, own, compiled)};
}

std::string SoftShadows::forward_source(const ParamSet& params, const Light& light) const {
  const ForwardProgram program = forward_program(params, light);
  const gl::ShaderSource source = gl::load_shader_source(device_.shaders.files(), program.include, program.defines);
  return with_prefix(without_version(source.text), "penumbra_");
}

std::vector<gl::ProgramDesc> SoftShadows::all_programs(const ParamSet& defaults) const {
  return state_->programs.all(defaults);
}

std::vector<ForwardProgram> SoftShadows::all_forward_programs(const ParamSet& defaults) const {
  std::vector<ForwardProgram> all;
  for (const Technique& technique : registry_.techniques()) {
    if (technique.glsl.empty()) continue;
    for (std::vector<gl::Define>& defines : state_->programs.all_defines(technique, defaults)) {
      all.push_back({state_->programs.forward_file(technique), std::move(defines)});
    }
  }
  return all;
}

}  // namespace penumbra::shadow
