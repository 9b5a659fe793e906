// The cache of traced pictures: which inputs are part of its key, which files it accepts, and how much it keeps.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "support/temp_folder.h"
#include "truth/cache.h"

namespace penumbra::test {
namespace {

namespace fs = std::filesystem;
using truth::Cache;
using truth::Key;

class TruthCache : public testing::Test {
 protected:
  // A file of 1000 pixels is a little over 12,000 bytes.
  static truth::Traced traced(float value) {
    return {.visibility = std::vector<float>(1000, value),
            .standard_error = std::vector<float>(1000, value / 2),
            .hard = std::vector<float>(1000, 1),
            .rays = 7,
            .seconds = 0.5,
            .samples = 64};
  }
  void age(const Key& key, int hours) const {
    const fs::path file = folder_ / (key.text() + ".truth");
    fs::last_write_time(file, fs::last_write_time(file) - std::chrono::hours(hours));
  }

  test::TempFolder temp_;
  fs::path folder_ = temp_.path() / "cache";
};

TEST_F(TruthCache, GivesBackWhatItKept) {
  const Cache cache(folder_);
  const Key key{1, 2};
  EXPECT_FALSE(cache.find(key, 1000));
  cache.keep(key, traced(0.25f));
  const auto found = cache.find(key, 1000);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->visibility, traced(0.25f).visibility);
  EXPECT_EQ(found->standard_error, traced(0.25f).standard_error);
  EXPECT_EQ(found->hard, traced(0.25f).hard);
  EXPECT_EQ(found->rays, 7);
  EXPECT_EQ(found->samples, 64);
  EXPECT_FALSE(cache.find({2, 1}, 1000));
  EXPECT_FALSE(cache.find(key, 999)) << "a picture of another size";
}

TEST_F(TruthCache, DoesNotBelieveAFileOfAnotherName) {
  const Cache cache(folder_);
  cache.keep({1, 2}, traced(1));
  fs::rename(folder_ / (Key{1, 2}.text() + ".truth"), folder_ / (Key{3, 4}.text() + ".truth"));
  EXPECT_FALSE(cache.find({3, 4}, 1000));
}

TEST_F(TruthCache, DoesNotBelieveADamagedFile) {
  const Cache cache(folder_);
  const Key key{1, 2};
  cache.keep(key, traced(0.25f));
  const fs::path file = folder_ / (key.text() + ".truth");
  std::string good(fs::file_size(file), ' ');
  std::ifstream(file, std::ios::binary).read(good.data(), static_cast<std::streamsize>(good.size()));
  const auto write = [&](const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; };
  for (std::size_t at = 0; at < good.size(); at += at < 120 ? 1 : 97) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    write(bad);
    EXPECT_FALSE(cache.find(key, 1000)) << "byte " << at;
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{50}, good.size() / 2, good.size() - 1}) {
    write(good.substr(0, length));
    EXPECT_FALSE(cache.find(key, 1000)) << length << " bytes";
  }
  write(good + "x");
  EXPECT_FALSE(cache.find(key, 1000));
  cache.keep(key, traced(0.25f));  // traced again
  EXPECT_TRUE(cache.find(key, 1000));
}

