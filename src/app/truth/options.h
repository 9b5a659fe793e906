#pragma once

#include <optional>
#include <string>

#include "app/frame_options.h"

namespace penumbra::app {

// What `penumbra truth` was asked for.
struct TruthOptions : FrameOptions {
  std::optional<std::string> samples, error, seed;
};

void add_truth_options(CLI::App& app, TruthOptions& options);

// Throws UsageError for options that can't be combined.
void check_together(const TruthOptions& options);

// The values to trace with. The short options are applied before every --set, as --sun-angle is.
ParamSet params_of(const TruthOptions& options, const shadow::Registry& registry);

}  // namespace penumbra::app
