#include "scene/gltf/schema.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.h"
#include "scene/gltf/schema_rules.h"

namespace penumbra::scene::gltf {
namespace {

using Json = nlohmann::json;

std::size_t array_size(const Json& document, const std::string& path) {
  const Json* array = path.empty() ? nullptr : array_at(document, path);
  return array == nullptr ? 0 : array->size();
}

class Walker {
 public:
  Walker(Json& document, const Check& check, LeftOut& left_out)
      : document_(document), check_(check), left_out_(left_out), targets_(array_size(document, check.into)) {}

  void walk(std::string_view path) { member(document_, path); }

 private:
  // Enters the member that `path` begins with.
  void member(Json& value, std::string_view path) {
    if (!value.is_object()) fail("{} must be an object", where_.empty() ? "the document" : where_);
    const auto end = path.find_first_of(".[{");
    const std::string key(path.substr(0, end));
    const std::string_view rest = end == std::string_view::npos ? std::string_view() : path.substr(end);
    const auto found = value.find(key);
    if (found == value.end()) {
      if (rest.empty() && is_required_of(value)) fail("{}{}{} is missing", where_, where_.empty() ? "" : ".", key);
      return;
    }
    const std::size_t length = where_.size();
    if (!where_.empty()) where_ += '.';
    where_ += key;
    below(*found, rest);
    where_.resize(length);
  }

  bool is_required_of(const Json& owner) const {
    return check_.required && (check_.of_type.empty() || owner.value("type", std::string()) == check_.of_type);
  }

  void below(Json& value, std::string_view rest) {
    if (rest.empty()) return leaf(value);
    if (rest[0] == '.') return member(value, rest.substr(1));
    const bool elements = rest[0] == '[';
    if (elements ? !value.is_array() : !value.is_object())
      fail("{} must be an {}", where_, elements ? "array" : "object");
    const std::size_t length = where_.size();
    const auto stand_in = elements ? stand_ins().find(where_) : stand_ins().end();
    std::size_t i = 0;
    for (auto it = value.begin(); it != value.end(); ++it, ++i) {
      where_ += elements ? fmt::format("[{}]", i) : "." + it.key();
      if (stand_in == stand_ins().end())
        below(*it, rest.substr(2));
      else
        element(*it, rest.substr(2), stand_in->first, i);
      where_.resize(length);
    }
  }

  // An element that can be left out.
  void element(Json& value, std::string_view rest, const std::string& array, std::size_t index) {
    if (left_out_.holds(array, index)) return;
    try {
      below(value, rest);
    } catch (const Error& e) {
      left_out_.add(array, index, e.what());
      value = stand_ins().at(array);
    }
  }

  void leaf(Json& value) {
    switch (check_.type) {
      case Type::boolean:
        return expect(value.is_boolean(), "true or false");
      case Type::object:
        return expect(value.is_object(), "an object");
      case Type::array:
        return expect(value.is_array(), "an array");
      case Type::text:
        return check_text(value);
      case Type::number:
        return check_number(value);
      case Type::numbers:
        return check_numbers(value);
      case Type::integer:
        return check_integer(value);
      case Type::index:
        return check_index(value);
    }
  }

  void expect(bool ok, std::string_view what) const {
    if (!ok) fail("{} must be {}", where_, what);
  }

  void check_text(const Json& value) const {
    expect(value.is_string(), "a string");
    if (check_.words.empty()) return;
    const auto& word = value.get_ref<const std::string&>();
    if (std::find(check_.words.begin(), check_.words.end(), word) == check_.words.end())
      fail("{} is '{}', not one of {}", where_, word, fmt::join(check_.words, ", "));
  }

  void check_number(const Json& value) const {
    expect(value.is_number(), "a number");
    if (const double number = value.get<double>(); !(number >= check_.min && number <= check_.max))
      fail("{} is {}, outside {} to {}", where_, number, check_.min, check_.max);
  }

  void check_numbers(const Json& value) const {
    expect(value.is_array(), "an array of numbers");
    if (check_.length != 0 && value.size() != check_.length)
      fail("{} has {} numbers, not {}", where_, value.size(), check_.length);
    for (const Json& element : value) check_number(element);
  }

  void check_integer(Json& value) const {
    if (value.is_number_float()) {
      const double number = value.get<double>();
      if (std::abs(number) < 9e15 && number == std::floor(number)) value = static_cast<int64_t>(number);
    }
    expect(value.is_number_integer(), "an integer");
    if (check_.values.empty()) return check_number(value);
    if (std::find(check_.values.begin(), check_.values.end(), value.get<int64_t>()) == check_.values.end())
      fail("{} is {}, not one of {}", where_, value.get<int64_t>(), fmt::join(check_.values, ", "));
  }

  void check_index(Json& value) const {
    check_integer(value);
    const double number = value.get<double>();
    if (!(number >= 0 && number < static_cast<double>(targets_)))
      fail("{} is {}, but there are {} {}", where_, number, targets_, check_.into);
  }

  Json& document_;
  const Check& check_;
  LeftOut& left_out_;
  std::size_t targets_;
  std::string where_;
};

}  // namespace

void check_schema(Json& document, LeftOut& left_out) {
  for (const Rule& rule : schema()) Walker(document, rule.check, left_out).walk(rule.path);
}

}  // namespace penumbra::scene::gltf
