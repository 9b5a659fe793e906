#include "scene/one_line.h"

#include "core/utf8.h"

namespace penumbra::scene {
namespace {

// C0, DEL and C1.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  return first < 0x20 || first == 0x7f || (first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0);
}

}  // namespace

std::string one_line(std::string_view text) {
  constexpr std::size_t longest = 400;  // bytes
  std::string line;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    text.remove_prefix(character.size());
    if (line.size() + character.size() > longest) break;
    if (character == "\n")
      line += ' ';
    else if (length == 0 || is_control(character))
      line += '?';
    else
      line += character;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace penumbra::scene
