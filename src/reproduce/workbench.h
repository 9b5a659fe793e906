#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "cli/options.h"
#include "gl/context.h"
#include "metrics/error_figures.h"
#include "session/cache_options.h"
#include "session/prepared_scene.h"
#include "session/render_session.h"
#include "truth/technique.h"

namespace penumbra::reproduce {

// What `penumbra reproduce` was asked for; every value is parsed and in range.
struct Options : cli::SceneOptions, cli::DeviceOptions, session::CacheOptions {
  std::string output;        // a folder
  std::string moving_scene;  // scenes/moving.glb, for what the thesis says of motion
  std::filesystem::path page() const { return std::filesystem::path(output) / "index.html"; }
  std::filesystem::path json() const { return std::filesystem::path(output) / "figures.json"; }
  std::filesystem::path csv() const { return std::filesystem::path(output) / "figures.csv"; }
  bool quick = false, quiet = false;

  int truth_samples() const { return quick ? 64 : 256; }
  // The number of frames whose median is a cost.
  int cost_frames() const { return quick ? 3 : 5; }
};

// Throws UsageError if an output would overwrite one of the scene's files, or another file that the command reads.
void check_inputs(const Options& options, std::span<const std::filesystem::path> scene_files);

// How something is drawn: a technique or a preset, and values ("pcss.filter_taps=8") that differ from its own.
struct ShadowConfig {
  std::string technique = "pcss";
  std::vector<std::string> values;

  std::string key() const;
};

// A visibility picture against both references, over the receivers.
struct MeasuredPicture {
  std::vector<float> visibility;
  double psnr_pcss = 0, psnr_truth = 0;  // in the penumbra, dB
  // The PSNR against converged PCSS with the errors blurred first: the error that remains for a viewer or a denoiser
  // that averages neighbouring pixels. Grain disappears, bands and blotches remain.
  double psnr_blurred = 0;
  double flip = 0;        // against converged PCSS
  double width_bias = 0;  // of penumbra widths, against converged PCSS; a share of the width
  metrics::ErrorFigures to_pcss, to_truth;
};

// The scene, its references and the pictures drawn of it, each drawn once.
class Workbench {
 public:
  // `drawn` is called after each picture. Opens a context, which stays current. Throws Error.
  Workbench(const Options& options, std::function<void()> drawn);

  // Valid as long as the workbench.
  const MeasuredPicture& draw(const ShadowConfig& config);
  // Median time of the passes between G-buffer and lighting, ms. The configurations are drawn alternately, so that a
  // machine that slows down during the run slows all of them alike.
  std::vector<double> costs(const std::vector<ShadowConfig>& configs);
  // RGB, 8 bits.
  std::vector<std::uint8_t> display(const ShadowConfig& config);
  // Counts a picture that a figure draws by itself.
  void count_drawn() const { drawn_(); }
  // A picture's errors within some of the receivers, against converged PCSS.
  metrics::ErrorFigures errors_at(const MeasuredPicture& drawing, const std::vector<std::uint8_t>& mask) const;

  const std::vector<float>& truth() const { return truth_picture_; }
  const std::vector<float>& pcss() const { return pcss_picture_; }
  const std::vector<std::uint8_t>& receivers() const { return receivers_; }
  int width() const { return options_.size.width; }
  int height() const { return options_.size.height; }
  const Options& options() const { return options_; }
  const gl::DeviceInfo& device() const { return device_; }
  double sun_angle() const;  // full angle, degrees

  ParamSet params_of(const ShadowConfig& config) const;
  ShadowConfig truth_config() const;
  // Uses another seed than the measured pictures, so that their errors are independent.
  static ShadowConfig pcss_config();

 private:
  std::vector<float> picture_of(const ShadowConfig& config);
  MeasuredPicture measured(std::vector<float> visibility) const;
  metrics::ImageView as_picture(const std::vector<float>& pixels) const;
  double psnr_blurred(const std::vector<float>& visibility) const;

  const Options& options_;
  std::function<void()> drawn_;
  truth::TruthTechnique truth_;
  shadow::Registry techniques_;
  session::PreparedScene prepared_;
  session::RenderSession session_;
  gl::DeviceInfo device_;
  std::vector<float> truth_picture_, pcss_picture_;
  std::vector<std::uint8_t> receivers_;
  std::map<std::string, MeasuredPicture> drawings_;
};

}  // namespace penumbra::reproduce
