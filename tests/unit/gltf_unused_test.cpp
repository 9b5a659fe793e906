// What nothing drawn uses can't refuse a scene: it is left out, with a warning that names its place.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/gltf_files.h"
#include "support/scene_faults.h"

namespace penumbra::test {
namespace {

using scene::Scene;

// A triangle that is drawn, by accessor 0, beside what each test adds; `arrays` are further members.
std::string drawn_triangle(const std::string& arrays, const std::string& accessors = "") {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" +
         data_uri(bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0})) +
         R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,)"
         R"("count":3,"type":"VEC3"})" +
         accessors + "]," + arrays + "}";
}

constexpr const char* scene_part = R"("scenes":[{"nodes":[0]}])";
std::string meshes(const std::string& more = "") {
  return R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]})" + more + "]";
}
std::string nodes(const std::string& more = "") { return R"("nodes":[{"mesh":0})" + more + "]"; }

// Expects that the scene loads, with one warning that names the place.
void expect_left_out(const std::string& text, const std::string& place) {
  const std::vector<std::string> warnings = warnings_of([&] {
    const std::string fault = error_of([&] {
      const Scene scene = load_text(text);
      check_scene(scene);
      EXPECT_EQ(scene.meshes[0].primitives.size(), 1u) << place;
    });
    EXPECT_EQ(fault, "") << place;
  });
  ASSERT_EQ(warnings.size(), 1u) << place;
  EXPECT_NE(warnings[0].find("scene.gltf: " + place), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("nothing that is drawn uses it"), std::string::npos) << warnings[0];
}

void expect_refused(const std::string& text) {
  EXPECT_NE(error_of([&] { load_text(text); }), "") << text;
}

TEST(GltfUnused, AccessorsAndBufferViewsAndBuffers) {
  const std::string rest = meshes() + "," + nodes() + "," + scene_part;
  expect_left_out(drawn_triangle(rest, R"(,{"componentType":1,"count":3,"type":"VEC3"})"), "accessors[1]");
  expect_left_out(drawn_triangle(rest, R"(,{"componentType":5126,"count":0,"type":"VEC3"})"), "accessors[1]");
  std::string views = drawn_triangle(rest);
  views.replace(views.find(R"(}],"accessors")"), 2, R"(},{"buffer":0,"byteOffset":30,"byteLength":7}])");
  expect_left_out(views, "bufferViews[1]");
  std::string buffers = drawn_triangle(rest);
  buffers.replace(buffers.find(R"(}],"bufferViews")"), 2, R"(},{"byteLength":7,"uri":"missing.bin"}])");
  expect_left_out(buffers, "buffers[1]");
}

TEST(GltfUnused, SkinsCamerasAndLights) {
  const std::string rest = meshes() + "," + nodes(",{}") + "," + scene_part + ",";
  expect_left_out(drawn_triangle(rest + R"("skins":[{"joints":[]}])"), "skins[0]");
  expect_left_out(drawn_triangle(rest + R"("skins":[{"joints":[9]}])"), "skins[0]");
  expect_left_out(drawn_triangle(rest + R"("skins":[{"joints":[1],"inverseBindMatrices":0}])"), "skins[0]");
  expect_left_out(drawn_triangle(rest + R"("cameras":[{"type":"fisheye"}])"), "cameras[0]");
  expect_left_out(drawn_triangle(rest + R"("cameras":[{"type":"perspective","perspective":)"
                                        R"({"yfov":0.7,"znear":1,"zfar":0.5}}])"),
                  "cameras[0]");
  expect_left_out(drawn_triangle(rest + R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot",)"
                                        R"("spot":{"innerConeAngle":0.1,"outerConeAngle":2}}]}})"),
                  "extensions.KHR_lights_punctual.lights[0]");
  for (const char* type : {"perspective", "orthographic"})
    expect_left_out(drawn_triangle(rest + fmt::format(R"("cameras":[{{"type":"{}"}}])", type)), "cameras[0]");
  expect_left_out(drawn_triangle(rest + R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot"}]}})"),
                  "extensions.KHR_lights_punctual.lights[0].spot is missing");
  const std::string used = meshes() + R"(,"nodes":[{"mesh":0,"camera":0}],)" + scene_part + ",";
  expect_refused(drawn_triangle(used + R"("cameras":[{"type":"fisheye"}])"));
  const std::string without = drawn_triangle(used + R"("cameras":[{"type":"perspective"}])");
  EXPECT_NE(error_of([&] { load_text(without); }).find("cameras[0].perspective is missing"), std::string::npos);
}

