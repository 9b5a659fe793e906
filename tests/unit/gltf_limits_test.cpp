// Limits: their names, what they count, and small files that would expand to large scenes.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "scene/gltf/budget.h"
#include "scene/limits.h"
#include "scene/scene_info.h"
#include "support/gltf_files.h"

namespace penumbra::test {
namespace {

using scene::ReadLimits;

TEST(GltfLimits, AreSetByName) {
  ReadLimits limits;
  scene::set_limit(limits, "images=3GiB");
  scene::set_limit(limits, "file=1500MiB");
  scene::set_limit(limits, "data=123456");
  scene::set_limit(limits, "vertices=7");
  EXPECT_EQ(limits.image_bytes, std::size_t{3} << 30);
  EXPECT_EQ(limits.file_bytes, std::size_t{1500} << 20);
  EXPECT_EQ(limits.decoded_bytes, 123456u);
  EXPECT_EQ(limits.decoded_ratio, 0u) << "that much, whatever the files hold";
  EXPECT_EQ(limits.vertices, 7u);
}

TEST(GltfLimits, RefuseWhatIsNoNumber) {
  ReadLimits limits;
  for (const char* text : {"images", "images=", "images=0", "images=-1", "images=1.5GiB", "images=2GB", "vertices=2GiB",
                           "images=99999999999999999999", "images=9999999999999GiB", "=1"})
    EXPECT_NE(error_of([&] { scene::set_limit(limits, text); }), "") << text;
  EXPECT_NE(error_of([&] { scene::set_limit(limits, "vertexes=1"); }).find("did you mean 'vertices'"),
            std::string::npos);
  EXPECT_EQ(error_of([&] { scene::set_limit(limits, "images=many"); }),
            "limit images: 'many' is not a number of bytes, as 1500000000, 1500MiB or 2GiB");
}

TEST(GltfLimits, EachIsNamedByItsRow) {
  for (const scene::LimitRow& row : scene::limit_rows()) {
    ReadLimits limits;
    limits.*row.value = std::size_t{3} << 20;
    EXPECT_EQ(error_of([&] { scene::fail_over_limit("too much", limits, row.value); }),
              fmt::format("too much, over the limit of {}; --limit {}={} changes it", row.bytes ? "3 MiB" : "3145728",
                          row.name, row.bytes ? "SIZE" : "N"));
  }
}

std::string refusal(const std::string& text, const ReadLimits& limits) {
  return error_of([&] { load_text(text, limits); });
}

std::string list(std::size_t count, const std::string& element) {
  std::string text = element;
  text.reserve(count * (element.size() + 1));
  for (std::size_t i = 1; i < count; ++i) text += "," + element;
  return text;
}

// A triangle; `node` draws it.
std::string triangle(const std::string& node, std::size_t count, const std::string& more = "") {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  gltf.add(std::vector<uint8_t>(12, 0), "VEC4", 4);
  gltf.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  return gltf.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],"nodes":[)" +
                   list(count, node) + "]" + more);
}

TEST(GltfLimits, CountWhatIsDrawn) {
  const std::string ten = triangle(R"({"mesh":0})", 10);
  EXPECT_EQ(refusal(ten, {.triangles = 10, .instances = 10}), "");
  EXPECT_NE(refusal(ten, {.triangles = 9}).find("10 triangles to draw, over the limit of 9; --limit triangles=N"),
            std::string::npos);
  EXPECT_NE(refusal(ten, {.instances = 9}).find("10 primitives to draw, over the limit of 9; --limit instances=N"),
            std::string::npos);
  const std::string skinned = triangle(R"({"mesh":0,"skin":0})", 10, R"(,"skins":[{"joints":[0]}])");
  EXPECT_EQ(refusal(skinned, {.vertices = 30}), "");
  EXPECT_NE(refusal(skinned, {.vertices = 29}).find("30 vertices of skinned and morphed meshes, over the limit of 29"),
            std::string::npos);
}

std::string draco_scene(const std::string& bytes) {
  GltfBuilder gltf;
  gltf.add(std::vector<uint8_t>(bytes.begin(), bytes.end()), "SCALAR", 1);
  return gltf.text(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":)"
      R"({"bufferView":0,"attributes":{"POSITION":0}}}}]}],"nodes":[{"mesh":0}],)"
      R"("extensionsUsed":["KHR_draco_mesh_compression"])");
}

// Of this process so far, bytes.
std::size_t most_resident() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

void expect_over_data_limit(const std::string& message, const std::string& limit) {
  EXPECT_NE(message.find("bytes of files expand to more, over the limit of " + limit), std::string::npos) << message;
  EXPECT_NE(message.find("--limit data=SIZE changes it"), std::string::npos) << message;
}

// Draco allocates what its header declares before it reads the data.
TEST(GltfLimits, CountWhatADracoHeaderDeclares) {
  std::string bytes("DRACO\x02\x02\x01\x01\0\0\0", 12);  // version 2.2, a mesh, edge breaker, no flags, traversal 0
  bytes += std::string("\x80\x80\x80\x20\x80\x80\x80\x20", 8);  // 2^26 points and faces
  bytes.resize(1 << 19);
  expect_over_data_limit(refusal(draco_scene(bytes), {}), "1");
}

