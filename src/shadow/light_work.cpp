#include "light_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace penumbra::shadow {

const Technique& forward_technique(const Registry& registry, const ParamSet& params) {
  const Technique& technique = registry.find(params.get_word("technique"));
  return technique.stand_in.empty() ? technique : registry.find(technique.stand_in);
}

const Denoiser* denoiser_for(const Registry& registry, const Technique& technique, const ParamSet& params) {
  const Denoiser* denoiser = technique.denoisable ? registry.find_denoiser(params.get_word("denoiser")) : nullptr;
  const bool applies = denoiser != nullptr && (!denoiser->applies || denoiser->applies(params));
  return applies ? denoiser : nullptr;
}

std::vector<Denoiser::Remembered> remembered_by(const Denoiser* denoiser, const ParamSet& params) {
  if (denoiser == nullptr || !denoiser->remembers) return {};
  return denoiser->remembers(params);
}

bool needs_second_layer(const Technique& technique) {
  return std::ranges::find(technique.needs, "second_layer") != technique.needs.end();
}

bool reads_second_layer(const Technique& technique, const ParamSet& params) {
  return needs_second_layer(technique) && params.get_int("maps.layers") == 2;
}

bool sees_hidden_casters(const Technique& technique, const ParamSet& params) {
  return technique.sees_hidden_casters || reads_second_layer(technique, params);
}

const Product* find_product(const LightFrame& frame, std::string_view name) {
  const auto found = std::ranges::find(frame.products, name, &Product::name);
  return found == frame.products.end() ? nullptr : &*found;
}

PassOwner owner_of(const Technique& technique) {
  return {.kind = PassOwner::Kind::technique,
          .name = technique.name,
          .needs = technique.needs,
          .params = technique.params,
          .programs = technique.programs,
          .technique = &technique};
}

PassOwner owner_of(const Recipe& recipe) {
  return {.kind = PassOwner::Kind::recipe,
          .name = recipe.name,
          .needs = recipe.needs,
          .params = recipe.params,
          .programs = recipe.programs};
}

PassOwner owner_of(const Denoiser& denoiser) {
  return {.kind = PassOwner::Kind::denoiser,
          .name = denoiser.name,
          .needs = denoiser.needs,
          .params = denoiser.params,
          .programs = denoiser.programs};
}

namespace {

// Writes a set's tables to its place.
void write_samples(const LightWork& work, const Technique& technique, const char* name, int set,
                   LightState::SampleTables& tables) {
  constexpr std::size_t alignment = 256;  // the most that OpenGL may ask for, bytes
  const std::vector<glm::vec4> points =
      work.samples.tables(technique, work.params(), {.set = set, .scramble = tables.scramble});
  if (tables.written == 0) {
    tables.bytes = sizeof(glm::vec4) * points.size();
    tables.stride = (tables.bytes + alignment - 1) / alignment * alignment;
    tables.buffer = &work.device.scratch(work.prefix() + name, static_cast<std::size_t>(tables.sets) * tables.stride);
  }
  tables.buffer->write(std::as_bytes(std::span(points)), static_cast<std::size_t>(set) * tables.stride);
  tables.written |= 1u << set;
}

}  // namespace

void upload_samples(const LightWork& work, const Technique& technique, const char* name) {
  if (technique.samples.empty()) return;
  const Scramble scramble = scramble_of(technique, work.params(), work.frame.shape);
  const int sets = scramble == Scramble::keys ? 1 : set_count(work.params());
  LightState::SampleTables& tables = work.state.samples[technique.name];
  if (!work.state.uploaded || tables.sets != sets || tables.scramble != scramble) {
    tables = {.sets = sets, .scramble = scramble};
  }
  const int set = static_cast<int>(work.state.age % static_cast<std::uint64_t>(sets));
  if ((tables.written >> set & 1u) == 0) write_samples(work, technique, name, set, tables);
  tables.offset = static_cast<std::size_t>(set) * tables.stride;
}

void bind_light(gl::Device& device, const LightFrame& frame, const LightState& state, const PassOwner& owner) {
  state.params_block->bind_uniform(block_params);
  state.shadow_block->bind_uniform(block_shadow);
  if (owner.technique != nullptr && !owner.technique->samples.empty()) {
    const LightState::SampleTables& tables = state.samples.at(owner.technique->name);
    tables.buffer->bind_uniform(block_samples, tables.offset, tables.bytes);
  }
  // Outside of the map there are no casters: depth 1.
  device.sampler({.wrap_s = GL_CLAMP_TO_BORDER, .wrap_t = GL_CLAMP_TO_BORDER}).bind(unit_shadow_map);
  gl::glBindTextureUnit(unit_shadow_map, frame.depth);
  device.sampler({}).bind(unit_noise);
  state.noise->bind(unit_noise);
  unsigned unit = first_product_unit;
  for (const std::string& need : owner.needs) {
    if (is_base_map(need)) continue;
    const Product* product = find_product(frame, need);
    if (product == nullptr) throw std::logic_error(fmt::format("nothing has made the product '{}'", need));
    device.sampler(product->sampler).bind(unit);
    gl::glBindTextureUnit(unit++, product->texture != nullptr ? product->texture->id() : 0);
  }
}

GLuint normals_of(const LightWork& work) {
  if (!work.inputs.makes_normals() || work.view.normals == nullptr) return work.inputs.normals.id;
  return work.view.normals->id();
}

void bind_receivers(const LightWork& work) {
  for (const GLuint unit : {unit_receiver_depth, unit_receiver_normal}) work.device.sampler({}).bind(unit);
  gl::glBindTextureUnit(unit_receiver_depth, work.inputs.depth.id);
  gl::glBindTextureUnit(unit_receiver_normal, normals_of(work));
}

void bind_inputs(const LightWork& work, const PassOwner& owner) {
  bind_light(work.device, work.frame, work.state, owner);
  bind_receivers(work);
}

}  // namespace penumbra::shadow
