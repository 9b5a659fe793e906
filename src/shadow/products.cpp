#include "products.h"

#include <algorithm>
#include <ranges>
#include <string_view>

#include "pass_context.h"

namespace penumbra::shadow {

namespace {

bool applies(const Recipe& recipe, const ParamSet& params) { return !recipe.applies || recipe.applies(params); }

}  // namespace

Wanted wanted_of(const LightWork& work) {
  std::vector<std::string_view> names;
  const auto ask = [&names](const std::vector<std::string>& needs) {
    names.insert(names.end(), needs.begin(), needs.end());
  };
  const auto asked = [&names](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
  ask(work.technique.needs);
  if (work.inputs.binds_forward) ask(work.forward.needs);
  if (work.denoiser != nullptr) ask(work.denoiser->needs);
  Wanted wanted;
  // A recipe's needs come before it in the registry, so a backward pass finds all of them.
  for (const Recipe& recipe : work.registry.recipes() | std::views::reverse) {
    if (!asked(recipe.name)) continue;
    wanted.recipes.insert(wanted.recipes.begin(), &recipe);
    if (applies(recipe, work.params())) ask(recipe.needs);
  }
  wanted.shadow_map = asked("shadow_map");
  return wanted;
}

namespace {

std::vector<ParamValue> values_of(const Recipe& recipe, const ParamSet& params) {
  std::vector<ParamValue> values;
  for (const Param& row : recipe.params) values.push_back(params.value(row.name));
  return values;
}

bool same_values(const Recipe& recipe, const ParamSet& params, const std::vector<ParamValue>& values) {
  size_t i = 0;
  return std::ranges::all_of(recipe.params, [&](const Param& row) { return params.value(row.name) == values[i++]; });
}

// Whether the shadow map, or the product of that recipe, is that of the last frame.
bool is_kept(const LightWork& work, std::string_view name) {
  if (name == "shadow_map") {
    return work.frame.kept_layers.count() == static_cast<size_t>(work.frame.projection.layers());
  }
  const auto found = work.state.products.find(name);
  return found != work.state.products.end() && found->second.kept;
}

// The last frame's product, if the recipe makes the same from the same needs; else null.
LightState::KeptProduct* last_product(const LightWork& work, const Recipe& recipe) {
  const auto found = work.state.products.find(recipe.name);
  if (found == work.state.products.end()) return nullptr;
  LightState::KeptProduct& last = found->second;
  const bool same = recipe.depends_only_on_needs && work.params().get_bool("maps.keep") &&
                    last.frame + 1 == work.state.frames && last.shape == work.frame.shape &&
                    last.shader_changes == work.device.shaders.changes() &&
                    same_values(recipe, work.params(), last.values);
  return same ? &last : nullptr;
}

// The last frame's product, if building it would give the same.
const gl::Texture* kept_product(const LightWork& work, const Recipe& recipe) {
  if (const auto found = work.state.products.find(recipe.name); found != work.state.products.end())
    found->second.kept = false;
  LightState::KeptProduct* kept = last_product(work, recipe);
  if (kept == nullptr || !std::ranges::all_of(recipe.needs, [&](const auto& name) { return is_kept(work, name); }))
    return nullptr;
  LightState::KeptProduct& last = *kept;
  last.kept = true;
  last.frame = work.state.frames;
  // Else its textures would be released as those that this frame did not use.
  if (work.state.changed) work.state.used.merge(work.device.names(target_prefix(work, owner_of(recipe))));
  return last.texture;
}

const gl::Texture& build_product(const LightWork& work, const Recipe& recipe) {
  const gl::Texture& texture = recipe.build(PassContext(work, owner_of(recipe)));
  if (recipe.depends_only_on_needs && work.params().get_bool("maps.keep")) {
    work.state.products[recipe.name] = {.texture = &texture,
                                        .values = values_of(recipe, work.params()),
                                        .shape = work.frame.shape,
                                        .shader_changes = work.device.shaders.changes(),
                                        .frame = work.state.frames};
  }
  return texture;
}

}  // namespace

LayerSet unchanged_layers(const LightWork& work, const Recipe& recipe) {
  return last_product(work, recipe) != nullptr ? work.frame.kept_layers : LayerSet();
}

void build_products(const LightWork& work, const std::vector<const Recipe*>& recipes) {
  for (const Recipe* recipe : recipes) {
    const gl::Texture* texture = nullptr;
    if (applies(*recipe, work.params())) {
      texture = kept_product(work, *recipe);
      if (texture == nullptr) texture = &build_product(work, *recipe);
    }
    work.frame.products.push_back({.name = recipe->name, .texture = texture, .sampler = recipe->sampler});
  }
}

}  // namespace penumbra::shadow
