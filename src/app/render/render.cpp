#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <future>
#include <string>

#include "app/commands.h"
#include "app/render/drawing.h"
#include "app/render/file_check.h"
#include "app/render/frame_files.h"
#include "app/render/options.h"
#include "cli/output_names.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "image/read.h"
#include "io/output_file.h"
#include "session/prepared_scene.h"
#include "session/render_session.h"
#include "session/techniques.h"
#include "truth/technique.h"

namespace penumbra::app {

namespace {

using Clock = std::chrono::steady_clock;

std::string summary(const RenderOptions& options, const ParamSet& params, const cli::OutputNames& names,
                    const cli::FrameRange& range, double seconds) {
  std::string files = names.picture(range.first).string();
  if (range.count() > 1) files += " to " + names.picture(range.last).string();
  if (!options.aovs.empty())
    files += fmt::format(" with the AOV{} {}", options.aovs.size() == 1 ? "" : "s", fmt::join(options.aovs, ", "));
  return fmt::format("wrote {} ({}×{}, {}, {:.2f} s)", files, options.size.width, options.size.height,
                     session::technique_label(params), seconds);
}

// Standard output, unless a result is written there.
std::FILE* summary_stream(const RenderOptions& options) {
  for (const std::string& result : {options.output, options.stats, options.save_preset}) {
    if (!result.empty() && io::would_replace(result, "/dev/stdout")) return stderr;
  }
  return stdout;
}

void render_files(RenderOptions options) {
  const Clock::time_point start = Clock::now();
  const cli::OutputNames names(options.output, options.is_sequence());
  const ParamSet params = params_of(options);
  warn_without_effect(options, params);
  const cli::FrameRange range = options.frames.value_or(cli::FrameRange{});
  cli::clean_up_on_signals();
  session::limit_threads(options);
  check_files(options, names);
  options.reading.skies_chosen = cli::is_chosen(options, params, "casters.skies");

  // Starting the driver takes about as long as loading a scene: do both at once.
  std::future<session::PreparedScene> loading = std::async(std::launch::async, [&options] {
    return session::load_scene(options, image::image_decoder(cli::limits_of(options.reading)));
  });
  std::unique_ptr<gl::Context> context = session::open_context(options, options);
  const session::PreparedScene prepared = loading.get();
  check_scene_files(prepared.scene.files, options, names);
  cli::warn_without_lights(options, options, session::kinds_of_light(prepared));
  const truth::TruthTechnique truth(session::truth_options(options, options));
  session::RenderSession session(options, options, std::move(context), prepared, truth.registry(),
                                 /* timed= */ !options.stats.empty());

  draw_frames(options, session, params, range, [&](int frame) { write_frame(session, options, params, names, frame); });
  write_reports(options, prepared, params, session,
                options.stats.empty() ? 0 : measure(options, session, params, range));
  const std::chrono::duration<double> elapsed = Clock::now() - start;
  if (!options.quiet)
    // Not by fmt::print, which throws where standard error is closed or full.
    std::fputs((cli::printable(summary(options, params, names, range, elapsed.count())) + "\n").c_str(),
               summary_stream(options));
}

}  // namespace

int run_render(const Arguments& arguments) {
  CLI::App app("Draw a glTF scene into a PNG or EXR file", "penumbra render");
  RenderOptions options;
  add_render_options(app, options);
  if (!cli::parse(app, arguments)) return 0;
  check_together(options);
  options.reading.progress = !options.quiet;
  render_files(std::move(options));
  return 0;
}

}  // namespace penumbra::app
