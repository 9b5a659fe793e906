#include "app/truth/job.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <utility>

#include "app/metadata.h"
#include "app/plan/sequence.h"
#include "app/truth/options.h"
#include "app/truth/picture.h"
#include "cli/no_effect.h"
#include "image/probe.h"
#include "image/read.h"
#include "session/render_session.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

using io::Json;

class TruthJob : public plan::Job {
 public:
  TruthJob(TruthOptions options, const SequenceOptions& sequence, std::vector<cli::GivenOption> given)
      : options_(std::move(options)),
        params_(params_of(options_, session::all_techniques())),
        names_(options_.output, options_.frames.has_value()),
        items_(sequence, options_.frames, {}),
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
    return {{"options", plan::json_of(given_, {"--frames", "--preset", "--set", "--sun-angle", "--exposure", "--spp",
                                               "--error", "--seed", "--frames-per-item"})},
            {"name", options_.output},
            {"params", io::to_json(params_)},
            {"sequence", options_.frames.has_value()},
            {"frames", {frames.first, frames.last}}};
  }

  Json what(std::size_t item) const override {
    const cli::FrameRange frames = items_.frames(item);
    return {{"frames", {frames.first, frames.last}},
            {"techniques", {{{"name", "truth"}, {"params", io::changed_params(params_)}}}}};
  }

  plan::SceneFacts facts(std::size_t /*scene*/) const override {
    plan::ImageSizes images([](const scene::ReadAt& file) { return image::probe(file); });
    session::PreparedScene prepared = session::load_scene(options_, images.decoder());
    render::keep_first_light(prepared.setup);
    return plan::facts_of(prepared, options_, images);
  }

  plan::Estimate estimate(std::size_t item, const plan::SceneFacts& facts) const override {
    const int frames = items_.frames(item).count();
    const plan::Drawn drawn{.params = &params_, .frames = frames};
    constexpr double values = 16;  // bytes of a pixel of a frame's file
    return plan::estimate_of(facts, options_.size, {&drawn, 1}, session::all_techniques(), values * frames);
  }

  void warn() const override { cli::warn_without_effect(options_, {&params_, 1}, session::all_techniques()); }

  plan::Result work(std::size_t item) const override {
    session::PreparedScene prepared =
        session::load_scene(options_, image::image_decoder(cli::limits_of(options_.reading)));
    render::keep_first_light(prepared.setup);
    truth::TechniqueOptions how = session::truth_options(options_, options_);
    const truth::TruthTechnique truth(std::move(how));
    session::RenderSession session(options_, options_, session::open_context(options_, options_), prepared,
                                   truth.registry(), /* timed= */ false);
    std::vector<cli::EncodedFile> files;
    const cli::FrameRange frames = items_.frames(item);
    for (int frame = frames.first; frame <= frames.last; ++frame) {
      session.draw(frame, params_);
      files.push_back(encoded_picture(names_, frame, options_.size, truth.last(),
                                      metadata_of(options_, session.setup(), params_, frame)));
    }
    return result_of(std::move(files), session.device_info().renderer);
  }

  std::vector<std::filesystem::path> outputs(const std::filesystem::path& folder) const override {
    std::vector<std::filesystem::path> files;
    for (std::size_t item = 0; item < count(); ++item) {
      const cli::FrameRange frames = items_.frames(item);
      for (int frame = frames.first; frame <= frames.last; ++frame) files.push_back(folder / names_.picture(frame));
    }
    return files;
  }

  void merge(const Read& read, const std::filesystem::path& folder) const override {
    write_pictures(*this, read, folder);
  }

 private:
  TruthOptions options_;
  ParamSet params_;
  cli::OutputNames names_;
  SequenceItems items_;
  std::vector<cli::GivenOption> given_;
};

}  // namespace

std::unique_ptr<plan::Job> make_truth_job(const cli::Arguments& arguments) {
  CLI::App app("Ray trace the shadows of a scene, in items", "penumbra plan truth");
  TruthOptions options;
  SequenceOptions sequence;
  add_truth_options(app, options);
  add_sequence_options(app, sequence, "truth.exr");
  if (!cli::parse(app, arguments)) return nullptr;
  check_together(options);
  options.output = picture_name(sequence);
  return std::make_unique<TruthJob>(std::move(options), sequence, cli::given_options(app));
}

}  // namespace penumbra::app
