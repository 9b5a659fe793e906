#pragma once

#include <string>
#include <vector>

namespace penumbra::manual {

// What --set can be given: a parameter's name, and its words, or its default where its values are numbers.
struct Setting {
  std::string name;
  std::string help;
  std::vector<std::string> values;
};
std::vector<Setting> settings();

}  // namespace penumbra::manual
