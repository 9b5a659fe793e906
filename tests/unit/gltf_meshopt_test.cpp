// EXT_meshopt_compression: what libmeshoptimizer's encoders write is read again, in every mode and by every filter.

#include <gtest/gtest.h>
#define MESHOPTIMIZER_NO_WRAPPERS
#include <meshoptimizer.h>

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gl/shared_library.h"
#include "support/gltf_files.h"
#include "support/scene_faults.h"

namespace penumbra::test {
namespace {

struct Encoders {
  decltype(&meshopt_encodeVertexBuffer) vertices = nullptr;
  decltype(&meshopt_encodeIndexBuffer) triangles = nullptr;
  decltype(&meshopt_encodeIndexSequence) indices = nullptr;
  decltype(&meshopt_encodeFilterOct) octahedral = nullptr;
  decltype(&meshopt_encodeFilterQuat) quaternion = nullptr;
  decltype(&meshopt_encodeFilterExp) exponential = nullptr;

  Encoders() {
    const gl::SharedLibrary library("the test", {"libmeshoptimizer.so.2d", "libmeshoptimizer.so"});
    library.require(vertices, "meshopt_encodeVertexBuffer");
    library.require(triangles, "meshopt_encodeIndexBuffer");
    library.require(indices, "meshopt_encodeIndexSequence");
    library.require(octahedral, "meshopt_encodeFilterOct");
    library.require(quaternion, "meshopt_encodeFilterQuat");
    library.require(exponential, "meshopt_encodeFilterExp");
  }
};

// A file whose bufferViews are compressed, each in a buffer of its own; buffer 0 stands for what they decode to.
class CompressedFile {
 public:
  // `type`: further members of the accessor, as JSON.
  void add_filtered(decltype(Encoders::octahedral) filter, const char* name, std::size_t stride, int bits,
                    const std::vector<float>& values, std::size_t count, const std::string& type) {
    std::vector<char> filtered(count * stride);
    filter(filtered.data(), count, stride, bits, values.data());
    add_vertices(filtered.data(), count, stride, type, name);
  }
  void add_vertices(const void* values, std::size_t count, std::size_t stride, const std::string& type,
                    const char* filter = "NONE") {
    std::string stream(4096, '\0');
    stream.resize(encode_.vertices(bytes(stream), stream.size(), values, count, stride));
    add(stream, "ATTRIBUTES", filter, count, stride, type);
  }
  void add_triangles(const std::vector<unsigned>& indices) {
    std::string stream(4096, '\0');
    stream.resize(encode_.triangles(bytes(stream), stream.size(), indices.data(), indices.size()));
    add(stream, "TRIANGLES", "NONE", indices.size(), 2, R"("componentType":5123,"type":"SCALAR")");
  }
  void add_indices(const std::vector<unsigned>& indices) {
    std::string stream(4096, '\0');
    stream.resize(encode_.indices(bytes(stream), stream.size(), indices.data(), indices.size()));
    add(stream, "INDICES", "NONE", indices.size(), 4, R"("componentType":5125,"type":"SCALAR")");
  }

  const Encoders& encode() const { return encode_; }
  scene::Scene load(const std::string& rest) const {
    return load_text(fmt::format(R"({{"asset":{{"version":"2.0"}},"extensionsRequired":["EXT_meshopt_compression"],)"
                                 R"("extensionsUsed":["EXT_meshopt_compression"],"buffers":[{{"byteLength":{},)"
                                 R"("extensions":{{"EXT_meshopt_compression":{{"fallback":true}}}}}}{}],)"
                                 R"("bufferViews":[{}],"accessors":[{}],{}}})",
                                 decoded_size_, buffers_, views_, accessors_, rest));
  }

 private:
  static unsigned char* bytes(std::string& text) { return reinterpret_cast<unsigned char*>(text.data()); }

  void add(const std::string& stream, const char* mode, const char* filter, std::size_t count, std::size_t stride,
           const std::string& type) {
    EXPECT_FALSE(stream.empty()) << mode;
    const char* comma = added_ == 0 ? "" : ",";
    buffers_ += fmt::format(R"(,{{"byteLength":{},"uri":"{}"}})", stream.size(), data_uri(stream));
    const bool vertices = std::string(mode) == "ATTRIBUTES";
    views_ +=
        fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}{},"extensions":{{)"
                    R"("EXT_meshopt_compression":{{"buffer":{},"byteLength":{},"byteStride":{},"count":{},)"
                    R"("mode":"{}","filter":"{}"}}}}}})",
                    comma, decoded_size_, count * stride, vertices ? fmt::format(R"(,"byteStride":{})", stride) : "",
                    added_ + 1, stream.size(), stride, count, mode, filter);
    accessors_ += fmt::format(R"({}{{"bufferView":{},"count":{},{}}})", comma, added_, count, type);
    decoded_size_ += (count * stride + 3) / 4 * 4;
    ++added_;
  }

