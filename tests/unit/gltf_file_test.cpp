// Files, URIs and containers: which are opened, which are refused, and with what message.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

#include "scene/one_line.h"
#include "support/gltf_files.h"

namespace penumbra::test {
namespace {

constexpr const char* empty_scene = R"({"asset":{"version":"2.0"}})";

std::string refusal(const std::filesystem::path& file, const scene::ReadLimits& limits = {}) {
  std::string message = error_of([&] { scene::read_gltf(file, no_image, {.limits = limits}); });
  EXPECT_EQ(message.find(file.string()), 0u) << "the message begins with the file: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message;
}

void expect_refused(const std::filesystem::path& file, const std::string& why) {
  const std::string message = refusal(file);
  EXPECT_NE(message.find(why), std::string::npos) << message;
}

std::string triangle_with_buffer(const std::string& uri) {
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":36,"uri":"{}"}}],)"
                     R"("bufferViews":[{{"buffer":0,"byteLength":36}}],"accessors":[{{"bufferView":0,)"
                     R"("componentType":5126,"count":3,"type":"VEC3"}}],{}}})",
                     uri, one_mesh(R"({"attributes":{"POSITION":0}})"));
}

const std::string triangle_bytes = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});

std::string little_endian(uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

std::string chunk(const char* type, const std::string& data) {
  return little_endian(static_cast<uint32_t>(data.size())) + type + data;
}

std::string glb(const std::string& chunks, uint32_t extra = 0) {
  return "glTF" + little_endian(2) + little_endian(static_cast<uint32_t>(chunks.size()) + 12 + extra) + chunks;
}

const std::string json_type = "JSON", bin_type("BIN\0", 4);

std::string padded(std::string text) {
  while (text.size() % 4 != 0) text += ' ';
  return text;
}

TEST(GltfFile, RefusesWhatIsNoFile) {
  const ScratchFolder folder;
  expect_refused(folder.scene() / "nothing.gltf", "file not found");
  expect_refused(folder.scene(), "not a regular file");
  const auto pipe = folder.scene() / "pipe.gltf";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expect_refused(pipe, "not a regular file");
}

TEST(GltfFile, RefusesAnUnreadableFile) {
  const ScratchFolder folder;
  const auto file = folder.write("locked.gltf", empty_scene);
  ASSERT_EQ(chmod(file.c_str(), 0), 0);
  if (access(file.c_str(), R_OK) == 0) GTEST_SKIP() << "skipped: root reads any file";
  expect_refused(file, "can't be opened");
}

TEST(GltfFile, RefusesWhatIsNoGltf) {
  const ScratchFolder folder;
  expect_refused(folder.write("empty.glb", ""), "the file is empty");
  expect_refused(folder.write("text.gltf", "hello"), "neither a GLB nor a glTF file");
  expect_refused(folder.write("cut.gltf", R"({"asset":)"), "not valid JSON");
  expect_refused(folder.write("nan.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"scale":[NaN,1,1]}]})"),
                 "not valid JSON");
  expect_refused(folder.write("huge.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"scale":[1e999,1,1]}]})"),
                 "number overflow");
  expect_refused(folder.write("float.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"scale":[1e300,1,1]}]})"),
                 "nodes[0].scale is 1e+300");
}

TEST(GltfFile, ReadsAByteOrderMark) {
  const ScratchFolder folder;
  EXPECT_NO_THROW(scene::read_gltf(folder.write("bom.gltf", std::string("\xEF\xBB\xBF") + empty_scene), no_image));
}

TEST(GltfFile, QuotesNothingUnprintable) {
  const ScratchFolder folder;
  const auto file = folder.write("evil.gltf", R"({"asset":{"version":"2.0"},"extensionsRequired":["a\n\u001b[31mb"]})");
  for (const char c : refusal(file)) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST(GltfFile, QuotesNamesOfAllLanguages) {
  const ScratchFolder folder;
  expect_refused(folder.write("scene.gltf", triangle_with_buffer("größe.bin")), "'größe.bin' not found");
  for (const char* name : {"größe", "\u2764", "\U0001F600", "\u00a0"}) EXPECT_EQ(scene::one_line(name), name);
}

TEST(GltfFile, ReplacesControlCharactersAndWhatIsNoUtf8) {
  EXPECT_EQ(scene::one_line("a\nb\tc\x1b[31m\x7f \n"), "a b?c?[31m?");
  EXPECT_EQ(scene::one_line("\u0080\u009b"), "??");
  EXPECT_EQ(scene::one_line("\xff\xc3x\xed\xa0\x80\xe2\x9d"), "??x?????");
}

TEST(GltfFile, CutsMessagesBetweenCharacters) {
  EXPECT_EQ(scene::one_line(std::string(500, 'a')), std::string(400, 'a'));
  EXPECT_EQ(scene::one_line(std::string(399, 'a') + "öb"), std::string(399, 'a'));
  EXPECT_EQ(scene::one_line(std::string(398, 'a') + "öb"), std::string(398, 'a') + "ö");
}

TEST(GltfFile, RefusesUnknownRequiredExtensionsByName) {
  EXPECT_NE(error_of([] {
              load_text(R"({"asset":{"version":"2.0"},"extensionsRequired":["ACME_magic"]})");
            }).find("requires the extension ACME_magic"),
            std::string::npos);
  EXPECT_NO_THROW(load_text(R"({"asset":{"version":"2.0"},"extensionsUsed":["ACME_magic"]})"));
}

TEST(GltfFile, RefusesOtherVersions) {
  EXPECT_NE(error_of([] { load_text(R"({"asset":{"version":"1.0"}})"); }).find("glTF version 1.0"), std::string::npos);
  EXPECT_NO_THROW(load_text(R"({"asset":{"version":"2.9"}})"));
  EXPECT_NE(error_of([] { load_text(R"({"asset":{"version":"2.9","minVersion":"2.1"}})"); }).find("needs glTF 2.1"),
            std::string::npos);
}

TEST(GltfFile, LimitsNestingAndValuesBeforeParsing) {
  const std::string deep =
      R"({"asset":{"version":"2.0"},"extras":)" + std::string(300, '[') + std::string(300, ']') + "}";
  EXPECT_NE(error_of([&] { load_text(deep); }).find("nested deeper than the limit of 256"), std::string::npos);
  EXPECT_NE(error_of([&] {
              load_text(deep, {.json_values = 100, .json_depth = 1000});
            }).find("over the limit of 100; --limit json-values=N"),
            std::string::npos);
  EXPECT_NO_THROW(load_text(R"({"asset":{"version":"2.0"},"extras":"[[[[\"[[["})", {.json_depth = 2}));
}

TEST(GltfFile, ReadsGlbChunks) {
  const ScratchFolder folder;
  const std::string json = chunk(json_type.c_str(), padded(empty_scene));
  const auto load = [&](const std::string& bytes) { scene::read_gltf(folder.write("a.glb", bytes), no_image); };
  EXPECT_NO_THROW(load(glb(json)));
  EXPECT_NO_THROW(load(glb(json) + "trailing bytes"));
  EXPECT_NO_THROW(load(glb(json + chunk("what", "ever"))));
  EXPECT_NE(error_of([&] { load(glb(json, 1)); }).find("the file has"), std::string::npos);
  EXPECT_NE(error_of([&] { load(glb(json + little_endian(100) + bin_type)); }).find("only 0 are left"),
            std::string::npos);
  EXPECT_NE(error_of([&] { load(glb(json + json)); }).find("one JSON chunk"), std::string::npos);
}

TEST(GltfFile, DecodesPercentEscapesAndTakesNamesAsTheyAre) {
  const ScratchFolder folder;
  folder.write("my data/\xE2\x9D\xA4.bin", triangle_bytes);
  folder.write("50%25.bin", triangle_bytes);
  for (const char* uri :
       {"my%20data/%E2%9D%A4.bin", "my data/\xE2\x9D\xA4.bin", "./my%20data/../my%20data/%e2%9d%a4.bin", "50%25.bin"})
    EXPECT_NO_THROW(scene::read_gltf(folder.write("scene.gltf", triangle_with_buffer(uri)), no_image)) << uri;
}

TEST(GltfFile, ReadsNothingOutsideTheScenesFolder) {
  const ScratchFolder folder;
  folder.write("../secret.bin", triangle_bytes);
  std::filesystem::create_symlink(folder.scene() / ".." / "secret.bin", folder.scene() / "link.bin");
  std::filesystem::create_directory_symlink(folder.scene() / "..", folder.scene() / "up");
  const std::string absolute = (folder.scene().parent_path() / "secret.bin").string();
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("x/../../secret.bin"),
        std::string("link.bin"), std::string("up/secret.bin"), absolute, "file://" + absolute,
        std::string("http://localhost/a.bin"), std::string("a%00.bin")})
    EXPECT_THROW(scene::read_gltf(folder.write("scene.gltf", triangle_with_buffer(uri)), no_image), Error) << uri;
  for (const char* uri : {"link.bin", "up/secret.bin"})
    expect_refused(folder.write("scene.gltf", triangle_with_buffer(uri)),
                   "leads out of the scene's folder by a symbolic link; --follow-links allows it");
}

// While it lives, the process has no rights but those of everyone. Without effect for other users than root.
class WithoutRights {
 public:
  WithoutRights() : was_root_(geteuid() == 0 && seteuid(65534) == 0) {}
  ~WithoutRights() {
    if (was_root_ && seteuid(0) != 0) std::abort();
  }
  WithoutRights(const WithoutRights&) = delete;
  WithoutRights& operator=(const WithoutRights&) = delete;

 private:
  bool was_root_;
};

TEST(GltfFile, SaysWhyAFileOfTheSceneCantBeRead) {
  const ScratchFolder folder;
  folder.write("locked.bin", triangle_bytes);
  folder.write("closed/data.bin", triangle_bytes);
  std::filesystem::create_directories(folder.scene() / "folder.bin");
  ASSERT_EQ(mkfifo((folder.scene() / "pipe.bin").c_str(), 0600), 0);
  std::filesystem::create_symlink("loop.bin", folder.scene() / "loop.bin");
  std::filesystem::create_symlink("nowhere.bin", folder.scene() / "dangling.bin");
  ASSERT_EQ(chmod((folder.scene() / "locked.bin").c_str(), 0), 0);
  ASSERT_EQ(chmod((folder.scene() / "closed").c_str(), 0), 0);
  const std::string longest(300, 'a');
  const std::pair<std::string, std::string> causes[] = {
      {"missing.bin", "'missing.bin' not found"},
      {"missing/data.bin", "'missing/data.bin' not found"},
      {"dangling.bin", "'dangling.bin' not found"},
      {"folder.bin", "'folder.bin': not a regular file"},
      {"pipe.bin", "'pipe.bin': not a regular file"},
      {"locked.bin", "'locked.bin': can't be read: Permission denied"},
      {"closed/data.bin", "'closed/data.bin' can't be read: Permission denied"},
      {"locked.bin/data.bin", "'locked.bin/data.bin' not found"},
      {"loop.bin", "'loop.bin' can't be read: Too many levels of symbolic links"},
      {longest, "' can't be read: File name too long"},
      {"../data.bin", "'../data.bin' leads out of the scene's folder"},
      {"/etc/passwd", "'/etc/passwd' is an absolute path"},
      {"a%00.bin", "'a%00.bin' holds a zero byte"},
      {"http://localhost/a.bin", "'http://localhost/a.bin' is not a file beside the scene"},
      {"", "an empty URI"},
  };
  for (const bool follow_links : {false, true}) {
    for (const auto& [uri, cause] : causes) {
      const auto scene = folder.write("scene.gltf", triangle_with_buffer(uri));
      const WithoutRights everyone;
      const std::string message = error_of([&] { scene::read_gltf(scene, no_image, {.follow_links = follow_links}); });
      EXPECT_EQ(message.find(scene.string() + ": buffers[0]: "), 0u) << message;
      EXPECT_NE(message.find(cause), std::string::npos) << message << (follow_links ? ", follows links" : "");
    }
  }
  chmod((folder.scene() / "closed").c_str(), 0700);
}

TEST(GltfFile, FollowsLinksOnlyIfAsked) {
  const ScratchFolder folder;
  folder.write("../elsewhere/data.bin", triangle_bytes);
  std::filesystem::create_symlink("../elsewhere/data.bin", folder.scene() / "link.bin");
  std::filesystem::create_directory_symlink("../elsewhere", folder.scene() / "up");
  const auto load = [&](const char* uri) {
    scene::read_gltf(folder.write("scene.gltf", triangle_with_buffer(uri)), no_image, {.follow_links = true});
  };
  EXPECT_NO_THROW(load("link.bin"));
  EXPECT_NO_THROW(load("up/data.bin"));
  for (const char* uri : {"../elsewhere/data.bin", "up/../../elsewhere/data.bin"})
    EXPECT_NE(error_of([&] { load(uri); }).find("leads out of the scene's folder"), std::string::npos)
        << "a name that leads out is no link: " << uri;
}

TEST(GltfFile, NamesOnlyFilesThatItMayRead) {
  const ScratchFolder folder;
  for (const char* name : {"../secret.bin", "data.bin", "a%20b.bin"}) folder.write(name, triangle_bytes);
  std::filesystem::create_symlink("../secret.bin", folder.scene() / "link.bin");
  std::filesystem::create_symlink("loop.bin", folder.scene() / "loop.bin");
  std::string images;
  for (const char* uri : {"/etc/passwd", "../secret.bin", "%2e%2e/secret.bin", "file:///etc/passwd", "data:,a",
                          "loop.bin", "link.bin", "missing.bin", "a%20b.bin", "./x/../data.bin"})
    images += fmt::format(R"({}{{"uri":"{}"}})", images.empty() ? "" : ",", uri);
  const auto file = folder.write("scene.gltf", fmt::format(R"({{"asset":{{"version":"2.0"}},"images":[{}]}})", images));
  const auto named = [&](bool follow_links) {
    std::vector<std::string> names;
    const auto keep = [&](const std::vector<std::filesystem::path>& files) {
      for (const auto& path : files) names.push_back(path.filename().string());
    };
    scene::read_gltf(file, no_image, {.follow_links = follow_links, .names_files = keep});
    return names;
  };
  EXPECT_EQ(named(false), (std::vector<std::string>{"missing.bin", "a%20b.bin", "data.bin"}));
  EXPECT_EQ(named(true), (std::vector<std::string>{"link.bin", "missing.bin", "a%20b.bin", "data.bin"}));
}

TEST(GltfFile, ReadsLinksThatStayInside) {
  const ScratchFolder folder;
  folder.write("data.bin", triangle_bytes);
  std::filesystem::create_symlink("data.bin", folder.scene() / "alias.bin");
  EXPECT_NO_THROW(scene::read_gltf(folder.write("scene.gltf", triangle_with_buffer("alias.bin")), no_image));
}

TEST(GltfFile, RefusesBuffersThatAreShortOrOverTheLimit) {
  const ScratchFolder folder;
  folder.write("short.bin", triangle_bytes.substr(0, 35));
  folder.write("long.bin", triangle_bytes + "padding");
  expect_refused(folder.write("scene.gltf", triangle_with_buffer("short.bin")), "buffers[0]: has 35 bytes, not 36");
  const auto scene = folder.write("scene.gltf", triangle_with_buffer("long.bin"));
  EXPECT_NO_THROW(scene::read_gltf(scene, no_image));
  EXPECT_NE(refusal(scene, {.file_bytes = 40}).find("over the limit of 40 bytes; --limit file=SIZE"),
            std::string::npos);
}

TEST(GltfFile, ReadsDataUrisInBase64AndPercentEncoded) {
  std::string escaped;
  for (const char byte : triangle_bytes) escaped += fmt::format("%{:02x}", static_cast<unsigned char>(byte));
  std::string base64_escaped;
  for (const char c : base64(triangle_bytes)) base64_escaped += c == 'A' ? "%41" : std::string(1, c);
  for (const std::string& uri :
       {"data:application/octet-stream," + escaped, "data:," + escaped, "DATA:;charset=x," + escaped,
        "data:;base64," + base64(triangle_bytes), "data:;BASE64," + base64_escaped}) {
    const scene::Scene scene = load_text(triangle_with_buffer(uri));
    EXPECT_EQ(scene.meshes[0].primitives[0].positions[1], glm::vec3(1, 0, 0)) << uri;
  }
}

TEST(GltfFile, RefusesBrokenDataUris) {
  for (const char* uri :
       {"data:;base64,AA!A", "data:;base64,A", "data:text/plain,AAAA", "data:", "data:,%0", "data:,%zz"})
    EXPECT_THROW(load_text(triangle_with_buffer(uri)), Error) << uri;
}

TEST(GltfFile, RefusesGeometryBeyondTheExtent) {
  const auto at = [](const char* scale) {
    GltfBuilder gltf;
    gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    return gltf.text(fmt::format(R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],)"
                                 R"("nodes":[{{"mesh":0,"scale":[{0},{0},{0}]}}])",
                                 scale));
  };
  EXPECT_NO_THROW(load_text(at("1e8")));
  EXPECT_NE(error_of([&] { load_text(at("1e30")); }).find("over the limit of 1e+09 m"), std::string::npos);
}

}  // namespace
}  // namespace penumbra::test
