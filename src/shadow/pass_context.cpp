#include "pass_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "../core/error.h"
#include "light_work.h"
#include "mask_pass.h"
#include "products.h"
#include "shadow_map.h"

namespace penumbra::shadow {

namespace {

const char* name_of(PassOwner::Kind kind) {
  switch (kind) {
    case PassOwner::Kind::recipe:
      return "recipe";
    case PassOwner::Kind::denoiser:
      return "denoiser";
    case PassOwner::Kind::technique:
      break;
  }
  return "technique";
}

// Adds to clip-space z over w of what a matrix transforms; 0 leaves it as it is, to the bit.
void move_along(glm::mat4& to_clip, float depth) {
  for (glm::length_t i = 0; i < 4; ++i) to_clip[i].z += depth * to_clip[i].w;
}

}  // namespace

std::string target_prefix(const LightWork& work, const PassOwner& owner) {
  return fmt::format("{}{}s/{}/", work.prefix(), name_of(owner.kind), owner.name);
}

gl::Device& PassContext::device() const { return work_.device; }
const Inputs& PassContext::inputs() const { return work_.inputs; }
const Light& PassContext::light() const { return work_.light; }
const ParamSet& PassContext::params() const { return work_.params(); }
const LightFrame& PassContext::frame() const { return work_.frame; }
const gl::Texture& PassContext::mask() const { return work_.mask; }
int PassContext::age() const { return static_cast<int>(work_.state.age); }
bool PassContext::uses_compute() const { return params().get_word("driver") == "compute"; }

const gl::Texture& PassContext::product(std::string_view recipe) const {
  const Product* product = find_product(work_.frame, recipe);
  const bool asked = std::ranges::find(owner_.needs, recipe) != owner_.needs.end();
  if (product == nullptr || product->texture == nullptr || !asked) {
    throw std::logic_error(fmt::format("{} '{}' does not ask for '{}'", name_of(owner_.kind), owner_.name, recipe));
  }
  return *product->texture;
}

LayerSet PassContext::unchanged_layers() const {
  return shadow::unchanged_layers(work_, work_.registry.find_recipe(owner_.name));
}

std::string PassContext::full_name(std::string_view name) const {
  std::string full = target_prefix(work_, owner_).append(name);
  if (work_.state.changed) work_.state.used.insert(full);
  return full;
}

const DepthRounding& PassContext::depth_rounding() const { return work_.view.checked.depth; }

const gl::Texture& PassContext::shadow_map() const {
  gl::Texture& known = work_.state.shadow_map;
  const gl::TextureDesc desc = shadow_map_desc(work_.frame.projection);
  if (known.id() != work_.frame.depth || known.desc() != desc) known = gl::Texture::wrap(work_.frame.depth, desc);
  return known;
}

const gl::Texture& PassContext::target(std::string_view name, const gl::TextureDesc& desc) const {
  return work_.device.target(full_name(name), desc);
}

const gl::Buffer& PassContext::scratch(std::string_view name, std::size_t bytes) const {
  return work_.device.scratch(full_name(name), bytes);
}

History PassContext::history(std::string_view name, const gl::TextureDesc& desc) const {
  LightState& state = work_.state;
  const std::string kept_name = fmt::format("history {}", name);
  LightState::KeptTexture& kept = state.kept[full_name(kept_name)];
  assert(kept.filled != state.frames);
  const bool valid = state.age > 0 && kept.desc == desc && kept.filled + 1 == state.frames;
  kept = {.desc = desc, .now = 1 - kept.now, .filled = state.frames};
  const auto texture = [&](int index) -> const gl::Texture& {
    return target(fmt::format("{}/{}", kept_name, index), desc);
  };
  return {texture(1 - kept.now), texture(kept.now), valid};
}

const gl::ProgramDesc& PassContext::own_program(std::string_view program) const {
  LightState& state = work_.state;
  const std::string key = fmt::format("{} {}", name_of(owner_.kind), owner_.name);
  auto own = state.programs.find(key);
  if (own == state.programs.end()) {
    const Programs::Compiled compiled = owner_.technique != nullptr
                                            ? Programs::compiled_for(*owner_.technique, params(), work_.frame.shape)
                                            : Programs::Compiled{};
    own = state.programs.emplace(key, work_.programs.own(owner_, params(), compiled)).first;
  }
  const std::string name = Programs::own_name(owner_, program);
  const auto found = std::ranges::find(own->second, name, &gl::ProgramDesc::name);
  if (found == own->second.end()) {
    throw std::logic_error(fmt::format("{} '{}' has no program '{}'", name_of(owner_.kind), owner_.name, program));
  }
  return *found;
}

const gl::Program& PassContext::use(gl::Pass& pass, std::string_view program) const {
  const gl::Program& used = pass.use(own_program(program));
  bind_inputs(work_, owner_);
  return used;
}

void PassContext::cover(gl::Pass& pass) const {
  const Rect& viewport = work_.frame.viewport;
  if (uses_compute()) {
    pass.dispatch(viewport.width, viewport.height);
  } else {
    pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
    pass.draw_full_screen();
  }
}

void PassContext::evaluate(const gl::Texture& target, int layer) const {
  run_mask_pass(work_, {.mask = &target, .layer = layer});
}

void PassContext::check_draws() const {
  if (!work_.inputs.draw)
    fail("soft shadows: light {}: {} '{}' draws casters, and there is no caster callback", light().id,
         name_of(owner_.kind), owner_.name);
}

CasterPass PassContext::caster_pass(CasterKind kind, int layer) const {
  check_draws();
  const LightProjection& projection = work_.frame.projection;
  return {.kind = kind,
          .layer = layer,
          .world_to_clip = projection.casters_to_clip(layer),
          .anchored = projection.anchored_to_clip(layer),
          .cull = projection.cull_volume(layer),
          .source = light().source};
}

void PassContext::draw_casters(gl::Pass& pass, CasterKind kind, int layer) const {
  assert(kind != CasterKind::geometry && kind != CasterKind::second_depth);
  work_.inputs.draw(caster_pass(kind, layer), pass);
}

void PassContext::draw_second_depth(gl::Pass& pass, int layer, float gap) const {
  CasterPass casters = caster_pass(CasterKind::second_depth, layer);
  casters.gap = gap / work_.frame.projection.depth_range(layer);
  // Programs and matrices that are not the ones which drew the map may give other depths, by some steps of a float.
  constexpr float rounding = 4 * 0x1p-24f;
  if (light().maps || gap > 0) casters.gap = std::max(casters.gap, rounding);
  const float nearer = work_.frame.projection.drawn_reversed() ? casters.gap : -casters.gap;
  move_along(casters.world_to_clip, nearer);
  move_along(casters.anchored.to_clip, nearer);
  work_.inputs.draw(casters, pass);
}

void PassContext::draw_caster_geometry(gl::Pass& pass, std::string_view program, const glm::mat4& world_to_clip) const {
  check_draws();
  bind_inputs(work_, owner_);
  work_.inputs.draw({.kind = CasterKind::geometry,
                     .layer = 0,
                     .world_to_clip = world_to_clip,
                     .anchored = {.to_clip = world_to_clip, .anchor = glm::vec3(0)},
                     .cull = work_.frame.projection.cull_volume_of_all(),
                     .source = light().source,
                     .program = own_program(program)},
                    pass);
}

}  // namespace penumbra::shadow