  Encoders encode_;
  std::string buffers_, views_, accessors_;
  std::size_t decoded_size_ = 0;
  int added_ = 0;
};

const std::string vec3 = R"("componentType":5126,"type":"VEC3")";

TEST(GltfMeshopt, ReadsTrianglesWithFilteredPositionsAndNormals) {
  const std::array<glm::vec3, 4> positions = {{{0, 0, 0.125f}, {1.5f, 0, -0.75f}, {1.25f, 3, 0}, {-2, 1, 40}}};
  const std::array<glm::vec3, 4> normals = {{{0, 0, 1}, {0.6f, 0.8f, 0}, {0, -0.6f, -0.8f}, {-1, 0, 0}}};
  std::vector<float> position_values, normal_values;
  for (std::size_t i = 0; i < 4; ++i) {
    position_values.insert(position_values.end(), {positions[i].x, positions[i].y, positions[i].z});
    normal_values.insert(normal_values.end(), {normals[i].x, normals[i].y, normals[i].z, 0});
  }
  CompressedFile file;
  file.add_filtered(file.encode().exponential, "EXPONENTIAL", 12, 20, position_values, 4, vec3);
  file.add_filtered(file.encode().octahedral, "OCTAHEDRAL", 4, 8, normal_values, 4,
                    R"("componentType":5120,"normalized":true,"type":"VEC3")");
  file.add_filtered(file.encode().octahedral, "OCTAHEDRAL", 8, 16, normal_values, 4,
                    R"("componentType":5122,"normalized":true,"type":"VEC3")");
  file.add_triangles({0, 1, 2, 2, 1, 3});
  file.add_indices({3, 0, 1, 3, 2, 0});
  const scene::Scene scene =
      file.load(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":3},)"
                R"({"attributes":{"POSITION":0,"NORMAL":2},"indices":4}]}],"nodes":[{"mesh":0}])");
  check_scene(scene);
  const std::vector<scene::Primitive>& primitives = scene.meshes.at(0).primitives;
  ASSERT_EQ(primitives.size(), 2u);
  for (const auto& [primitive, tolerance] : {std::pair(&primitives[0], 0.02f), {&primitives[1], 1e-3f}}) {
    ASSERT_EQ(primitive->positions.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT(glm::distance(primitive->positions[i], positions[i]), 1e-3f) << i;
      EXPECT_LT(glm::distance(primitive->normals[i], normals[i]), tolerance) << i;
    }
  }
  EXPECT_EQ(primitives[0].indices, (std::vector<uint32_t>{0, 1, 2, 2, 1, 3}));
  EXPECT_EQ(primitives[1].indices, (std::vector<uint32_t>{3, 0, 1, 3, 2, 0}));
}

TEST(GltfMeshopt, ReadsFilteredRotations) {
  const std::vector<float> rotations = {0, 0, 0, 1, 0.5f, 0.5f, -0.5f, 0.5f, 0, 0.6f, 0, -0.8f};
  const std::array<float, 3> times = {0, 1, 2};
  CompressedFile file;
  file.add_vertices(times.data(), 3, 4, R"("componentType":5126,"type":"SCALAR")");
  file.add_filtered(file.encode().quaternion, "QUATERNION", 8, 12, rotations, 3,
                    R"("componentType":5122,"normalized":true,"type":"VEC4")");
  const scene::Scene scene = file.load(R"("nodes":[{}],"animations":[{"samplers":[{"input":0,"output":1}],)"
                                       R"("channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}}]}])");
  const scene::AnimationChannel& channel = scene.animations.at(0).channels.at(0);
  EXPECT_EQ(channel.times, std::vector<float>(times.begin(), times.end()));
  ASSERT_EQ(channel.values.size(), rotations.size());
  for (std::size_t i = 0; i < rotations.size(); i += 4) {
    double cosine = 0;  // a quaternion and its negative are one rotation
    for (std::size_t k = 0; k < 4; ++k) cosine += static_cast<double>(channel.values[i + k]) * rotations[i + k];
    EXPECT_NEAR(std::abs(cosine), 1, 1e-3) << i;
  }
}

}  // namespace
}  // namespace penumbra::test
