#include "params.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "error.h"
#include "names.h"

namespace penumbra {

namespace {

std::string allowed(const Param& param) {
  if (std::holds_alternative<bool>(param.default_value)) return "true or false";
  if (std::holds_alternative<std::string>(param.default_value))
    return "one of " + fmt::format("{}", fmt::join(param.choices, ", "));
  const std::string unit = param.unit.empty() ? "" : " " + param.unit;
  const char* kind = std::holds_alternative<int>(param.default_value) ? "a whole number" : "a number";
  return fmt::format("{} from {:g} to {:g}{}", kind, param.min, param.max, unit);
}

[[noreturn]] void fail_value(const Param& param, std::string_view text) {
  fail("parameter '{}' can't be '{}': it takes {}", param.name, text, allowed(param));
}

// The whole of `text` as a number, or nothing.
template <class T>
bool parse_number(std::string_view text, T& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

bool in_range(const Param& param, double value) {
  // A float's own rounding must not push a bound outside its range.
  return std::isfinite(value) && value >= static_cast<float>(param.min) && value <= static_cast<float>(param.max);
}

bool is_number(const ParamValue& value) {
  return std::holds_alternative<int>(value) || std::holds_alternative<float>(value);
}

double number(const ParamValue& value) {
  if (const int* whole = std::get_if<int>(&value)) return *whole;
  return std::get<float>(value);
}

int choice_index(const Param& param, const std::string& word) {
  const auto found = std::find(param.choices.begin(), param.choices.end(), word);
  return found == param.choices.end() ? -1 : static_cast<int>(found - param.choices.begin());
}

bool well_formed_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_' || c == '.';
  });
}

template <class T>
const T& value_as(const ParamSet& params, std::string_view name) {
  const T* value = std::get_if<T>(&params.value(name));
  if (value == nullptr) throw std::logic_error("parameter '" + std::string(name) + "' read as another type");
  return *value;
}

}  // namespace

std::string type_name(const Param& param) {
  static constexpr const char* names[] = {"bool", "int", "float"};
  if (param.default_value.index() < 3) return names[param.default_value.index()];
  return fmt::format("{}", fmt::join(param.choices, "|"));
}

std::string to_text(const ParamValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const int* whole = std::get_if<int>(&value)) return std::to_string(*whole);
  if (const float* quantity = std::get_if<float>(&value)) return fmt::format("{}", *quantity);
  return std::get<std::string>(value);
}

ParamValue parse_value(const Param& param, std::string_view text) {
  if (std::holds_alternative<bool>(param.default_value)) {
    if (text == "true" || text == "on" || text == "1") return true;
    if (text == "false" || text == "off" || text == "0") return false;
  } else if (std::holds_alternative<int>(param.default_value)) {
    if (int whole = 0; parse_number(text, whole) && in_range(param, whole)) return whole;
  } else if (std::holds_alternative<float>(param.default_value)) {
    if (float quantity = 0; parse_number(text, quantity) && in_range(param, quantity)) return quantity;
  } else if (choice_index(param, std::string(text)) >= 0) {
    return std::string(text);
  }
  fail_value(param, text);
}

ParamValue checked_value(const Param& param, const ParamValue& value) {
  const ParamValue& like = param.default_value;
  if (std::holds_alternative<float>(like) && is_number(value)) {
    if (in_range(param, number(value))) return static_cast<float>(number(value));
  } else if (like.index() == value.index()) {
    if (const int* whole = std::get_if<int>(&value); whole != nullptr && !in_range(param, *whole))
      fail_value(param, to_text(value));
    const auto* word = std::get_if<std::string>(&value);
    if (word == nullptr || choice_index(param, *word) >= 0) return value;
  }
  fail_value(param, to_text(value));
}

std::vector<ParamValue> representative_values(const Param& param) {
  if (std::holds_alternative<bool>(param.default_value)) return {false, true};
  if (std::holds_alternative<int>(param.default_value) && param.max == param.min + 1)
    return {static_cast<int>(param.min), static_cast<int>(param.max)};
  if (param.choices.empty()) return {param.default_value};
  return {param.choices.begin(), param.choices.end()};
}

ParamSet::ParamSet(std::vector<Param> rows) {
  auto declared = std::make_shared<Declared>();
  declared->rows = std::move(rows);
  for (size_t i = 0; i < declared->rows.size(); ++i) {
    const Param& param = declared->rows[i];
    if (!well_formed_name(param.name)) throw std::logic_error("parameter name '" + param.name + "'");
    if (!declared->index.emplace(param.name, i).second) {
      throw std::logic_error("parameter '" + param.name + "' declared twice");
    }
    values_.push_back(checked_value(param, param.default_value));
  }
  for (const Param& param : declared->rows) {
    for (const std::string& former : param.former_names) {
      if (declared->index.contains(former)) {
        throw std::logic_error("parameter '" + former + "' is also a former name of '" + param.name + "'");
      }
    }
  }
  declared_ = std::move(declared);
}

std::span<const Param> ParamSet::rows() const {
  return declared_ ? std::span<const Param>(declared_->rows) : std::span<const Param>();
}

