#include <CLI/CLI.hpp>
#include <chrono>
#include <future>
#include <string>

#include "app/commands.h"
#include "app/drawing.h"
#include "app/file_check.h"
#include "app/frame_files.h"
#include "app/output_names.h"
#include "app/render_options.h"
#include "app/techniques.h"
#include "image/read.h"
#include "studio/signals.h"
#include "studio/stage.h"
#include "studio/studio.h"
#include "truth/technique.h"

namespace penumbra::app {

namespace {

using Clock = std::chrono::steady_clock;

std::string summary(const RenderOptions& options, const ParamSet& params, const OutputNames& names,
                    const studio::FrameRange& range, double seconds) {
  std::string files = names.picture(range.first).string();
  if (range.count() > 1) files += " to " + names.picture(range.last).string();
  if (const std::size_t count = options.aovs.size(); count > 0)
    files += fmt::format(" with {} AOV{}", count, count == 1 ? "" : "s");
  return fmt::format("wrote {} ({}×{}, {}, {:.2f} s)", files, options.size.width, options.size.height,
                     params.get_word("technique"), seconds);
}

void render_files(const RenderOptions& options) {
  const Clock::time_point start = Clock::now();
  const OutputNames names(options.output, options.frames.has_value());
  const ParamSet params = studio::resolve_params(options, all_techniques());
  const studio::FrameRange range = options.frames.value_or(studio::FrameRange{});
  studio::clean_up_on_signals();
  studio::limit_threads(options);
  check_files(options, names);

  // Drivers take as long to start as scenes to load, and there are two cores nearly everywhere.
  std::future<studio::Stage> loading =
      std::async(std::launch::async, [&options] { return studio::load_stage(options, image::image_decoder()); });
  std::unique_ptr<gl::Context> context = studio::open_context(options, options);
  const studio::Stage stage = loading.get();
  check_scene_files(stage.scene.files, options, names);
  const truth::TruthTechnique truth({.cache = options.folder(), .threads = options.threads.value_or(0)});
  studio::Studio studio(
      options, std::move(context), stage,
      {.shaders = gl::ShaderFiles(options.glsl), .techniques = truth.registry(), .timed = !options.stats.empty()});

  draw_frames(options, studio, params, range, [&](int frame) { write_frame(studio, options, params, names, frame); });
  write_reports(options, stage, params, studio, options.stats.empty() ? 0 : measure(options, studio, params, range));
  const std::chrono::duration<double> elapsed = Clock::now() - start;
  if (!options.quiet) fmt::print("{}\n", summary(options, params, names, range, elapsed.count()));
}

}  // namespace

int run_render(const Arguments& arguments) {
  CLI::App app("Draw a glTF scene into a PNG or EXR file", "penumbra render");
  RenderOptions options;
  add_render_options(app, options);
  if (!studio::parse(app, arguments)) return 0;
  check_together(options);
  render_files(options);
  return 0;
}

}  // namespace penumbra::app
