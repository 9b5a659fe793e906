#include "viewer/json_file.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "cli/text.h"
#include "core/error.h"
#include "core/read_file.h"
#include "io/output_file.h"

namespace penumbra::viewer {

namespace {

using io::Json;

constexpr std::size_t largest_file = std::size_t{1} << 20;  // bytes; what is kept takes a few thousand
constexpr std::size_t longest_cause = 200;
constexpr int deepest = 4;       // of what is nested, unknown keys included
constexpr int most_keys = 2000;  // each is compared with all before it

Json parse(const std::vector<std::byte>& bytes) {
  int keys = 0;
  const auto guard = [&keys](int depth, Json::parse_event_t event, Json&) {
    if (depth > deepest) fail("nested deeper than {}", deepest);
    if (event == Json::parse_event_t::key && ++keys > most_keys) fail("more than {} keys", most_keys);
    return true;
  };
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  try {
    return Json::parse(text, text + bytes.size(), guard);
  } catch (const Json::parse_error& error) {
    fail("not JSON at byte {}", error.byte);
  } catch (const Json::exception&) {
    fail("not JSON: a number is out of range");
  }
}

std::string one_line(std::string cause) {
  if (cause.size() > longest_cause) {
    std::size_t end = longest_cause;
    while ((static_cast<unsigned char>(cause[end]) & 0xC0U) == 0x80U) --end;  // within a character of UTF-8
    cause = cause.substr(0, end) + "…";
  }
  return cli::printable(std::move(cause));
}

}  // namespace

Json read_json(const std::filesystem::path& file) { return parse(read_file(file, largest_file)); }

const Json* find(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::string ignored(const char* what, const std::filesystem::path& file, std::string cause) {
  return cli::printable(fmt::format("ignored the {} in {}", what, io::quoted(file))) + ": " +
         one_line(std::move(cause));
}

}  // namespace penumbra::viewer
