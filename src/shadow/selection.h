#pragma once

#include <string>
#include <vector>

#include "registry.h"

namespace penumbra::shadow {

// What parameters select.
struct Selection {
  // The preset that they are nearest to, if more than half of the values that it changes are theirs; else the
  // technique.
  std::string name;
  // Of a preset: other parameters of its groups, such as all that begin with "filter.", differ from it.
  bool modified = false;
};

// A registry's presets and their values.
class PresetValues {
 public:
  // `defaults`: a value for each parameter that the presets may set.
  PresetValues(const Registry& registry, const ParamSet& defaults);

  Selection selection_of(const ParamSet& params) const;

 private:
  struct Entry {
    std::string name;
    ParamSet params;                   // with the preset chosen
    std::vector<std::string> changed;  // the parameters that it sets to other values than their defaults
    std::vector<std::string> groups;   // of all that it sets but for maps and cascades, and of its technique
  };
  const Entry* nearest(const ParamSet& params) const;

  std::vector<Entry> entries_;
};

// Gives what a preset sets its defaults, but for values that were changed since. Nothing for a technique.
void take_back(ParamSet& params, const Registry& registry, const std::string& preset);

// The part of a parameter's name before the dot, or "".
std::string group_of(const std::string& param);

}  // namespace penumbra::shadow
