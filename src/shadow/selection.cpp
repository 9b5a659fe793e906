#include "selection.h"

#include <algorithm>

namespace penumbra::shadow {

namespace {

struct Match {
  std::ptrdiff_t same = 0, other = 0;  // how many of the values that the preset changes

  bool is_better_than(const Match& match) const { return same != match.same ? same > match.same : other < match.other; }
};

std::string param_of(const std::string& assignment) { return assignment.substr(0, assignment.find('=')); }

}  // namespace

PresetValues::PresetValues(const Registry& registry, const ParamSet& defaults) {
  for (const Preset& preset : registry.presets()) {
    Entry& added = entries_.emplace_back(Entry{preset.name, defaults, {}, {}});
    registry.select(added.params, preset.name);
    added.groups.push_back(added.params.get_word("technique"));
    for (const std::string& assignment : preset.assignments) {
      const std::string name = param_of(assignment);
      // The parameters of maps and cascades concern all techniques.
      const std::string group = group_of(name);
      if (!group.empty() && group != "maps" && group != "cascades") added.groups.push_back(group);
      if (added.params.value(name) != defaults.value(name)) added.changed.push_back(name);
    }
  }
}

const PresetValues::Entry* PresetValues::nearest(const ParamSet& params) const {
  const auto match_of = [&](const Entry& entry) -> Match {
    if (entry.params.value("technique") != params.value("technique")) return {};
    const std::ptrdiff_t same = std::ranges::count_if(
        entry.changed, [&](const std::string& name) { return params.value(name) == entry.params.value(name); });
    return {same, std::ssize(entry.changed) - same};
  };
  const Entry* nearest = nullptr;
  Match best;
  for (const Entry& entry : entries_) {
    const Match match = match_of(entry);
    if (match.same <= match.other || !match.is_better_than(best)) continue;
    best = match;
    nearest = &entry;
  }
  return nearest;
}

Selection PresetValues::selection_of(const ParamSet& params) const {
  const Entry* preset = nearest(params);
  if (preset == nullptr) return {.name = params.get_word("technique")};
  const bool modified = std::ranges::any_of(preset->params.rows(), [&](const Param& row) {
    const bool sets_group = std::ranges::find(preset->groups, group_of(row.name)) != preset->groups.end();
    const bool is_set = sets_group || std::ranges::find(preset->changed, row.name) != preset->changed.end();
    return is_set && params.value(row.name) != preset->params.value(row.name);
  });
  return {.name = preset->name, .modified = modified};
}

void take_back(ParamSet& params, const Registry& registry, const std::string& preset) {
  const auto found = std::ranges::find(registry.presets(), preset, &Preset::name);
  if (found == registry.presets().end()) return;
  ParamSet chosen = params;
  registry.select(chosen, preset);
  for (const std::string& assignment : found->assignments) {
    const std::string param = param_of(assignment);
    if (params.value(param) == chosen.value(param)) params.reset(param);
  }
}

std::string group_of(const std::string& param) {
  const std::size_t dot = param.find('.');
  return dot == std::string::npos ? "" : param.substr(0, dot);
}

}  // namespace penumbra::shadow
