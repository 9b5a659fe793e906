#include "bench/bench.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "bench/device.h"
#include "bench/measure.h"
#include "bench/options.h"
#include "bench/results.h"
#include "cli/no_effect.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "core/log.h"
#include "io/output_file.h"
#include "session/render_device.h"

namespace penumbra::bench {

namespace {

// The first device that is no software rasteriser; none where the user chose, or there is none.
std::unique_ptr<gl::Context> open_hardware(const Options& options) {
  if (options.egl_device || options.backend != "auto") return nullptr;
  const int count = static_cast<int>(gl::egl_devices().size());
  for (int i = 0; i < count; ++i) {
    Options one = options;
    one.egl_device = i;
    try {
      std::unique_ptr<gl::Context> context = session::open_context(one, one);
      if (!gl::device_info().software) return context;
    } catch (const Error& error) {
      log(LogLevel::debug, error.what());  // the next device may work
    }
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<gl::Context> open_measured(const Options& options) {
  std::unique_ptr<gl::Context> context = open_hardware(options);
  return context ? std::move(context) : session::open_context(options, options);
}

void write(const Results& results, const std::string& output) {
  const std::string extension = std::filesystem::path(output).extension().string();
  io::write_text(output, extension == ".json"  ? json_of(results)
                         : extension == ".csv" ? csv_of(results)
                                               : html_of(results));
}

int run(const std::string& name, const cli::Arguments& arguments, const DecoderOf& decoder,
        const RegistryOf& techniques) {
  CLI::App app(
      "Measure what shadows cost, pass by pass. Shadow maps are drawn anew in every frame unless --set maps.keep=on is "
      "given",
      name);
  Options options;
  options.command = cli::command_text(name, arguments);
  add_options(app, options);
  if (!cli::parse(app, arguments)) return 0;
  check_together(options);
  const shadow::Registry registry = techniques(options.threads.value_or(0));
  const std::vector<Entry> entries = entries_of(options, registry);  // wrong names end it here
  options.reading.skies_chosen = std::ranges::all_of(
      entries, [&](const Entry& entry) { return cli::is_chosen(options, entry.params, "casters.skies"); });
  std::vector<ParamSet> drawn;
  for (const Entry& entry : entries) drawn.push_back(entry.params);
  cli::warn_without_effect(options, drawn, registry);
  const std::filesystem::path scene = options.scene;
  const cli::InputFiles inputs = inputs_of(options, {&scene, 1});
  for (const std::string& output : options.outputs) {
    inputs.check("-o", output);
    io::check_writable(output);
  }
  cli::clean_up_on_signals();
  session::limit_threads(options);

  const std::unique_ptr<gl::Context> context = open_measured(options);
  Results results = measure(options, decoder(cli::limits_of(options.reading)), registry);
  results.backend = gl::to_string(context->backend());
  for (const std::string& output : options.outputs) write(results, output);
  if (!options.quiet) fmt::print("{}", text_of(results));
  return 0;
}

}  // namespace penumbra::bench
