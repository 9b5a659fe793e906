#pragma once

#include <string>
#include <vector>

namespace penumbra::manual {

// What may follow an option, or stand in its place if it is positional.
enum class Values {
  none,      // nothing: a flag
  free,      // any text
  words,     // one of Option::words
  lists,     // some of Option::words, with commas between them
  settings,  // NAME=VALUE of a parameter
  presets,   // one of Option::words or a file
  scenes,    // a glTF file
  files,
  folders,
};

struct Option {
  std::vector<std::string> names;  // "-o", "--output"; of a positional one its name alone: "SCENE"
  std::string type;                // what the help calls its value: "FILE"
  std::string help;
  Values values = Values::none;
  std::vector<std::string> words;
  bool positional = false, required = false, repeatable = false;

  bool operator==(const Option&) const = default;
};

// The command line of a command, such as "render", or of a part of one, such as "bake noise".
struct CommandLine {
  std::string name;
  std::string summary;  // of the command, as in `penumbra --help`; empty for a part of one
  std::string help;     // what `penumbra NAME --help` says before the options
  std::vector<Option> options;
};

// All commands in the order of `penumbra --help`; the parts of a command follow after it.
std::vector<CommandLine> command_lines();

}  // namespace penumbra::manual
