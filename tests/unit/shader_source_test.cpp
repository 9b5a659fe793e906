#include "gl/shader_source.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace penumbra::gl {
namespace {

ShaderFiles files(std::initializer_list<std::pair<const char*, const char*>> list) {
  ShaderFiles result;
  for (const auto& [name, text] : list) result.put(name, text);
  return result;
}

std::string message(const ShaderFiles& files, std::string_view root) {
  try {
    load_shader_source(files, root, {});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

class TemporaryFolder {
 public:
  TemporaryFolder() : path_(testing::TempDir() + "penumbra_overlay_" + std::to_string(getpid())) {
    std::filesystem::create_directories(path_ / "lib");
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

TEST(ShaderSource, StartsWithVersionAndDefines) {
  const auto source =
      load_shader_source(files({{"a.frag", "int taps = TAPS ON;\n"}}), "a.frag", {{"TAPS", "16"}, {"ON", ""}});
  EXPECT_EQ(source.text, "#version 450 core\n#define TAPS 16\n#define ON \nint taps = TAPS ON;\n");
  EXPECT_EQ(source.files, std::vector<std::string>{"a.frag"});
}

// So that a stage is the same text in programs that differ in what only another stage reads.
TEST(ShaderSource, LeavesOutDefinesThatNoCodeMentions) {
  const gl::ShaderFiles both = files({{"a.vert", "#include \"b.glsl\"\nint a; // UNUSED\n"}, {"b.glsl", "int b = B;"}});
  const auto source = load_shader_source(both, "a.vert", {{"UNUSED", "1"}, {"B", "2"}, {"OTHER", "3"}});
  EXPECT_EQ(source.text, "#version 450 core\n#define B 2\nint b = B;\nint a; // UNUSED\n");
  EXPECT_EQ(source.lines,
            (std::vector<ShaderSource::Line>{{ShaderSource::no_file, 0}, {ShaderSource::no_file, 0}, {1, 1}, {0, 2}}));
}

TEST(ShaderSource, AnIncludeStandsInItsPlaceAndLinesGoOn) {
  const auto source = load_shader_source(
      files({{"a.frag", "first\n  #  include \"lib/b.glsl\" // why\nlast"}, {"lib/b.glsl", "inner"}}), "a.frag", {});
  EXPECT_EQ(source.text, "#version 450 core\nfirst\ninner\nlast\n");
  EXPECT_EQ(source.files, (std::vector<std::string>{"a.frag", "lib/b.glsl"}));
  EXPECT_EQ(source.lines, (std::vector<ShaderSource::Line>{{ShaderSource::no_file, 0}, {0, 1}, {1, 1}, {0, 3}}));
}

TEST(ShaderSource, EveryFileComesOnceWhoeverIncludesIt) {
  const auto source = load_shader_source(files({{"a.frag", "#include \"b\"\n#include \"c\"\n#include \"b\"\n"},
                                                {"b", "#include \"c\"\nBODY_B\n"},
                                                {"c", "#include \"a.frag\"\n#include \"b\"\nBODY_C\n"}}),
                                         "a.frag", {});
  EXPECT_EQ(count(source.text, "BODY_B"), 1u);
  EXPECT_EQ(count(source.text, "BODY_C"), 1u);
  EXPECT_EQ(source.files.size(), 3u);
}

TEST(ShaderSource, HeadersSharedWithCppNeedNoCare) {
  const auto source = load_shader_source(
      files({{"shared/x.h", "#pragma once\n#ifdef __cplusplus\n#include <glm/glm.hpp>\n#endif\nstruct X {};\r\n"}}),
      "shared/x.h", {});
  EXPECT_EQ(source.text, "#version 450 core\n\n#ifdef __cplusplus\n\n#endif\nstruct X {};\r\n");
}

TEST(ShaderSource, AMissingIncludeNamesWhoAsked) {
  EXPECT_EQ(message(files({{"a.frag", "\n#include \"lib/none.glsl\"\n"}}), "a.frag"),
            "glsl/a.frag:2: shader file 'glsl/lib/none.glsl' not found");
  EXPECT_EQ(message(files({}), "none.frag"), "shader file 'glsl/none.frag' not found");
}

TEST(ShaderSource, AMalformedIncludeNamesItsLine) {
  for (const char* line : {"#include", "#include lib/b.glsl", "#include \"b", "#include \"\""}) {
    EXPECT_EQ(message(files({{"a.frag", (std::string("\n\n") + line).c_str()}}), "a.frag"),
              "glsl/a.frag:3: #include takes a name in quotes")
        << line;
  }
}

// A chain of files, each of which includes the next.
ShaderFiles chain_of(std::size_t count) {
  ShaderFiles files;
  for (std::size_t i = 0; i < count; ++i) {
    const bool last = i + 1 == count;
    files.put(fmt::format("chain/{}.glsl", i),
              last ? "float end;\n" : fmt::format("#include \"chain/{}.glsl\"\n", i + 1));
  }
  return files;
}

TEST(ShaderSource, AChainOfIncludesEndsAtALimitThatIsNamed) {
  EXPECT_EQ(load_shader_source(chain_of(most_shader_files), "chain/0.glsl", {}).files.size(), most_shader_files);
  EXPECT_EQ(message(chain_of(60000), "chain/0.glsl"),
            "glsl/chain/999.glsl:1: shader 'glsl/chain/0.glsl' includes more than 1000 files");
}

TEST(ShaderSource, NamesThatLeaveTheFolderAreRefused) {
  const TemporaryFolder folder;
  folder.write("secret", "SECRET");
  const ShaderFiles overlay(folder.path() + "/lib");
  EXPECT_EQ(overlay.read("../secret"), std::nullopt);
  EXPECT_EQ(overlay.read("x/../../secret"), std::nullopt);
  EXPECT_EQ(overlay.read(folder.path() + "/secret"), std::nullopt);
  EXPECT_NE(message(files({{"a", "#include \"../x\""}}), "a").find("outside of glsl/"), std::string::npos);
}

TEST(ShaderSource, AnOverlaysFileWinsOverTheBuiltInOne) {
  const std::vector<std::string> names = ShaderFiles::built_in_names();
  ASSERT_FALSE(names.empty());
  const std::string& built_in = names.front();
  const TemporaryFolder folder;
  std::filesystem::create_directories((std::filesystem::path(folder.path()) / built_in).parent_path());
  const ShaderFiles overlay(folder.path());
  EXPECT_EQ(overlay.read(built_in), ShaderFiles().read(built_in));
  folder.write(built_in, "OVERLAID\n");
  EXPECT_EQ(overlay.read(built_in), "OVERLAID\n");
}

TEST(ShaderSource, AnOverlaysFileThatCantBeReadIsNotTheBuiltInOne) {
  const std::string name = "lib/tone_map.glsl";
  ASSERT_TRUE(ShaderFiles().read(name));
  const TemporaryFolder folder;
  const std::filesystem::path path = std::filesystem::path(folder.path()) / name;
  const auto expect_refused = [&](const std::string& cause) {
    const std::string told = message(ShaderFiles(folder.path()), name);
    EXPECT_EQ(told, fmt::format("cannot read the shader '{}': {}", path.string(), cause));
    std::filesystem::remove_all(path);
  };
  std::filesystem::create_directory(path);
  expect_refused("not a regular file");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_refused("not a regular file");
  std::filesystem::create_symlink("nowhere", path);
  expect_refused("file not found");
  std::filesystem::create_symlink(path, path);
  expect_refused("can't be read: Too many levels of symbolic links");
  std::filesystem::create_symlink("/proc/self/mem", path);
  expect_refused("can't be read: Input/output error");
  std::filesystem::create_symlink("/proc/self/status", path);
  expect_refused("longer than the 0 bytes of its size");
  folder.write(name, "");
  std::filesystem::resize_file(path, (1 << 20) + 1);
  expect_refused("1048577 bytes, over the limit of 1048576");
  EXPECT_EQ(ShaderFiles(folder.path()).read(name), ShaderFiles().read(name)) << "the built-in one is back";
  std::filesystem::remove_all(path.parent_path());
  folder.write("lib", "a file in place of the folder");
  EXPECT_EQ(ShaderFiles(folder.path()).read(name), ShaderFiles().read(name));
}

TEST(ShaderSource, BuiltInFilesAreTheFilesOfTheTree) {
  for (const std::string& name : ShaderFiles::built_in_names()) {
    std::ifstream stream(std::string(PENUMBRA_ROOT) + "/glsl/" + name, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    EXPECT_EQ(ShaderFiles().read(name), text) << name;
  }
}

// #version, a line of a.frag, two of b.glsl, and the rest of a.frag.
const ShaderSource two_files{
    "", {"shadow/a.frag", "lib/b.glsl"}, {{ShaderSource::no_file, 0}, {0, 11}, {1, 1}, {1, 2}, {0, 13}}};

TEST(TranslateLog, EveryDriversFormBecomesFileAndLine) {
  EXPECT_EQ(translate_log("0:2(5): error: `x' undeclared\n0:4(1): warning: unused\n", two_files),
            "glsl/shadow/a.frag:11: error: `x' undeclared\nglsl/lib/b.glsl:2: warning: unused");
  EXPECT_EQ(translate_log("0(3) : error C1008: undefined variable \"x\"\n", two_files),
            "glsl/lib/b.glsl:1: error C1008: undefined variable \"x\"");
  EXPECT_EQ(translate_log("ERROR: 0:5: 'x' : undeclared identifier\nWARNING: 0:3: odd", two_files),
            "glsl/shadow/a.frag:13: error: 'x' : undeclared identifier\nglsl/lib/b.glsl:1: warning: odd");
}

TEST(TranslateLog, AnEmptyFileIsNamed) {
  gl::ShaderFiles files;
  files.put("empty.frag", "");
  const gl::ShaderSource source = gl::load_shader_source(files, "empty.frag", {});
  EXPECT_EQ(gl::translate_log("0:2(1): error: syntax error, unexpected end of file", source),
            "glsl/empty.frag:1: error: syntax error, unexpected end of file");
}

TEST(TranslateLog, OtherLinesStayAndEmptyOnesGo) {
  EXPECT_EQ(translate_log("\n\nlinking failed\n  \n0:1(1): error: version\n0:7(1): error: from nowhere\n", two_files),
            "linking failed\n0:1(1): error: version\n0:7(1): error: from nowhere");
}

TEST(TranslateLog, TheLineStandsUnderItsLastMessageAndRepetitionsGo) {
  const auto source = load_shader_source(
      files({{"a.frag", "#include \"lib/b.glsl\"\n  color = one;  \n"}, {"lib/b.glsl", "float two;"}}), "a.frag", {});
  EXPECT_EQ(translate_log("0:3(1): error: `color'\n0:3(9): error: `one'\n0:3(9): error: `one'\n0:2(1): warning: odd\n",
                          source),
            "glsl/a.frag:2: error: `color'\nglsl/a.frag:2: error: `one'\n    color = one;\n"
            "glsl/lib/b.glsl:1: warning: odd\n    float two;");
}

TEST(TranslateLog, AnOverlaysFileIsNamedAsTheUserDoes) {
  const TemporaryFolder folder;
  folder.write("lib/b.glsl", "\noops");
  folder.write("a.frag", "#include \"lib/b.glsl\"\n#include \"lib/none.glsl\"\n");
  const ShaderFiles overlay(folder.path());
  EXPECT_EQ(translate_log("0:3(1): error: x", load_shader_source(overlay, "lib/b.glsl", {})),
            folder.path() + "/lib/b.glsl:2: error: x\n    oops");
  EXPECT_EQ(message(overlay, "a.frag"), folder.path() + "/a.frag:2: shader file 'glsl/lib/none.glsl' not found");
}

}  // namespace
}  // namespace penumbra::gl
