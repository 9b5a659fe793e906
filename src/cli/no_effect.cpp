#include "cli/no_effect.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "core/log.h"

namespace penumbra::cli {

namespace {

using shadow::Registry;
using shadow::SampleSet;
using shadow::Technique;

// While `other` has this value, nothing reads the parameter.
struct Rule {
  const char* param;
  const char* other;
  const char* value;
};

constexpr std::array rules{
    Rule{"history.alpha", "history.reuse", "false"},
    Rule{"history.mean", "history.reuse", "false"},
    Rule{"history.distance", "history.reuse", "false"},
    Rule{"history.turn", "history.reuse", "false"},
    Rule{"movement.map", "history.reuse", "false"},
    Rule{"movement.present", "history.reuse", "false"},
    Rule{"pcss.disocclusion_taps", "history.reuse", "false"},
    Rule{"filter.width", "filter.visibility", "none"},
    Rule{"filter.max_sigma", "filter.visibility", "none"},
    Rule{"filter.taps", "filter.visibility", "none"},
    Rule{"filter.width", "filter.visibility", "median_visibility"},
    Rule{"filter.max_sigma", "filter.visibility", "median_visibility"},
    Rule{"filter.taps", "filter.visibility", "median_visibility"},
    Rule{"filter.edge", "filter.visibility", "none"},
    Rule{"filter.edge", "filter.visibility", "box"},
    Rule{"filter.edge", "filter.visibility", "gaussian"},
    Rule{"maps.gap", "maps.layers", "1"},
    Rule{"maps.overlap", "maps.layers", "1"},
    Rule{"mask.tiles", "mask.scale", "2"},
    Rule{"mask.tiles", "mask.scale", "3"},
    Rule{"mask.tiles", "mask.scale", "4"},
    Rule{"cascades.split", "cascades.fit", "visible"},
    Rule{"cascades.split", "cascades.fit", "penumbrae"},
    Rule{"cascades.split", "cascades.count", "1"},
    Rule{"cascades.blend", "cascades.seam", "none"},
    Rule{"evsm.negative", "evsm.warps", "1"},
    Rule{"brute_force.blocker_taps", "brute_force.every_texel", "true"},
    Rule{"brute_force.filter_taps", "brute_force.every_texel", "true"},
    Rule{"esm.threshold", "esm.classification", "none"},
    Rule{"esm.fallback_taps", "esm.classification", "none"},
    Rule{"exposure.ev", "exposure.auto", "true"},
    Rule{"exposure.compensation", "exposure.auto", "false"},
};

std::string why_by_rule(const std::string& name, const ParamSet& params) {
  for (const Rule& rule : rules) {
    if (name == rule.param && params.contains(rule.other) && to_text(params.value(rule.other)) == rule.value)
      return fmt::format("{} is {}", rule.other, rule.value);
  }
  return {};
}

// Pixels that mask.scale computes between the others are filtered on the receiver's plane, if the filter's kernel has a
// width.
bool filters_between(const ParamSet& params, const Registry& registry) {
  const std::string& filter = params.get_word("filter.visibility");
  return params.get_int("mask.scale") > 1 && filter != "none" &&
         registry.find_filter(filter).keeps == shadow::Filter::Keeps::narrow;
}

bool lists(const std::vector<Param>& params, const std::string& name) {
  return std::ranges::find(params, name, &Param::name) != params.end();
}

bool counts_samples(const Technique& technique, const std::string& name) {
  return std::ranges::find(technique.samples, name, &SampleSet::count_parameter) != technique.samples.end();
}

// Whether one of these products, or one that they are made from, has the parameter.
bool products_list(const Registry& registry, const std::vector<std::string>& needs, const std::string& name) {
  return std::ranges::any_of(needs, [&](const std::string& need) {
    if (shadow::is_base_map(need)) return false;
    const shadow::Recipe& recipe = registry.find_recipe(need);
    return lists(recipe.params, name) || products_list(registry, recipe.needs, name);
  });
}

bool takes_pattern(const Technique& technique, SampleSet::Step step) {
  return technique.pattern.empty() &&
         std::ranges::find(technique.samples, step, &SampleSet::step) != technique.samples.end();
}

// Whether the shadows of a technique may depend on a parameter of the library, of a product or of a technique.
bool reads(const Technique& technique, const std::string& name, const Registry& registry) {
  if (name == "sun.angle" || name == "sun.shape") return technique.soft;
  if (name == "mask.tiles") return technique.decides_tiles;
  if (name == "mask.scale") return !technique.resolve;
  if (name == "maps.jitter") return !technique.needs.empty();
  if (name == "sampling.blocker_pattern") return takes_pattern(technique, SampleSet::Step::blocker);
  if (name == "sampling.filter_pattern") return takes_pattern(technique, SampleSet::Step::filter);
  if (name == "sampling.scramble") return !technique.samples.empty() && technique.scramble.empty();
  const bool is_of_maps = name.starts_with("cascades.") || name.starts_with("bias.");
  if (is_of_maps && name != "cascades.size" && technique.needs.empty() && !technique.resolve) return false;
  if (name.starts_with("sampling.")) return technique.soft || !technique.samples.empty();
  if (lists(technique.params, name) || counts_samples(technique, name)) return true;
  const auto of_technique = [&](const Technique& other) { return lists(other.params, name); };
  if (std::ranges::any_of(registry.techniques(), of_technique)) return false;
  const auto of_recipe = [&](const shadow::Recipe& recipe) { return lists(recipe.params, name); };
  if (std::ranges::any_of(registry.recipes(), of_recipe)) return products_list(registry, technique.needs, name);
  return true;
}

bool is_of_denoisers(const std::string& name, const Registry& registry) {
  return name.starts_with("filter.") || name.starts_with("movement.") ||
         std::ranges::any_of(registry.denoisers(), [&](const auto& denoiser) { return lists(denoiser.params, name); });
}

}  // namespace

std::string why_without_effect(const std::string& name, const ParamSet& params, const Registry& registry) {
  const Technique& technique = registry.find(params.get_word("technique"));
  if (name == "sampling.seed" && params.get_bool("maps.jitter"))
    return why_without_effect("maps.jitter", params, registry);
  if (is_of_denoisers(name, registry)) {
    if (!technique.denoisable) return fmt::format("what the technique {} draws is not denoised", technique.name);
    if (registry.find_denoiser(params.get_word("denoiser")) == nullptr) return "denoiser is none";
  }
  // A stand-in shadows blended surfaces, which have no mask.
  const bool asks_stand_in = !technique.stand_in.empty() && !name.starts_with("mask.");
  const bool read =
      reads(technique, name, registry) || (asks_stand_in && reads(registry.find(technique.stand_in), name, registry));
  if (!read && name.starts_with("sun."))
    return fmt::format("the shadows of the technique {} do not soften with the sun's size", technique.name);
  if (!read) return fmt::format("the technique {} does not read it", technique.name);
  if (name == "filter.edge" && filters_between(params, registry)) return {};
  return why_by_rule(name, params);
}

void warn_without_effect(std::span<const std::string> assignments, std::span<const ParamSet> drawn,
                         const Registry& registry) {
  std::vector<std::string> warned;
  for (const std::string& assignment : assignments) {
    const std::string name = assignment.substr(0, assignment.find('='));
    if (drawn.empty() || std::ranges::find(warned, name) != warned.end()) continue;
    const std::string why = why_without_effect(name, drawn.front(), registry);
    const auto has_none = [&](const ParamSet& params) { return !why_without_effect(name, params, registry).empty(); };
    if (why.empty() || !std::ranges::all_of(drawn, has_none)) continue;
    warn("{} has no effect here: {}", name, why);
    warned.push_back(name);
  }
}

namespace {

std::vector<std::string> assigned(const ShadowOptions& options) {
  std::vector<std::string> assignments = options.assignments;
  if (!options.sun_angle.empty()) assignments.insert(assignments.begin(), "sun.angle=" + options.sun_angle);
  return assignments;
}

// The sizes of maps are no sign of a mistake: scripts set them once for all their scenes.
bool is_of_lamps(const std::string& name) { return name.starts_with("lamps.") && name != "lamps.size"; }

// Lamps read cascades.seam and cascades.blend where the maps of a cube meet.
bool is_of_suns(const std::string& name) {
  constexpr std::array<std::string_view, 3> exempt{"cascades.size", "cascades.seam", "cascades.blend"};
  if (name == "maps.jitter") return true;
  return name.starts_with("sun.") || (name.starts_with("cascades.") && std::ranges::find(exempt, name) == exempt.end());
}

}  // namespace

void warn_of_rate(const SceneOptions& options) {
  if (options.names_fps && !options.frames) warn("--fps has no effect here: a single picture is drawn");
}

void warn_without_lights(const SceneOptions& scene, const ShadowOptions& shadows, const LightKinds& shining) {
  constexpr std::string_view no_sun = "no sun shines", no_lamp = "no spot or point light shines";
  std::vector<std::string> warned;
  for (const std::string& assignment : assigned(shadows)) {
    const std::string name = assignment.substr(0, assignment.find('='));
    const bool without_sun = is_of_suns(name) && !shining.sun;
    if (!without_sun && !(is_of_lamps(name) && !shining.lamps)) continue;
    if (std::ranges::find(warned, name) != warned.end()) continue;
    warn("{} has no effect here: {}", name, without_sun ? no_sun : no_lamp);
    warned.push_back(name);
  }
  if (scene.lamp_radius && !shining.lamps) warn("--lamp-radius has no effect here: {}", no_lamp);
}

void warn_without_effect(const ShadowOptions& options, std::span<const ParamSet> drawn, const Registry& registry) {
  warn_without_effect(assigned(options), drawn, registry);
}

}  // namespace penumbra::cli
