#include "preset.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "error.h"
#include "names.h"

namespace penumbra {

namespace {

constexpr std::string_view technique_key = "technique";

// A value of the file: a parameter's name and the TOML node.
struct Entry {
  std::string name;
  const toml::node* node;
};

void collect(const toml::table& table, const std::string& prefix, std::vector<Entry>& entries) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      collect(*inner, name + ".", entries);
    } else {
      entries.push_back({name, &node});
    }
  }
}

// Refuses lines that are longer than any preset needs. A key of thousands of parts would nest as many tables, and the
// stack might not suffice for them.
void check_lines(std::string_view text, const std::string& file) {
  constexpr std::size_t longest = 1024;  // bytes
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > longest) fail("{}:{}: the line is longer than {} bytes", file, number, longest);
    begin = end + 1;
  }
}

// The TOML library orders tables alphabetically; sorted by position, messages are about the first fault in the file.
void sort_as_written(std::vector<Entry>& entries) {
  const auto position = [](const Entry& entry) {
    const toml::source_position at = entry.node->source().begin;
    return std::pair(at.line, at.column);
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const Entry& a, const Entry& b) { return position(a) < position(b); });
}

// A TOML value as a parameter value; `kind` is set to the name of its type, for messages.
std::optional<ParamValue> scalar(const toml::node& node, std::string_view& kind) {
  if (const auto flag = node.value_exact<bool>()) return kind = "a bool", ParamValue(*flag);
  if (const auto word = node.value_exact<std::string>()) return kind = "a string", ParamValue(*word);
  if (const auto quantity = node.value_exact<double>()) {
    kind = "a number with a point";
    constexpr double largest = std::numeric_limits<float>::max();
    const float infinity = std::numeric_limits<float>::infinity();
    if (std::abs(*quantity) > largest) return ParamValue(*quantity > 0 ? infinity : -infinity);
    return ParamValue(static_cast<float>(*quantity));
  }
  const auto whole = node.value_exact<std::int64_t>();
  if (!whole) return kind = "a list or a date", std::nullopt;
  kind = "a whole number";
  return ParamValue(static_cast<int>(*whole));
}

// Only the type is checked here; ParamSet::set() checks the range.
ParamValue value_of(const Param& param, const toml::node& node) {
  std::string_view kind;
  const std::optional<ParamValue> value = scalar(node, kind);
  const bool widens =
      std::holds_alternative<float>(param.default_value) && value && std::holds_alternative<int>(*value);
  if (value && (widens || value->index() == param.default_value.index())) return *value;
  fail("parameter '{}' takes {}, not {}", param.name, type_name(param), kind);
}

void apply(const Entry& entry, ParamSet& params, const SelectTechnique& select) {
  if (entry.name != technique_key) {
    // A list of all names would make the line too long.
    const bool known = params.contains(entry.name) || params.renamed_from(entry.name) != nullptr;
    if (!known && near_names(entry.name, params.names()).empty())
      fail("unknown parameter '{}'; see penumbra list params", entry.name);
    const auto whole = entry.node->value_exact<std::int64_t>();
    if (whole && !std::in_range<int>(*whole)) {
      params.set_text(entry.name, std::to_string(*whole));
    } else {
      params.set(entry.name, value_of(params.row(entry.name), *entry.node));
    }
    return;
  }
  const auto name = entry.node->value_exact<std::string>();
  if (!name) fail("'technique' takes a name in quotes");
  select(params, *name);
}

// The value as TOML; a float gets a decimal point, so that it is read as a float again.
std::string toml_value(const ParamValue& value) {
  std::string text = to_text(value);
  if (std::holds_alternative<std::string>(value)) return "\"" + text + "\"";
  const bool whole = text.find_first_of(".e") == std::string::npos;
  return std::holds_alternative<float>(value) && whole ? text + ".0" : text;
}

}  // namespace

void apply_preset(std::string_view text, const std::string& file, ParamSet& params, const SelectTechnique& select,
                  const IsLeftOut& left_out) {
  const auto fail_at = [&file](const toml::source_region& at, std::string_view fault) {
    fail("{}:{}: {}", file, at.begin.line, fault);
  };
  check_lines(text, file);
  ParamSet changed = params;
  try {
    const toml::table table = toml::parse(text, file);
    std::vector<Entry> entries;
    collect(table, "", entries);
    if (left_out) std::erase_if(entries, [&](const Entry& entry) { return left_out(entry.name); });
    sort_as_written(entries);
    std::stable_partition(entries.begin(), entries.end(), [](const Entry& e) { return e.name == technique_key; });
    for (const Entry& entry : entries) {
      try {
        apply(entry, changed, select);
      } catch (const Error& error) {
        fail_at(entry.node->source(), error.what());
      }
    }
  } catch (const toml::parse_error& error) {
    fail_at(error.source(), error.description());
  }
  params = std::move(changed);
}

std::string preset_text(const ParamSet& params) {
  std::string top;
  std::map<std::string, std::string> tables;
  for (const Param& param : params.rows()) {
    if (params.is_default(param.name) && param.name != technique_key) continue;
    const size_t dot = param.name.find('.');
    const std::string value = toml_value(params.value(param.name));
    if (dot == std::string::npos) {
      top += fmt::format("{} = {}\n", param.name, value);
    } else {
      tables[param.name.substr(0, dot)] += fmt::format("{} = {}\n", param.name.substr(dot + 1), value);
    }
  }
  std::string text =
      "# Penumbra preset: what differs from the defaults. `penumbra help NAME` explains a parameter.\n" + top;
  for (const auto& [name, rows] : tables) text += fmt::format("\n[{}]\n{}", name, rows);
  return text;
}

}  // namespace penumbra
