#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "io/key.h"
#include "io/report.h"

namespace penumbra::plan {

// The most items of a plan, and the most bytes of its file.
constexpr std::size_t most_items = 1'000'000;
constexpr std::size_t largest_plan = std::size_t{1} << 30;

// What an item is expected to take, drawn in software. See docs/clusters.md.
struct Estimate {
  double seconds = 0;  // of one core
  double memory_mib = 0;
};

// A file that the items of a scene read.
struct PlannedFile {
  std::string path;
  std::uintmax_t bytes = 0;
  io::Key hash;        // of its content
  std::string shader;  // of --glsl: its path in that folder, so which built-in shader it replaces; empty: another file
};

struct PlannedScene {
  std::string path;  // as the user gave it; empty: the command generates it
  io::Json view;     // camera and light, for readers of the plan
  std::vector<PlannedFile> files;
};

// A piece of work that depends on no other.
struct PlannedItem {
  io::Key key;  // of all that its result depends on: see key_of()
  std::size_t scene = 0;
  Estimate estimate;
};

// What made a plan or a result. Results of other programs do not go with its own.
struct Program {
  std::string version, commit;
  io::Key build;  // of both; of a program whose sources differed from the commit, also of its file
};

// The work of one command, divided into items.
struct Plan {
  Program program;
  std::string command;       // "compare"
  cli::Arguments arguments;  // of that command; the one at `output` is empty: the value of -o
  std::size_t output = 0;
  std::vector<PlannedScene> scenes;
  std::vector<PlannedItem> items;

  // Those of the whole command that writes to `output`.
  cli::Arguments arguments_with(const std::string& output_value) const;
  // The largest estimates of any item, and the sum of all seconds.
  Estimate largest() const;
  double total_seconds() const;
};

// Reads a plan. Throws Error: one line that names the file and the fault, also for a plan of another program.
Plan read_plan(const std::filesystem::path& path, const Program& program);

// The plan as JSON (docs/schemas/plan.json), an item in each line. `what`: what each item is, for readers.
std::string text_of(const Plan& plan, const std::vector<io::Json>& what);

// The files of the results lie there unless the user says otherwise: "sweep.results" beside "sweep.json".
std::filesystem::path results_folder(const std::filesystem::path& plan);

}  // namespace penumbra::plan
