#include "prefilter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "lib/prefilter.glsl"
#include "pass_context.h"

namespace penumbra::shadow {

namespace {

constexpr int most_taps = 9;    // on one side of a kernel's centre, and the centre
constexpr int most_block = 16;  // texels of the map along each side that one invocation averages

// Of a texel and its neighbours on one side, by distance. With those of the other side they add up to 1, so that no
// weighted sum exceeds the greatest value: the squares of warped depths use the whole range of a float.
std::array<float, most_taps> kernel_weights(float radius) {
  std::array<float, most_taps> weights{glsl::kernel_weight(0)};
  float sum = weights[0];
  for (size_t i = 1; i < weights.size() && radius > 0; ++i) {
    weights[i] = glsl::kernel_weight(static_cast<float>(i) / radius);
    sum += 2 * weights[i];
  }
  for (float& weight : weights) weight /= sum;
  return weights;
}

std::string radius_of(const FilteredMap& map) { return map.prefix + ".radius"; }
std::string shrink_of(const FilteredMap& map) { return map.prefix + ".shrink"; }

int slices_of(const FilteredMap& map, const ParamSet& params) { return map.slices ? map.slices(params) : 1; }

// The passes that fill one layer's slices.
class LayerPasses {
 public:
  LayerPasses(const PassContext& context, gl::Pass& pass, const gl::Texture& filtered, int slices, int layer)
      : context_(context), pass_(pass), filtered_(filtered), slices_(slices), layer_(layer) {}

  void fill(int shrink, float radius) {
    const glm::vec2 texel = context_.frame().projection.texel(layer_) * static_cast<float>(shrink);
    const int level = glsl::kernel_level(radius / std::min(texel.x, texel.y), filtered_.desc().levels);
    int first = 0;
    while (first < level && shrink << (first + 1) <= most_block) ++first;
    from_depth(first, shrink << first);
    for (int coarser = first + 1; coarser <= level; ++coarser) halve(coarser);
    if (!context_.frame().projection.texels_vary()) {
      filter(level, radius / (texel * std::exp2(static_cast<float>(level))));
      for (int coarser = level + 1; coarser < filtered_.desc().levels; ++coarser) halve(coarser);
      return;
    }
    // For nearer receivers each coarser level holds a kernel of twice as many texels of the map.
    for (int coarser = level + 1; coarser < filtered_.desc().levels; ++coarser) halve(coarser);
    for (int each = level; each < filtered_.desc().levels; ++each) {
      const bool coarser = each > level;
      filter(each, {glsl::kernel_texels(radius / texel.x, level, coarser),
                    glsl::kernel_texels(radius / texel.y, level, coarser)});
    }
  }

 private:
  struct Slices {
    const gl::Texture& texture;
    int slice = 0;
  };

  int first_slice() const { return layer_ * slices_; }

  void dispatch(const gl::Texture& target, int level) {
    target.bind_image(0, GL_WRITE_ONLY, level);
    const int side = std::max(1, target.width() >> level);
    pass_.dispatch(side, side, slices_);
  }

  // With a kernel of that radius, texels.
  void filter(int level, const glm::vec2& texels) {
    if (std::max(texels.x, texels.y) <= 1) return;
    const gl::Texture& rows = context_.target("rows", {.target = GL_TEXTURE_2D_ARRAY,
                                                       .format = filtered_.desc().format,
                                                       .width = filtered_.width(),
                                                       .height = filtered_.height(),
                                                       .layers = slices_,
                                                       .levels = filtered_.desc().levels});
    blur({.texture = filtered_, .slice = first_slice()}, {.texture = rows}, level, {1, 0}, texels.x);
    blur({.texture = rows}, {.texture = filtered_, .slice = first_slice()}, level, {0, 1}, texels.y);
  }

  void from_depth(int level, int block) {
    const gl::Program& program = context_.use(pass_, "from depth");
    program.set("map_layer", layer_);
    program.set("first_slice", first_slice());
    program.set("block", block);
    dispatch(filtered_, level);
  }

