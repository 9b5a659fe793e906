#include "scene/one_line.h"

namespace penumbra::scene {

std::string one_line(std::string_view text) {
  constexpr std::size_t longest = 400;
  std::string line(text.substr(0, longest));
  while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.pop_back();
  for (char& c : line)
    if (c < ' ' || c > '~') c = c == '\n' ? ' ' : '?';
  return line;
}

}  // namespace penumbra::scene
