#include "cli/help_groups.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::cli {

namespace {

constexpr std::size_t least_options = 20;  // of a command with headings

struct Heading {
  const char* text;
  std::vector<std::string_view> options;  // long names, in whichever command
};

const std::vector<Heading>& headings() {
  static const std::vector<Heading> all{
      {"Output", {"output", "aov", "aov-samples", "stats", "stats-frames", "save-preset", "layout", "quiet"}},
      {"Picture", {"size", "supersample", "samples", "sample-shadows", "quick", "defaults"}},
      {"Camera", {"camera", "eye", "target", "fov", "orbit", "cut-at"}},
      {"Light", {"sun", "no-sun", "lights", "lamp-radius", "lamp", "sun-angle", "exposure"}},
      {"Scene", {"ground", "casters", "limit", "follow-links"}},
      {"Time", {"time", "frames", "frame", "fps", "play", "warmup", "warmup-still"}},
      {"Parameters", {"technique", "set", "preset"}},
      {"Measurement",
       {"reference", "spp", "error", "seed", "cost-frames", "no-cost", "floor", "whole-frames", "sweep"}},
      {"Plan", {"file", "frames-per-item", "lead-in"}},
      {"Cache of ray-traced shadows", {"cache", "cache-size", "no-cache"}},
      {"Context", {"backend", "egl-device", "threads", "glsl", "debug"}},
      {"General", {"help", "log-level"}}};
  return all;
}

const Heading* heading_of(const CLI::Option& option) {
  if (option.get_lnames().empty()) return nullptr;
  const auto has_it = [&](const Heading& heading) {
    return std::ranges::find(heading.options, option.get_lnames().front()) != heading.options.end();
  };
  const auto found = std::ranges::find_if(headings(), has_it);
  return found == headings().end() ? nullptr : &*found;
}

}  // namespace

void group_options(CLI::App& options) {
  // The headings stand in the order of their first options: the help's own comes last.
  if (const CLI::Option* help = options.get_help_ptr(); help != nullptr) {
    const std::string description = help->get_description();  // a copy: the option is removed
    options.set_help_flag("-h,--help", description);
  }
  const std::vector<CLI::Option*> all = options.get_options(
      [](const CLI::Option* option) { return option->nonpositional() && !option->get_group().empty(); });
  if (all.size() < least_options) return;
  for (CLI::Option* option : all) {
    const Heading* heading = heading_of(*option);
    if (option->get_group() == "Options" && heading != nullptr) option->group(heading->text);
  }
}

}  // namespace penumbra::cli
