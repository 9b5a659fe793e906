#include "session/techniques.h"

#include "render/renderer.h"

namespace penumbra::session {

const shadow::Registry& all_techniques() {
  static const shadow::Registry registry = truth::TruthTechnique().registry();
  return registry;
}

shadow::Selection selection_of(const ParamSet& params) {
  static const shadow::PresetValues presets(all_techniques(), ParamSet(render::Renderer::params(all_techniques())));
  return presets.selection_of(params);
}

std::string technique_label(const ParamSet& params) {
  const shadow::Selection selection = selection_of(params);
  return selection.modified ? selection.name + " (modified)" : selection.name;
}

ParamSet unmodified(const ParamSet& params) {
  ParamSet base = params;
  for (const Param& row : params.rows()) base.reset(row.name);
  all_techniques().select(base, selection_of(params).name);
  return base;
}

void choose_technique(ParamSet& params, const shadow::Registry& registry, const std::string& name) {
  shadow::take_back(params, registry, selection_of(params).name);
  registry.select(params, name);
}

bool keeps_history(const ParamSet& params) {
  return params.get_bool("history.reuse") && params.get_word("denoiser") != "none" &&
         all_techniques().find(params.get_word("technique")).denoisable;
}

std::string earlier_frames_matter(const ParamSet& params) {
  if (keeps_history(params)) return "history.reuse";
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
