#include "check_registry.h"

#include <algorithm>
#include <set>

#include "../core/error.h"
#include "../core/names.h"
#include "light_frame.h"
#include "samples.h"

namespace penumbra::shadow {

namespace {

// OpenGL 4.5 guarantees uniform blocks of at least 16 KiB.
constexpr std::size_t most_table_bytes = 16384;

void check_names(std::string_view kinds, std::vector<std::string> names) {
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice != names.end()) fail("two {} have the name '{}'", kinds, *twice);
}

// Whether a name can be a part of GLSL identifiers, file names and the names of textures.
bool is_identifier(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
  return !name.empty() && letter(name[0]) &&
         std::ranges::all_of(name, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

void check_identifiers(std::string_view kind, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (!is_identifier(name)) fail("'{}' can't be the name of a {}: not lower-case letters, digits and _", name, kind);
  }
}

template <class T>
std::vector<std::string> names_of(std::span<const T> pieces) {
  std::vector<std::string> names;
  for (const T& piece : pieces) names.push_back(piece.name);
  return names;
}

void check_word(std::string_view technique, std::string_view kind, const std::string& word,
                const std::vector<std::string>& known) {
  if (!word.empty() && std::ranges::find(known, word) == known.end()) {
    fail_unknown(fmt::format("{} of technique '{}'", kind, technique), word, known);
  }
}

// `of`: "technique 'pcss'".
void check_sample_set(const std::string& of, const SampleSet& set, const ParamSet& params) {
  if (!is_identifier(set.name)) fail("{}: '{}' can't be the name of a sample set in GLSL", of, set.name);
  if (!params.contains(set.count_parameter)) {
    fail("{}: the sample set '{}' is counted by '{}', which is no parameter", of, set.name, set.count_parameter);
  }
  const Param& count = params.row(set.count_parameter);
  if (!std::holds_alternative<int>(count.default_value) || count.min < 0 || count.max < 1) {
    fail("{}: the sample set '{}' is counted by '{}', which is no number of points", of, set.name, count.name);
  }
  if (count.max > most_points) {
    fail("{}: the sample set '{}' may have {:g} points by '{}'; {} fit", of, set.name, count.max, count.name,
         most_points);
  }
}

void check_samples(const Technique& technique, const ParamSet& params) {
  const std::string of = fmt::format("technique '{}'", technique.name);
  std::size_t bytes = 0;
  for (const SampleSet& set : technique.samples) {
    check_sample_set(of, set, params);
    bytes += sizeof(glm::vec4) * table_size(set, params);
  }
  check_names("sample sets of " + of, names_of<SampleSet>(technique.samples));
  if (bytes > most_table_bytes) {
    fail("{}: its sample sets take {} bytes; a uniform block has {}", of, bytes, most_table_bytes);
  }
}

// `of`: "recipe 'moments'"; `known`: what may be asked for.
void check_needs(const std::string& of, const std::vector<std::string>& needs, const std::vector<std::string>& known) {
  for (const std::string& need : needs) {
    if (std::ranges::find(known, need) == known.end()) fail_unknown("product that " + of + " needs", need, known);
  }
  check_names("needs of " + of, needs);
  const auto products = std::ranges::count_if(needs, [](const std::string& need) { return !is_base_map(need); });
  if (products > static_cast<std::ptrdiff_t>(most_products)) {
    fail("{} needs {} products; there are texture units for {}", of, products, most_products);
  }
}

// Tiles are decided by the shadow map and its pyramid.
void check_tiles(const Technique& technique) {
  if (!technique.decides_tiles) return;
  for (const char* need : {"shadow_map", "least_depth_pyramid"}) {
    if (std::ranges::find(technique.needs, need) == technique.needs.end()) {
      fail("technique '{}' decides tiles, for which it needs '{}'", technique.name, need);
    }
  }
  if (technique.glsl.empty()) fail("technique '{}' decides tiles, for which it needs glsl", technique.name);
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

void check_contents(const Registry& registry) {
  check_names("techniques", registry.names());
  check_names("filters", names_of(registry.filters()));
  check_names("denoisers", names_of(registry.denoisers()));
  check_names("recipes", names_of(registry.recipes()));
  check_identifiers("technique or preset", registry.names());
  check_identifiers("filter", names_of(registry.filters()));
  check_identifiers("denoiser", names_of(registry.denoisers()));
  check_identifiers("recipe", names_of(registry.recipes()));
  for (const Technique& technique : registry.techniques()) check(technique, registry);
  std::vector<std::string> known{"shadow_map"};
  for (const Recipe& recipe : registry.recipes()) {
    if (!recipe.build) fail("recipe '{}' has no build", recipe.name);
    if (is_base_map(recipe.name)) fail("a recipe can't have the name '{}': the library draws that map", recipe.name);
    check_needs(fmt::format("recipe '{}'", recipe.name), recipe.needs, known);
    known.push_back(recipe.name);
  }
  const std::vector<Param> rows = registry.params();
  check_names("parameters", names_of<Param>(rows));
  const ParamSet params(rows);
  for (const Technique& technique : registry.techniques()) {
    check_needs(fmt::format("technique '{}'", technique.name), technique.needs, known);
    check_samples(technique, params);
    check_tiles(technique);
  }
  known.emplace_back("movement_map");
  for (const Denoiser& denoiser : registry.denoisers()) {
    if (!denoiser.denoise) fail("denoiser '{}' has no denoise", denoiser.name);
    if (denoiser.name == no_denoiser().name) fail("a denoiser can't have the name '{}'", denoiser.name);
    check_needs(fmt::format("denoiser '{}'", denoiser.name), denoiser.needs, known);
  }
  for (const Preset& preset : registry.presets()) registry.find(preset.technique);
  registry.find(registry.default_technique());
}

}  // namespace penumbra::shadow