// 2^13 faces and points, and a corner table for each of 255 attributes with seams.
TEST(GltfLimits, CountTheCornerTablesThatADracoHeaderDeclares) {
  std::string bytes("DRACO\x02\x02\x01\x01\0\0\0", 12);
  bytes += std::string("\x80\x40\x80\x40\xff", 5);
  bytes.resize(1 << 12);
  expect_over_data_limit(refusal(draco_scene(bytes), {.decoded_bytes = 8 << 20, .decoded_ratio = 0}), "8 MiB");
}

// Seven bits a byte, the lowest ones first.
std::string varint(uint32_t value) {
  std::string bytes;
  for (; value >= 128; value >>= 7) bytes += static_cast<char>(value | 128);
  return bytes + static_cast<char>(value);
}

// Draco zero-fills all attributes that the stream declares before it reads the values, which are missing here: 350 MiB
// of one attribute with 255 components of eight bytes.
TEST(GltfLimits, CountTheAttributesThatADracoStreamDeclares) {
  const uint32_t faces = 60'000, points = 3 * faces;
  std::string bytes("DRACO\x02\x02\x01\0\0\0", 11);  // version 2.2, a mesh, sequential, no flags
  bytes += varint(faces) + varint(points) + '\x01';  // indices as they are, each a byte
  bytes += std::string(std::size_t{3} * faces, '\0');
  bytes += std::string("\x01\x01\0\x0a\xff\0\0\0", 8);  // a decoder of one attribute, its type and encoding
  bytes.resize(bytes.size() + 64);
  const std::string text = draco_scene(bytes);
  const std::size_t before = most_resident();
  expect_over_data_limit(refusal(text, {.decoded_bytes = 8 << 20, .decoded_ratio = 0}), "8 MiB");
  EXPECT_LT(most_resident() - before, std::size_t{64} << 20);
}

// A thousand of them, empty, of three vertices.
TEST(GltfLimits, CountWhatMorphTargetsTakeOnTheGpu) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  const std::string text =
      gltf.text(one_mesh(R"({"attributes":{"POSITION":0,"NORMAL":1},"targets":[)" + list(1000, "{}") + "]}"));
  EXPECT_EQ(refusal(text, {.decoded_bytes = 150'000, .decoded_ratio = 0}), "");
  expect_over_data_limit(refusal(text, {.decoded_bytes = 50'000, .decoded_ratio = 0}), "");
  const std::size_t pose = 3 * 28 + 12, fixed = 3 * 24 + 3 * 4;  // vertices and a triangle's normal; the rest of them
  EXPECT_EQ(scene::describe(load_text(text)).gpu_vertex_bytes, 2 * pose + fixed + std::size_t{3} * (44 + 1000 * 36));
}

// Buffers that are the same file, by different names, and one that no bufferView reads.
TEST(GltfLimits, AFileOfManyBuffersIsLoadedOnce) {
  const ScratchFolder folder;
  for (const char* name : {"a.bin", "b.bin"})
    std::filesystem::resize_file(folder.write(name, ""), std::uintmax_t{16} << 20);
  std::string buffers = R"({"byteLength":4,"uri":"b.bin"})", views, name = "a.bin";
  for (int i = 1; i < 16; ++i, name.insert(0, "./")) {
    buffers += fmt::format(R"(,{{"byteLength":4,"uri":"{}"}})", name);
    views += fmt::format(R"({}{{"buffer":{},"byteLength":4}})", i == 1 ? "" : ",", i);
  }
  const auto file = folder.write("scene.gltf", R"({"asset":{"version":"2.0"},"nodes":[{}],"buffers":[)" + buffers +
                                                   R"(],"bufferViews":[)" + views + "]}");
  const std::size_t before = most_resident();
  scene::read_gltf(file, any_image);
  EXPECT_LT(most_resident() - before, std::size_t{64} << 20);
}

TEST(GltfLimits, AFileCountsOnceForWhatMayBeDecoded) {
  scene::gltf::Budget budget({.decoded_bytes = 0, .decoded_ratio = 1});
  for (int i = 0; i < 3; ++i) budget.add_file("shared.bin", 10);
  for (int i = 0; i < 2; ++i) budget.add_file({}, 5);
  budget.spend(20, 1);
  EXPECT_NE(error_of([&] { budget.spend(1, 1); }).find("20 bytes of files expand to more"), std::string::npos);
}

TEST(GltfLimits, ProgressTellsOfEveryPartAtMostAHundredTimes) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  const std::string text =
      gltf.text(R"("meshes":[)" + list(1000, R"({"primitives":[{"attributes":{"POSITION":0}}]})") + "]");
  const ScratchFolder folder;
  std::size_t calls = 0, last = 0;
  const auto file = folder.write("scene.gltf", text);
  scene::read_gltf(file, any_image, {.progress = [&](const scene::ReadProgress& progress) {
                     EXPECT_EQ(std::string(progress.part), "mesh");
                     EXPECT_EQ(progress.count, 1000u);
                     EXPECT_TRUE(calls == 0 || progress.done > last);
                     last = progress.done;
                     ++calls;
                   }});
  EXPECT_EQ(calls, 100u);
  EXPECT_NE(error_of([&] {
              scene::read_gltf(file, any_image,
                               {.progress = [](const scene::ReadProgress&) { fail("not wanted any more"); }});
            }).find("not wanted any more"),
            std::string::npos);
}

}  // namespace
}  // namespace penumbra::test
