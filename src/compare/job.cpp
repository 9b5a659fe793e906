#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "bench/machine.h"
#include "cli/no_effect.h"
#include "compare/command.h"
#include "compare/draw.h"
#include "compare/drawing.h"
#include "compare/options.h"
#include "compare/page.h"
#include "compare/part_result.h"
#include "compare/reports.h"
#include "compare/scene_names.h"
#include "image/probe.h"
#include "session/techniques.h"

namespace penumbra::compare {

namespace {

using io::Json;

class CompareJob : public plan::Job {
 public:
  CompareJob(cli::Arguments arguments, std::size_t output, CompareOptions options)
      : arguments_(std::move(arguments)),
        output_(output),
        options_(std::move(options)),
        values_(values_of(options_, session::all_techniques())),
        names_(scene_names(options_.scenes, &std::filesystem::path::filename)),
        parts_(options_.no_cost ? values_.contenders.size() : 1) {
    options_.reading.skies_chosen = cli::is_chosen(options_, values_.reference, "casters.skies");
    session::limit_threads(options_);
  }

  std::size_t count() const override { return parts_ * options_.scenes.size(); }
  std::vector<std::string> scenes() const override { return options_.scenes; }
  std::size_t scene_of(std::size_t item) const override { return part_of(item).scene; }

  std::string name(std::size_t item) const override {
    const Part part = part_of(item);
    const std::string& scene = names_[part.scene];
    return part.count == 1 ? fmt::format("{}, {}", scene, options_.contenders[part.first].label) : scene;
  }

  // Options that are in the values of the parameters already, or that are of other items, are left out. Times depend on
  // the number of threads.
  Json depends(std::size_t item) const override {
    const Part part = part_of(item);
    Json techniques = Json::array();
    for (std::size_t i = 0; i < part.count; ++i) techniques.push_back(io::to_json(values_.contenders[part.first + i]));
    return {{"options", plan::json_of(options_.given, {"SCENE", "--technique", "--preset", "--set", "--sun-angle",
                                                       "--exposure", "--spp"})},
            {"threads", options_.no_cost ? Json() : Json(options_.threads.value_or(0))},
            {"reference", io::to_json(values_.reference)},
            {"with_reference", part.first == 0},
            {"techniques", techniques}};
  }

  Json what(std::size_t item) const override {
    const Part part = part_of(item);
    const cli::FrameRange range = options_.frames.value_or(cli::FrameRange{});
    Json techniques = Json::array();
    for (std::size_t i = part.first; i < part.first + part.count; ++i)
      techniques.push_back(
          {{"name", options_.contenders[i].label}, {"params", io::changed_params(values_.contenders[i])}});
    return {{"frames", {range.first, range.last}}, {"techniques", techniques}};
  }

  plan::SceneFacts facts(std::size_t scene) const override {
    CompareOptions one = options_;
    one.scene = options_.scenes[scene];
    plan::ImageSizes images([](const scene::ReadAt& file) { return image::probe(file); });
    return plan::facts_of(load_scene(one, images.decoder()), options_, images);
  }

  plan::Estimate estimate(std::size_t item, const plan::SceneFacts& facts) const override {
    const Part part = part_of(item);
    const int frames = options_.frames ? options_.frames->count() : 1;
    const int again = cost_frames_of(options_);
    std::vector<plan::Drawn> drawn{{.params = &values_.reference, .frames = frames}};
    for (std::size_t i = part.first; i < part.first + part.count; ++i) {
      const ParamSet& params = values_.contenders[i];
      drawn.push_back({.params = &params, .frames = frames + again + warmup_of(options_, params)});
    }
    // References and pictures.
    const double kept = facts.lights * (5.0 * frames + 12.0 * static_cast<double>(part.count));
    return plan::estimate_of(facts, options_.size, drawn, session::all_techniques(), kept);
  }

  void warn() const override { warn_of_settings(options_, values_); }

  plan::Result work(std::size_t item) const override {
    const Part part = part_of(item);
    Drawing drawing(options_, values_, part.scene);
    ComparedScene drawn = drawing.draw(part, [] {});
    if (part.first > 0) drawn.reference = {};
    return result_of(drawn, drawing.drawn_by());
  }

  std::vector<std::filesystem::path> outputs(const std::filesystem::path& folder) const override {
    CompareOptions options = options_;
    options.output = folder.string();
    return {options.page(), options.csv(), options.json()};
  }

  std::vector<std::filesystem::path> merge(const Read& read, const std::filesystem::path& folder) const override {
    CompareOptions options = options_;
    options.output = folder.string();
    Comparison comparison{.reference_params = values_.reference,
                          .names = scene_names(options.scenes, &std::filesystem::path::stem)};
    plan::DeviceCheck devices;
    for (std::size_t scene = 0; scene < options.scenes.size(); ++scene) {
      ComparedScene whole;
      for (std::size_t i = 0; i < parts_; ++i) {
        const std::size_t item = i * options.scenes.size() + scene;
        KeptPart kept = kept_part(read(item), options, values_, part_of(item));
        devices.add(kept.by.device.at("renderer").get<std::string>());
        if (item == 0) comparison.drawn_by = kept.by;
        bench::check_same_machine(comparison.drawn_by.timed_on, kept.by.timed_on, item);
        if (i == 0) {
          whole = std::move(kept.scene);
          continue;
        }
        for (ComparedTechnique& technique : kept.scene.techniques) whole.techniques.push_back(std::move(technique));
      }
      add_scene(comparison, options, std::move(whole));
    }
    devices.warn();
    cli::Arguments arguments = arguments_;
    arguments[output_] = options.output;
    write_reports(comparison, options, arguments);
    return outputs(folder);
  }

 private:
  // First the first technique on every scene, then the second: so that workers which begin together trace the truths of
  // different scenes, and find them in the cache later.
  Part part_of(std::size_t item) const {
    const std::size_t scenes = options_.scenes.size();
    if (!options_.no_cost) return {.scene = item, .first = 0, .count = values_.contenders.size()};
    return {.scene = item % scenes, .first = item / scenes, .count = 1};
  }

  cli::Arguments arguments_;
  std::size_t output_;
  CompareOptions options_;
  ComparedValues values_;
  std::vector<std::string> names_;  // of the scenes, for messages
  std::size_t parts_;               // of a scene
};

}  // namespace

std::unique_ptr<plan::Job> make_job(const cli::Arguments& arguments, std::size_t output) {
  CompareOptions options;
  if (!parse_compare(arguments, options, {.name = "penumbra plan compare", .output = "Plan to write, .json"}))
    return nullptr;
  return std::make_unique<CompareJob>(arguments, output, std::move(options));
}

}  // namespace penumbra::compare
