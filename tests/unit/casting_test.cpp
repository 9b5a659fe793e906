// Which surfaces cast shadows, as set by extras, by material and by parameters; and that skies cast none.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/casting.h"
#include "scene/sky.h"
#include "support/gltf_files.h"

namespace penumbra::test {
namespace {

using scene::CasterFaces;
using scene::casting_faces;
using scene::CastSetting;
using scene::Material;
using scene::Node;
using scene::Scene;

std::string document(const std::string& node, const std::string& material) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  return gltf.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"nodes":[{"mesh":0)" +
                   node + R"(}],"materials":[{"name":"paint")" + material + "}]");
}

std::string extras(const std::string& value) { return R"(,"extras":{"penumbra_casts":)" + value + "}"; }

TEST(CastSetting, IsReadFromExtras) {
  const std::vector<std::pair<const char*, CastSetting>> values{
      {"false", CastSetting::off},     {"true", CastSetting::on},        {R"("off")", CastSetting::off},
      {R"("on")", CastSetting::on},    {R"("both")", CastSetting::both}, {R"("front")", CastSetting::front},
      {R"("back")", CastSetting::back}};
  for (const auto& [text, casting] : values) {
    EXPECT_EQ(load_text(document(extras(text), "")).nodes[0].casting, casting) << text;
    EXPECT_EQ(load_text(document("", extras(text))).materials[0].casting, casting) << text;
  }
  EXPECT_EQ(load_text(document("", "")).nodes[0].casting, CastSetting::automatic);
  const std::vector<std::string> warnings = warnings_of([] { load_text(document(extras("7"), "")); });
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("nodes[0]: penumbra_casts"), std::string::npos) << warnings[0];
}

TEST(CastSetting, OfANodeStandsOverItsMaterialsAndThatOfTheCommandLineOverBoth) {
  Scene scene = load_text(document(extras(R"("front")"), extras("false")));
  EXPECT_EQ(casting_faces(scene.nodes[0], scene.materials[0], {}), CasterFaces::front);
  EXPECT_TRUE(scene::set_casting(scene, "paint", CastSetting::back));
  EXPECT_EQ(casting_faces(scene.nodes[0], scene.materials[0], {}), CasterFaces::back);
  EXPECT_FALSE(scene::set_casting(scene, "pain", CastSetting::back));
}

TEST(CastSetting, FollowsTheParametersWhereNothingElseIsSaid) {
  Node node;
  Material material;
  EXPECT_EQ(casting_faces(node, material, {.faces = CasterFaces::front}), CasterFaces::front);
  node.casting = CastSetting::on;
  EXPECT_EQ(casting_faces(node, material, {.faces = CasterFaces::front}), CasterFaces::front);
  node.casting = CastSetting::automatic;
  material.double_sided = true;
  EXPECT_EQ(casting_faces(node, material, {.faces = CasterFaces::front}), CasterFaces::both) << "neither is a back";
  node.sky = true;
  EXPECT_EQ(casting_faces(node, material, {}), std::nullopt);
  EXPECT_EQ(casting_faces(node, material, {.skies = true}), CasterFaces::both);
  node.casting = CastSetting::on;
  EXPECT_EQ(casting_faces(node, material, {}), CasterFaces::both);
}

