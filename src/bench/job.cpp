#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <ranges>
#include <utility>

#include "bench/bench.h"
#include "bench/device.h"
#include "bench/machine.h"
#include "bench/measure.h"
#include "bench/options.h"
#include "bench/part_result.h"
#include "bench/results.h"
#include "cli/no_effect.h"
#include "cli/text.h"
#include "session/prepared_scene.h"
#include "session/render_device.h"

namespace penumbra::bench {

namespace {

using io::Json;

std::size_t points_here(const Options& options, const Tools& tools, const shadow::Registry& registry) {
  if (options.sweep.empty()) return 1;
  const std::unique_ptr<gl::Context> context = open_measured(options);
  return sweep_of(options, tools.decoder(cli::limits_of(options.reading)), registry).points.size();
}

class BenchJob : public plan::Job {
 public:
  BenchJob(cli::Arguments arguments, std::size_t output, Options options, Tools tools, std::optional<std::size_t> items)
      : arguments_(std::move(arguments)),
        output_(output),
        options_(std::move(options)),
        tools_(std::move(tools)),
        registry_(tools_.techniques(options_.threads.value_or(0))),
        entries_(entries_of(options_, registry_)) {
    options_.reading.skies_chosen = std::ranges::all_of(
        entries_, [&](const Entry& entry) { return cli::is_chosen(options_, entry.params, "casters.skies"); });
    session::limit_threads(options_);
    points_ = items ? *items : points_here(options_, tools_, registry_);
  }

  std::size_t count() const override { return points_; }
  std::vector<std::string> scenes() const override { return {options_.scene}; }
  std::size_t scene_of(std::size_t /*item*/) const override { return 0; }

  std::string name(std::size_t item) const override {
    const std::string scene = std::filesystem::path(options_.scene).filename().string();
    const std::string begin = scene.empty() ? "generated casters" : scene;
    return options_.sweep.empty() ? begin : fmt::format("{}, point {} of {}", begin, item, options_.sweep);
  }

  // Times depend on the number of threads.
  Json depends(std::size_t item) const override {
    Json techniques = Json::array();
    for (const Entry& entry : entries_)
      techniques.push_back({{"label", entry.label}, {"params", io::to_json(entry.params)}});
    return {
        {"options", plan::json_of(options_.given, {"--technique", "--preset", "--set", "--sun-angle", "--exposure"})},
        {"threads", options_.threads.value_or(0)},
        {"techniques", techniques},
        {"point", item},
        {"points", points_}};
  }

  Json what(std::size_t item) const override {
    Json techniques = Json::array();
    for (const Entry& entry : entries_)
      techniques.push_back({{"name", entry.label}, {"params", io::changed_params(entry.params)}});
    return {{"point", item}, {"techniques", techniques}};
  }

  plan::SceneFacts facts(std::size_t /*scene*/) const override {
    constexpr double most_casters = 1e6;  // in software
    if (options_.scene.empty()) {
      return {.view = Json::object(), .files = plan::shaders_of(options_), .triangles = most_casters};
    }
    plan::ImageSizes images(tools_.probe);
    const session::PreparedScene prepared = session::load_scene(options_, images.decoder());
    cli::warn_without_lights(options_, options_, session::kinds_of_light(prepared));
    plan::SceneFacts facts = plan::facts_of(prepared, options_, images);
    if (options_.sweep == "casters") facts.triangles = std::max(facts.triangles, most_casters);
    return facts;
  }

  plan::Estimate estimate(std::size_t /*item*/, const plan::SceneFacts& facts) const override {
    const FrameCounts frames = frame_counts(options_, /* software= */ true);
    const int with_floor = options_.floor ? 2 : 1;
    std::vector<plan::Drawn> drawn;
    for (const Entry& entry : entries_)
      drawn.push_back({.params = &entry.params, .frames = with_floor * (frames.measured + frames.warmup)});
    return plan::estimate_of(facts, options_.size, drawn, registry_, 0);
  }

  void warn() const override {
    std::vector<ParamSet> drawn;
    for (const Entry& entry : entries_) drawn.push_back(entry.params);
    cli::warn_without_effect(options_, drawn, registry_);
  }

  plan::Result work(std::size_t item) const override {
    Options options = options_;
    options.quiet = true;
    const std::unique_ptr<gl::Context> context = open_measured(options);
    Results measured = measure(options, tools_.decoder(cli::limits_of(options.reading)), registry_,
                               OnePoint{.index = item, .of = points_});
    measured.backend = gl::to_string(context->backend());
    return result_of(measured);
  }

  std::vector<std::filesystem::path> outputs(const std::filesystem::path& folder) const override {
    return {folder / "index.html", folder / "results.csv", folder / "results.json"};
  }

  std::vector<std::filesystem::path> merge(const Read& read, const std::filesystem::path& folder) const override {
    std::vector<std::filesystem::path> files = outputs(folder);
    Results whole;
    for (std::size_t item = 0; item < points_; ++item) {
      Results kept = kept_point(read(item));
      if (item == 0) {
        whole = std::move(kept);
        continue;
      }
      check_same_machine(described(whole.machine, whole.device.renderer), described(kept.machine, kept.device.renderer),
                         item);
      whole.points.push_back(std::move(kept.points.front()));
    }
    whole.version = cli::version();
    whole.commit = commit();
    whole.threads = options_.threads;
    whole.command = cli::command_text("penumbra bench", arguments_with(files));
    whole.entries = entries_;
    whole.sweep = make_sweep(options_.sweep, {});
    whole.sweep.points.clear();
    for (const Measured& point : whole.points) {
      check_costs(point);
      whole.sweep.points.push_back(point.point);
    }
    fit_models(whole);
    for (const std::filesystem::path& file : files) write(whole, file.string());
    return files;
  }

 private:
  // As bench itself would be told to write these files.
  cli::Arguments arguments_with(const std::vector<std::filesystem::path>& files) const {
    cli::Arguments arguments = arguments_;
    arguments[output_] = files.front().string();
    cli::Arguments more;
    for (const std::filesystem::path& file : files | std::views::drop(1))
      more.insert(more.end(), {"-o", file.string()});
    arguments.insert(arguments.begin() + static_cast<std::ptrdiff_t>(output_) + 1, more.begin(), more.end());
    return arguments;
  }

  void check_costs(const Measured& point) const {
    const std::size_t axes = make_sweep(options_.sweep, {}).axes.size();
    if (point.costs.size() != entries_.size() || point.point.at.size() != axes || point.point.names.size() != axes)
      fail("a result is not of this sweep");
  }

  cli::Arguments arguments_;
  std::size_t output_;
  Options options_;
  Tools tools_;
  shadow::Registry registry_;
  std::vector<Entry> entries_;
  std::size_t points_ = 1;
};

}  // namespace

std::unique_ptr<plan::Job> make_job(const cli::Arguments& arguments, std::size_t output, Tools tools,
                                    std::optional<std::size_t> items) {
  CLI::App app("Measure what shadows cost, pass by pass, in items", "penumbra plan bench");
  Options options;
  add_options(app, options);
  app.get_option("--output")->description("Plan to write, .json");
  if (!cli::parse(app, arguments)) return nullptr;
  options.given = cli::given_options(app);
  check_together(options);
  options.outputs.clear();
  return std::make_unique<BenchJob>(arguments, output, std::move(options), std::move(tools), items);
}

}  // namespace penumbra::bench
