// Hierarchy, skins, instances, cameras, lights and animations as the reader checks them.

#include <gtest/gtest.h>

#include <cmath>

#include "render/setup.h"
#include "scene/pose.h"
#include "scene/scene_info.h"
#include "support/gltf_files.h"
#include "support/scene_faults.h"

namespace penumbra::test {
namespace {

using scene::Scene;

std::string document(const std::string& rest) { return R"({"asset":{"version":"2.0"},)" + rest + "}"; }

void expect_fault(const std::string& rest, const std::string& fault) {
  const std::string message = error_of([&] { load_text(document(rest)); });
  EXPECT_NE(message.find(fault), std::string::npos) << "'" << message << "' should say '" << fault << "'";
}

TEST(GltfNode, RefusesGraphsThatAreNoForest) {
  expect_fault(R"("nodes":[{"children":[0]}])", "nodes[0] is its own child");
  expect_fault(R"("nodes":[{"children":[1]},{"children":[2]},{"children":[0]}])", "belongs to a cycle");
  expect_fault(R"("nodes":[{"children":[2]},{"children":[2]},{}])", "nodes[2] has two parents, 0 and 1");
  expect_fault(R"("nodes":[{"children":[1,1]},{}])", "nodes[1] has two parents");
  expect_fault(R"("nodes":[{"children":[7]}])", "nodes[0].children[0] is 7, but there are 1 nodes");
  expect_fault(R"("nodes":[{"children":[1]},{}],"scenes":[{"nodes":[1]}])", "which has a parent");
  expect_fault(R"("nodes":[{}],"scenes":[{"nodes":[0,0]}])", "lists a node twice");
}

TEST(GltfNode, RefusesHierarchiesDeeperThanTheLimit) {
  std::string nodes;
  for (int i = 1; i < 50; ++i) nodes += fmt::format(R"({{"children":[{}]}},)", i);
  const std::string text = document(R"("nodes":[)" + nodes + "{}]");
  EXPECT_NO_THROW(load_text(text, {.node_depth = 50}));
  EXPECT_NE(error_of([&] {
              load_text(text, {.node_depth = 49});
            }).find("50 levels deep, over the limit of 49; --limit node-depth=N"),
            std::string::npos);
}

TEST(GltfNode, DrawsTheDefaultSceneOrTheFirst) {
  const std::string scenes = R"("nodes":[{},{}],"scenes":[{"nodes":[0]},{"nodes":[1]}])";
  EXPECT_EQ(load_text(document(scenes)).roots, std::vector<int>{0});
  EXPECT_EQ(load_text(document(scenes + R"(,"scene":1)")).roots, std::vector<int>{1});
  EXPECT_EQ(load_text(document(R"("nodes":[{"children":[1]},{}])")).roots, std::vector<int>{0});
}

TEST(GltfNode, RefusesProjectiveMatrices) {
  expect_fault(R"("nodes":[{"matrix":[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1]}])", "last row");
  expect_fault(R"("nodes":[{"matrix":[1,0,0]}])", "has 3 numbers, not 16");
}

TEST(GltfNode, MakesUnitQuaternions) {
  const Scene scene = load_text(document(R"("nodes":[{"rotation":[0,0,0,0]},{"rotation":[0,2,0,0]}])"));
  EXPECT_EQ(scene.nodes[0].transform.rotation, glm::quat(1, 0, 0, 0));
  EXPECT_EQ(scene.nodes[1].transform.rotation, glm::quat(0, 0, 1, 0));
}

TEST(GltfNode, ReadsInstances) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{10, 0, 0, 20, 0, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{2, 2, 2, 3, 3, 3}, "VEC3", 3);
  const std::string mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0,)"
                           R"("extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1,"SCALE":)";
  const Scene scene = load_text(gltf.text(mesh + "2}}}}]"));
  check_scene(scene);
  ASSERT_EQ(scene.nodes[0].instances.size(), 2u);
  EXPECT_EQ(scene::bounds_of(scene, scene::rest_pose(scene)).max, glm::vec3(23, 3, 0));
  EXPECT_THROW(load_text(gltf.text(mesh + "0}}}}]")), Error) << "three scales for two translations";

  gltf.add(std::vector<float>{0, std::sqrt(0.5f), 0, std::sqrt(0.5f), 0, 0, 0, 1}, "VEC4", 4);
  const Scene turned = load_text(gltf.text(mesh + R"(2,"ROTATION":3}}}}])"));
  check_scene(turned);
  const scene::Bounds bounds = scene::bounds_of(turned, scene::rest_pose(turned));  // +X turned to -Z
  EXPECT_LT(glm::distance(bounds.min, glm::vec3(10, 0, -2)), 1e-5f);
  EXPECT_LT(glm::distance(bounds.max, glm::vec3(23, 3, 0)), 1e-5f);
}

