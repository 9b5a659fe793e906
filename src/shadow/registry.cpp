#include <algorithm>

#include "../core/error.h"
#include "../core/names.h"
#include "library_params.h"
#include "samples.h"
#include "technique.h"

namespace penumbra::shadow {

namespace {

using MakeTechnique = Technique();

// One line a technique; each is defined in techniques/<name>.cpp.
#define PENUMBRA_TECHNIQUES(X) \
  X(none)                      \
  X(hard)                      \
  X(pcf)                       \
  X(pcss)                      \
  X(brute_force)

void check_word(std::string_view technique, std::string_view kind, const std::string& word,
                const std::vector<std::string>& known) {
  if (!word.empty() && std::ranges::find(known, word) == known.end()) {
    fail_unknown(fmt::format("{} of technique '{}'", kind, technique), word, known);
  }
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

const Registry& built_in_registry() {
  static const Registry registry(
      {
#define X(name) name(),
          PENUMBRA_TECHNIQUES(X)
#undef X
      },
      {
          {"pcss_compute", "pcss", "PCSS in a compute shader.", {"driver=compute"}},
      },
      "pcss");
  return registry;
}

Registry::Registry(std::vector<Technique> techniques, std::vector<Alias> aliases, std::string default_technique)
    : techniques_(std::move(techniques)),
      aliases_(std::move(aliases)),
      default_technique_(std::move(default_technique)) {
  if (techniques_.empty()) fail("a registry needs a technique");
  if (default_technique_.empty()) default_technique_ = techniques_.front().name;
  std::vector<std::string> sorted = names();
  std::ranges::sort(sorted);
  const auto twice = std::ranges::adjacent_find(sorted);
  if (twice != sorted.end()) fail("two techniques have the name '{}'", *twice);
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
  for (Param& row : library_params()) rows.push_back(std::move(row));
  for (const Technique& technique : techniques_)
    rows.insert(rows.end(), technique.params.begin(), technique.params.end());
  return rows;
}

}  // namespace penumbra::shadow
