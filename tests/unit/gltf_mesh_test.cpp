// What the reader makes of primitives: indices, attributes, normals, tangents.

#include <gtest/gtest.h>

#include "support/gltf_files.h"
#include "support/scene_faults.h"

namespace penumbra::test {
namespace {

using scene::Primitive;
using scene::Scene;
using scene::Topology;

const std::vector<float> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<float> square_normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};

Primitive read_primitive(const GltfBuilder& gltf, const std::string& primitive, const std::string& more = "") {
  const Scene scene = load_text(gltf.text(one_mesh(primitive, more)));
  check_scene(scene);
  return scene.meshes.at(0).primitives.at(0);
}

Primitive read_mode(int mode) {
  GltfBuilder gltf;
  gltf.add(square, "VEC3", 3);
  gltf.add(square_normals, "VEC3", 3);
  return read_primitive(gltf, fmt::format(R"({{"attributes":{{"POSITION":0,"NORMAL":1}},"mode":{}}})", mode));
}

double signed_area(const Primitive& primitive) {
  double area = 0;
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    const glm::vec3 a = primitive.positions[primitive.indices[i]], b = primitive.positions[primitive.indices[i + 1]],
                    c = primitive.positions[primitive.indices[i + 2]];
    area += glm::cross(b - a, c - a).z / 2;
  }
  return area;
}

TEST(GltfMesh, ExpandsEveryModeToLists) {
  EXPECT_EQ(read_mode(0).indices, (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(read_mode(1).indices, (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(read_mode(2).indices, (std::vector<uint32_t>{0, 1, 1, 2, 2, 3, 3, 0}));
  EXPECT_EQ(read_mode(3).indices, (std::vector<uint32_t>{0, 1, 1, 2, 2, 3}));
  EXPECT_EQ(read_mode(4).indices, (std::vector<uint32_t>{0, 1, 2})) << "a left-over vertex is dropped";
  EXPECT_EQ(read_mode(0).topology, Topology::points);
  EXPECT_EQ(read_mode(2).topology, Topology::lines);
  EXPECT_EQ(read_mode(5).topology, Topology::triangles);
}

TEST(GltfMesh, FansKeepTheirWinding) { EXPECT_DOUBLE_EQ(signed_area(read_mode(6)), 1); }

TEST(GltfMesh, StripsKeepTheirWinding) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 3);
  gltf.add(square_normals, "VEC3", 3);
  EXPECT_DOUBLE_EQ(signed_area(read_primitive(gltf, R"({"attributes":{"POSITION":0,"NORMAL":1},"mode":5})")), 1);
}

TEST(GltfMesh, TakesOnlyTheVerticesThatItUses) {
  GltfBuilder gltf;
  std::vector<float> line;
  for (int i = 0; i < 100; ++i) line.insert(line.end(), {static_cast<float>(i), 0, 0});
  gltf.add(line, "VEC3", 3);
  gltf.add(std::vector<uint16_t>{90, 7}, "SCALAR", 1);
  const Primitive primitive = read_primitive(gltf, R"({"attributes":{"POSITION":0},"indices":1,"mode":1})");
  ASSERT_EQ(primitive.positions.size(), 2u);
  EXPECT_EQ(primitive.positions[primitive.indices[0]].x, 90);
  EXPECT_EQ(primitive.positions[primitive.indices[1]].x, 7);
}

TEST(GltfMesh, GeneratesFlatNormalsWithVerticesOfTheirOwn) {
  GltfBuilder gltf;
  // Two triangles that share an edge at a right angle.
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
  gltf.add(std::vector<uint8_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
  const Primitive primitive = read_primitive(gltf, R"({"attributes":{"POSITION":0},"indices":1})");
  ASSERT_EQ(primitive.positions.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(primitive.normals[primitive.indices[i]], glm::vec3(0, 0, 1));
  for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(primitive.normals[primitive.indices[i]], glm::vec3(1, 0, 0));
}

TEST(GltfMesh, FlatNormalsFollowMorphTargets) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{0, 0, 0, 0, 0, 0, 0, -1, 1}, "VEC3", 3);  // tilts the triangle into the plane y = 0
  const Primitive primitive = read_primitive(gltf, R"({"attributes":{"POSITION":0},"targets":[{"POSITION":1}]})");
  const glm::vec3 moved = primitive.normals[0] + primitive.targets[0].normals[0];
  EXPECT_NEAR(glm::distance(moved, glm::vec3(0, -1, 0)), 0, 1e-6);
}

TEST(GltfMesh, RepairsNormalsWithoutLength) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{0, 0, 0, 0, 0, 5, 0, 0, 0}, "VEC3", 3);
  for (const glm::vec3& normal : read_primitive(gltf, R"({"attributes":{"POSITION":0,"NORMAL":1}})").normals)
    EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(GltfMesh, ReadsNormalizedAndPlainIntegers) {
  GltfBuilder gltf;
  gltf.add(std::vector<int16_t>{0, 0, 0, 2, 0, 0, 0, -3, 0}, "VEC3", 3);
  gltf.add(std::vector<int8_t>{0, 0, 127, 0, 0, 127, 0, 0, -128}, "VEC3", 3, R"("normalized":true)");
  gltf.add(std::vector<uint16_t>{0, 65535, 65535, 0, 0, 0}, "VEC2", 2, R"("normalized":true)");
  const Primitive primitive =
      read_primitive(gltf, R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"mode":0})");
  EXPECT_EQ(primitive.positions[1], glm::vec3(2, 0, 0));
  EXPECT_EQ(primitive.positions[2], glm::vec3(0, -3, 0));
  EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(primitive.uvs[0][0], glm::vec2(0, 1));
}

