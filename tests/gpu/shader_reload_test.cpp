#include "session/shader_reload.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <string>

#include "gl/api.h"
#include "gpu_test.h"
#include "session/file_watch.h"
#include "support/temp_folder.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* sized = "layout(local_size_x = SIZE) in; void main() {}\n";

// A folder that overlays the built-in files and is watched; files are saved to it as by an editor, and reloaded.
class ShaderReloadTest : public test::GpuTest {
 protected:
  ShaderReloadTest() {
    save("size.glsl", "#define SIZE 4\n");
    save("a.comp", std::string("#include \"size.glsl\"\n") + sized);
    save("b.comp", std::string("#define SIZE 2\n") + sized);
    watch.add_folder(folder);
    library.get(a);
    library.get(b);
  }
  ~ShaderReloadTest() override { fs::remove_all(folder); }

  void save(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  session::ShaderReload reload() { return session::reload_shaders(library, watch.poll(20s)); }
  session::ShaderReload reload(const std::string& name, const std::string& text) {
    save(name, text);
    return reload();
  }
  int size_of(const gl::ProgramDesc& desc) { return library.get(desc).group_size().x; }

  test::TempFolder temp;
  fs::path folder = temp.path();
  gl::ShaderLibrary library{gl::ShaderFiles(folder.string())};
  session::FileWatch watch;
  gl::ProgramDesc a{.name = "a", .compute = "a.comp"}, b{.name = "b", .compute = "b.comp"};
};

TEST_F(ShaderReloadTest, AnIncludeRebuildsWhatDependsOnItAtOnce) {
  const GLuint id = library.get(b).id();
  const session::ShaderReload result = reload("size.glsl", "#define SIZE 8\n");
  EXPECT_EQ(result.files, std::vector<fs::path>{folder / "size.glsl"});
  EXPECT_EQ(result.rebuilt, 1u);
  EXPECT_EQ(result.failed, 0u);
  EXPECT_TRUE(result.redraws());
  EXPECT_EQ(size_of(a), 8);
  EXPECT_EQ(library.get(b).id(), id);
  EXPECT_FALSE(reload("notes.txt", "nothing to do with it").redraws());
}

TEST_F(ShaderReloadTest, ABrokenFileIsToldWithItsLineAndTheLastGoodProgramStays) {
  const session::ShaderReload broken = reload("size.glsl", "#define SIZE 8\n\nfloat half_of(float x) { return y; }\n");
  EXPECT_EQ(broken.failed, 1u);
  EXPECT_FALSE(broken.redraws());
  ASSERT_EQ(broken.errors.size(), 1u);
  const std::string& error = broken.errors.front();
  EXPECT_EQ(error.find("program 'a': the compute shader does not compile\n"), 0u) << error;
  EXPECT_NE(error.find("\n" + (folder / "size.glsl").string() + ":3: "), std::string::npos) << error;
  EXPECT_NE(error.find("\n    float half_of(float x) { return y; }"), std::string::npos) << error;
  library.take_outdated();
  EXPECT_EQ(size_of(b), 2);
  EXPECT_FALSE(library.take_outdated());
  EXPECT_EQ(size_of(a), 4);
  EXPECT_TRUE(library.take_outdated());

  const session::ShaderReload fixed = reload("size.glsl", "#define SIZE 16\n");
  EXPECT_EQ(fixed.rebuilt, 1u);
  EXPECT_TRUE(fixed.errors.empty());
  EXPECT_EQ(size_of(a), 16);
  EXPECT_FALSE(library.take_outdated());
}

TEST_F(ShaderReloadTest, AFileThatCantBeReadIsToldAndTheLastGoodProgramStays) {
  fs::remove(folder / "size.glsl");
  fs::create_symlink("nowhere", folder / "size.glsl");
  const session::ShaderReload broken = reload();
  EXPECT_EQ(broken.failed, 1u);
  EXPECT_EQ(broken.errors, std::vector<std::string>{"cannot read the shader '" + (folder / "size.glsl").string() +
                                                    "': file not found"});
  EXPECT_EQ(size_of(a), 4);

  fs::remove(folder / "size.glsl");
  EXPECT_EQ(reload("size.glsl", "#define SIZE 16\n").rebuilt, 1u);
  EXPECT_EQ(size_of(a), 16);
}

TEST_F(ShaderReloadTest, ProgramsThatFailForTheSameLinesAreToldOnce) {
  gl::ProgramDesc other = a;
  other.name = "other";
  library.get(other);
  const session::ShaderReload broken = reload("size.glsl", "#define SIZE 8\noops\n");
  EXPECT_EQ(broken.failed, 2u);
  EXPECT_EQ(broken.errors.size(), 1u);
}

TEST_F(ShaderReloadTest, ABuiltInFileIsHiddenWhileTheOverlayHasIt) {
  const gl::ShaderFiles built_in;
  std::string name;
  for (const std::string& candidate : gl::ShaderFiles::built_in_names()) {
    if (candidate.starts_with("lib/")) name = candidate;
  }
  ASSERT_FALSE(name.empty());
  reload("c.comp", "#include \"" + name + "\"\n" +
                       "#ifndef SIZE\n#define SIZE 1\n#endif\nlayout(local_size_x = SIZE) in; void main() {}\n");
  const gl::ProgramDesc c{.name = "c", .compute = "c.comp"};
  EXPECT_EQ(size_of(c), 1);
  fs::create_directories(folder / "lib");
  EXPECT_EQ(reload(name, built_in.read(name).value() + "\n#define SIZE 32\n").rebuilt, 1u);
  EXPECT_EQ(size_of(c), 32);
  fs::remove(folder / name);
  EXPECT_EQ(reload().rebuilt, 1u);
  EXPECT_EQ(size_of(c), 1);
}

TEST_F(ShaderReloadTest, GeneratedFilesStayWhatTheyAre) {
  library.files().put("generated/size.glsl", "#define SIZE 64\n");
  save("d.comp", std::string("#include \"generated/size.glsl\"\n") + sized);
  reload();
  const gl::ProgramDesc d{.name = "d", .compute = "d.comp"};
  EXPECT_EQ(size_of(d), 64);
  fs::create_directories(folder / "generated");
  reload("generated/size.glsl", "#define SIZE 128\n");
  EXPECT_EQ(size_of(d), 64);
}

TEST_F(ShaderReloadTest, AFirstLoadThatFailsThrowsAndAFixIsFound) {
  reload("e.comp", "layout(local_size_x = 1) in; void main() { oops; }\n");
  const gl::ProgramDesc e{.name = "e", .compute = "e.comp"};
  EXPECT_THROW(library.get(e), Error);
  EXPECT_THROW(library.get(e), Error);
  reload("e.comp", "layout(local_size_x = 1) in; void main() {}\n");
  EXPECT_EQ(size_of(e), 1);
  EXPECT_TRUE(library.errors().empty());
}

// Ids of OpenGL's programs and shaders, up to some thousands above `own`.
std::set<GLuint> live_names(const std::set<GLuint>& own) {
  std::set<GLuint> names;
  for (GLuint id = 1; id < *own.rbegin() + 4096; ++id) {
    if (gl::glIsProgram(id) == GL_TRUE || gl::glIsShader(id) == GL_TRUE) names.insert(id);
  }
  return names;
}

TEST_F(ShaderReloadTest, ManySavesLeaveNoObjectsBehind) {
  const auto own_names = [&] { return std::set<GLuint>{library.get(a).id(), library.get(b).id()}; };
  // A program that an earlier test deleted while it was current lives until another one, or none, is made current. Then
  // its id is free, and a new program of this test can get it.
  gl::glUseProgram(0);
  std::set<GLuint> others = live_names(own_names());
  for (const GLuint id : own_names()) others.erase(id);
  std::minstd_rand random(1);
  for (int i = 0; i < 200; ++i) {
    const char* name = random() % 2 == 0 ? "size.glsl" : "b.comp";
    std::string text = "#define SIZE " + std::to_string(1 + random() % 64) + "\n";
    if (random() % 3 == 0) text += "oops\n";
    if (name == std::string("b.comp")) text += sized;
    save(name, text);
    const std::vector<fs::path> changed{folder / name};
    session::reload_shaders(library, changed);
    library.get(a).use();
  }
  save("size.glsl", "#define SIZE 3\n");
  save("b.comp", std::string("#define SIZE 5\n") + sized);
  session::reload_shaders(library, std::vector<fs::path>{folder / "size.glsl", folder / "b.comp"});
  EXPECT_EQ(size_of(a), 3);
  EXPECT_EQ(size_of(b), 5);
  EXPECT_TRUE(library.errors().empty());
  gl::glUseProgram(0);
  std::set<GLuint> left = live_names(own_names());
  for (const GLuint id : others) left.erase(id);
  EXPECT_EQ(left, own_names());
}

}  // namespace
}  // namespace penumbra
