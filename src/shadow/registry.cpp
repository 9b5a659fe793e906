#include <algorithm>

#include "../core/error.h"
#include "../core/names.h"
#include "library_params.h"
#include "samples.h"
#include "technique.h"

namespace penumbra::shadow {

namespace {

using MakeTechnique = Technique();
using MakeFilter = Filter();

// One line a technique; each is defined in techniques/<name>.cpp.
#define PENUMBRA_TECHNIQUES(X) \
  X(none)                      \
  X(hard)                      \
  X(pcf)                       \
  X(pcss)                      \
  X(brute_force)

// One line a filter; each is defined in filters/<name>.cpp.
#define PENUMBRA_FILTERS(X) \
  X(median)                 \
  X(box)                    \
  X(gaussian)               \
  X(bilateral)              \
  X(bilateral_separable)

void check_word(std::string_view technique, std::string_view kind, const std::string& word,
                const std::vector<std::string>& known) {
  if (!word.empty() && std::ranges::find(known, word) == known.end()) {
    fail_unknown(fmt::format("{} of technique '{}'", kind, technique), word, known);
  }
}

void check_names(std::string_view kind, std::vector<std::string> names) {
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice != names.end()) fail("two {} have the name '{}'", kind, *twice);
}

void check(const Technique& technique, const Registry& registry) {
  const std::string& name = technique.name;
  if (technique.glsl.empty() && !technique.resolve) fail("technique '{}' has neither glsl nor resolve", name);
  if (technique.glsl.empty() && technique.stand_in.empty())
    fail("technique '{}' has neither glsl nor a stand_in", name);
  if (!technique.stand_in.empty() && registry.find(technique.stand_in).glsl.empty()) {
    fail("technique '{}': its stand_in '{}' has no glsl", name, technique.stand_in);
  }
  check_word(name, "pattern", technique.pattern, pattern_names());
  check_word(name, "scramble", technique.scramble, scramble_names());
}

}  // namespace

#define X(name) MakeTechnique name;
PENUMBRA_TECHNIQUES(X)
#undef X
#define X(name) MakeFilter name;
PENUMBRA_FILTERS(X)
#undef X

std::vector<Filter> built_in_filters() {
  return {
#define X(name) name(),
      PENUMBRA_FILTERS(X)
#undef X
  };
}

namespace {

// What is set, and the same in compute shaders.
std::vector<Alias> presets() {
  const std::vector<std::string> thesis{"pcss.blocker_taps=16",
                                        "pcss.filter_taps=16",
                                        "pcss.renewal_taps=64",
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
  std::vector<Alias> aliases{
      {"thesis", "pcss", "The method of Deligiannis 2019: few taps, a history with a movement map, filters.", thesis},
      {"thesis_8x8", "pcss", "Its fast form, of figure 4.12: 8/8 taps and a filter, no history.", thesis_8x8}};
  for (Alias& alias : aliases) alias.assignments.emplace_back("driver=fragment");
  for (const Alias& alias : std::vector{Alias{"pcss", "pcss", "", {}}, Alias{"brute_force", "brute_force", "", {}},
                                        aliases[0], aliases[1]}) {
    aliases.push_back({alias.name + "_compute", alias.technique, "The same in compute shaders.", alias.assignments});
    aliases.back().assignments.emplace_back("driver=compute");
  }
  return aliases;
}

}  // namespace

const Registry& built_in_registry() {
  static const Registry registry(
      {
#define X(name) name(),
          PENUMBRA_TECHNIQUES(X)
#undef X
      },
      presets(), "pcss");
  return registry;
}

Registry::Registry(std::vector<Technique> techniques, std::vector<Alias> aliases, std::string default_technique,
                   std::vector<Filter> filters)
    : techniques_(std::move(techniques)),
      aliases_(std::move(aliases)),
      default_technique_(std::move(default_technique)),
      filters_(std::move(filters)) {
  if (techniques_.empty()) fail("a registry needs a technique");
  if (default_technique_.empty()) default_technique_ = techniques_.front().name;
  check_names("techniques", names());
  std::vector<std::string> filter_names;
  for (const Filter& filter : filters_) filter_names.push_back(filter.name);
  check_names("filters", std::move(filter_names));
  for (const Technique& technique : techniques_) check(technique, *this);
  for (const Alias& alias : aliases_) find(alias.technique);
  find(default_technique_);
}

std::vector<std::string> Registry::names() const {
  std::vector<std::string> names;
  for (const Technique& technique : techniques_) names.push_back(technique.name);
  for (const Alias& alias : aliases_) names.push_back(alias.name);
  return names;
}

const Technique& Registry::find(std::string_view name) const {
  for (const Technique& technique : techniques_) {
    if (technique.name == name) return technique;
  }
  fail_unknown("technique", name, names());
}

void Registry::select(ParamSet& params, std::string_view name) const {
  for (const Alias& alias : aliases_) {
    if (alias.name != name) continue;
    params.set("technique", alias.technique);
    for (const std::string& assignment : alias.assignments) params.assign(assignment);
    return;
  }
  params.set("technique", find(name).name);
}

std::vector<Param> Registry::params() const {
  std::vector<std::string> choices;
  for (const Technique& technique : techniques_) choices.push_back(technique.name);
  std::vector<Param> rows{
      {"technique", default_technique_, 0, 0, "", "How shadows are computed.", ParamBinding::host, choices}};
  for (Param& row : library_params(filters_)) rows.push_back(std::move(row));
  for (const Technique& technique : techniques_)
    rows.insert(rows.end(), technique.params.begin(), technique.params.end());
  return rows;
}

}  // namespace penumbra::shadow
