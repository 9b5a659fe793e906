#include "bench/floor.h"

#include <algorithm>
#include <utility>

#include "gl/api.h"

namespace penumbra::bench {

namespace {

constexpr const char* floor_name = "fetch_floor";
constexpr unsigned unit_source = shadow::first_pass_unit;

// A texture that holds the light's layer of a mask alone.
const gl::Texture& copied_layer(const shadow::PassContext& context, const gl::Texture& mask) {
  gl::TextureDesc desc = mask.desc();
  desc.layers = 1;
  const gl::Texture& target = context.target("mask copy", desc);
  gl::Pass pass(context.device(), {.name = "mask copy", .colors = {{.texture = &target}}});
  context.use(pass, "copy mask").set("layer", context.frame().layer);
  context.device().sampler({}).bind(unit_source);
  mask.bind(unit_source);
  pass.draw_full_screen();
  return target;
}

std::vector<Param> floor_rows() {
  using enum ParamBinding;
  return {
      {"fetch_floor.blocker_taps", 0, 0, 256, "taps", "As the technique's own.", compiled},
      {.name = "fetch_floor.blocker_reads",
       .default_value = "footprint",
       .help = "As the technique's own.",
       .binding = compiled,
       .choices = {"footprint", "texel"}},
      {"fetch_floor.filter_taps", 0, 0, 256, "taps", "As the technique's own.", compiled},
      {"fetch_floor.radius", 0.0f, 0, 1000, "m", "As the technique's own, if it is constant; else 0.", uniform},
  };
}

// The light's layer of the technique's mask, whose channel G is the radius of its filter.
shadow::Recipe kernel_radii(const gl::Texture& kernels) {
  return {.name = "kernel_radii",
          .summary = "A layer of a mask of the technique that is measured.",
          .source = "none",
          .needs = {},
          .build = [&kernels](const shadow::PassContext& context) -> const gl::Texture& {
            return copied_layer(context, kernels);
          },
          .programs =
              [](const ParamSet&) {
                return std::vector<gl::ProgramDesc>{
                    {.name = "copy mask", .vertex = "shared/full_screen.vert", .fragment = "bench/copy_mask.frag"}};
              }};
}

shadow::Registry floor_registry(const shadow::Technique& of, const gl::Texture& kernels) {
  using Step = shadow::SampleSet::Step;
  shadow::Registry::Contents contents{
      .techniques = {
          {.name = floor_name,
           .summary = "Only the fetches of another technique.",
           .source = "none",
           .glsl = "bench/fetch_floor.glsl",
           .needs = {"shadow_map", "least_depth_pyramid", "kernel_radii"},
           .params = floor_rows(),
           .samples = {{.name = "blocker", .count_parameter = "fetch_floor.blocker_taps", .step = Step::blocker},
                       {.name = "filter", .count_parameter = "fetch_floor.filter_taps"}},
           .pattern = of.pattern,
           .scramble = of.scramble}}};
  contents.recipes.push_back(kernel_radii(kernels));
  return shadow::Registry(std::move(contents));
}

// Whether the technique reads as many points as its parameters say.
bool declares_taps(const shadow::Technique& technique, const ParamSet& params) {
  const auto name_of = [&technique](const char* row) { return technique.name + "." + row; };
  const bool reads_all = params.contains(name_of("every_texel")) && params.get_bool(name_of("every_texel"));
  return !reads_all && (params.contains(name_of("filter_taps")) || params.contains(name_of("blocker_taps")));
}

}  // namespace

Floor::Floor(const shadow::Technique& technique, const ParamSet& params, const scene::Scene& scene,
             gl::ShaderFiles shaders, gl::Timers::Mode timing)
    : technique_(technique),
      has_fetches_(declares_taps(technique, params)),
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

// The technique's values, without the denoiser that comes after its fetches.
ParamSet Floor::params_for(const ParamSet& params) const {
  ParamSet own(render::Renderer::params(renderer_.registry()));
  for (const Param& row : own.rows()) {
    const std::string part = row.name.substr(row.name.find('.') + 1);
    const std::string& source = row.name.starts_with(floor_name) ? technique_.name + "." + part : row.name;
    if (row.name != "technique" && params.contains(source)) own.set(row.name, params.value(source));
  }
  own.set("denoiser", std::string("none"));
  return own;
}

const render::Frame& Floor::draw(const render::FrameInputs& inputs, const ParamSet& params) {
  return renderer_.draw(scene_, inputs, params_for(params));
}

std::vector<std::pair<std::string, ParamValue>> values_for_floor(const ParamSet& params) {
  std::vector<std::pair<std::string, ParamValue>> values{{"mask.tiles", false}, {"mask.scale", 1}};
  const std::string exits = params.get_word("technique") + ".early_exit";
  if (params.contains(exits)) values.emplace_back(exits, false);
  return values;
}

}  // namespace penumbra::bench
