#include "samples.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <span>

#include "light_frame.h"
#include "noise.h"

namespace penumbra::shadow {

namespace {

// Number of point sets through which a step cycles.
constexpr int set_count = 16;

// The name of a SampleSet::Step in parameter names and in GLSL.
const char* name_of(SampleSet::Step step) { return step == SampleSet::Step::blocker ? "blocker" : "filter"; }

void append_table(std::vector<glm::vec4>& tables, std::size_t size, const std::vector<glm::vec2>& points) {
  assert(points.size() <= size);
  const std::size_t first = tables.size();
  tables.resize(first + size);
  for (std::size_t i = 0; i < points.size(); ++i) tables[first + i] = glm::vec4(points[i], 0.0F, 0.0F);
}

bool changes(const ParamSet& params, SampleSet::Step step, std::string_view how) {
  return params.get_word(fmt::format("sampling.{}_sequence", name_of(step))) == how;
}

// Point `index` of the lattice of the plastic number.
glm::vec2 lattice(int index) {
  const auto coordinate = [index](double ratio) { return static_cast<float>(std::fmod(index * ratio, 1.0)); };
  return {coordinate(0.75487766624669276), coordinate(0.56984029099805327)};
}

glm::vec2 shift_of(const ParamSet& params, SampleSet::Step step, int frame) {
  const bool moves = changes(params, step, "shift");
  return glm::fract(lattice(params.get_int("sampling.seed")) + lattice(moves ? frame : 0));
}

}  // namespace

const std::vector<std::string>& scramble_names() {
  static const std::vector<std::string> names{"rotate", "shift"};
  return names;
}

bool rotates_samples(const Technique& technique, const ParamSet& params, const LightShape& shape) {
  const std::string& scramble = technique.scramble.empty() ? params.get_word("sampling.scramble") : technique.scramble;
  // A square must not be rotated: that would be a different light.
  return scramble == "rotate" && !shape.square;
}

glm::vec4 noise_shift(const ParamSet& params, int frame) {
  return {shift_of(params, SampleSet::Step::blocker, frame), shift_of(params, SampleSet::Step::filter, frame)};
}

int set_number(const ParamSet& params, int frame) {
  const bool any = changes(params, SampleSet::Step::blocker, "set") || changes(params, SampleSet::Step::filter, "set");
  return any ? frame % set_count : 0;
}

std::size_t table_size(const SampleSet& set, const ParamSet& params) {
  return static_cast<std::size_t>(params.row(set.count_parameter).max);
}

std::string sample_declarations(const Technique& technique, const ParamSet& params) {
  if (technique.samples.empty()) return {};
  std::string members, functions;
  for (const SampleSet& set : technique.samples) {
    members += fmt::format("  vec4 {}_points[{}];\n", set.name, table_size(set, params));
    functions += fmt::format(
        "vec2 {0}_point(int index, Scramble scramble, Light light) {{\n"
        "  return shape_point({0}_points[index].xy, scramble, light);\n}}\n"
        "Scramble {0}_scramble(Receiver receiver) {{ return scramble_of(receiver, {1}_step); }}\n",
        set.name, name_of(set.step));
  }
  return fmt::format(
      "#include \"shadow/sampling.glsl\"\nlayout(std140, binding = {}) uniform SamplePoints {{\n{}}};\n{}",
      static_cast<unsigned>(block_samples), members, functions);
}

std::vector<glm::vec4> Samples::tables(const Technique& technique, const ParamSet& params, const Tables& of) {
  std::vector<glm::vec4> tables;
  for (const SampleSet& samples : technique.samples) {
    const std::string pattern_row = fmt::format("sampling.{}_pattern", name_of(samples.step));
    const std::string& pattern = technique.pattern.empty() ? params.get_word(pattern_row) : technique.pattern;
    const auto seed = static_cast<std::uint64_t>(changes(params, samples.step, "set") ? of.set : 0);
    const int count = params.get_int(samples.count_parameter);
    append_table(tables, table_size(samples, params), points({pattern, count, of.rotated, seed}));
  }
  return tables;
}

const std::vector<glm::vec2>& Samples::points(const Key& key) {
  const auto [entry, added] = points_.try_emplace(key);
  const auto& [pattern, count, disc, set] = key;
  if (added) entry->second = (disc ? disc_points : square_points)(pattern, count, set);
  return entry->second;
}

const gl::Texture& Samples::noise(const std::string& kind) {
  const auto made = noise_.find(kind);
  if (made != noise_.end()) return *made->second;
  std::vector<std::uint16_t> texels(2, 0);
  int size = 1;
  if (kind != "none") {
    const NoiseTile tile = built_in_noise(kind);
    size = tile.size;
    texels.clear();
    for (const std::uint16_t rank : tile.ranks) {
      texels.push_back(static_cast<std::uint16_t>((2 * rank + 1) * 65535 / (2 * tile.count())));
    }
  }
  const gl::Texture& texture =
      device_.target(prefix_ + "noise/" + kind, {.format = GL_RG16, .width = size, .height = size});
  texture.upload(GL_RG, GL_UNSIGNED_SHORT, std::as_bytes(std::span(texels)));
  noise_[kind] = &texture;
  return texture;
}

}  // namespace penumbra::shadow
