#pragma once

#include <optional>
#include <string>

#include "cli/cli_fwd.h"
#include "cli/output_names.h"
#include "cli/usage.h"

namespace penumbra::app {

// The options that only the plan of a sequence has.
struct SequenceOptions {
  std::string file;  // the name of the pictures
  std::optional<int> frames_per_item;
  std::optional<int> lead_in;
};
// `file`: the usual name.
void add_sequence_options(CLI::App& app, SequenceOptions& options, const char* file);

// A sequence in items of several frames each.
class SequenceItems {
 public:
  // `depends`: what makes each frame depend on those before it; empty: nothing does. Throws UsageError if the options
  // can't be combined.
  SequenceItems(const SequenceOptions& options, const std::optional<cli::FrameRange>& frames,
                const std::string& depends);

  // Warns where frames depend on those before them: of a sequence that is not divided, or of what differs from the
  // pictures of one process.
  void warn() const;

  std::size_t count() const;
  cli::FrameRange frames(std::size_t item) const;
  // The item's frames, and those before them that are drawn, but not written: none for the first item.
  cli::FrameRange drawn(std::size_t item) const;
  // Whether these begin where the sequence does.
  bool from_start(std::size_t item) const { return drawn(item).first == range_.first; }

 private:
  cli::FrameRange range_;
  int per_item_ = 1, lead_in_ = 0;
  std::string depends_;
};

// The name of the pictures: a name without a folder, which `merge` puts into one. Throws UsageError for others.
std::string picture_name(const SequenceOptions& options);

}  // namespace penumbra::app