TEST(GltfUnused, MeshesMaterialsAndImages) {
  const std::string rest = nodes() + "," + scene_part + ",";
  expect_left_out(drawn_triangle(rest + meshes(R"(,{"primitives":[{"attributes":{"POSITION":9}}]})")), "meshes[1]");
  expect_left_out(drawn_triangle(rest + meshes(R"(,{"primitives":[{"attributes":{"POSITION":0},"targets":[{}]},)"
                                               R"({"attributes":{"POSITION":0}}]})")),
                  "meshes[1]");
  expect_left_out(drawn_triangle(rest + meshes() + R"(,"materials":[{"alphaMode":"GLASS"}])"), "materials[0]");
  expect_left_out(drawn_triangle(rest + meshes() +
                                 R"(,"images":[{"uri":"missing.png"}],"textures":[{"source":0}],)"
                                 R"("materials":[{"emissiveTexture":{"index":0}}])"),
                  "images[0]");
}

TEST(GltfUnused, NodesOutsideOfTheScene) {
  const std::string rest = meshes() + "," + std::string(scene_part) + ",";
  expect_left_out(drawn_triangle(rest + nodes(R"(,{"matrix":[1,2,3]})")), "nodes[1]");
  expect_left_out(drawn_triangle(rest + nodes(R"(,{"children":[1]})")), "nodes[1] is its own child");
  expect_left_out(drawn_triangle(rest + nodes(R"(,{"children":[2]},{"children":[2]})")), "nodes[2]");
  expect_refused(drawn_triangle(rest + nodes(R"(,{"children":[0]})")));
}

TEST(GltfUnused, AnimationsOfWhatIsNotDrawn) {
  const std::string rest = meshes() + "," + scene_part + "," + nodes(",{}") + ",";
  const auto animation = [](int node) {
    return R"("animations":[{"samplers":[{"input":0,"output":0}],"channels":[{"sampler":0,"target":{"node":)" +
           std::to_string(node) + R"(,"path":"translation"}}]}])";
  };
  expect_left_out(drawn_triangle(rest + animation(1)), "animations[0].channels[0]");
  expect_refused(drawn_triangle(rest + animation(0)));
}

TEST(GltfUnused, AttributesThatAreNotRead) {
  GltfBuilder gltf;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{0, 0, nan, 0, 0, 1}, "VEC2", 2);
  gltf.add(std::vector<uint8_t>(12, 0), "VEC4", 4);
  gltf.add(std::vector<float>(12, nan), "VEC4", 4);
  expect_left_out(gltf.text(one_mesh(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1}})")),
                  "meshes[0].primitives[0].attributes.TEXCOORD_0");
  expect_left_out(gltf.text(one_mesh(R"({"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3}})")),
                  "meshes[0].primitives[0].attributes.JOINTS_0");
  expect_refused(gltf.text(one_mesh(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0})",
                                    R"("materials":[{"emissiveTexture":{"index":0}}],"textures":[{"source":0}],)"
                                    R"("images":[{"uri":"data:,x"}])")));
}

TEST(GltfUnused, ManyFaultsAreToldInFewLines) {
  std::string cameras;
  for (int i = 0; i < 1000; ++i) cameras += std::string(i == 0 ? "" : ",") + R"({"type":"fisheye"})";
  const std::vector<std::string> warnings =
      warnings_of([&] { load_text(drawn_triangle(meshes() + "," + nodes() + R"(,"cameras":[)" + cameras + "]")); });
  ASSERT_EQ(warnings.size(), 9u);
  EXPECT_NE(warnings.back().find("992 more parts are left out"), std::string::npos) << warnings.back();
}

// A square with a normal for each vertex, of which some are not valid.
void expect_recomputed(const std::vector<float>& normals, const std::string& count) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0}, "VEC3", 3);
  gltf.add(normals, "VEC3", 3);
  gltf.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
  const std::vector<std::string> warnings = warnings_of([&] {
    const Scene scene = load_text(gltf.text(one_mesh(R"({"attributes":{"POSITION":0,"NORMAL":1},"indices":2})")));
    check_scene(scene);
    for (const glm::vec3& normal : scene.meshes[0].primitives[0].normals) EXPECT_EQ(normal, glm::vec3(0, 1, 0));
  });
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("meshes[0].primitives[0]: " + count + " of 4 normals"), std::string::npos) << warnings[0];
}

TEST(GltfNormals, ThatAreNoDirectionsAreComputedFromTheTriangles) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  expect_recomputed({0, 1, 0, nan, 1, 0, 0, infinite, 0, 0, 1, 0}, "2");
  expect_recomputed({0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}, "1");
  expect_recomputed(std::vector<float>(12, nan), "4");
}

}  // namespace
}  // namespace penumbra::test
