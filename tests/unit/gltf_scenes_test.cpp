// Public scenes, from $PENUMBRA_ASSETS: all load, fulfil what scene.h promises, and have the expected contents.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "image/read.h"
#include "scene/gltf.h"
#include "scene/scene_info.h"
#include "support/gltf_files.h"
#include "support/scene_faults.h"

namespace penumbra::test {
namespace {

using scene::Scene;

class PublicScenes : public testing::Test {
 protected:
  void SetUp() override {
    const char* const assets = std::getenv("PENUMBRA_ASSETS");
    if (assets != nullptr) folder_ = std::filesystem::path(assets) / "scenes";
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "skipped: PENUMBRA_ASSETS names no folder with scenes";
  }

  Scene load(const std::string& name) const { return scene::read_gltf(folder_ / name, image::image_decoder()); }

  std::filesystem::path folder_;
};

// Files that readers of glTF 2.0 must refuse.
bool must_be_refused(const std::filesystem::path& file) { return file.filename() == "Compatibility_04.gltf"; }

std::vector<std::filesystem::path> scenes_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST_F(PublicScenes, AllLoad) {
  std::size_t count = 0;
  for (const auto& file : scenes_below(folder_)) {
    ++count;
    const std::string fault = error_of([&] {
      const Scene scene = scene::read_gltf(file, image::image_decoder());
      check_scene(scene);
      if (scene::describe(scene).bounds.empty) fail("nothing to draw");
    });
    EXPECT_EQ(fault.empty(), !must_be_refused(file)) << file << ": " << fault;
  }
  EXPECT_GE(count, 113u);
}

TEST_F(PublicScenes, HoldTheTrianglesThatTheirMakersCounted) {
  const std::vector<std::pair<const char*, std::size_t>> counts = {
      {"zdm2/zdm2.glb", 58'772},
      {"small_city/scene.gltf", 36'930},
      {"steelribs/steelribs.glb", 45'904},
      {"dutch_ship/dutch_ship_medium_1k.gltf", 69'162},
      {"ToyCar/ToyCar.gltf", 108'936},
      {"box_meshopt/BoxMeshopt.glb", 12},
      {"MeshPrimitiveModes/MeshPrimitiveModes.gltf", 16},
      {"SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12}};
  for (const auto& [name, triangles] : counts) EXPECT_EQ(scene::describe(load(name)).triangles, triangles) << name;
}

TEST_F(PublicScenes, TeapotsAreInstanced) {
  const Scene scene = load("teapots_instanced/TeapotsGalore.gltf");
  std::vector<std::size_t> counts;
  for (const scene::Node& node : scene.nodes)
    if (!node.instances.empty()) counts.push_back(node.instances.size());
  EXPECT_EQ(counts, (std::vector<std::size_t>{958, 941}));
}

void expect_same_bounds(const Scene& a, const Scene& b, double seconds, float tolerance) {
  const scene::Bounds first = scene::bounds_of(a, scene::pose_at(a, seconds));
  const scene::Bounds second = scene::bounds_of(b, scene::pose_at(b, seconds));
  EXPECT_LT(glm::distance(first.min, second.min), tolerance) << seconds;
  EXPECT_LT(glm::distance(first.max, second.max), tolerance) << seconds;
}

struct Corner {
  glm::vec3 position, normal;
  glm::vec2 uv;
};
using Triangle = std::array<Corner, 3>;

std::vector<Triangle> triangles_of(const Scene& scene) {
  std::vector<Triangle> triangles;
  for (const scene::Mesh& mesh : scene.meshes) {
    for (const scene::Primitive& primitive : mesh.primitives) {
      const std::vector<glm::vec2>& uvs = primitive.uvs[0];
      for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        Triangle& triangle = triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
          const uint32_t vertex = primitive.indices[i + k];
          triangle[k] = {primitive.positions[vertex], primitive.normals[vertex],
                         uvs.empty() ? glm::vec2(0) : uvs[vertex]};
        }
      }
    }
  }
  return triangles;
}

bool alike(const Corner& a, const Corner& b, float tolerance) {
  return glm::distance(a.position, b.position) < tolerance && glm::distance(a.normal, b.normal) < tolerance &&
         glm::distance(a.uv, b.uv) < tolerance;
}

// Whichever corner is the first.
bool alike(const Triangle& a, const Triangle& b, float tolerance) {
  for (std::size_t first = 0; first < 3; ++first) {
    if (alike(a[0], b[first], tolerance) && alike(a[1], b[(first + 1) % 3], tolerance) &&
        alike(a[2], b[(first + 2) % 3], tolerance))
      return true;
  }
  return false;
}

// Each triangle of `a` is one of `b`, in whatever order.
void expect_same_triangles(const Scene& a, const Scene& b, float tolerance) {
  const std::vector<Triangle> of_a = triangles_of(a), of_b = triangles_of(b);
  ASSERT_FALSE(of_a.empty());
  ASSERT_EQ(of_a.size(), of_b.size());
  const auto missing = std::ranges::count_if(of_a, [&](const Triangle& triangle) {
    return std::ranges::none_of(of_b, [&](const Triangle& other) { return alike(triangle, other, tolerance); });
  });
  EXPECT_EQ(missing, 0);
}

TEST_F(PublicScenes, CompressionChangesNothingVisible) {
  const Scene plain = load("CesiumMan/CesiumMan.glb"), draco = load("CesiumMan_draco/CesiumMan.gltf");
  expect_same_triangles(plain, draco, 0.02f);
  const Scene cube = load("AnimatedMorphCube/AnimatedMorphCube.glb"),
              quantized = load("AnimatedMorphCube_quantized/AnimatedMorphCube.gltf");
  EXPECT_EQ(scene::describe(cube).morph_targets, scene::describe(quantized).morph_targets);
  for (const double seconds : {0.0, 0.4, 1.3, 2.1}) {
    expect_same_bounds(plain, draco, seconds, 0.004f);
    expect_same_bounds(cube, quantized, seconds, 0.004f);
  }
  EXPECT_EQ(scene::describe(load("box_meshopt/BoxMeshopt.glb")).bounds.extent(), glm::vec3(1));
}

TEST_F(PublicScenes, HoldAnimationsLightsAndCameras) {
  const scene::SceneInfo robot = scene::describe(load("robot/robot.glb"));
  EXPECT_EQ(robot.animations.size(), 14u);
  EXPECT_EQ(std::count_if(robot.animations.begin(), robot.animations.end(), [](const auto& a) { return a.played; }), 1)
      << "clips for one skeleton exclude each other";
  const scene::SceneInfo interpolation = scene::describe(load("InterpolationTest/InterpolationTest.glb"));
  EXPECT_TRUE(std::all_of(interpolation.animations.begin(), interpolation.animations.end(),
                          [](const auto& a) { return a.played; }));
  EXPECT_EQ(scene::describe(load("LightsPunctualLamp/LightsPunctualLamp.gltf")).lights.size(), 5u);
  EXPECT_EQ(scene::describe(load("ToyCar/ToyCar.gltf")).cameras.size(), 8u);
  EXPECT_EQ(load("MultipleScenes/MultipleScenes.gltf").roots.size(), 1u);
}

TEST_F(PublicScenes, NamesWithSpacesAndBeyondAsciiLoad) {
  EXPECT_EQ(load("Box With Spaces/Box With Spaces.gltf").images.size(), 3u);
  EXPECT_EQ(load("Unicode❤♻Test/Unicode❤♻Test.gltf").images.size(), 1u);
}

}  // namespace
}  // namespace penumbra::test
