#include "reproduce/workbench.h"

#include <fmt/format.h>

#include <utility>

#include "bench/times.h"
#include "cli/input_files.h"
#include "core/log.h"
#include "image/read.h"
#include "io/output_file.h"
#include "metrics/convolve.h"
#include "metrics/flip.h"
#include "metrics/penumbra_width.h"
#include "render/receivers.h"
#include "session/techniques.h"

namespace penumbra::reproduce {

namespace {

constexpr double blur_sigma = 1.5;  // pixels

session::PreparedScene load_scene(const Options& options) {
  session::PreparedScene prepared = session::load_scene(options, image::image_decoder(cli::limits_of(options.reading)));
  check_inputs(options, prepared.scene.files);
  const cli::LightKinds shining = session::kinds_of_light(prepared);
  if (shining.lamps || !shining.sun)
    fail("{}: the figures are of a scene that suns alone light, and {}; choose them with --lights",
         io::quoted(options.scene), shining.sun ? "lamps shine here too" : "none shines here");
  return prepared;
}

}  // namespace

void check_inputs(const Options& options, std::span<const std::filesystem::path> scene_files) {
  cli::InputFiles inputs;
  inputs.add_scene(scene_files);
  inputs.add_shaders(options);
  for (const std::filesystem::path& output : {options.page(), options.json(), options.csv()})
    inputs.check("-o", output);
}

std::string ShadowConfig::key() const {
  return values.empty() ? technique : fmt::format("{} {}", technique, fmt::join(values, " "));
}

Workbench::Workbench(const Options& options, std::function<void()> drawn)
    : options_(options),
      drawn_(std::move(drawn)),
      truth_(session::truth_options(options, options)),
      techniques_(truth_.registry()),
      prepared_(load_scene(options)),
      session_(options, options, session::open_context(options, options), prepared_, techniques_, /* timed= */ true),
      device_(session_.device_info()) {
  truth_picture_ = picture_of(truth_config());
  receivers_ = render::receivers_of(session_.renderer(), session_.setup().sun, params_of(pcss_config()));
  pcss_picture_ = picture_of(pcss_config());
  drawings_.emplace(pcss_config().key(), measured(pcss_picture_));
}

ShadowConfig Workbench::truth_config() const {
  return {"truth", {fmt::format("truth.samples={}", options_.truth_samples())}};
}

ShadowConfig Workbench::pcss_config() { return {"brute_force", {"sampling.seed=4711"}}; }

double Workbench::sun_angle() const { return static_cast<double>(params_of(pcss_config()).get_float("sun.angle")); }

ParamSet Workbench::params_of(const ShadowConfig& config) const {
  cli::ShadowOptions shadow;
  shadow.technique = config.technique;
  shadow.assignments = config.values;
  return cli::resolve_params(shadow, techniques_);
}

std::vector<float> Workbench::picture_of(const ShadowConfig& config) {
  session_.draw(0, params_of(config));
  drawn_();
  return session_.renderer().read_aov("shadow");
}

metrics::ImageView Workbench::as_picture(const std::vector<float>& pixels) const {
  return {.width = width(), .height = height(), .pixels = pixels};
}

const MeasuredPicture& Workbench::draw(const ShadowConfig& config) {
  const std::string key = config.key();
  if (const auto known = drawings_.find(key); known != drawings_.end()) return known->second;
  const MeasuredPicture& drawing = drawings_.emplace(key, measured(picture_of(config))).first->second;
  if (const std::size_t count = drawing.to_pcss.not_finite; count > 0)
    warn("'{}' gives values that are not finite: {}; each counts as an error of 1", key, count);
  return drawing;
}

MeasuredPicture Workbench::measured(std::vector<float> visibility) const {
  MeasuredPicture drawing{.visibility = std::move(visibility)};
  const metrics::ImageView test = as_picture(drawing.visibility), pcss = as_picture(pcss_picture_);
  drawing.to_pcss = metrics::error_figures(test, pcss, receivers_);
  drawing.to_truth = metrics::error_figures(test, as_picture(truth_picture_), receivers_);
  drawing.psnr_pcss = drawing.to_pcss.psnr_penumbra;
  drawing.psnr_truth = drawing.to_truth.psnr_penumbra;
  drawing.psnr_blurred = psnr_blurred(drawing.visibility);
  drawing.flip = metrics::flip(test, pcss, receivers_).mean;
  drawing.width_bias = metrics::penumbra_width(test, pcss, receivers_).relative_bias;
  return drawing;
}

double Workbench::psnr_blurred(const std::vector<float>& visibility) const {
  metrics::Plane errors(width(), height()), weights(width(), height());
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    if (receivers_[i] == 0) continue;
    errors.pixels[i] = metrics::signed_error(visibility[i], pcss_picture_[i]);
    weights.pixels[i] = 1;
  }
  const metrics::Plane sums = metrics::blurred(errors, blur_sigma, metrics::Border::zero),
                       shares = metrics::blurred(weights, blur_sigma, metrics::Border::zero);
  double squared = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    const float reference = pcss_picture_[i];
    if (receivers_[i] == 0 || reference < metrics::penumbra_low || reference > metrics::penumbra_high) continue;
    const double error = sums.pixels[i] / shares.pixels[i];
    squared += error * error;
    ++count;
  }
  return metrics::psnr_of(squared / static_cast<double>(count));
}

metrics::ErrorFigures Workbench::errors_at(const MeasuredPicture& drawing,
                                           const std::vector<std::uint8_t>& mask) const {
  std::vector<std::uint8_t> both(mask.size());
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = mask[i] != 0 && receivers_[i] != 0 ? 1 : 0;
  return metrics::error_figures(as_picture(drawing.visibility), as_picture(pcss_picture_), both);
}

std::vector<double> Workbench::costs(const std::vector<ShadowConfig>& configs) {
  std::vector<bench::PassTimes> times(configs.size());
  const auto measured_params = [this](const ShadowConfig& config) {
    ParamSet params = params_of(config);
    params.set("maps.keep", false);  // as in the thesis, each frame draws its maps
    return params;
  };
  for (const ShadowConfig& config : configs) session_.draw(0, measured_params(config));  // compiles
  for (int frame = 0; frame < options_.cost_frames(); ++frame) {
    for (std::size_t i = 0; i < configs.size(); ++i) {
      session_.draw(0, measured_params(configs[i]));
      times[i].append(session_.device().timers.rows(), session_.device().timers.cpu_milliseconds(), 1);
    }
  }
  std::vector<double> medians;
  for (const bench::PassTimes& one : times) medians.push_back(bench::summary_of(one.shadow_sums()).median);
  return medians;
}

std::vector<std::uint8_t> Workbench::display(const ShadowConfig& config) {
  session_.draw(0, params_of(config));
  return session_.renderer().read_display();
}

}  // namespace penumbra::reproduce
