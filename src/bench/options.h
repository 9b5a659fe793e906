#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/contender.h"
#include "cli/options.h"

namespace penumbra::bench {

// What the command was asked for; every value is parsed and in range.
struct Options : cli::SceneOptions, cli::ShadowOptions, cli::DeviceOptions {
  std::vector<std::string> techniques;  // names, or presets (.toml)
  std::optional<int> frame_count, warmup;
  bool play = false;
  bool floor = false;
  std::string sweep;                 // empty: none
  std::vector<std::string> outputs;  // .json, .csv, .html
  bool quiet = false;
  std::string command;  // to show again: files by their names alone
};

void add_options(CLI::App& app, Options& options);

// Throws UsageError where options that are right alone don't go together.
void check_together(const Options& options);

// What takes turns: one entry a technique asked for, in that order. Throws as cli::resolve_params().
std::vector<Entry> entries_of(const Options& options, const shadow::Registry& registry);

// The frames of a point that count, and those before them. A software rasteriser gets fewer.
struct FrameCounts {
  int measured = 0, warmup = 0;
};
FrameCounts frame_counts(const Options& options, bool software);

}  // namespace penumbra::bench
