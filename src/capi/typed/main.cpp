// Writes penumbra_settings.hpp: a struct with a field for each parameter, from the rows that the C interface lists. Run
// by the build: penumbra_typed_settings FILE.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "capi/penumbra.h"

namespace {

std::string file_head() {
  return R"(/** @file
 * Penumbra's parameters as fields, generated from their rows: a wrong name or word does not compile. Over penumbra.hpp:
 *
 *     penumbra::api::TypedSettings typed;  // the defaults
 *     typed.sun.angle = 1.5f;
 *     typed.technique = penumbra::api::TypedSettings::Technique::pcss;
 *     typed.write(settings);
 */
#ifndef PENUMBRA_SETTINGS_HPP
#define PENUMBRA_SETTINGS_HPP

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

)"
         "#include \"penumbra.hpp\"\n"
         R"(
namespace penumbra::api {

namespace detail {

// The place of a parameter's word among those that it can have.
template <class Word, std::size_t count>
Word word_of(const Settings& settings, const char* name, const std::array<const char*, count>& words) {
  const std::string held = settings.get(name);
  for (std::size_t i = 0; i < count; ++i) {
    if (held == words[i]) return static_cast<Word>(i);
  }
  throw std::out_of_range("the library is newer than penumbra_settings.hpp: " + std::string(name) + "=" + held);
}

}  // namespace detail

)";
}

// "csm_fourier": "CsmFourier".
std::string type_name(std::string_view name) {
  std::string made;
  bool upper = true;
  for (const char c : name) {
    if (c == '_' || c == '.') {
      upper = true;
    } else {
      made += upper && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
      upper = false;
    }
  }
  return made;
}

// A name as an identifier of C++.
std::string identifier(std::string name) {
  static const std::set<std::string_view> keywords{"auto",   "break", "case",   "default", "do",    "double", "float",
                                                   "for",    "if",    "int",    "long",    "new",   "short",  "signed",
                                                   "static", "this",  "switch", "true",    "false", "union",  "using",
                                                   "void",   "while", "or",     "and",     "not",   "xor"};
  for (char& c : name) {
    if (c == '.' || c == '-' || c == ' ') c = '_';
  }
  const bool starts_with_digit = name.front() >= '0' && name.front() <= '9';
  return starts_with_digit || keywords.contains(name) ? "_" + name + "_" : name;
}

// The text of the header, in parts: fields by the group of their parameter ("" is the top), and the bodies of read()
// and write().
struct Parts {
  std::vector<std::string> groups;  // in the order of their first parameter
  std::map<std::string, std::string> fields;
  std::string read, write;
};

void add(Parts& parts, const penumbra_param& param) {
  const std::string name = param.name;
  const std::size_t dot = name.find('.');
  const std::string group = dot == std::string::npos ? "" : name.substr(0, dot);
  const std::string own = name.substr(dot == std::string::npos ? 0 : dot + 1);
  if (!parts.fields.contains(group)) parts.groups.push_back(group);
  std::string& fields = parts.fields[group];
  const std::string indent = group.empty() ? "  " : "    ";
  const std::string field = identifier(own);
  const std::string place = group.empty() ? field : fmt::format("{}.{}", identifier(group), field);
  const std::string scope = group.empty() ? "" : type_name(group) + "::";

  std::string help = fmt::format("{}/// {}", indent, param.help);
  if (*param.unit != '\0') help += fmt::format(" Unit: {}.", param.unit);
  if (param.type == PENUMBRA_TYPE_INTEGER || param.type == PENUMBRA_TYPE_REAL) {
    help += fmt::format(" Range: {} to {}.", param.least, param.greatest);
  }
  help += '\n';
  if (param.type == PENUMBRA_TYPE_WORD) {
    const std::string type = type_name(own);
    std::string values, words;
    for (uint32_t i = 0; i < param.choice_count; ++i) {
      values += fmt::format("{}{}", i == 0 ? "" : ", ", identifier(param.choices[i]));
      words += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", param.choices[i]);
    }
    fields += fmt::format(
        "{0}/// What `{4}` can be.\n{0}enum class {1} {{ {2} }};\n"
        "{0}/// The same as text.\n{0}static constexpr std::array<const char*, {3}> {4}_words{{{5}}};\n",
        indent, type, values, param.choice_count, field, words);
    fields += help;
    fields += fmt::format("{0}{1} {2} = {1}::{3};\n", indent, type, field, identifier(param.default_value));
    parts.write += fmt::format("    settings.set(\"{}\", {}{}_words.at(static_cast<std::size_t>({})));\n", name, scope,
                               field, place);
    parts.read += fmt::format("    typed.{0} = detail::word_of<{1}{2}>(settings, \"{3}\", {1}{4}_words);\n", place,
                              scope, type, name, field);
    return;
  }
  const bool real = param.type == PENUMBRA_TYPE_REAL;
  std::string value = param.default_value;
  if (real && value.find_first_of(".e") == std::string::npos) value += ".0";
  const char* type = real ? "float" : param.type == PENUMBRA_TYPE_INTEGER ? "int" : "bool";
  fields += help;
  fields += fmt::format("{}{} {} = {}{};\n", indent, type, field, value, real ? "f" : "");
  parts.write += fmt::format("    settings.set(\"{}\", {});\n", name, place);
  parts.read += param.type == PENUMBRA_TYPE_SWITCH
                    ? fmt::format("    typed.{} = settings.get_number(\"{}\") != 0;\n", place, name)
                    : fmt::format("    typed.{} = static_cast<{}>(settings.get_number(\"{}\"));\n", place, type, name);
}

std::string header() {
  Parts parts;
  for (std::size_t i = 0; i < penumbra_param_count(); ++i) {
    penumbra_param param{};
    param.struct_size = sizeof param;
    if (penumbra_param_info(i, &param) != PENUMBRA_OK) throw std::runtime_error(penumbra_last_error());
    add(parts, param);
  }
  std::string text = file_head() + "/// All parameters, at their defaults.\nstruct TypedSettings {\n";
  for (const std::string& group : parts.groups) {
    if (group.empty()) {
      text += parts.fields[group];
    } else {
      text += fmt::format(
          "  /// Parameters whose names begin with \"{0}.\".\n  struct {1} {{\n{2}  }} {3};  ///< \"{0}.\"\n", group,
          type_name(group), parts.fields[group], identifier(group));
    }
  }
  text += fmt::format(
      "\n  /// Sets every parameter.\n  void write(Settings& settings) const {{\n{}  }}\n"
      "  /// The values of every parameter, such as those of a preset that was read or a technique that was selected.\n"
      "  static TypedSettings read(const Settings& settings) {{\n    TypedSettings typed;\n{}    return typed;\n  "
      "}}\n}};\n\n"
      "}}  // namespace penumbra::api\n\n#endif\n",
      parts.write, parts.read);
  return text;
}

// Leaves a file as it is that has the text already, so that nothing is compiled again for it.
void write_if_changed(const char* path, const std::string& text) {
  std::ifstream old(path, std::ios::binary);
  if (old && std::string(std::istreambuf_iterator<char>(old), {}) == text) return;
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error(fmt::format("cannot write {}", path));
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count != 2) throw std::runtime_error("usage: penumbra_typed_settings FILE");
    write_if_changed(arguments[1], header());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
