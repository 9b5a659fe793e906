#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/given.h"
#include "cli/options.h"
#include "session/cache_options.h"

namespace penumbra::compare {

// One of the things compared: a technique or a preset, with parameter values that only it uses.
struct Contender {
  std::string label;  // as the user wrote it: "pcss:pcss.filter_taps=64"
  std::string name;
  std::vector<std::string> assignments;  // "pcss.filter_taps=64"
};

// What `penumbra compare` was asked for; every value is parsed and in range.
struct CompareOptions : cli::SceneOptions, cli::ShadowOptions, cli::DeviceOptions, session::CacheOptions {
  std::vector<std::string> scenes;
  std::vector<Contender> contenders;
  std::string reference = "truth";
  std::optional<int> samples;  // rays a pixel of the truth

  std::optional<double> orbit;     // degrees a frame
  std::optional<int> cut_at;       // frame at which the orbit jumps
  std::optional<int> warmup;       // frames of a picture before the one that counts, for techniques with a history
  std::optional<int> cost_frames;  // of a single picture
  bool no_cost = false;            // the report then depends on the command alone

  std::string output;  // a folder
  std::vector<cli::GivenOption> given;
  std::filesystem::path page() const { return std::filesystem::path(output) / "index.html"; }
  std::filesystem::path csv() const { return std::filesystem::path(output) / "results.csv"; }
  std::filesystem::path json() const { return std::filesystem::path(output) / "results.json"; }
  bool quiet = false;
};

// What the help of the command says: its name, and what -o is.
struct CommandHelp {
  const char* name = "penumbra compare";
  const char* output = "Folder for index.html, results.csv and results.json";
};

// Parses the command line; returns false if --help was asked for. Throws UsageError for every fault that does not
// depend on the contents of preset files and scenes, before any of them is read.
bool parse_compare(const cli::Arguments& arguments, CompareOptions& options, const CommandHelp& help = {});

// Throws UsageError if an output would overwrite one of a scene's files, or another file that the command reads.
void check_inputs(const CompareOptions& options, std::span<const std::filesystem::path> scene_files);

// Throws Error if the reference pictures of that many lights would take too much memory. parse_compare() checks those
// of one light.
void check_memory(const CompareOptions& options, std::size_t lights);

// "a,b:p=1,q=2,c" means a, then b with two parameter values that only it uses, then c. Throws UsageError for an empty
// name.
std::vector<Contender> parse_contenders(const std::string& text);

// The values that the reference and the contenders are drawn with. A sampled reference gets another seed than the
// contenders, so that their errors are independent. Throws UsageError if the command line is wrong, and Error if a
// preset is.
struct ComparedValues {
  ParamSet reference;
  std::vector<ParamSet> contenders;
};
ComparedValues values_of(const CompareOptions& options, const shadow::Registry& registry);

}  // namespace penumbra::compare