TEST(GltfNode, RefusesJointsBeyondTheSkin) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0}, "VEC3", 3);
  gltf.add(std::vector<uint8_t>{5, 0, 0, 0}, "VEC4", 4);
  gltf.add(std::vector<float>{1, 0, 0, 0}, "VEC4", 4);
  const std::string text =
      gltf.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"mode":0}]}],)"
                R"("nodes":[{"mesh":0,"skin":0},{}],"skins":[{"joints":[1]}])");
  EXPECT_NE(error_of([&] { load_text(text); }).find("uses joint 5, but its skin has 1"), std::string::npos);
}

TEST(GltfNode, ReadsCameras) {
  const Scene scene =
      load_text(document(R"("cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.01}},)"
                         R"({"type":"orthographic","orthographic":{"xmag":2,"ymag":-3,"znear":0,"zfar":9}}])"));
  EXPECT_FALSE(scene.cameras[0].far) << "infinite";
  EXPECT_EQ(scene.cameras[1].half_height, 3);
  EXPECT_EQ(scene.cameras[1].far, 9);
  const std::string placed = R"("nodes":[{"camera":0}],"cameras":)";
  expect_fault(placed + R"([{"type":"perspective","perspective":{"yfov":0.7,"znear":1,"zfar":0.5}}])", "not beyond");
  expect_fault(placed + R"([{"type":"perspective","perspective":{"yfov":4,"znear":1}}])", "yfov is 4, outside");
  expect_fault(placed + R"([{"type":"orthographic","orthographic":{"xmag":0,"ymag":1,"znear":0,"zfar":9}}])", "zero");
}

// As --camera counts and names them: by the nodes that are drawn.
TEST(GltfNode, CamerasAreListedAsTheyAreChosen) {
  const std::string lens = R"("type":"perspective","perspective":{"yfov":0.7,"znear":0.01})";
  const Scene scene =
      load_text(document(R"("cameras":[{"name":"low",)" + lens + "},{" + lens + R"(},{"name":"unused",)" + lens +
                         R"(}],"nodes":[{"name":"Top","camera":1},{"name":"x","camera":0}])"));
  std::vector<std::string> names;
  for (const scene::CameraInfo& camera : scene::describe(scene).cameras) names.push_back(camera.name);
  EXPECT_EQ(names, (std::vector<std::string>{"Top", "low"}));
  EXPECT_EQ(names, render::camera_names(scene));
}

TEST(GltfNode, ReadsLightsAndLeavesUnknownOnesOut) {
  const Scene scene = load_text(document(
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"area"},{"type":"spot","color":[1,0.5,0],)"
      R"("intensity":20,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.3}}]}},"nodes":[)"
      R"({"extensions":{"KHR_lights_punctual":{"light":0}}},{"extensions":{"KHR_lights_punctual":{"light":1}}}])"));
  EXPECT_EQ(scene.nodes[0].light, -1);
  ASSERT_EQ(scene.nodes[1].light, 0);
  EXPECT_EQ(scene.lights[0].kind, scene::LightKind::spot);
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1, 0.5f, 0));
  EXPECT_FLOAT_EQ(scene.lights[0].outer_cone, 0.3f);
  expect_fault(R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}],)"
               R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":-1}]}})",
               "intensity is -1, outside");
  expect_fault(R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])", "light is 0, but there are 0");
}

