#include "samples.h"

#include <cmath>

#include "noise.h"

namespace penumbra::shadow {

namespace {

static_assert(sizeof(glsl::SampleBlock) == 6144);

// Sets that a step takes in turn.
constexpr int set_count = 16;

void fill_table(glm::vec4* table, const std::vector<glm::vec2>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    glm::vec4& pair = table[i / 2];
    (i % 2 == 0 ? pair.x : pair.z) = points[i].x;
    (i % 2 == 0 ? pair.y : pair.w) = points[i].y;
  }
}

int taps(const Technique& technique, const ParamSet& params, const std::string& step, int otherwise = 0) {
  const std::string name = technique.name + "." + step + "_taps";
  return params.contains(name) ? params.get_int(name) : otherwise;
}

// Point `index` of the lattice of the plastic number.
glm::vec2 lattice(int index) {
  const auto coordinate = [index](double ratio) { return static_cast<float>(std::fmod(index * ratio, 1.0)); };
  return {coordinate(0.75487766624669276), coordinate(0.56984029099805327)};
}

glm::vec2 shift_of(const ParamSet& params, const std::string& step, int frame) {
  const bool moves = params.get_word("sampling." + step + "_sequence") == "shift";
  return glm::fract(lattice(params.get_int("sampling.seed")) + lattice(moves ? frame : 0));
}

}  // namespace

const std::vector<std::string>& scramble_names() {
  static const std::vector<std::string> names{"rotate", "shift"};
  return names;
}

bool turns_samples(const Technique& technique, const ParamSet& params) {
  const std::string& scramble = technique.scramble.empty() ? params.get_word("sampling.scramble") : technique.scramble;
  // A turned square would be another light.
  return scramble == "rotate" && params.get_word("sun.shape") == "disc";
}

glm::vec4 noise_shift(const ParamSet& params, int frame) {
  return {shift_of(params, "blocker", frame), shift_of(params, "filter", frame)};
}

glsl::SampleBlock Samples::block(const Technique& technique, const ParamSet& params, int frame) {
  const bool disc = turns_samples(technique, params);
  const auto points_of = [&](const std::string& step, int count) -> const std::vector<glm::vec2>& {
    const std::string prefix = "sampling." + step;
    const std::string& pattern = technique.pattern.empty() ? params.get_word(prefix + "_pattern") : technique.pattern;
    const bool changes = params.get_word(prefix + "_sequence") == "set";
    const auto set = static_cast<std::uint64_t>(changes ? frame % set_count : 0);
    return points({pattern, count, disc, set});
  };
  glsl::SampleBlock block{};
  const int filter_taps = taps(technique, params, "filter");
  fill_table(block.blocker, points_of("blocker", taps(technique, params, "blocker")));
  fill_table(block.filter_points, points_of("filter", filter_taps));
  fill_table(block.renewal_points, points_of("filter", taps(technique, params, "renewal", filter_taps)));
  return block;
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
