#include "session/render_session.h"

#include <utility>
#include <variant>

#include "core/log.h"
#include "scene/drawn.h"

namespace penumbra::session {

namespace {

// On a software rasteriser a pass over this many triangles takes seconds, and a frame has several passes.
void warn_of_many(const scene::Scene& scene, const gl::DeviceInfo& device) {
  constexpr std::size_t many_triangles = 20'000'000, many_vertices = 10'000'000;
  if (!device.software) return;
  const scene::Drawn drawn = scene::count_drawn(scene);
  if (drawn.triangles > many_triangles || drawn.deformed_vertices > many_vertices)
    warn("a frame draws {} triangles, and {} vertices of skinned and morphed meshes: a software rasteriser takes long",
         drawn.triangles, drawn.deformed_vertices);
}

}  // namespace

RenderSession::RenderSession(const cli::SceneOptions& options, const cli::DeviceOptions& device_options,
                             std::unique_ptr<gl::Context> context, const PreparedScene& prepared,
                             shadow::Registry techniques, bool timed)
    : options_(options),
      prepared_(&prepared),
      context_(std::move(context)),
      device_(device_options, timed ? RenderDevice::Timed::passes : RenderDevice::Timed::nothing),
      scene_(std::make_unique<scene::GpuScene>(device_.device, prepared.scene)),
      renderer_(device_.device, std::move(techniques)) {
  warn_of_many(prepared.scene, device_.info);
}

void RenderSession::show(const PreparedScene& prepared) {
  scene_ = std::make_unique<scene::GpuScene>(device_.device, prepared.scene);
  prepared_ = &prepared;
  cut();
}

void RenderSession::draw(int frame, const ParamSet& params, int samples) {
  const double time = time_of(options_, frame), last_time = time_of(options_, frame - 1);
  draw_at({.time = time, .last_time = last_time, .cut = drawn_time_ != last_time}, params, samples);
}

void RenderSession::redraw(const ParamSet& params, int samples) {
  draw_at({.time = *drawn_time_, .last_time = *drawn_time_}, params, samples);
}

void RenderSession::draw_at(const FrameTime& when, const ParamSet& params, int samples) {
  const cli::Size pixels{options_.size.width * options_.supersample, options_.size.height * options_.supersample};
  render::FrameInputs inputs = frame_inputs(*prepared_, pixels, when);
  inputs.mask_details = mask_details_;
  inputs.samples = samples;
  inputs.averaged_aovs = averaged_aovs_;
  inputs.own_shadows = options_.own_shadows;
  setup_ = setup_at(*prepared_, when.time);
  renderer_.draw(*scene_, inputs, params);
  drawn_time_ = when.time;
}

}  // namespace penumbra::session
