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

// A preset with the values that it sets.
struct PresetValues {
  std::string name;
  std::vector<std::pair<std::string, ParamValue>> values;
};

std::vector<PresetValues> presets_with_values() {
  const shadow::Registry& registry = all_techniques();
  std::vector<PresetValues> presets;
  for (const shadow::Preset& preset : registry.presets()) {
    ParamSet params(render::Renderer::params(registry));
    registry.select(params, preset.name);
    PresetValues& added = presets.emplace_back(PresetValues{.name = preset.name, .values = {}});
    added.values.emplace_back("technique", params.value("technique"));
    for (const std::string& assignment : preset.assignments) {
      const std::string name = assignment.substr(0, assignment.find('='));
      added.values.emplace_back(name, params.value(name));
    }
  }
  return presets;
}

}  // namespace

std::string technique_label(const ParamSet& params) {
  static const std::vector<PresetValues> presets = presets_with_values();
  const PresetValues* best = nullptr;
  for (const PresetValues& preset : presets) {
    const bool fits = std::ranges::all_of(preset.values,
                                          [&](const auto& value) { return params.value(value.first) == value.second; });
    if (fits && (best == nullptr || preset.values.size() > best->values.size())) best = &preset;
  }
  return best != nullptr ? best->name : params.get_word("technique");
}

void choose_technique(ParamSet& params, const shadow::Registry& registry, const std::string& name) {
  const std::string last = technique_label(params);
  const auto preset = std::ranges::find(registry.presets(), last, &shadow::Preset::name);
  if (preset != registry.presets().end()) {
    for (const std::string& assignment : preset->assignments) params.reset(assignment.substr(0, assignment.find('=')));
  }
  registry.select(params, name);
}

truth::TechniqueOptions truth_options(const CacheOptions& cache, const cli::DeviceOptions& device,
                                      truth::TechniqueOptions more) {
  more.cache = cache.folder();
  more.threads = device.threads.value_or(0);
  return more;
}

}  // namespace penumbra::session
