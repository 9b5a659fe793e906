#include "app/truth/job.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <utility>

#include "app/metadata.h"
#include "app/plan/sequence_job.h"
#include "app/truth/options.h"
#include "app/truth/picture.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

class TruthJob : public SequenceJob {
 public:
  TruthJob(TruthOptions options, const SequenceOptions& sequence, std::vector<cli::GivenOption> given)
      : SequenceJob(params_of(options, session::all_techniques()), {options.output, options.frames.has_value()},
                    {sequence, options.frames, {}}, std::move(given)),
        options_(std::move(options)) {
    options_.reading.skies_chosen = cli::is_chosen(options_, params(), "casters.skies");
    session::limit_threads(options_);
  }

 protected:
  const FrameOptions& options() const override { return options_; }

  std::vector<std::filesystem::path> files_of(int frame, std::size_t lights) const override {
    return picture_files(names(), frame, lights);
  }

  double file_bytes(double lights) const override { return 16 * lights; }

  std::vector<cli::EncodedFile> draw(session::RenderSession& session, const truth::TruthTechnique& truth,
                                     std::size_t item) const override {
    std::vector<cli::EncodedFile> files;
    const cli::FrameRange frames = items().frames(item);
    for (int frame = frames.first; frame <= frames.last; ++frame) {
      session.draw(frame, params());
      for (cli::EncodedFile& file :
           encoded_pictures(names(), frame, options_.size, truth, render::shadowed_lights(session.setup()).size(),
                            metadata_of(options_, session.setup(), params(), frame)))
        files.push_back(std::move(file));
    }
    return files;
  }

 private:
  TruthOptions options_;
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