// Exporters write equal angles for a hard edge, and 0 for a light that reaches everywhere.
TEST(GltfNode, ASpotMayHaveAHardEdgeAndALightARangeOf0) {
  const auto spot = [](const std::string& angles) {
    return load_text(document(R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","range":0,"spot":{)" +
                              angles + R"(}}]}},"nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])"))
        .lights.at(0);
  };
  EXPECT_EQ(spot(R"("innerConeAngle":0.5,"outerConeAngle":0.5)").inner_cone, 0.5f);
  EXPECT_EQ(spot(R"("innerConeAngle":0.5,"outerConeAngle":0.5)").range, 0);
  EXPECT_EQ(spot(R"("innerConeAngle":0.6,"outerConeAngle":0.5)").inner_cone, 0.5f) << "with a warning";
}

TEST(GltfNode, ReadsTheRadiusOfALampFromItsExtras) {
  const auto radius_of = [](const std::string& extras) {
    return load_text(document(R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","extras":)" + extras +
                              R"(}]}},"nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])"))
        .lights.at(0)
        .radius;
  };
  EXPECT_EQ(radius_of(R"({"radius":0.25})"), 0.25f);
  EXPECT_EQ(radius_of(R"({"radius":0})"), 0.0f);
  for (const char* extras :
       {R"({})", R"({"radius":-1})", R"({"radius":1e30})", R"({"radius":"big"})", R"({"size":2})", "3"})
    EXPECT_FALSE(radius_of(extras)) << extras;
}

std::string animated(const std::vector<float>& times, const std::vector<float>& values,
                     const std::string& interpolation) {
  GltfBuilder gltf;
  gltf.add(times, "SCALAR", 1);
  gltf.add(values, "VEC3", 3);
  return gltf.text(R"("nodes":[{"matrix":[2,0,0,0,0,2,0,0,0,0,2,0,5,6,7,1]}],"animations":[{"samplers":[{"input":0,)"
                   R"("output":1,"interpolation":")" +
                   interpolation + R"("}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])");
}

TEST(GltfAnimation, ChecksKeys) {
  EXPECT_NO_THROW(load_text(animated({0, 1}, {0, 0, 0, 1, 1, 1}, "LINEAR")));
  EXPECT_THROW(load_text(animated({1, 0}, {0, 0, 0, 1, 1, 1}, "LINEAR")), Error) << "times go back";
  EXPECT_THROW(load_text(animated({-1, 0}, {0, 0, 0, 1, 1, 1}, "LINEAR")), Error) << "before zero";
  EXPECT_THROW(load_text(animated({0, 1}, {0, 0, 0, 1, 1, 1}, "CUBICSPLINE")), Error) << "no tangents";
  EXPECT_THROW(load_text(animated({0, 1}, {0, 0, 0}, "LINEAR")), Error) << "a value is missing";
}

// Exporters write two keys at one time for a jump, also at the beginning and at the end.
TEST(GltfAnimation, EqualKeysAreAJump) {
  const Scene scene = load_text(
      animated({0, 0, 1, 1, 1, 2, 2}, {9, 0, 0, 0, 0, 0, 1, 0, 0, 7, 0, 0, 5, 0, 0, 6, 0, 0, 8, 0, 0}, "LINEAR"));
  check_scene(scene);
  const auto place_at = [&](double time) { return scene::pose_at(scene, time).world[0][3].x; };
  EXPECT_EQ(place_at(0), 0);
  EXPECT_EQ(place_at(0.5), 0.5f);
  EXPECT_NEAR(place_at(0.999), 1, 2e-3f);
  EXPECT_EQ(place_at(1), 5);
  EXPECT_EQ(place_at(1.5), 5.5f);
}

TEST(GltfAnimation, MovesANodeThatWasGivenByAMatrix) {
  const Scene scene = load_text(animated({0, 1}, {1, 0, 0, 3, 0, 0}, "LINEAR"));
  const glm::mat4 world = scene::pose_at(scene, 0.5).world[0];
  EXPECT_EQ(glm::vec3(world[3]), glm::vec3(2, 0, 0));
  EXPECT_FLOAT_EQ(world[1][1], 2) << "its scale stays";
}

}  // namespace
}  // namespace penumbra::test
