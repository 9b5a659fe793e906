#include "cli/text.h"

#include <cctype>

#include <algorithm>

#include <fmt/format.h>

#include <array>

namespace penumbra::cli {

std::string printable(std::string text) {
  bool after_c2 = false;  // the first byte of U+0080 to U+00BF in UTF-8
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_c1 = after_c2 && byte >= 0x80 && byte < 0xa0;
    if (is_c1) *(&c - 1) = ' ';
    if (is_c1 || byte < 0x20 || byte == 0x7f) c = ' ';
    after_c2 = byte == 0xc2;
  }
  return text;
}

std::string bytes_text(double bytes) {
  static constexpr std::array units{"B", "KiB", "MiB", "GiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024.0 && unit + 1 < units.size(); ++unit) bytes /= 1024.0;
  return fmt::format("{:.{}f} {}", bytes, unit == 0 ? 0 : 1, units[unit]);
}

namespace {

// Of UTF-8.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

// Where the last column of a line begins: behind the last two spaces in succession, or else behind its indentation.
std::size_t indent_of(std::string_view line) {
  const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.rfind("  ");
  return gap == std::string_view::npos || gap < first ? first : width_of(line.substr(0, gap + 2));
}

void add_wrapped(std::string& text, std::string_view line, std::size_t columns) {
  const std::string indent(std::min(indent_of(line), columns / 2), ' ');
  bool broken = false;
  while (width_of(line) > columns - (broken ? indent.size() : 0)) {
    const std::size_t room = columns - (broken ? indent.size() : 0);
    std::size_t space = std::string_view::npos;
    // The last space within the room, or else the first one after it; not among the line's own indentation.
    for (std::size_t at = line.find(' ', broken ? 0 : indent.size() + 1); at != std::string_view::npos;
         at = line.find(' ', at + 1)) {
      if (space != std::string_view::npos && width_of(line.substr(0, at)) > room) break;
      space = at;
    }
    if (space == std::string_view::npos) break;
    text.append(broken ? indent : "").append(line.substr(0, space)).append("\n");
    line.remove_prefix(std::min(line.find_first_not_of(' ', space), line.size()));
    broken = true;
  }
  text.append(broken ? indent : "").append(line);
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    add_wrapped(result, text.substr(begin, end - begin), columns);
    if (end < text.size()) result += '\n';
    begin = end + 1;
  }
  return result;
}

namespace {

std::string shell_quoted(const std::string& text) {
  const bool plain = !text.empty() && std::ranges::all_of(text, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:=,+@%").find(c) != std::string_view::npos;
  });
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string command_text(std::string_view program, const std::vector<std::string>& arguments) {
  std::string text(program);
  for (const std::string& argument : arguments) text += fmt::format(" {}", shell_quoted(argument));
  return text;
}

}  // namespace penumbra::cli
