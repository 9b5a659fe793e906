#include "app/plan/sequence.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/options.h"
#include "core/log.h"

namespace penumbra::app {

void add_sequence_options(CLI::App& app, SequenceOptions& o, const char* file) {
  o.file = file;
  cli::add_value(app, "--file", "NAME", fmt::format("Name of the pictures that merge writes ({})", file).c_str(),
                 [&o](const auto& text) { o.file = text; });
  cli::add_value(app, "--frames-per-item", "N", "Frames of a sequence that are one item (8)", [&o](const auto& text) {
    o.frames_per_item = cli::parse_count("--frames-per-item", text, 1, 1000000);
  });
  cli::add_value(app, "--lead-in", "N",
                 "Where each frame depends on those before it: frames drawn, but not written, before each item",
                 [&o](const auto& text) { o.lead_in = cli::parse_count("--lead-in", text, 1, 10000); });
  app.get_option("--output")->description("Plan to write, .json");
}

SequenceItems::SequenceItems(const SequenceOptions& options, const std::optional<cli::FrameRange>& frames,
                             const std::string& depends)
    : range_(frames.value_or(cli::FrameRange{})), depends_(depends) {
  constexpr int usual_frames = 8;
  if (!frames && (options.frames_per_item || options.lead_in))
    cli::fail_usage("--frames-per-item and --lead-in divide a sequence: they need --frames");
  if (options.lead_in && depends.empty())
    cli::fail_usage("--lead-in is of no use: no frame depends on those before it");
  per_item_ = options.frames_per_item.value_or(usual_frames);
  lead_in_ = options.lead_in.value_or(0);
  if (depends.empty() || range_.count() == 1) return;
  if (!options.lead_in && options.frames_per_item)
    cli::fail_usage(
        "each frame depends on those before it ({}): leave out --frames-per-item, for one item, or give "
        "--lead-in, with which the pictures are not exactly those of one process",
        depends);
  if (!options.lead_in) per_item_ = range_.count();
}

void SequenceItems::warn() const {
  if (depends_.empty() || range_.count() == 1) return;
  if (lead_in_ == 0) {
    penumbra::warn("each frame depends on those before it ({}), so the sequence is one item; --lead-in N divides it",
                   depends_);
    return;
  }
  for (std::size_t item = 0; item < count(); ++item) {
    if (drawn(item).first == range_.first) continue;  // it draws all frames that its own depend on
    penumbra::warn(
        "each frame depends on those before it ({}): from frame {} on, pictures differ from those of one "
        "process, and change with --lead-in and --frames-per-item",
        depends_, frames(item).first);
    return;
  }
}

std::size_t SequenceItems::count() const {
  return static_cast<std::size_t>((range_.count() + per_item_ - 1) / per_item_);
}

cli::FrameRange SequenceItems::frames(std::size_t item) const {
  const int first = range_.first + static_cast<int>(item) * per_item_;
  return {first, std::min(first + per_item_ - 1, range_.last)};
}

cli::FrameRange SequenceItems::drawn(std::size_t item) const {
  const cli::FrameRange written = frames(item);
  return {std::max(written.first - lead_in_, range_.first), written.last};
}

std::string picture_name(const SequenceOptions& options) {
  const std::filesystem::path path = options.file;
  if (path.has_parent_path() || !path.has_filename() || options.file == "." || options.file == "..")
    cli::fail_usage("--file '{}' is not a name without a folder: merge -o names the folder", options.file);
  return options.file;
}

}  // namespace penumbra::app
