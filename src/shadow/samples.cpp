#include "samples.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <span>

#include "light_frame.h"
#include "noise.h"
#include "sample_keys.h"

namespace penumbra::shadow {

namespace {

// Number of point sets through which a step cycles.
constexpr int most_sets = 16;

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

constexpr const char* keyed = "heitz_belcour";

struct StepRead {
  glm::vec2 shift{0};
  glm::ivec4 place{0};
};

StepRead step_read(const ParamSet& params, SampleSet::Step step, int frame) {
  const std::string& noise = params.get_word("sampling.noise");
  const bool filter = step == SampleSet::Step::filter;
  // So that the steps read different values.
  StepRead read{.place = filter ? glm::ivec4(built_in_noise_side / 2, built_in_noise_side / 2, 0, 0) : glm::ivec4(0)};
  int turn = changes(params, step, "shift") ? frame : 0;
  if (noise == "spatiotemporal") {
    read.place.z = turn % spatiotemporal_frames;
    turn /= spatiotemporal_frames;
  }
  const glm::vec2 of_seed = lattice(params.get_int("sampling.seed"));
  if (noise == keyed) {
    read.place += glm::ivec4(of_seed * static_cast<float>(built_in_noise_side), 0, turn % keyed_point_count);
    read.shift = lattice(turn);
  } else {
    read.shift = glm::fract(of_seed + lattice(turn));
  }
  return read;
}

std::uint16_t unorm16(float value) { return static_cast<std::uint16_t>(std::lround(value * 65535)); }

// The texels of Samples::noise().
std::vector<std::uint16_t> texels_of(const NoiseTile& tile) {
  const std::int64_t count = tile.count();
  std::vector<std::uint16_t> texels;
  for (int pixel = 0; pixel < count; ++pixel) {
    for (int channel = 0; channel < 2; ++channel)
      texels.push_back(static_cast<std::uint16_t>((2 * tile.rank(pixel, channel) + 1) * 65535LL / (2 * count)));
    texels.insert(texels.end(), {0, 0});
  }
  return texels;
}

std::vector<std::uint16_t> texels_of(const KeyTile& tile) {
  std::vector<std::uint16_t> texels;
  for (const SampleKey& key : tile.keys) {
    const glm::vec2 first = keyed_point(key, 0);
    texels.insert(texels.end(),
                  {unorm16(first.x), unorm16(first.y), static_cast<std::uint16_t>(key.y << 8 | key.x), key.order});
  }
  return texels;
}

std::vector<glm::vec4> keyed_table() {
  std::vector<glm::vec4> table;
  for (const glm::u8vec2& point : keyed_points()) table.emplace_back(glm::vec2(point), 0.0F, 0.0F);
  return table;
}

}  // namespace

const std::vector<std::string>& scramble_names() {
  static const std::vector<std::string> names{"rotate", "shift"};
  return names;
}

Scramble scramble_of(const Technique& technique, const ParamSet& params, const LightShape& shape) {
  const bool chosen = technique.scramble.empty();
  if (chosen && !technique.samples.empty() && params.get_word("sampling.noise") == keyed) return Scramble::keys;
  const std::string& scramble = chosen ? params.get_word("sampling.scramble") : technique.scramble;
  // A square must not be rotated: that would be a different light.
  return scramble == "rotate" && !shape.square ? Scramble::rotate : Scramble::shift;
}

std::vector<Scramble> scrambles_of(const Technique& technique) {
  if (technique.scramble.empty() && !technique.samples.empty())
    return {Scramble::rotate, Scramble::shift, Scramble::keys};
  return {Scramble::rotate, Scramble::shift};
}

NoiseRead noise_read(const ParamSet& params, int frame) {
  const StepRead blocker = step_read(params, SampleSet::Step::blocker, frame);
  const StepRead filter = step_read(params, SampleSet::Step::filter, frame);
  return {.shift = {blocker.shift, filter.shift}, .place = {blocker.place, filter.place}};
}

int set_count(const ParamSet& params) {
  const bool any = changes(params, SampleSet::Step::blocker, "set") || changes(params, SampleSet::Step::filter, "set");
  return any ? most_sets : 1;
}

int set_number(const ParamSet& params, int frame) { return frame % set_count(params); }

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
        "#if SAMPLE_SCRAMBLE == SCRAMBLE_KEYS\n"
        "  return shape_point(keyed_points[keyed_index(index, {2}, scramble)].xy, scramble, light);\n"
        "#else\n"
        "  return shape_point({0}_points[index].xy, scramble, light);\n"
        "#endif\n}}\n"
        "Scramble {0}_scramble(Receiver receiver) {{ return scramble_of(receiver, {1}_step); }}\n",
        set.name, name_of(set.step), glsl_name(params.row(set.count_parameter)));
  }
  return fmt::format(
      "#include \"shadow/sampling.glsl\"\n"
      "#if SAMPLE_SCRAMBLE != SCRAMBLE_NONE\n"
      "layout(std140, binding = {}) uniform SamplePoints {{\n"
      "#if SAMPLE_SCRAMBLE == SCRAMBLE_KEYS\n"
      "  vec4 keyed_points[{}];\n"
      "#else\n"
      "{}"
      "#endif\n}};\n{}"
      "#endif\n",
      static_cast<unsigned>(block_samples), keyed_point_count, members, functions);
}

std::vector<glm::vec4> Samples::tables(const Technique& technique, const ParamSet& params, const Tables& of) {
  if (of.scramble == Scramble::keys) return keyed_table();
  std::vector<glm::vec4> tables;
  for (const SampleSet& samples : technique.samples) {
    const std::string pattern_row = fmt::format("sampling.{}_pattern", name_of(samples.step));
    const std::string& pattern = technique.pattern.empty() ? params.get_word(pattern_row) : technique.pattern;
    const auto seed = static_cast<std::uint64_t>(changes(params, samples.step, "set") ? of.set : 0);
    const int count = params.get_int(samples.count_parameter);
    append_table(tables, table_size(samples, params), points({pattern, count, of.scramble == Scramble::rotate, seed}));
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
  std::vector<std::uint16_t> texels(4, 0);
  if (kind == keyed) {
    texels = texels_of(built_in_sample_keys());
  } else if (kind != "none") {
    texels = texels_of(built_in_noise(kind));
  }
  const int size = kind == "none" ? 1 : built_in_noise_side;
  const auto rows = static_cast<int>(texels.size()) / (4 * size);
  const gl::Texture& texture =
      device_.target(prefix_ + "noise/" + kind, {.format = GL_RGBA16, .width = size, .height = rows});
  texture.upload(GL_RGBA, GL_UNSIGNED_SHORT, std::as_bytes(std::span(texels)));
  noise_[kind] = &texture;
  return texture;
}

}  // namespace penumbra::shadow
