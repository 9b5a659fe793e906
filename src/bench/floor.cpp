#include "bench/floor.h"

#include <algorithm>
#include <utility>

#include "gl/api.h"

namespace penumbra::bench {

namespace {

constexpr const char* floor_name = "fetch_floor";
constexpr unsigned unit_source = shadow::first_pass_unit;

void copy_mask(const shadow::TechniqueFrame& work, const gl::Texture& mask) {
  const gl::Texture& target = work.target("mask copy", mask.desc());
  gl::Pass pass(work.device(), {.name = "mask copy", .colors = {{.texture = &target}}});
  work.use(pass, "copy mask");
  work.device().sampler({}).bind(unit_source);
  mask.bind(unit_source);
  pass.draw_full_screen();
}

std::vector<Param> floor_rows() {
  using enum ParamBinding;
  return {
      {"fetch_floor.blocker_taps", 0, 0, 256, "taps", "As the technique's own.", compiled},
      {"fetch_floor.filter_taps", 0, 0, 256, "taps", "As the technique's own.", compiled},
      {"fetch_floor.radius", 0.0f, 0, 1000, "m", "As the technique's own, if it is constant; else 0.", uniform},
  };
}

shadow::Registry floor_registry(const shadow::Technique& of, const gl::Texture& kernels) {
  shadow::Technique floor{.name = floor_name,
                          .summary = "Only the fetches of another technique.",
                          .source = "none",
                          .glsl = "bench/fetch_floor.glsl",
                          .needs = shadow::needs_shadow_map | shadow::needs_depth_pyramid,
                          .params = floor_rows(),
                          .pattern = of.pattern,
                          .scramble = of.scramble};
  floor.prepare = [&kernels](const shadow::TechniqueFrame& work) {
    work.frame().products.push_back({.unit = shadow::first_product_unit, .texture = &kernels});
    copy_mask(work, kernels);
  };
  floor.programs = [](const ParamSet&) {
    return std::vector<gl::ProgramDesc>{
        {.name = "copy mask", .vertex = "shared/full_screen.vert", .fragment = "bench/copy_mask.frag"}};
  };
  return shadow::Registry({std::move(floor)}, {});
}

bool has_row(const shadow::Technique& technique, const char* row) {
  const std::string name = technique.name + "." + row;
  return std::ranges::any_of(technique.params, [&name](const Param& param) { return param.name == name; });
}

}  // namespace

Floor::Floor(const shadow::Technique& technique, const scene::Scene& scene, gl::ShaderFiles shaders,
             gl::Timers::Mode timing)
    : technique_(technique),
      has_fetches_(has_row(technique, "filter_taps") || has_row(technique, "blocker_taps")),
      kernels_(std::make_unique<gl::Texture>()),
      device_(std::move(shaders), timing),
      scene_(device_, scene),
      renderer_(device_, floor_registry(technique, *kernels_)) {}

void Floor::take_kernels(const gl::Texture& mask) {
  const gl::TextureDesc& desc = mask.desc();
  if (!*kernels_ || kernels_->desc() != desc) *kernels_ = gl::Texture("kernels", desc);
  gl::glCopyImageSubData(mask.id(), desc.target, 0, 0, 0, 0, kernels_->id(), desc.target, 0, 0, 0, 0, desc.width,
                         desc.height, desc.layers);
}

// The technique's values, without the history and the filters that come after its fetches.
ParamSet Floor::params_for(const ParamSet& params) const {
  ParamSet own(render::Renderer::params(renderer_.registry()));
  for (const Param& row : own.rows()) {
    const std::string part = row.name.substr(row.name.find('.') + 1);
    const std::string& source = row.name.starts_with(floor_name) ? technique_.name + "." + part : row.name;
    if (row.name != "technique" && params.contains(source)) own.set(row.name, params.value(source));
  }
  own.set("history.reuse", false);
  own.set("filter.penumbra", std::string("none"));
  own.set("filter.visibility", std::string("none"));
  return own;
}

void Floor::draw(const render::FrameInputs& inputs, const ParamSet& params) {
  renderer_.draw(scene_, inputs, params_for(params));
}

}  // namespace penumbra::bench
