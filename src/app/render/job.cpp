#include "app/render/job.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <utility>

#include "app/plan/sequence.h"
#include "app/render/drawing.h"
#include "app/render/frame_files.h"
#include "app/render/options.h"
#include "cli/no_effect.h"
#include "image/probe.h"
#include "image/read.h"
#include "session/render_session.h"
#include "session/techniques.h"
#include "truth/technique.h"

namespace penumbra::app {

namespace {

using io::Json;

class RenderJob : public plan::Job {
 public:
  RenderJob(RenderOptions options, const SequenceOptions& sequence, std::vector<cli::GivenOption> given)
      : options_(std::move(options)),
        params_(params_of(options_)),
        names_(options_.output, options_.is_sequence()),
        items_(sequence, options_.frames, session::earlier_frames_matter(params_)),
        given_(std::move(given)) {
    options_.reading.skies_chosen = cli::is_chosen(options_, params_, "casters.skies");
    session::limit_threads(options_);
  }

  std::size_t count() const override { return items_.count(); }
  std::vector<std::string> scenes() const override { return {options_.scene}; }
  std::size_t scene_of(std::size_t /*item*/) const override { return 0; }

  std::string name(std::size_t item) const override {
    const cli::FrameRange frames = items_.frames(item);
    const std::string scene = std::filesystem::path(options_.scene).filename().string();
    return options_.frames ? fmt::format("{}, frames {} to {}", scene, frames.first, frames.last) : scene;
  }

  // The scene's name is in the metadata of EXR files.
  Json depends(std::size_t item) const override {
    const cli::FrameRange frames = items_.frames(item);
    return {{"options", plan::json_of(given_, {"--frames", "--technique", "--preset", "--set", "--sun-angle",
                                               "--exposure", "--frames-per-item", "--lead-in", "--warmup"})},
            {"name", options_.output},
            {"params", io::to_json(params_)},
            {"sequence", options_.frames.has_value()},
            {"frames", {frames.first, frames.last}},
            {"drawn_from", items_.drawn(item).first},
            {"warmup", warmup_of(item)}};
  }

  Json what(std::size_t item) const override {
    const cli::FrameRange frames = items_.frames(item);
    return {{"frames", {frames.first, frames.last}},
            {"techniques", {{{"name", session::technique_label(params_)}, {"params", io::changed_params(params_)}}}}};
  }

  plan::SceneFacts facts(std::size_t /*scene*/) const override {
    plan::ImageSizes images([](const scene::ReadAt& file) { return image::probe(file); });
    return plan::facts_of(session::load_scene(options_, images.decoder()), options_, images);
  }

  plan::Estimate estimate(std::size_t item, const plan::SceneFacts& facts) const override {
    const cli::Size pixels{options_.size.width * options_.supersample, options_.size.height * options_.supersample};
    const int frames = items_.frames(item).count();
    const plan::Drawn drawn{.params = &params_, .frames = items_.drawn(item).count() + warmup_of(item)};
    const double values = 4 + 16.0 * static_cast<double>(options_.aovs.size());  // bytes of a pixel of a frame's files
    return plan::estimate_of(facts, pixels, {&drawn, 1}, session::all_techniques(), values * frames);
  }

  void warn() const override {
    items_.warn();
    cli::warn_without_effect(options_, {&params_, 1}, session::all_techniques());
  }

  plan::Result work(std::size_t item) const override {
    RenderOptions options = options_;
    options.warmup = warmup_of(item);
    options.quiet = true;
    const session::PreparedScene prepared =
        session::load_scene(options, image::image_decoder(cli::limits_of(options.reading)));
    const truth::TruthTechnique truth(session::truth_options(options, options));
    session::RenderSession session(options, options, session::open_context(options, options), prepared,
                                   truth.registry(), /* timed= */ false);
    std::vector<cli::EncodedFile> files;
    draw_frames(options, session, params_, items_.drawn(item), [&](int frame) {
      if (frame < items_.frames(item).first) return;
      for (cli::EncodedFile& file : encoded_frame(session, options, params_, names_, frame))
        files.push_back(std::move(file));
    });
    return result_of(std::move(files), session.device_info().renderer);
  }

  std::vector<std::filesystem::path> outputs(const std::filesystem::path& folder) const override {
    std::vector<std::filesystem::path> files;
    for (std::size_t item = 0; item < count(); ++item) {
      const cli::FrameRange frames = items_.frames(item);
      for (int frame = frames.first; frame <= frames.last; ++frame) {
        for (const std::filesystem::path& name : frame_files(options_, names_, frame)) files.push_back(folder / name);
      }
    }
    return files;
  }

  void merge(const Read& read, const std::filesystem::path& folder) const override {
    write_pictures(*this, read, folder);
  }

 private:
  int warmup_of(std::size_t item) const { return items_.from_start(item) ? options_.warmup : 0; }

  RenderOptions options_;
  ParamSet params_;
  cli::OutputNames names_;
  SequenceItems items_;
  std::vector<cli::GivenOption> given_;
};

}  // namespace

std::unique_ptr<plan::Job> make_render_job(const cli::Arguments& arguments) {
  CLI::App app("Draw a glTF scene into PNG or EXR files, in items", "penumbra plan render");
  RenderOptions options;
  SequenceOptions sequence;
  add_render_options(app, options);
  add_sequence_options(app, sequence, "frame.png");
  if (!cli::parse(app, arguments)) return nullptr;
  check_together(options);
  if (!options.stats.empty() || !options.save_preset.empty())
    cli::fail_usage("--stats and --save-preset are for penumbra render: a plan's results are pictures");
  options.output = picture_name(sequence);
  return std::make_unique<RenderJob>(std::move(options), sequence, cli::given_options(app));
}

}  // namespace penumbra::app
