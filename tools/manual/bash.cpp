#include <fmt/format.h>

#include <string_view>

#include "manual/completion.h"
#include "manual/settings.h"

namespace penumbra::manual {

namespace {

// What completes without tables. Words are what is typed between spaces: bash also splits at '=' and ':', and puts what
// the function returns behind the last of these.
constexpr std::string_view functions = R"(
# Offers those of the words $2... that begin with what is typed, $1.
_penumbra_offer() {
  local typed=$1 word shown=
  shift
  [[ $typed == *[=:]* ]] && shown=${typed%"${typed##*[=:]}"}
  for word in "$@"; do
    [[ $word == "$typed"* ]] && COMPREPLY+=("${word#"$shown"}")
  done
  return 0
}

# Offers words of a list with commas: what is typed, $1, then the words.
_penumbra_offer_list() {
  local typed=$1 before=
  shift
  [[ $typed == *,* ]] && before=${typed%,*},
  _penumbra_offer "$typed" "${@/#/$before}"
}

_penumbra_files() {
  compopt -o bashdefault -o default
}

_penumbra_folders() {
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen -d -- "$1")
}

# glTF files and folders; all files where what is typed is quoted.
_penumbra_scenes() {
  [[ $1 == *[\\\'\"\$~]* ]] && { _penumbra_files; return; }
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen -f -X '!*.glb' -- "$1"; compgen -f -X '!*.gltf' -- "$1"; compgen -d -- "$1")
}

_penumbra_settings() {
  if [[ $1 == *=* ]]; then
    _penumbra_offer "$1" $(_penumbra_values_of "${1%%=*}")
  else
    compopt -o nospace
    _penumbra_offer "$1" $(_penumbra_parameters)
  fi
}

_penumbra() {
  local line=${COMP_LINE:0:COMP_POINT} typed last command option i
  local -a words
  COMPREPLY=()
  read -ra words <<<"$line"
  [[ $line == *[[:space:]] ]] && words+=("")
  last=$((${#words[@]} - 1))
  typed=${words[last]}
  if ((last == 1)); then
    _penumbra_offer "$typed" $(_penumbra_commands) --help --version
    return
  fi
  command=${words[1]}
  option=${words[last - 1]}
  if [[ -n $(_penumbra_parts_of "$command") ]]; then
    if ((last == 2)); then
      _penumbra_offer "$typed" $(_penumbra_parts_of "$command") --help
      return
    fi
    command+=" ${words[2]}"
  fi
  if [[ $typed == --*=* ]]; then
    option=${typed%%=*}
    _penumbra_value "$command" "$option" "${typed#*=}" && return
  fi
  _penumbra_value "$command" "$option" "$typed" && return
  if [[ $typed == -* ]]; then
    _penumbra_offer "$typed" $(_penumbra_options_of "$command")
  else
    _penumbra_positional "$command" "$typed"
  fi
}

complete -F _penumbra penumbra
)";

// A pattern of `case` for an option of a command: "render --aov".
std::string pattern_of(const CommandLine& line, const Option& option) {
  std::string pattern;
  for (const std::string& name : option.names)
    pattern += fmt::format("{}\"{} {}\"", pattern.empty() ? "" : " | ", line.name, name);
  return pattern;
}

std::string action_of(const Option& option, std::string_view typed) {
  const std::string words = fmt::format("{}", fmt::join(option.words, " "));
  switch (option.values) {
    case Values::none:
    case Values::free:
      return ":";
    case Values::words:
      return fmt::format("_penumbra_offer {} {}", typed, words);
    case Values::lists:
      return fmt::format("_penumbra_offer_list {} {}", typed, words);
    case Values::settings:
      return fmt::format("_penumbra_settings {}", typed);
    case Values::presets:
      return fmt::format("_penumbra_offer {} {}; _penumbra_files", typed, words);
    case Values::scenes:
      return fmt::format("_penumbra_scenes {}", typed);
    case Values::files:
      return "_penumbra_files";
    case Values::folders:
      return fmt::format("_penumbra_folders {}", typed);
  }
  return ":";
}

// A function that prints words, by one `case` of its argument.
class WordTable {
 public:
  explicit WordTable(std::string_view name) : text_(fmt::format("{}() {{\n  case $1 in\n", name)) {}
  void add(std::string_view key, const std::vector<std::string>& words) {
    text_ += fmt::format("    \"{}\") echo {} ;;\n", key, fmt::join(words, " "));
  }
  std::string take() { return text_ + "  esac\n}\n"; }

 private:
  std::string text_;
};

std::string commands_and_parts(std::span<const CommandLine> commands) {
  std::vector<std::string> names;
  WordTable table("_penumbra_parts_of");
  for (const CommandLine& line : commands) {
    if (line.name.find(' ') != std::string::npos) continue;
    names.push_back(line.name);
    std::vector<std::string> parts;
    for (const CommandLine& other : commands)
      if (other.name.starts_with(line.name + " ")) parts.push_back(other.name.substr(line.name.size() + 1));
    if (!parts.empty()) table.add(line.name, parts);
  }
  return fmt::format("_penumbra_commands() {{\n  echo {}\n}}\n\n{}", fmt::join(names, " "), table.take());
}

std::string options_of(std::span<const CommandLine> commands) {
  WordTable table("_penumbra_options_of");
  for (const CommandLine& line : commands) {
    std::vector<std::string> names;
    for (const Option& option : line.options)
      if (!option.positional) names.push_back(option.names.back());
    if (!names.empty()) table.add(line.name, names);
  }
  return table.take();
}

// Completes an option's value, and fails where the option takes none.
std::string values(std::span<const CommandLine> commands) {
  std::string text = "_penumbra_value() {\n  case \"$1 $2\" in\n";
  for (const CommandLine& line : commands)
    for (const Option& option : line.options)
      if (!option.positional && option.values != Values::none)
        text += fmt::format("    {}) {} ;;\n", pattern_of(line, option), action_of(option, "\"$3\""));
  return text + "    *) return 1 ;;\n  esac\n  return 0\n}\n";
}

std::string positional(std::span<const CommandLine> commands) {
  std::string text = "_penumbra_positional() {\n  case $1 in\n";
  for (const CommandLine& line : commands) {
    for (const Option& option : line.options) {
      if (!option.positional) continue;
      text += fmt::format("    \"{}\") {} ;;\n", line.name, action_of(option, "\"$2\""));
      break;  // the others are of the same kind
    }
  }
  return text + "  esac\n}\n";
}

std::string parameters() {
  std::vector<std::string> names;
  WordTable table("_penumbra_values_of");
  for (const Setting& setting : settings()) {
    names.push_back(setting.name + "=");
    std::vector<std::string> words;
    for (const std::string& value : setting.values) words.push_back(fmt::format("{}={}", setting.name, value));
    table.add(setting.name, words);
  }
  return fmt::format("_penumbra_parameters() {{\n  echo {}\n}}\n\n{}", fmt::join(names, " "), table.take());
}

}  // namespace

std::string bash_completion(std::span<const CommandLine> commands) {
  return fmt::format(
      "# Completes command lines of penumbra in bash. It is made from the program's own "
      "options.\n\n{}\n{}\n{}\n{}\n{}{}",
      commands_and_parts(commands), options_of(commands), values(commands), positional(commands), parameters(),
      functions);
}

}  // namespace penumbra::manual
