#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/frame_options.h"
#include "app/plan/sequence.h"
#include "cli/encoded_file.h"
#include "cli/output_names.h"
#include "core/params.h"
#include "plan/job.h"
#include "session/render_session.h"
#include "truth/technique.h"

namespace penumbra::app {

// The frames of one scene in items of several frames each, whose results are picture files. What a frame's files are,
// and how they are drawn, is left to the command.
class SequenceJob : public plan::Job {
 public:
  std::size_t count() const override { return items_.count(); }
  std::vector<std::string> scenes() const override { return {options().scene}; }
  std::size_t scene_of(std::size_t /*item*/) const override { return 0; }
  std::string name(std::size_t item) const override;
  io::Json depends(std::size_t item) const override;
  io::Json what(std::size_t item) const override;
  plan::SceneFacts facts(std::size_t scene) const override;
  plan::Estimate estimate(std::size_t item, const plan::SceneFacts& facts) const override;
  void warn() const override;
  plan::Result work(std::size_t item) const override;
  std::vector<std::filesystem::path> outputs(const std::filesystem::path& folder) const override;
  std::vector<std::filesystem::path> merge(const Read& read, const std::filesystem::path& folder) const override;

 protected:
  SequenceJob(ParamSet params, cli::OutputNames names, SequenceItems items, std::vector<cli::GivenOption> given);

  virtual const FrameOptions& options() const = 0;
  // Drawn, but not written, before the item's first frame.
  virtual int warmup_of(std::size_t /*item*/) const { return 0; }
  // Of each pixel of a frame that is written.
  virtual int samples() const { return 1; }
  // The files of a frame, without a folder. `lights`: how many cast shadows.
  virtual std::vector<std::filesystem::path> files_of(int frame, std::size_t lights) const = 0;
  // Bytes of a pixel of a frame's files, in memory.
  virtual double file_bytes(double lights) const = 0;
  virtual std::vector<cli::EncodedFile> draw(session::RenderSession& session, const truth::TruthTechnique& truth,
                                             std::size_t item) const = 0;

  const ParamSet& params() const { return params_; }
  const cli::OutputNames& names() const { return names_; }
  const SequenceItems& items() const { return items_; }

 private:
  std::vector<std::filesystem::path> files_of_item(std::size_t item, std::size_t lights) const;
  void check_files(std::size_t item, const plan::Result& result) const;  // throws Error

  ParamSet params_;
  cli::OutputNames names_;
  SequenceItems items_;
  std::vector<cli::GivenOption> given_;
};

}  // namespace penumbra::app
