#include <fmt/format.h>

#include <string_view>

#include "manual/completion.h"
#include "manual/settings.h"

namespace penumbra::manual {

namespace {

// As a part of a word in single quotes, and of a specification of _arguments or _describe.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'')
      result += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      (result += '\\') += c;
    else if (c == '\n')
      result += ' ';
    else
      result += c;
  }
  return result;
}

std::string action_of(const Option& option) {
  const std::string words = fmt::format("{}", fmt::join(option.words, " "));
  switch (option.values) {
    case Values::none:
    case Values::free:
      return "";
    case Values::words:
      return fmt::format("({})", words);
    case Values::lists:
      return fmt::format("_values -s , name {}", words);
    case Values::settings:
      return "_penumbra_settings";
    case Values::presets:
      return "_penumbra_presets";
    case Values::scenes:
      return "_files -g \"*.(glb|gltf)\"";
    case Values::files:
      return "_files";
    case Values::folders:
      return "_files -/";
  }
  return "";
}

// '*--set=[help]:NAME=VALUE:_penumbra_settings'
std::string specifications_of(const Option& option) {
  if (option.positional) {
    const char* times = option.repeatable ? "*" : "";
    return fmt::format(" '{}:{}:{}'", times, escaped(option.names.front()), action_of(option));
  }
  std::string others, result;
  for (const std::string& name : option.names) others += (others.empty() ? "" : " ") + name;
  const std::string excluded = option.repeatable ? "*" : fmt::format("({})", others);
  for (const std::string& name : option.names) {
    result += fmt::format(" \\\n        '{}{}", excluded, name);
    if (option.values != Values::none && name.starts_with("--")) result += "=";
    result += fmt::format("[{}]", escaped(option.help));
    if (option.values != Values::none) result += fmt::format(":{}:{}", escaped(option.type), action_of(option));
    result += "'";
  }
  return result;
}

std::string cases(std::span<const CommandLine> commands) {
  std::string text;
  for (const CommandLine& line : commands) {
    if (line.options.empty()) continue;
    text += fmt::format("    '{}')\n      _arguments -s", line.name);
    for (const Option& option : line.options) text += specifications_of(option);
    text += "\n      ;;\n";
  }
  return text;
}

std::string parts(std::span<const CommandLine> commands) {
  std::string text;
  for (const CommandLine& line : commands) {
    if (!line.options.empty()) continue;
    std::string names;
    for (const CommandLine& other : commands)
      if (other.name.starts_with(line.name + " ")) names += " " + other.name.substr(line.name.size() + 1);
    text += fmt::format("    {}) parts=({}) ;;\n", line.name, names.substr(1));
  }
  return text;
}

std::string descriptions(std::span<const CommandLine> commands) {
  std::string text;
  for (const CommandLine& line : commands)
    if (!line.summary.empty()) text += fmt::format("    '{}:{}'\n", line.name, escaped(line.summary));
  return text;
}

std::string presets(std::span<const CommandLine> commands) {
  for (const CommandLine& line : commands)
    for (const Option& option : line.options)
      if (option.values == Values::presets) return fmt::format("{}", fmt::join(option.words, " "));
  return "";
}

std::string setting_rows() {
  std::string text;
  for (const Setting& setting : settings()) text += fmt::format("    '{}:{}'\n", setting.name, escaped(setting.help));
  return text;
}

std::string setting_values() {
  std::string text;
  for (const Setting& setting : settings())
    text += fmt::format("    {}) values=({}) ;;\n", setting.name, fmt::join(setting.values, " "));
  return text;
}

}  // namespace

std::string zsh_completion(std::span<const CommandLine> commands) {
  return fmt::format(R"(#compdef penumbra
# Completes command lines of penumbra in zsh. It is made from the program's own options.

_penumbra_presets() {{
  _alternative 'presets:preset:({})' 'files:file:_files'
}}

_penumbra_settings() {{
  local -a names values
  if [[ $PREFIX == *=* ]]; then
    case ${{PREFIX%%=*}} in
{}    esac
    compset -P '*='
    compadd -a values
    return
  fi
  names=(
{}  )
  _describe 'parameter' names -S =
}}

_penumbra() {{
  local command
  local -a commands parts
  commands=(
{}  )
  if ((CURRENT == 2)); then
    _alternative 'commands:command:{{_describe command commands}}' 'options:option:(--help --version)'
    return
  fi
  command=$words[2]
  case $command in
{}  esac
  if ((${{#parts}})); then
    if ((CURRENT == 3)); then
      compadd -a parts
      return
    fi
    command+=" $words[3]"
    shift words
    ((CURRENT--))
  fi
  shift words
  ((CURRENT--))
  case $command in
{}  esac
}}

_penumbra "$@"
)",
                     presets(commands), setting_values(), setting_rows(), descriptions(commands), parts(commands),
                     cases(commands));
}

}  // namespace penumbra::manual