TEST_F(TruthCache, LeavesAloneWhatAnotherProcessIsWriting) {
  const Cache cache(folder_, 40'000);
  cache.keep({0, 1}, traced(1));
  const fs::path other = folder_ / ".00000000000000000000000000000001.truth.Ab12Cd";
  std::ofstream(other) << std::string(30'000, 'x');
  cache.keep({0, 2}, traced(1));
  EXPECT_TRUE(fs::exists(other));
  EXPECT_FALSE(cache.find({0, 1}, 1000)) << "the limit counts what is being written";
  EXPECT_TRUE(cache.find({0, 2}, 1000));
}

TEST_F(TruthCache, LetsGoOfWhatWasNotUsedForLongest) {
  const Cache cache(folder_, 40'000);
  for (const std::uint64_t i : {1u, 2u, 3u}) {
    cache.keep({0, i}, traced(1));
    age({0, i}, static_cast<int>(10 - i));
  }
  EXPECT_TRUE(cache.find({0, 1}, 1000));  // used just now, so it is no longer the oldest
  const std::vector<std::string> others{"of somebody else", "ground.truth", ".the.truth.old",
                                        "00000000000000000000000000000001.truths"};
  for (const std::string& name : others) std::ofstream(folder_ / name) << std::string(100'000, 'x');
  cache.keep({0, 4}, traced(1));
  EXPECT_TRUE(cache.find({0, 1}, 1000));
  EXPECT_FALSE(cache.find({0, 2}, 1000));
  EXPECT_TRUE(cache.find({0, 3}, 1000));
  EXPECT_TRUE(cache.find({0, 4}, 1000));
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
}

TEST_F(TruthCache, LetsGoOfWhatAKilledProcessLeft) {
  const Cache cache(folder_, 40'000);
  cache.keep({0, 1}, traced(1));
  const fs::path left = folder_ / ".00000000000000000000000000000001.truth.Ab12Cd";
  std::ofstream(left) << std::string(30'000, 'x');
  fs::last_write_time(left, fs::last_write_time(left) - std::chrono::hours(48));
  cache.keep({0, 2}, traced(1));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(cache.find({0, 1}, 1000));
}

// As many machines do: none sees a part of a file, and together they exceed the limit by no more than one file each.
TEST_F(TruthCache, IsSharedByManyProcesses) {
  constexpr int processes = 8, pictures = 60;
  constexpr std::uintmax_t largest = 60'000, file_bytes = 13'000;  // room for four
  std::vector<pid_t> children;
  for (int number = 0; number < processes; ++number) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child > 0) {
      children.push_back(child);
      continue;
    }
    const Cache cache(folder_, largest);
    bool good = true;
    for (int i = 0; i < pictures; ++i) {
      // Half of the pictures are the same in all processes.
      const Key key{i % 2 == 0 ? 0u : static_cast<std::uint64_t>(number), static_cast<std::uint64_t>(i)};
      const auto value = static_cast<float>(key.high * 1000 + key.low);
      cache.keep(key, traced(value));
      const auto found = cache.find(key, 1000);
      good = good && (!found || found->visibility == traced(value).visibility);
    }
    _exit(good ? 0 : 1);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().extension(), ".truth") << entry.path();
    bytes += entry.file_size();
  }
  EXPECT_LE(bytes, largest + processes * file_bytes);
  Cache(folder_, largest).keep({9, 9}, traced(1));
  bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) bytes += entry.file_size();
  EXPECT_LE(bytes, largest);
}

TEST_F(TruthCache, KeepsNothingThatIsLargerThanAllOfIt) {
  const Cache cache(folder_, 10'000);
  cache.keep({0, 1}, traced(1));
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(TruthCache, WithoutAFolderKeepsNothing) {
  const Cache cache({});
  cache.keep({0, 1}, traced(1));
  EXPECT_FALSE(cache.find({0, 1}, 1000));
}

// A leaf whose alpha texture decides what casts, with no surface below it.
struct Leaf {
  Leaf() {
    scene.images = {{.width = 2, .height = 1, .rgba = {0, 0, 0, 255, 0, 0, 0, 0}}};
    scene.textures = {{.image = 0}};
    scene.materials = {{.base_color_texture = {.texture = 0}, .alpha_mode = scene::AlphaMode::mask}};
    primitive = {.indices = {0, 1, 2}, .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .material = 0};
    primitive.uvs[0] = {{0, 0}, {1, 0}, {0, 1}};
  }

  Key key() {
    scene::PosedGeometry geometry;
    geometry.surfaces = {{.primitive = &primitive, .positions = primitive.positions, .world = world, .casts = casts}};
    return truth::key_of(scene, geometry);
  }

  scene::Scene scene;
  scene::Primitive primitive;
  glm::mat4 world{1};
  scene::CastMode casts = scene::CastMode::by_alpha;
};

TEST(TruthKey, DiffersWithAllThatCastersAreMadeOf) {
  std::set<std::string> keys{Leaf().key().text()};
  EXPECT_TRUE(keys.contains(Leaf().key().text()));
  const auto differs = [&](const char* what, auto change) {
    Leaf leaf;
    change(leaf);
    EXPECT_TRUE(keys.insert(leaf.key().text()).second) << what;
  };
  differs("position", [](Leaf& l) { l.primitive.positions[1].x = 1.0000001f; });
  differs("index", [](Leaf& l) { l.primitive.indices = {0, 2, 1}; });
  differs("place", [](Leaf& l) { l.world[3].x = 1; });
  differs("kind of caster", [](Leaf& l) { l.casts = scene::CastMode::always; });
  differs("none", [](Leaf& l) { l.casts = scene::CastMode::never; });
  differs("texels", [](Leaf& l) { l.scene.images[0].rgba[3] = 254; });
  differs("wrap", [](Leaf& l) { l.scene.textures[0].wrap_s = scene::Wrap::clamp_to_edge; });
  differs("filter", [](Leaf& l) { l.scene.textures[0].mag = scene::Filter::nearest; });
  differs("texture coordinates", [](Leaf& l) { l.primitive.uvs[0][1].x = 2; });
  differs("set of them", [](Leaf& l) { l.scene.materials[0].base_color_texture.uv_set = 1; });
  differs("transform of them", [](Leaf& l) { l.scene.materials[0].base_color_texture.uv_transform[2].x = 0.5f; });
  differs("colour", [](Leaf& l) { l.primitive.colors = {glm::vec4(1), glm::vec4(1), glm::vec4(0.5f)}; });
  differs("material's alpha", [](Leaf& l) { l.scene.materials[0].base_color.a = 0.9f; });
  differs("cutoff", [](Leaf& l) { l.scene.materials[0].alpha_cutoff = 0.4f; });
}

TEST(TruthKey, DoesNotDifferWithWhatNoRaySees) {
  const Key key = Leaf().key();
  Leaf leaf;
  leaf.scene.materials[0].roughness = 0.1f;
  leaf.scene.materials[0].emissive = glm::vec3(3);
  leaf.primitive.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  EXPECT_EQ(leaf.key(), key);
}

}  // namespace
}  // namespace penumbra::test
