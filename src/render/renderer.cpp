#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/log.h"
#include "render/frame.h"
#include "render/passes.h"

namespace penumbra::render {

struct Renderer::State {
  gl::Device& device;
  shadow::SoftShadows soft_shadows;
  Sky sky;
  gl::Texture noise;  // dither_noise(), from the first frame on: programs can be listed without a context
  FrameParts parts;
  Frame frame;
  // What a view's last frame drew; the next one that draws something else is a cut.
  struct Drawn {
    std::uint64_t scene = 0;  // its id
    scene::CasterChoice casters;
    double time = 0;

    // Apart from a ground, which shadows nothing when it begins or ends to cast.
    bool same_casters(const Drawn& other) const {
      return scene == other.scene && casters.faces == other.casters.faces && casters.skies == other.casters.skies;
    }
  };
  std::map<int, Drawn> last;  // by view; absent: its last frame threw, or there was none

  const FrameParts& drawn() const {
    if (parts.display == nullptr) fail("no frame was drawn that could be read");
    return parts;
  }

  // The same, with everything that this AOV needs.
  const FrameParts& drawn_for(std::string_view aov) {
    if (aov == "motion" && drawn().gbuffer.motion == nullptr) add_motion(device, parts);
    return drawn();
  }
};

Renderer::Renderer(gl::Device& device, shadow::Registry registry)
    : state_(new State{device, shadow::SoftShadows(device, std::move(registry)), {}, {}, {}, {}, {}}) {}

Renderer::~Renderer() = default;

std::vector<Param> Renderer::params(const shadow::Registry& registry) {
  std::vector<Param> rows = registry.params();
  for (Param& row : render_params()) rows.push_back(std::move(row));
  return rows;
}

namespace {

// A light by its place in the frame.
std::string name_of(int place, std::span<const std::string> names) {
  return names.empty() ? std::to_string(place) : fmt::format("'{}'", names[static_cast<std::size_t>(place)]);
}

// Once for each, however many renderers draw the scene.
void warn_of_hidden_suns(const FrameInputs& inputs, const ParamSet& params) {
  if (inputs.told_hidden == nullptr) return;
  for (std::size_t i = 0; i < inputs.lights.size(); ++i) {
    if (!is_hidden(inputs.lights[i], inputs.on_ground, params)) continue;
    const int id = inputs.light_ids.empty() ? static_cast<int>(i) : inputs.light_ids[i];
    if (!inputs.told_hidden->insert(id).second) continue;
    warn("light {} is below the horizon: the ground hides it, and it lights nothing",
         name_of(static_cast<int>(i), inputs.light_names));
  }
}

}  // namespace

void check_lights(const FrameInputs& inputs, const shadow::Registry& registry, const ParamSet& params) {
  const std::vector<shadow::Light> lights = shadow_lights(inputs.lights, {});  // with their places as ids
  const shadow::Technique& technique = registry.find(params.get_word("technique"));
  for (const shadow::Light& light : lights) {
    if (technique.suns_only && shadow::lamp_map_count(light.source) > 0)
      fail("light {} is a lamp, and technique '{}' is for suns alone", name_of(light.id, inputs.light_names),
           technique.name);
  }
  constexpr long long most_texels = 4LL * 8192 * 8192;
  const long long size = params.get_int("lamps.size");
  long long maps = 0;
  for (const shadow::Light& light : lights) maps += shadow::lamp_map_count(light.source);
  if (maps * size * size <= most_texels) return;
  fail("{} maps of lamps with lamps.size={} are {} texels: the limit is {} (1.2 GiB)", maps, size, maps * size * size,
       most_texels);
}

const Frame& Renderer::draw(scene::GpuScene& scene, const FrameInputs& inputs, const ParamSet& params) {
  if (inputs.lights.empty() || inputs.lights.size() > max_lights)
    fail("a frame has {} lights; 1 to {} can be drawn", inputs.lights.size(), max_lights);
  if (!inputs.light_ids.empty() && inputs.light_ids.size() != inputs.lights.size())
    fail("a frame has {} lights, and {} ids of lights", inputs.lights.size(), inputs.light_ids.size());
  if (!inputs.light_names.empty() && inputs.light_names.size() != inputs.lights.size())
    fail("a frame has {} lights, and {} names of lights", inputs.lights.size(), inputs.light_names.size());
  if (inputs.view < 0) fail("view {} can't be drawn: views have numbers from 0 on", inputs.view);
  if (inputs.samples < 1 || inputs.samples > max_samples)
    fail("a frame has {} samples for each pixel; 1 to {} can be drawn", inputs.samples, max_samples);
  check_lights(inputs, registry(), params);
  gl::Device& device = state_->device;
  const State::Drawn now{
      .scene = scene.id(), .casters = caster_choice(params, inputs.lights, registry()), .time = inputs.time};
  // Removed until this frame is complete: if it throws, the view's next frame must not reuse its history.
  const auto last = state_->last.extract(inputs.view);
  FrameInputs placed = inputs;
  placed.cut = inputs.cut || last.empty() || !last.mapped().same_casters(now);
  // If the caller left out frames of this view, the scene does not know what moved since its last one.
  constexpr double rounding = 1e-6;  // seconds: the caller may have computed the time again
  const bool knows_moved = placed.cut || (std::abs(last.mapped().time - inputs.last_time) <= rounding &&
                                          last.mapped().casters == now.casters);
  warn_of_hidden_suns(inputs, params);
  // If this frame throws, the textures of the last one are no longer valid and must not be read.
  state_->parts = {};
  if (!state_->noise) state_->noise = dither_noise();
  update_sky(state_->sky, inputs.lights, inputs.on_ground, params);
  device.shaders.next_frame();
  device.timers.begin_frame();
  state_->parts =
      draw_frame(device, state_->soft_shadows, scene, placed, knows_moved, params, state_->sky, state_->noise);
  device.timers.end_frame();
  state_->last[inputs.view] = now;
  const FrameParts& parts = state_->parts;
  state_->frame = {.display = parts.display, .color = parts.color, .depth = parts.gbuffer.depth, .mask = parts.mask};
  return state_->frame;
}

std::vector<float> Renderer::read_aov(std::string_view name, int light) const {
  return render::read_aov(state_->drawn_for(name), name, light);
}

std::vector<float> Renderer::read_visibilities() const {
  std::vector<float> all;
  const std::size_t lights = state_->drawn().mask.lights.size();
  for (std::size_t light = 0; light < lights; ++light) {
    const std::vector<float> one = read_aov("shadow", static_cast<int>(light));
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

std::vector<float> Renderer::read_aov(std::string_view name, const glm::ivec2& pixel) const {
  return render::read_aov(state_->drawn_for(name), name, 0, pixel);
}

std::vector<std::uint8_t> Renderer::read_display() const {
  const gl::Texture& display = *state_->drawn().display;
  const std::vector<float> pixels = gl::read_floats(display, 3);
  const auto row = static_cast<std::size_t>(display.width()) * 3;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(pixels.size());
  constexpr float half = 0.5f;  // std::lround() would be a call for each byte
  for (std::size_t y = pixels.size() / row; y-- > 0;) {
    for (std::size_t x = 0; x < row; ++x)
      bytes.push_back(static_cast<std::uint8_t>(pixels[y * row + x] * 255.0f + half));
  }
  return bytes;
}

std::vector<gl::ProgramDesc> Renderer::all_programs(const ParamSet& defaults) {
  std::vector<gl::ProgramDesc> all;
  for (std::vector<gl::ProgramDesc>& programs :
       std::vector{scene::GpuScene::programs(), gbuffer_programs(), surface_id_programs(),
                   state_->soft_shadows.all_programs(defaults), lighting_programs(),
                   blended_programs(state_->device, state_->soft_shadows, defaults), exposure_programs(),
                   tone_map_programs(), sample_programs(), sample_mask_programs()}) {
    std::move(programs.begin(), programs.end(), std::back_inserter(all));
  }
  const auto of_casters = [](const gl::ProgramDesc& program) {
    return program.vertex.empty() && program.compute.empty();
  };
  std::vector<gl::ProgramDesc> complete;
  for (gl::ProgramDesc& program : all) {
    if (of_casters(program)) {
      std::ranges::move(scene::GpuScene::caster_geometry_programs(program), std::back_inserter(complete));
    } else {
      complete.push_back(std::move(program));
    }
  }
  return complete;
}

void Renderer::forget_view(int id) {
  state_->soft_shadows.forget_view(id);
  state_->last.erase(id);
}

const shadow::Registry& Renderer::registry() const { return state_->soft_shadows.registry(); }

}  // namespace penumbra::render
