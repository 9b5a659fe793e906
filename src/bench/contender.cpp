#include "bench/contender.h"

namespace penumbra::bench {

namespace {

using Timed = session::RenderDevice::Timed;

constexpr const char* mask_pass = "shadow mask";

}  // namespace

Contender::Contender(const Entry& entry, const shadow::Registry& registry, const scene::Scene& scene,
                     const cli::DeviceOptions& options, const Measuring& what)
    : device_(options, what.passes ? Timed::passes : Timed::frames),
      scene_(device_.device, scene),
      renderer_(device_.device, registry) {
  const shadow::Technique& technique = renderer_.registry().find(entry.params.get_word("technique"));
  if (what.floor)
    floor_.emplace(technique, entry.params, scene, gl::ShaderFiles(options.glsl), device_.device.timers.mode());
}

void Contender::draw(const render::FrameInputs& inputs, const ParamSet& params) {
  render::FrameInputs own = inputs;
  own.mask_details = floor_.has_value();  // which reads the filter radii
  const render::Frame& frame = renderer_.draw(scene_, own, params);
  if (!floor_) return;
  // Copied between the two frames, so that the time of no pass includes it.
  floor_->take_kernels(*frame.mask.texture);
  floor_->draw(inputs, params);
}

void Contender::keep(PassTimes& own, PassTimes& floor, std::size_t count) {
  own.append(device_.device.timers.rows(), device_.device.timers.cpu_milliseconds(), count);
  if (floor_) floor.append(floor_->timers().rows(), floor_->timers().cpu_milliseconds(), count);
}

std::optional<FloorCost> Contender::floor_cost(const PassTimes& own, const PassTimes& floor) const {
  if (!floor_) return std::nullopt;
  FloorCost cost{.copy = summary_of(floor.of("mask copy"))};
  if (floor_->has_fetches()) {
    cost.fetch = summary_of(floor.of(mask_pass));
    cost.mask_ratio = paired_ratio(own.of(mask_pass), floor.of(mask_pass));
  }
  return cost;
}

}  // namespace penumbra::bench