std::vector<std::string> ParamSet::names() const {
  std::vector<std::string> names;
  for (const Param& param : rows()) names.push_back(param.name);
  return names;
}

bool ParamSet::contains(std::string_view name) const { return declared_ && declared_->index.contains(name); }

const Param* ParamSet::renamed_from(std::string_view former_name) const {
  for (const Param& param : rows()) {
    if (std::ranges::find(param.former_names, former_name) != param.former_names.end()) return &param;
  }
  return nullptr;
}

size_t ParamSet::index_of(std::string_view name) const {
  if (declared_) {
    const auto found = declared_->index.find(name);
    if (found != declared_->index.end()) return found->second;
  }
  if (const Param* present = renamed_from(name)) fail("parameter '{}' is now called '{}'", name, present->name);
  fail_unknown("parameter", name, names());
}

const Param& ParamSet::row(std::string_view name) const { return rows()[index_of(name)]; }
const ParamValue& ParamSet::value(std::string_view name) const { return values_[index_of(name)]; }

bool ParamSet::get_bool(std::string_view name) const { return value_as<bool>(*this, name); }
int ParamSet::get_int(std::string_view name) const { return value_as<int>(*this, name); }
float ParamSet::get_float(std::string_view name) const { return value_as<float>(*this, name); }
const std::string& ParamSet::get_word(std::string_view name) const { return value_as<std::string>(*this, name); }

void ParamSet::set(std::string_view name, const ParamValue& value) {
  const size_t index = index_of(name);
  values_[index] = checked_value(declared_->rows[index], value);
}

void ParamSet::set_text(std::string_view name, std::string_view text) {
  const size_t index = index_of(name);
  values_[index] = parse_value(declared_->rows[index], text);
}

void ParamSet::assign(std::string_view assignment) {
  const size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) fail("'{}' is not of the form name=value", assignment);
  set_text(assignment.substr(0, equals), assignment.substr(equals + 1));
}

void ParamSet::reset(std::string_view name) {
  const size_t index = index_of(name);
  values_[index] = declared_->rows[index].default_value;
}

bool ParamSet::is_default(std::string_view name) const {
  const size_t index = index_of(name);
  return values_[index] == declared_->rows[index].default_value;
}

bool ParamSet::operator==(const ParamSet& other) const {
  if (values_ != other.values_) return false;
  return declared_ == other.declared_ || std::ranges::equal(rows(), other.rows(), {}, &Param::name, &Param::name);
}

std::string glsl_name(const Param& param) {
  std::string name = param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

namespace {

const char* glsl_type(const Param& param) {
  return std::holds_alternative<float>(param.default_value) ? "float" : "int";  // bools are passed as int
}

std::string glsl_literal(const Param& param, const ParamValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "1" : "0";
  if (const auto* word = std::get_if<std::string>(&value)) return std::to_string(choice_index(param, *word));
  if (const int* whole = std::get_if<int>(&value)) return std::to_string(*whole);
  return fmt::format("{:.9e}", std::get<float>(value));
}

}  // namespace

std::string glsl_declarations(const ParamSet& params, int binding_point) {
  std::string constants, members;
  for (const Param& param : params.rows()) {
    if (param.binding == ParamBinding::host) continue;
    const std::string name = glsl_name(param);
    for (size_t i = 0; i < param.choices.size(); ++i) {
      constants += fmt::format("const int {}_{} = {};\n", name, param.choices[i], i);
    }
    if (param.binding == ParamBinding::uniform) members += fmt::format("  {} {};\n", glsl_type(param), name);
  }
  if (members.empty()) return constants;
  return fmt::format("{}layout(std140, binding = {}) uniform Params {{\n{}}};\n", constants, binding_point, members);
}

std::vector<GlslConstant> compiled_constants(const ParamSet& params, std::span<const Param> rows) {
  std::vector<GlslConstant> constants;
  for (const Param& param : rows) {
    if (param.binding != ParamBinding::compiled) continue;
    constants.push_back({glsl_name(param), glsl_literal(param, params.value(param.name))});
  }
  return constants;
}

std::vector<std::byte> uniform_bytes(const ParamSet& params) {
  std::vector<std::byte> bytes;
  for (const Param& param : params.rows()) {
    if (param.binding != ParamBinding::uniform) continue;
    const ParamValue& value = params.value(param.name);
    const auto append = [&bytes](auto scalar) {
      static_assert(sizeof(scalar) == 4);
      const size_t offset = bytes.size();
      bytes.resize(offset + 4);
      std::memcpy(bytes.data() + offset, &scalar, 4);
    };
    if (const float* quantity = std::get_if<float>(&value)) {
      append(*quantity);
    } else if (const int* whole = std::get_if<int>(&value)) {
      append(*whole);
    } else if (const bool* flag = std::get_if<bool>(&value)) {
      append(*flag ? 1 : 0);
    } else {
      append(choice_index(param, std::get<std::string>(value)));
    }
  }
  constexpr std::size_t block_step = 16;  // std140 rounds a block's size up to it
  bytes.resize((bytes.size() + block_step - 1) / block_step * block_step);
  return bytes;
}

}  // namespace penumbra
