#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/metadata.h"
#include "app/truth/options.h"
#include "app/truth/picture.h"
#include "cli/input_files.h"
#include "cli/no_effect.h"
#include "cli/output_names.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "core/log.h"
#include "image/read.h"
#include "io/output_file.h"
#include "session/prepared_scene.h"
#include "session/render_session.h"
#include "session/techniques.h"
#include "truth/technique.h"

namespace penumbra::app {

namespace {

// The standard error that 99.9 % of the receivers stay below, each for each light.
float error_of_most(const truth::TruthTechnique& truth, std::size_t lights) {
  std::vector<float> errors;
  for (std::size_t light = 0; light < lights; ++light) {
    const truth::TruthTechnique::Last& last = truth.last(static_cast<int>(light));
    for (std::size_t i = 0; i < last.receiver.size(); ++i) {
      if (last.receiver[i] > 0) errors.push_back(last.traced.standard_error[i]);
    }
  }
  if (errors.empty()) return 0;
  const std::size_t rank = errors.size() - 1 - errors.size() / 1000;
  std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(rank));
  return errors[rank];
}

// Of the last frame.
std::string summary(const std::filesystem::path& path, const cli::Size& size, const truth::TruthTechnique& truth,
                    std::size_t lights) {
  double millions = 0, seconds = 0;
  int samples = 0;
  std::size_t kept = 0;
  for (std::size_t light = 0; light < lights; ++light) {
    const truth::TruthTechnique::Last& last = truth.last(static_cast<int>(light));
    samples = std::max(samples, last.traced.samples);
    if (last.from_cache) {
      ++kept;
      continue;
    }
    millions += static_cast<double>(last.traced.rays) * 1e-6;
    seconds += last.traced.seconds;
  }
  std::string cost = "from the cache";
  if (kept < lights) {
    cost = fmt::format("{:.1f} million rays in {:.2f} s, {:.1f} million a second", millions, seconds,
                       millions / std::max(seconds, 1e-9));
    if (kept > 0) cost += fmt::format(", {} lights from the cache", kept);
  }
  const std::string of_lights = lights > 1 ? fmt::format("{} lights, ", lights) : "";
  return fmt::format("wrote {} ({}×{}, {}{} rays a pixel{}, {}, standard error up to {:.2g} in 99.9 %)", path.string(),
                     size.width, size.height, of_lights, samples, lights > 1 ? " each" : "", cost,
                     error_of_most(truth, lights));
}

void check_inputs(const std::vector<std::filesystem::path>& scene_files, const TruthOptions& options,
                  const cli::OutputNames& names, const cli::FrameRange& range, std::size_t lights) {
  cli::InputFiles inputs;
  inputs.add_scene(scene_files);
  inputs.add_presets(options.presets);
  inputs.add_shaders(options);
  for (int frame = range.first; frame <= range.last; ++frame) {
    for (const std::filesystem::path& file : picture_files(names, frame, lights)) inputs.check("-o", file);
  }
}

void trace_files(TruthOptions options) {
  const cli::OutputNames names(options.output, options.frames.has_value());
  const ParamSet params = params_of(options, session::all_techniques());
  cli::warn_without_effect(options, {&params, 1}, session::all_techniques());
  cli::warn_of_rate(options);
  const cli::FrameRange range = options.frames.value_or(cli::FrameRange{});
  cli::clean_up_on_signals();
  session::limit_threads(options);
  check_inputs({options.scene}, options, names, range, 1);
  io::check_writable(names.picture(range.first));
  options.reading.skies_chosen = cli::is_chosen(options, params, "casters.skies");
  const session::PreparedScene prepared =
      session::load_scene(options, image::image_decoder(cli::limits_of(options.reading)));
  const std::size_t lights = render::shadowed_lights(prepared.setup).size();
  check_inputs(prepared.scene.files, options, names, range, lights);
  for (const std::filesystem::path& file : picture_files(names, range.first, lights)) io::check_writable(file);
  cli::warn_without_lights(options, options, session::kinds_of_light(prepared));

  constexpr int parts = 1000;  // of a frame
  std::optional<cli::Progress> progress;
  progress.emplace(range.count() > 1 ? "frame" : "", range.count() > 1 ? range.count() : parts, !options.quiet);
  truth::TechniqueOptions how = session::truth_options(options, options);
  if (range.count() == 1) {
    how.progress = [&progress](double share) {
      progress->set_done(std::min(static_cast<int>(share * parts), parts - 1));
      return true;
    };
  }
  const truth::TruthTechnique truth(std::move(how));
  session::RenderSession session(options, options, session::open_context(options, options), prepared, truth.registry(),
                                 /* timed= */ false);
  std::string last_line;
  float worst = 0;
  for (int frame = range.first; frame <= range.last; ++frame) {
    session.draw(frame, params);
    for (const cli::EncodedFile& file : encoded_pictures(names, frame, options.size, truth, lights,
                                                         metadata_of(options, session.setup(), params, frame)))
      io::write_text(file.path, {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
    if (range.count() > 1) progress->step();
    worst = std::max(worst, error_of_most(truth, lights));
    last_line = summary(names.picture(frame), options.size, truth, lights);
  }
  progress.reset();
  const float asked = params.get_float("truth.error");
  if (asked > 0 && worst > asked)
    warn("truth.error {} is not reached: the standard error is up to {:.2g} with {} rays a pixel, the most", asked,
         worst, truth::max_samples);
  if (!options.quiet) fmt::print("{}\n", cli::printable(last_line));
}

}  // namespace

int run_truth(const Arguments& arguments) {
  CLI::App app("Ray trace the shadows of a scene, as a reference for techniques", "penumbra truth");
  TruthOptions options;
  add_truth_options(app, options);
  if (!cli::parse(app, arguments)) return 0;
  check_together(options);
  trace_files(std::move(options));
  return 0;
}

}  // namespace penumbra::app