TEST(GltfMesh, TheLeastNormalizedIntegerIsMinusOne) {
  GltfBuilder gltf;
  gltf.add(std::vector<int8_t>{-128, -127, 127}, "VEC3", 3, R"("normalized":true)");
  gltf.add(std::vector<int16_t>{-32768, -32767, 32767}, "VEC3", 3, R"("normalized":true)");
  for (const int accessor : {0, 1})
    EXPECT_EQ(
        read_primitive(gltf, fmt::format(R"({{"attributes":{{"POSITION":{}}},"mode":0}})", accessor)).positions[0],
        glm::vec3(-1, -1, 1));
}

TEST(GltfMesh, ReadsColoursOfEveryKind) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{0.25f, 0.5f, 1}, "VEC3", 3);
  gltf.add(std::vector<uint8_t>{255, 0, 51, 102}, "VEC4", 4, R"("normalized":true)");
  EXPECT_EQ(read_primitive(gltf, R"({"attributes":{"POSITION":0,"COLOR_0":1},"mode":0})").colors[0],
            glm::vec4(0.25f, 0.5f, 1, 1));
  EXPECT_EQ(read_primitive(gltf, R"({"attributes":{"POSITION":0,"COLOR_0":2},"mode":0})").colors[0],
            glm::vec4(1, 0, 0.2f, 0.4f));
}

TEST(GltfMesh, ReadsInterleavedAttributes) {
  const std::vector<float> rows = {0, 0, 0, 0.5f, 1, 0, 0, 0.6f, 0, 1, 0, 0.7f};  // position, then a scalar of no use
  const std::string text =
      fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":48,"uri":"{}"}}],)"
                  R"("bufferViews":[{{"buffer":0,"byteLength":48,"byteStride":16}}],)"
                  R"("accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],{}}})",
                  data_uri(bytes_of(rows)), one_mesh(R"({"attributes":{"POSITION":0}})"));
  EXPECT_EQ(load_text(text).meshes[0].primitives[0].positions[2], glm::vec3(0, 1, 0));
}

TEST(GltfMesh, ReadsSparseAccessorsWithoutABase) {
  const std::string bytes = bytes_of(std::vector<uint32_t>{1}) + bytes_of(std::vector<float>{4, 5, 6});
  const std::string text =
      fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":16,"uri":"{}"}}],"bufferViews":)"
                  R"([{{"buffer":0,"byteLength":4}},{{"buffer":0,"byteOffset":4,"byteLength":12}}],"accessors":[{{)"
                  R"("componentType":5126,"count":3,"type":"VEC3","sparse":{{"count":1,"indices":{{"bufferView":0,)"
                  R"("componentType":5125}},"values":{{"bufferView":1}}}}}}],{}}})",
                  data_uri(bytes), one_mesh(R"({"attributes":{"POSITION":0},"mode":0})"));
  const Primitive primitive = load_text(text).meshes[0].primitives[0];
  EXPECT_EQ(primitive.positions[0], glm::vec3(0));
  EXPECT_EQ(primitive.positions[1], glm::vec3(4, 5, 6));
}

