#include <unistd.h>

#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "scene_check/checks.h"

namespace penumbra::test {
namespace {

constexpr int mutations_a_scene = 200;

// Small scenes that together use every part of the reader.
constexpr std::array<const char*, 16> bases = {
    "box_meshopt/BoxMeshopt.glb",
    "CesiumMan_draco/CesiumMan.gltf",
    "AnimatedMorphCube/AnimatedMorphCube.glb",
    "AnimatedMorphCube_quantized/AnimatedMorphCube.gltf",
    "RiggedSimple/RiggedSimple.glb",
    "SimpleSkin/SimpleSkin.gltf",
    "SimpleSparseAccessor/SimpleSparseAccessor.gltf",
    "Lights/Lights.glb",
    "InterpolationTest/InterpolationTest.glb",
    "MeshPrimitiveModes/MeshPrimitiveModes.gltf",
    "Cameras/Cameras.gltf",
    "BoxInterleaved/BoxInterleaved.glb",
    "TextureTransformTest/TextureTransformTest.gltf",
    "teapots_instanced/TeapotsGalore.gltf",
    "MultiUVTest/MultiUVTest.glb",
    "VertexColorTest/VertexColorTest.glb",
};

constexpr std::array<std::string_view, 12> numbers = {
    "0", "-1", "1", "3", "65535", "65536", "99999", "2147483647", "4294967295", "1e38", "-1000000.5", "1e-40"};

std::string read_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc).write(text.data(), static_cast<std::streamsize>(text.size()));
}

class Mutator {
 public:
  explicit Mutator(unsigned int seed) : random_(seed) {}

  std::string mutated(std::string text, bool keep_length) {
    for (std::size_t i = 1 + below(3); i > 0; --i) mutate(text, keep_length);
    return text;
  }

  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

 private:
  void mutate(std::string& text, bool keep_length) {
    if (text.empty()) return;
    switch (below(4)) {
      case 0:
        text[below(text.size())] = static_cast<char>(random_());
        break;
      case 1:
        text[below(text.size())] ^= static_cast<char>(1 << below(8));
        break;
      case 2:
        replace_number(text, keep_length);
        break;
      default:
        if (keep_length)
          replace_number(text, keep_length);
        else
          text.erase(below(text.size()), 1 + below(40));
    }
  }

  // Changes a number of the JSON: hostile files have wrong offsets and counts.
  void replace_number(std::string& text, bool keep_length) {
    const auto at = text.find_first_of("0123456789", below(text.size()));
    if (at == std::string::npos) return;
    const auto end = std::min(text.find_first_not_of("0123456789.", at), text.size());
    std::string number(numbers[below(numbers.size())]);
    // The length stays the same, so that a GLB's chunk lengths remain valid and the document inside is read.
    if (keep_length) number.resize(end - at, ' ');
    text.replace(at, end - at, number);
  }

  std::mt19937 random_;
};

// A private copy of a scene's folder, which the destructor removes.
class Copy {
 public:
  explicit Copy(const std::filesystem::path& folder)
      : path_(std::filesystem::temp_directory_path() / ("penumbra_scene_check_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.is_regular_file()) {
        const auto file = path_ / entry.path().filename();
        write_text(file, read_text(entry.path()));
        files_.push_back(file);
      }
  }
  ~Copy() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> files_;
};

struct Counts {
  int loaded = 0, refused = 0, failed = 0;
};

void check_scene_mutations(const std::filesystem::path& scene, unsigned int seed, Counts& counts) {
  const Copy copy(scene.parent_path());
  const auto main_file = copy.path() / scene.filename();
  Mutator mutator(seed);
  for (int i = 0; i < mutations_a_scene; ++i) {
    // Chooses the file to damage: mostly the glTF, sometimes a buffer or image beside it.
    const auto& target = mutator.below(3) > 0 ? main_file : copy.files()[mutator.below(copy.files().size())];
    const std::string original = read_text(target);
    const bool keep_length = target.extension() != ".gltf" && mutator.below(8) > 0;
    write_text(target, mutator.mutated(original, keep_length));
    start_hang_guard(scene.string() + ", mutation " + std::to_string(i));
    try {
      ++(read_and_check(main_file).outcome == Outcome::loaded ? counts.loaded : counts.refused);
    } catch (const std::exception& e) {
      ++counts.failed;
      std::printf("FAILED: %s, mutation %d: %s\n", scene.c_str(), i, e.what());
    }
    write_text(target, original);
  }
}

}  // namespace

int check_mutations(const std::filesystem::path& scenes) {
  Counts counts;
  unsigned int seed = 1;
  for (const char* base : bases) check_scene_mutations(scenes / base, seed++, counts);
  std::printf("%d loaded, %d refused, %d failed\n", counts.loaded, counts.refused, counts.failed);
  // If all or none of the damaged files were refused, the mutations would not test the reader.
  const bool telling = counts.loaded > 0 && counts.refused > 0;
  if (!telling) std::printf("FAILED: the mutations tell nothing\n");
  return counts.failed + (telling ? 0 : 1);
}

}  // namespace penumbra::test
