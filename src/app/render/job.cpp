#include "app/render/job.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <utility>

#include "app/plan/sequence_job.h"
#include "app/render/drawing.h"
#include "app/render/frame_files.h"
#include "app/render/options.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

class RenderJob : public SequenceJob {
 public:
  RenderJob(RenderOptions options, const ParamSet& params, const SequenceOptions& sequence,
            std::vector<cli::GivenOption> given)
      : SequenceJob(params, {options.output, options.is_sequence()},
                    {sequence, options.frames, session::earlier_frames_matter(params)}, std::move(given)),
        options_(std::move(options)) {
    options_.reading.skies_chosen = cli::is_chosen(options_, params, "casters.skies");
    session::limit_threads(options_);
  }

 protected:
  const FrameOptions& options() const override { return options_; }

  int warmup_of(std::size_t item) const override { return items().from_start(item) ? options_.warmup : 0; }

  int samples() const override { return options_.samples; }

  std::vector<std::filesystem::path> files_of(int frame, std::size_t lights) const override {
    return frame_files(options_, names(), frame, lights);
  }

  double file_bytes(double lights) const override {
    return 4 + 16.0 * static_cast<double>(options_.aovs.size()) * lights;
  }

  std::vector<cli::EncodedFile> draw(session::RenderSession& session, const truth::TruthTechnique& /*truth*/,
                                     std::size_t item) const override {
    RenderOptions options = options_;
    options.warmup = warmup_of(item);
    options.quiet = true;
    std::vector<cli::EncodedFile> files;
    draw_frames(options, session, params(), items().drawn(item), [&](int frame) {
      if (frame < items().frames(item).first) return;
      for (cli::EncodedFile& file : encoded_frame(session, options, params(), names(), frame))
        files.push_back(std::move(file));
    });
    return files;
  }

 private:
  RenderOptions options_;
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
  const ParamSet params = params_of(options);
  return std::make_unique<RenderJob>(std::move(options), params, sequence, cli::given_options(app));
}

}  // namespace penumbra::app
