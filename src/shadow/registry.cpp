#include "registry.h"

#include <algorithm>

#include "../core/error.h"
#include "../core/names.h"
#include "check_registry.h"
#include "library_params.h"

namespace penumbra::shadow {

// One line for each technique; each is defined in techniques/<name>.cpp.
#define PENUMBRA_TECHNIQUES(X) \
  X(none)                      \
  X(hard)                      \
  X(shadow_volume)             \
  X(pcf)                       \
  X(pcf_hardware)              \
  X(pcf_tent)                  \
  X(pcf_poisson)               \
  X(vsm)                       \
  X(evsm)                      \
  X(msm)                       \
  X(esm)                       \
  X(csm_fourier)               \
  X(cssm)                      \
  X(pcss)                      \
  X(slices)                    \
  X(backprojection)            \
  X(ssss)                      \
  X(vssm)                      \
  X(brute_force)

// One line for each filter; each is defined in filters/<name>.cpp.
#define PENUMBRA_FILTERS(X) \
  X(median)                 \
  X(median_visibility)      \
  X(box)                    \
  X(gaussian)               \
  X(bilateral)              \
  X(bilateral_separable)    \
  X(isophote)

// One line for each denoiser; each is defined in denoisers/<name>.cpp.
#define PENUMBRA_DENOISERS(X) X(history_and_filters)

// One line for each product; each is defined in products/<name>.cpp. A product comes after those that it is made from.
#define PENUMBRA_PRODUCTS(X) \
  X(compared_depth)          \
  X(least_depth_pyramid)     \
  X(vsm_moments)             \
  X(evsm_moments)            \
  X(msm_moments)             \
  X(esm_depths)              \
  X(fourier_terms)           \
  X(cssm_terms)              \
  X(greatest_depth_pyramid)  \
  X(depth_sums)              \
  X(second_layer)            \
  X(second_layer_edges)

using MakeTechnique = Technique();
using MakeFilter = Filter();
using MakeDenoiser = Denoiser();
using MakeRecipe = Recipe();

#define X(name) MakeTechnique name;
PENUMBRA_TECHNIQUES(X)
#undef X
#define X(name) MakeFilter name;
PENUMBRA_FILTERS(X)
#undef X
#define X(name) MakeDenoiser name;
PENUMBRA_DENOISERS(X)
#undef X
#define X(name) MakeRecipe name;
PENUMBRA_PRODUCTS(X)
#undef X

#define X(name) name(),
std::vector<Technique> built_in_techniques() { return {PENUMBRA_TECHNIQUES(X)}; }
std::vector<Filter> built_in_filters() { return {PENUMBRA_FILTERS(X)}; }
std::vector<Denoiser> built_in_denoisers() { return {PENUMBRA_DENOISERS(X)}; }
std::vector<Recipe> built_in_recipes() { return {PENUMBRA_PRODUCTS(X)}; }
#undef X

namespace {

// What is set, and the same in compute shaders.
std::vector<Preset> presets() {
  const std::vector<std::string> thesis{"pcss.blocker_taps=16",
                                        "pcss.filter_taps=16",
                                        "pcss.disocclusion_taps=64",
                                        "sampling.blocker_pattern=poisson_hierarchical",
                                        "sampling.filter_pattern=poisson_hierarchical",
                                        "sampling.scramble=shift",
                                        "sampling.noise=blue",
                                        "sampling.filter_sequence=set",
                                        "history.reuse=true",
                                        "movement.map=average",
                                        "filter.penumbra=median",
                                        "filter.visibility=bilateral_separable"};
  const std::vector<std::string> thesis_8x8{"pcss.blocker_taps=8",
                                            "pcss.filter_taps=8",
                                            "sampling.blocker_pattern=hammersley",
                                            "sampling.filter_pattern=hammersley",
                                            "sampling.scramble=shift",
                                            "sampling.noise=blue",
                                            "history.reuse=false",
                                            "filter.penumbra=median",
                                            "filter.visibility=bilateral_separable"};
  std::vector<Preset> all{
      {"thesis", "pcss",
       "The method of Deligiannis 2019: pcss with few taps, a history with a movement map, and filters.", thesis},
      {"thesis_8x8", "pcss",
       "The fast method of Deligiannis 2019 (figure 4.12): pcss with 8/8 taps and filters, without a history.",
       thesis_8x8}};
  for (Preset& preset : all) preset.assignments.emplace_back("driver=fragment");
  const Preset denoised{
      "slices_denoised",
      "slices",
      "The technique slices with few samples a pixel, and a filter that removes their noise.",
      {"slices.azimuths=6", "slices.samples=9", "slices.narrow=8", "sampling.noise=interleaved_gradient",
       "denoiser=history_and_filters", "filter.penumbra=none", "filter.visibility=isophote", "filter.taps=4"}};
  Preset sparse = denoised;
  sparse.name = "slices_sparse";
  sparse.summary =
      "slices_denoised for a quarter of the pixels, and for the others where shadows are narrow or surfaces end.";
  // The noise of a pixel is also that of those it stands for. Narrow penumbrae get about as many slices as without
  // scale.
  std::ranges::replace(sparse.assignments, "slices.azimuths=6", "slices.azimuths=12");
  std::ranges::replace(sparse.assignments, "slices.narrow=8", "slices.narrow=4");
  sparse.assignments.emplace_back("mask.scale=2");
  Preset history = denoised;
  history.name = "slices_history";
  history.summary =
      "slices_denoised for sequences: other samples and moved maps each frame, which add up, and a narrowing filter.";
  history.assignments.insert(history.assignments.end(),
                             {"sampling.blocker_sequence=shift", "sampling.filter_sequence=shift", "history.reuse=true",
                              "history.mean=true", "history.alpha=0.03", "maps.jitter=true"});
  for (const Preset& preset :
       std::vector{Preset{"pcss", "pcss", "", {}}, Preset{"brute_force", "brute_force", "", {}}, all[0], all[1]}) {
    all.push_back({preset.name + "_compute", preset.technique,
                   preset.name + " in compute shaders instead of fragment shaders.", preset.assignments});
    all.back().assignments.emplace_back("driver=compute");
  }
  all.insert(all.begin(), {denoised, sparse, history});
  return all;
}

template <class T>
std::vector<std::string> names_of(std::span<const T> pieces) {
  std::vector<std::string> names;
  for (const T& piece : pieces) names.push_back(piece.name);
  return names;
}

template <class T>
const T& named(std::string_view kind, std::span<const T> pieces, std::string_view name) {
  for (const T& piece : pieces) {
    if (piece.name == name) return piece;
  }
  fail_unknown(kind, name, names_of(pieces));
}

std::vector<Param> rows_of(const Registry::Contents& contents) {
  std::vector<Param> rows{{.name = "technique",
                           .default_value = contents.default_technique,
                           .help = "How shadows are computed.",
                           .binding = ParamBinding::host,
                           .choices = names_of<Technique>(contents.techniques)}};
  const auto append = [&rows](const std::vector<Param>& more) { rows.insert(rows.end(), more.begin(), more.end()); };
  append(library_params());
  append({denoiser_param(contents.denoisers)});
  for (const Denoiser& denoiser : contents.denoisers) append(denoiser.params);
  append(movement_params());
  append(filter_params(contents.filters));
  for (const Recipe& recipe : contents.recipes) append(recipe.params);
  for (const Technique& technique : contents.techniques) append(technique.params);
  return rows;
}

}  // namespace

bool is_base_map(std::string_view name) { return name == "shadow_map" || name == "movement_map"; }

const Registry& built_in_registry() {
  static const Registry registry(
      {.techniques = built_in_techniques(), .presets = presets(), .default_technique = "pcss"});
  return registry;
}

Registry::Registry(Contents contents) : contents_(std::move(contents)) {
  if (contents_.techniques.empty()) fail("a registry needs a technique");
  if (contents_.default_technique.empty()) contents_.default_technique = contents_.techniques.front().name;
  check_contents(*this);
}

std::vector<std::string> Registry::names() const {
  std::vector<std::string> names = names_of(techniques());
  for (const Preset& preset : presets()) names.push_back(preset.name);
  return names;
}

const Technique& Registry::find(std::string_view name) const {
  for (const Technique& technique : techniques()) {
    if (technique.name == name) return technique;
  }
  fail_unknown("technique", name, names());
}

const Filter& Registry::find_filter(std::string_view name) const { return named("filter", filters(), name); }

const Recipe& Registry::find_recipe(std::string_view name) const { return named("product", recipes(), name); }

const Denoiser* Registry::find_denoiser(std::string_view name) const {
  return name == no_denoiser().name ? nullptr : &named("denoiser", denoisers(), name);
}

bool Registry::concerns(std::string_view param, const ParamSet& chosen) const {
  const auto lists = [param](const auto& piece) {
    return std::ranges::find(piece.params, param, &Param::name) != piece.params.end();
  };
  const std::string& technique = chosen.get_word("technique");
  const std::vector<SampleSet>& samples = find(technique).samples;
  if (std::ranges::find(samples, param, &SampleSet::count_parameter) != samples.end()) return true;
  const auto of_other = [&](const auto& pieces, const std::string& name) {
    return std::ranges::any_of(pieces, [&](const auto& piece) { return piece.name != name && lists(piece); });
  };
  return !of_other(techniques(), technique) && !of_other(denoisers(), chosen.get_word("denoiser"));
}

void Registry::select(ParamSet& params, std::string_view name) const {
  for (const Preset& preset : presets()) {
    if (preset.name != name) continue;
    params.set("technique", preset.technique);
    for (const std::string& assignment : preset.assignments) params.assign(assignment);
    return;
  }
  params.set("technique", find(name).name);
}

std::vector<Param> Registry::params() const { return rows_of(contents_); }

}  // namespace penumbra::shadow
