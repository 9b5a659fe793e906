#include "products.h"

#include <algorithm>
#include <ranges>
#include <string_view>

#include "pass_context.h"

namespace penumbra::shadow {

Wanted wanted_of(const LightWork& work) {
  std::vector<std::string_view> names;
  const auto ask = [&names](const std::vector<std::string>& needs) {
    names.insert(names.end(), needs.begin(), needs.end());
  };
  const auto asked = [&names](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
  ask(work.technique.needs);
  ask(work.forward.needs);
  if (work.denoiser != nullptr) ask(work.denoiser->needs);
  Wanted wanted;
  // A recipe's needs come before it in the registry, so a backward pass finds all of them.
  for (const Recipe& recipe : work.registry.recipes() | std::views::reverse) {
    if (!asked(recipe.name)) continue;
    wanted.recipes.insert(wanted.recipes.begin(), &recipe);
    ask(recipe.needs);
  }
  wanted.shadow_map = asked("shadow_map");
  return wanted;
}

void build_products(const LightWork& work, const std::vector<const Recipe*>& recipes) {
  for (const Recipe* recipe : recipes) {
    const gl::Texture& texture = recipe->build(PassContext(work, owner_of(*recipe)));
    work.frame.products.push_back({.name = recipe->name, .texture = &texture, .sampler = recipe->sampler});
  }
}

}  // namespace penumbra::shadow
