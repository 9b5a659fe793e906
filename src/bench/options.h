#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/contender.h"
#include "cli/given.h"
#include "cli/input_files.h"
#include "cli/options.h"

namespace penumbra::bench {

// What the command was asked for; every value is parsed and in range.
struct Options : cli::SceneOptions, cli::ShadowOptions, cli::DeviceOptions {
  std::vector<std::string> techniques;  // names, or presets (.toml)
  std::optional<int> frame_count, warmup;
  bool play = false;
  bool floor = false;
  bool whole_frames = false;         // no pass is timed by itself
  std::string sweep;                 // empty: none
  std::vector<std::string> outputs;  // .json, .csv, .html
  bool quiet = false;
  std::string command;  // for reports
  std::vector<cli::GivenOption> given;
};

void add_options(CLI::App& app, Options& options);

// Throws UsageError for options that can't be combined.
void check_together(const Options& options);

// What is measured: one entry for each requested technique, in that order. Throws as cli::resolve_params() does.
std::vector<Entry> entries_of(const Options& options, const shadow::Registry& registry);

// The files that the command reads.
cli::InputFiles inputs_of(const Options& options, std::span<const std::filesystem::path> scene_files);

// How many frames of a point are measured, and how many are drawn before them. Both are fewer on a software rasteriser.
struct FrameCounts {
  int measured = 0, warmup = 0;
};
FrameCounts frame_counts(const Options& options, bool software);

}  // namespace penumbra::bench