TEST(GltfMesh, KeepsTheFourHeaviestOfManyJoints) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0}, "VEC3", 3);
  gltf.add(std::vector<uint8_t>{0, 1, 2, 3}, "VEC4", 4);
  gltf.add(std::vector<float>{0.1f, 0.2f, 0.02f, 0.03f}, "VEC4", 4);
  gltf.add(std::vector<uint16_t>{4, 5, 6, 7}, "VEC4", 4);
  gltf.add(std::vector<float>{0.3f, 0.2f, 0.05f, 0}, "VEC4", 4);
  const Primitive primitive = read_primitive(
      gltf, R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"JOINTS_1":3,"WEIGHTS_1":4},"mode":0})");
  EXPECT_EQ(primitive.joints[0][0], 4);
  EXPECT_NEAR(primitive.weights[0][0], 0.3 / 0.8, 1e-6);
  EXPECT_NEAR(primitive.weights[0][3], 0.1 / 0.8, 1e-6) << "weights sum to one again";
}

const std::string normal_mapped = R"("materials":[{"normalTexture":{"index":0}}],"textures":[{"source":0}],)"
                                  R"("images":[{"uri":"data:image/png;base64,AAAA"}])";

TEST(GltfMesh, GeneratesTangentsForNormalMaps) {
  GltfBuilder gltf;
  gltf.add(square, "VEC3", 3);
  gltf.add(square_normals, "VEC3", 3);
  gltf.add(std::vector<float>{0, 1, 0, 0, 1, 0, 1, 1}, "VEC2", 2);  // u along +y, v along -x
  gltf.add(std::vector<uint8_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
  const Primitive primitive = read_primitive(
      gltf, R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0})", normal_mapped);
  ASSERT_EQ(primitive.tangents.size(), 4u);
  for (const glm::vec4& tangent : primitive.tangents) {
    EXPECT_NEAR(tangent.y, 1, 1e-5);
    EXPECT_EQ(tangent.w, 1);  // cross(n, t) = -x, the direction of growing v
  }
  EXPECT_TRUE(read_mode(6).tangents.empty()) << "none where no normal map needs them";
}

// Two triangles beside an edge along y, with the texture mirrored in it: the directions of growing u cancel out there.
TEST(GltfMesh, GeneratesTangentsAcrossMirroredSeams) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0, -1, 0, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  gltf.add(std::vector<float>{0, 0, 0, 1, 1, 0, 1, 0}, "VEC2", 2);
  gltf.add(std::vector<uint8_t>{0, 2, 1, 0, 1, 3}, "SCALAR", 1);
  const Primitive primitive = read_primitive(
      gltf, R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0})", normal_mapped);
  ASSERT_EQ(primitive.tangents.size(), 4u);
  for (const glm::vec4& tangent : primitive.tangents) {
    EXPECT_NEAR(std::abs(tangent.x), 1, 1e-5);
    EXPECT_EQ(tangent.w, tangent.x < 0 ? -1 : 1) << "v grows along +y on both sides";
  }
}

TEST(GltfMesh, SkipsWhatHasNoPositions) {
  GltfBuilder gltf;
  gltf.add(square_normals, "VEC3", 3);
  const Scene scene = load_text(gltf.text(one_mesh(R"({"attributes":{"NORMAL":0}})")));
  EXPECT_TRUE(scene.meshes[0].primitives.empty());
}

TEST(GltfMesh, RefusesIndicesBeyondTheVertices) {
  GltfBuilder gltf;
  gltf.add(square, "VEC3", 3);
  gltf.add(std::vector<uint16_t>{0, 1, 65535}, "SCALAR", 1);
  const std::string message =
      error_of([&] { load_text(gltf.text(one_mesh(R"({"attributes":{"POSITION":0},"indices":1})"))); });
  EXPECT_NE(message.find("meshes[0]: primitives[0]: index 65535, but there are 4 vertices"), std::string::npos)
      << message;
}

TEST(GltfMesh, RefusesMoreVerticesThanTheLimit) {
  GltfBuilder gltf;
  gltf.add(square, "VEC3", 3);
  const std::string text = gltf.text(one_mesh(R"({"attributes":{"POSITION":0},"mode":0})"));
  EXPECT_NO_THROW(load_text(text, {.vertices = 4}));
  EXPECT_NE(error_of([&] {
              load_text(text, {.vertices = 3});
            }).find("at least 4 vertices, over the limit of 3; --limit vertices=N"),
            std::string::npos);
}

TEST(GltfMesh, RefusesCountsWithoutBytesBehindThem) {
  const std::string text = R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":2000000000,)"
                           R"("type":"VEC3"}],)" +
                           one_mesh(R"({"attributes":{"POSITION":0}})") + "}";
  EXPECT_NE(error_of([&] { load_text(text); }).find("expand to more, over the limit of 1 GiB; --limit data=SIZE"),
            std::string::npos);
}

}  // namespace
}  // namespace penumbra::test
