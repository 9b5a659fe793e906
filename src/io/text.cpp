#include "io/text.h"

#include <algorithm>

#include "core/utf8.h"

namespace penumbra::io {

std::string csv_field(std::string_view text) {
  const bool quoted = text.find_first_of(",\"\r\n") != std::string_view::npos;
  std::string field;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (text[0] == '"') field += '"';
    field += length == 0 ? "\xef\xbf\xbd" : text.substr(0, length);
    text.remove_prefix(std::max(length, std::size_t{1}));
  }
  return quoted ? '"' + field + '"' : field;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace penumbra::io