// A sphere, or its upper half, whose triangles face the centre.
scene::Primitive dome(float radius, bool whole, bool inwards = true) {
  constexpr int rings = 16, sectors = 24;
  scene::Primitive primitive;
  const int last = whole ? rings : rings / 2;
  for (int r = 0; r <= last; ++r)
    for (int s = 0; s <= sectors; ++s) {
      const float down = glm::pi<float>() * static_cast<float>(r) / rings;
      const float round = 2 * glm::pi<float>() * static_cast<float>(s) / sectors;
      primitive.positions.push_back(
          radius * glm::vec3(std::sin(down) * std::cos(round), std::cos(down), std::sin(down) * std::sin(round)));
    }
  primitive.normals.assign(primitive.positions.size(), {0, 1, 0});
  for (uint32_t r = 0; r < static_cast<uint32_t>(last); ++r)
    for (uint32_t s = 0; s < sectors; ++s) {
      const uint32_t a = r * (sectors + 1) + s, b = a + sectors + 1;
      // The order of vertices is clockwise as seen from outside: from a to a + 1 the angle goes from +X to +Z.
      if (inwards)
        primitive.indices.insert(primitive.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
      else
        primitive.indices.insert(primitive.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
    }
  return primitive;
}

scene::Primitive box(const glm::vec3& low, const glm::vec3& high, bool inwards) {
  scene::Primitive primitive;
  for (int i = 0; i < 8; ++i)
    primitive.positions.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                     (i & 4) != 0 ? high.z : low.z);
  primitive.normals.assign(8, {0, 1, 0});
  primitive.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  if (inwards)
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
      std::swap(primitive.indices[i], primitive.indices[i + 1]);
  return primitive;
}

class Skies : public testing::Test {
 protected:
  int add(scene::Primitive primitive, const std::string& name = "", const Material& material = {}) {
    primitive.material = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(material);
    const int number = static_cast<int>(scene_.nodes.size());
    scene_.meshes.push_back({.name = "", .primitives = {std::move(primitive)}});
    scene_.nodes.push_back({.name = name, .mesh = number});
    scene_.roots.push_back(number);
    return number;
  }
  void add_things() {
    add(box({-5, -0.1f, -5}, {5, 0, 5}, false), "floor");
    add(box({-1, 0, -1}, {1, 2, 1}, false), "crate");
  }
  std::vector<int> found() const { return scene::find_skies(scene_, scene::rest_pose(scene_)); }

  Scene scene_;
};

using Numbers = std::vector<int>;

TEST_F(Skies, AreKnownByTheirNameTheirMaterialOrTheirDistance) {
  add_things();
  EXPECT_EQ(found(), Numbers{});
  const int number = add(dome(12, false), "");
  EXPECT_EQ(found(), Numbers{}) << "a plain dome that is not far";
  scene_.nodes.back().name = "SkyDome_01";
  EXPECT_EQ(found(), Numbers{number});
  scene_.nodes.back().name = "";
  scene_.materials.back().unlit = true;
  EXPECT_EQ(found(), Numbers{number});
  scene_.materials.back() = {.base_color = {0, 0, 0, 1}, .emissive = {1, 1, 1}};
  EXPECT_EQ(found(), Numbers{number});
  scene_.materials.back() = {.name = "hdri"};
  EXPECT_EQ(found(), Numbers{number});
  scene_.materials.back() = {};
  scene_.meshes.back().primitives[0] = dome(40, false);
  scene_.meshes.back().primitives[0].material = number;
  EXPECT_EQ(found(), Numbers{number}) << "far off";
}

TEST_F(Skies, AreWholeSpheresAndBoxesToo) {
  add_things();
  const int sphere = add(dome(100, true));
  EXPECT_EQ(found(), Numbers{sphere});
  const int cube = add(box(glm::vec3(-200), glm::vec3(200), true), "skybox");
  EXPECT_EQ(found(), (Numbers{cube, sphere})) << "from the outermost inwards";
}

TEST_F(Skies, ShowTheirFront) {
  add_things();
  const glm::mat4 mirror = glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1));
  const int sky = add(dome(100, true, /*inwards=*/false), "sky");
  EXPECT_EQ(found(), Numbers{}) << "nobody inside sees it";
  scene_.nodes.back().matrix = mirror;
  EXPECT_EQ(found(), Numbers{}) << "fronts of mirrored nodes are clockwise, so they face outwards still";
  scene_.materials.back().double_sided = true;
  EXPECT_EQ(found(), Numbers{sky});
  scene_.materials.back().double_sided = false;
  scene_.meshes.back().primitives[0].indices = dome(100, true).indices;
  EXPECT_EQ(found(), Numbers{sky}) << "inwards and mirrored";
}

TEST_F(Skies, AreNoRooms) {
  add(box({-1, 0, -1}, {1, 2, 1}, false), "crate");
  add(box({-30, 0, -30}, {30, 25, 30}, true), "hall");
  EXPECT_EQ(found(), Numbers{}) << "the crate stands on its floor";
}

TEST_F(Skies, HoldAllElse) {
  add_things();
  add(dome(100, true), "sky");
  add(box({150, 0, 0}, {160, 5, 5}, false), "far tower");
  EXPECT_EQ(found(), Numbers{});
  scene_.roots.pop_back();
  EXPECT_EQ(found(), Numbers{2}) << "what is not drawn does not count";
}

TEST_F(Skies, AreOpenBelowButNotAbove) {
  add_things();
  scene::Primitive open = dome(100, true);
  open.indices.erase(open.indices.begin(), open.indices.begin() + 24 * 6 * 4);  // leaves a hole at the top
  add(std::move(open), "sky");
  EXPECT_EQ(found(), Numbers{});
}

TEST(SkyWarning, NamesNodeAndMaterial) {
  GltfBuilder gltf;
  const scene::Primitive sphere = dome(50, true);
  std::vector<float> positions;
  for (const glm::vec3& p : sphere.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  gltf.add(positions, "VEC3", 3);
  gltf.add(sphere.indices, "SCALAR", 1);
  gltf.add(std::vector<float>{0, 0, 0, 0, 0, 1, 1, 0, 0}, "VEC3", 3);
  const auto text = [&](const std::string& more) {
    return gltf.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},)"
                     R"({"primitives":[{"attributes":{"POSITION":2}}]}],"materials":[{"name":"Clouds"}],)"
                     R"("nodes":[{"name":"Dome","mesh":0)" +
                     more + R"(},{"mesh":1}])");
  };
  const auto warnings_about = [](scene::Scene scene) {
    EXPECT_TRUE(scene.nodes[0].sky);
    return warnings_of([&] { scene::warn_of_skies("a.gltf", scene); });
  };
  const std::vector<std::string> warnings = warnings_about(load_text(text("")));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("node 'Dome' (material 'Clouds') encloses the scene as a sky does; "
                             "it casts no shadow unless casters.skies is on"),
            std::string::npos)
      << warnings[0];
  for (const char* decided : {"true", "false"})
    EXPECT_TRUE(warnings_about(load_text(text(extras(decided)))).empty()) << decided;
  scene::Scene chosen = load_text(text(""));
  scene::set_casting(chosen, "Clouds", CastSetting::off);
  EXPECT_TRUE(warnings_about(std::move(chosen)).empty());
}

}  // namespace
}  // namespace penumbra::test