  void blur(const Slices& from, const Slices& to, int level, const glm::ivec2& axis, float radius) {
    const gl::Program& program = context_.use(pass_, "blur");
    bind_source(from.texture);
    program.set("source_level", level);
    program.set("first_slices", glm::ivec2(from.slice, to.slice));
    program.set("axis", axis);
    const std::array<float, most_taps> weights = kernel_weights(radius);
    for (size_t i = 0; i < weights.size(); ++i) program.set(fmt::format("weights[{}]", i), weights[i]);
    dispatch(to.texture, level);
  }

  void bind_source(const gl::Texture& texture) {
    context_.device().sampler({.min_filter = GL_NEAREST_MIPMAP_NEAREST}).bind(first_pass_unit);
    texture.bind(first_pass_unit);
  }

  void halve(int level) {
    const gl::Program& program = context_.use(pass_, "halve");
    bind_source(filtered_);
    program.set("finer_level", level - 1);
    program.set("first_slice", first_slice());
    dispatch(filtered_, level);
  }

  const PassContext& context_;
  gl::Pass& pass_;
  const gl::Texture& filtered_;
  int slices_, layer_;
};

const gl::Texture& build(const FilteredMap& map, const PassContext& context) {
  const ParamSet& params = context.params();
  const LightProjection& projection = context.frame().projection;
  const int shrink = params.get_int(shrink_of(map));
  const int slices = slices_of(map, params);
  const auto side = std::bit_ceil(static_cast<unsigned>((projection.size() + shrink - 1) / shrink));
  const gl::Texture& filtered = context.target("filtered", {.target = GL_TEXTURE_2D_ARRAY,
                                                            .format = map.format(params),
                                                            .width = static_cast<int>(side),
                                                            .height = static_cast<int>(side),
                                                            .layers = projection.layers() * slices,
                                                            .levels = static_cast<int>(std::bit_width(side))});
  const float radius = map.radius > 0 ? params.get_float(radius_of(map)) : 0;
  gl::Pass pass(context.device(), {.name = "filtered map"});
  const LayerSet unchanged = context.unchanged_layers();
  for (int i = 0; i < projection.layers(); ++i) {
    if (unchanged[static_cast<size_t>(i)]) continue;
    LayerPasses(context, pass, filtered, slices, i).fill(shrink, radius);
  }
  return filtered;
}

std::vector<Param> params_of(const FilteredMap& map) {
  using enum ParamBinding;
  std::vector<Param> rows{{shrink_of(map), 2, 1, 4, "texels",
                           "Texels of the shadow map along each side of a texel of the filtered map.", uniform}};
  if (map.radius > 0) {
    rows.insert(
        rows.begin(),
        {radius_of(map), map.radius, 0, 1000, "m",
         "Radius of the filter, perpendicular to the light: a Gaussian with half of it as its standard deviation.",
         uniform});
  }
  rows.insert(rows.end(), map.params.begin(), map.params.end());
  return rows;
}

}  // namespace

Recipe filtered_map(const FilteredMap& map) {
  return {.name = map.name,
          .summary = map.summary,
          .source = map.source,
          .params = params_of(map),
          .depends_only_on_needs = true,
          .build = [map](const PassContext& context) -> const gl::Texture& { return build(map, context); },
          .programs =
              [map](const ParamSet&) {
                const char* log_space = map.log_space ? "1" : "0";
                return std::vector<gl::ProgramDesc>{
                    {.name = "from depth", .compute = map.function},
                    {.name = "blur", .compute = "shadow/prefilter/blur.comp", .defines = {{"LOG_SPACE", log_space}}},
                    {.name = "halve", .compute = "shadow/prefilter/halve.comp", .defines = {{"LOG_SPACE", log_space}}}};
              }};
}

}  // namespace penumbra::shadow
