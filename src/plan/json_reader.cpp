#include "plan/json_reader.h"

#include <cmath>
#include <limits>

#include "core/error.h"

namespace penumbra::plan {

namespace {

using io::Json;

// Far more than plans and results have. nlohmann copies and destroys values with a call for each level.
constexpr int deepest = 64;

// What nlohmann says after its own prefix: "[json.exception.parse_error.101] parse error at line 3, column 7: …".
std::string cause_of(const Json::parse_error& error) {
  const std::string text = error.what();
  const std::size_t at = text.find("] ");
  return at == std::string::npos ? text : text.substr(at + 2);
}

}  // namespace

Json parse_json(std::string_view text, const Json::parser_callback_t& filter) {
  const auto checked = [&filter](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth >= deepest && (event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start))
      fail("it is nested more than {} deep", deepest);
    return !filter || filter(depth, event, parsed);
  };
  try {
    return Json::parse(text, checked);
  } catch (const Json::parse_error& error) {
    fail("it is no JSON: {}", cause_of(error));
  } catch (const Json::out_of_range& error) {  // a number that no double holds
    fail("it has a number out of range");
  }
}

void check_format(const Json& json, std::string_view format) {
  if (!json.is_object() || !json.contains("format")) fail(R"(it has no "format", which would be "{}")", format);
  const std::string found = text_in(json, "format");
  if (found != format) fail("its format is '{}'; this program reads '{}'", found, format);
}

const Json& member_of(const Json& json, const char* name) {
  if (!json.is_object() || !json.contains(name)) fail("\"{}\" is missing", name);
  return json.at(name);
}

const Json& array_in(const Json& json, const char* name) {
  const Json& list = member_of(json, name);
  if (!list.is_array()) fail("\"{}\" is no list", name);
  return list;
}

std::string text_of_value(const Json& value, const char* name) {
  if (!value.is_string()) fail("\"{}\" is no text", name);
  auto text = value.get<std::string>();
  if (text.find('\0') != std::string::npos) fail("\"{}\" has a zero byte", name);
  return text;
}

std::string text_in(const Json& json, const char* name) { return text_of_value(member_of(json, name), name); }

std::size_t whole_in(const Json& json, const char* name, std::size_t largest) {
  const Json& value = member_of(json, name);
  if (!value.is_number_unsigned()) fail("\"{}\" is no whole number from 0", name);
  const auto number = value.get<std::uint64_t>();
  if (number > largest) fail("\"{}\" is {}: over the limit of {}", name, number, largest);
  return number;
}

double number_in(const Json& json, const char* name) {
  const Json& value = member_of(json, name);
  if (!value.is_number()) fail("\"{}\" is no number", name);
  const auto number = value.get<double>();
  if (!std::isfinite(number) || number < 0) fail("\"{}\" is below 0 or not finite", name);
  return number;
}

double any_number_in(const Json& json, const char* name) {
  const Json& value = member_of(json, name);
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (value == "inf" || value == "-inf") return (value == "inf" ? 1 : -1) * std::numeric_limits<double>::infinity();
  if (!value.is_number()) fail("\"{}\" is no number", name);
  return value.get<double>();
}

}  // namespace penumbra::plan
