#include "session/techniques.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "render/renderer.h"

namespace penumbra::session {

const shadow::Registry& all_techniques() {
  static const shadow::Registry registry = truth::TruthTechnique().registry();
  return registry;
}

namespace {

struct PresetValues {
  std::string name;
  ParamSet params;                   // with the preset chosen
  std::vector<std::string> changed;  // the parameters that it sets to other values than their defaults
  std::vector<std::string> groups;   // of all that it sets but for maps and cascades, and of its technique
};

std::vector<PresetValues> presets_with_values() {
  const shadow::Registry& registry = all_techniques();
  const ParamSet defaults(render::Renderer::params(registry));
  std::vector<PresetValues> presets;
  for (const shadow::Preset& preset : registry.presets()) {
    PresetValues& added = presets.emplace_back(PresetValues{preset.name, defaults, {}, {}});
    registry.select(added.params, preset.name);
    added.groups.push_back(added.params.get_word("technique"));
    for (const std::string& assignment : preset.assignments) {
      const std::string name = assignment.substr(0, assignment.find('='));
      // The parameters of maps and cascades concern all techniques.
      const std::string group = group_of(name);
      if (!group.empty() && group != "maps" && group != "cascades") added.groups.push_back(group);
      if (added.params.value(name) != defaults.value(name)) added.changed.push_back(name);
    }
  }
  return presets;
}

struct Match {
  std::ptrdiff_t same = 0, other = 0;  // how many of the values that the preset changes

  bool is_better_than(const Match& match) const { return same != match.same ? same > match.same : other < match.other; }
};

Match match_of(const PresetValues& preset, const ParamSet& params) {
  if (preset.params.value("technique") != params.value("technique")) return {};
  const std::ptrdiff_t same = std::ranges::count_if(
      preset.changed, [&](const std::string& name) { return params.value(name) == preset.params.value(name); });
  return {same, std::ssize(preset.changed) - same};
}

const PresetValues* nearest_preset(const ParamSet& params) {
  static const std::vector<PresetValues> presets = presets_with_values();
  const PresetValues* nearest = nullptr;
  Match best;
  for (const PresetValues& preset : presets) {
    const Match match = match_of(preset, params);
    if (match.same <= match.other || !match.is_better_than(best)) continue;
    best = match;
    nearest = &preset;
  }
  return nearest;
}

}  // namespace

std::string group_of(const std::string& param) {
  const std::size_t dot = param.find('.');
  return dot == std::string::npos ? "" : param.substr(0, dot);
}

Selection selection_of(const ParamSet& params) {
  const PresetValues* preset = nearest_preset(params);
  if (preset == nullptr) return {.name = params.get_word("technique")};
  const bool modified = std::ranges::any_of(preset->params.rows(), [&](const Param& row) {
    const bool sets_group = std::ranges::find(preset->groups, group_of(row.name)) != preset->groups.end();
    const bool is_set = sets_group || std::ranges::find(preset->changed, row.name) != preset->changed.end();
    return is_set && params.value(row.name) != preset->params.value(row.name);
  });
  return {.name = preset->name, .modified = modified};
}

std::string technique_label(const ParamSet& params) {
  const Selection selection = selection_of(params);
  return selection.modified ? selection.name + " (modified)" : selection.name;
}

ParamSet unmodified(const ParamSet& params) {
  ParamSet base = params;
  for (const Param& row : params.rows()) base.reset(row.name);
  all_techniques().select(base, selection_of(params).name);
  return base;
}

void choose_technique(ParamSet& params, const shadow::Registry& registry, const std::string& name) {
  const std::string last = selection_of(params).name;
  const auto preset = std::ranges::find(registry.presets(), last, &shadow::Preset::name);
  if (preset != registry.presets().end()) {
    ParamSet chosen = params;
    registry.select(chosen, last);
    for (const std::string& assignment : preset->assignments) {
      const std::string param = assignment.substr(0, assignment.find('='));
      if (params.value(param) == chosen.value(param)) params.reset(param);
    }
  }
  registry.select(params, name);
}

std::string earlier_frames_matter(const ParamSet& params) {
  if (params.get_bool("history.reuse") && params.get_word("denoiser") != "none") return "history.reuse";
  // Points follow the number of frames since the first one.
  for (const char* sequence : {"sampling.blocker_sequence", "sampling.filter_sequence"}) {
    if (params.get_word(sequence) != "still") return sequence;
  }
  return {};
}

truth::TechniqueOptions truth_options(const CacheOptions& cache, const cli::DeviceOptions& device,
                                      truth::TechniqueOptions more) {
  more.cache = cache.folder();
  if (cache.cache_bytes) more.cache_bytes = *cache.cache_bytes;
  more.threads = device.threads.value_or(0);
  return more;
}

}  // namespace penumbra::session
