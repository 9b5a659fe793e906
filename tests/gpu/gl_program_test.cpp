#include "gl/program.h"

#include <algorithm>

#include "gl/api.h"
#include "gpu_test.h"

namespace penumbra {
namespace {

using test::message_of;
using test::shader_files;

constexpr const char* triangle =
    "void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0, 1); }\n";

gl::ProgramDesc raster(std::string fragment) {
  return {.name = "blur", .vertex = "triangle.vert", .fragment = std::move(fragment)};
}

class GlProgram : public test::GpuTest {};

TEST_F(GlProgram, AnErrorNamesTheLineOfTheRootFile) {
  const auto files = shader_files({{"triangle.vert", triangle},
                                   {"lib/one.glsl", "float one() { return 1.0; }\n"},
                                   {"a.frag",
                                    "#include \"lib/one.glsl\"\n"
                                    "layout(location = 0) out vec4 color;\n"
                                    "void main() {\n"
                                    "  color = vec4(one() + nothing);\n"
                                    "}\n"}});
  const std::string message = message_of([&] { gl::Program(raster("a.frag"), files); });
  EXPECT_EQ(message.find("program 'blur': the fragment shader does not compile\n"), 0u) << message;
  EXPECT_NE(message.find("\nglsl/a.frag:4: "), std::string::npos) << message;
  EXPECT_NE(message.find("nothing"), std::string::npos) << message;
}

TEST_F(GlProgram, AnErrorNamesTheLineOfAnInclude) {
  // Unknown names and errors of type and syntax: drivers find them in different stages of compilation.
  for (const std::string fault : {"missing", "vec2(1.0)", "one.x", "1.0 +", "vec4(1.0).nothing"}) {
    const std::string text = "#pragma once\n\nfloat one() {\n  return " + fault + ";\n}\n";
    const auto files = shader_files({{"triangle.vert", triangle},
                                     {"lib/one.glsl", text.c_str()},
                                     {"a.frag",
                                      "layout(location = 0) out vec4 color;\n#include \"lib/one.glsl\"\n"
                                      "void main() { color = vec4(one()); }\n"}});
    const std::string message = message_of([&] { gl::Program(raster("a.frag"), files); });
    EXPECT_NE(message.find("\nglsl/lib/one.glsl:4: "), std::string::npos) << message;
  }
}

TEST_F(GlProgram, StagesThatDoNotLinkAreNamed) {
  const auto files = shader_files({{"v.vert", "layout(location = 0) out vec3 a;\nvoid main() { a = vec3(1); }\n"},
                                   {"f.frag",
                                    "layout(location = 0) in vec4 a;\nlayout(location = 0) out vec4 color;\n"
                                    "void main() { color = a; }\n"}});
  const std::string message =
      message_of([&] { gl::Program({.name = "mismatch", .vertex = "v.vert", .fragment = "f.frag"}, files); });
  EXPECT_EQ(message.find("program 'mismatch': the stages do not link\n"), 0u) << message;
}

TEST_F(GlProgram, DefinesAndUniformsReachTheShader) {
  const auto files = shader_files({{"triangle.vert", triangle},
                                   {"a.frag",
                                    "uniform float f; uniform int i; uniform vec2 v2; uniform vec3 v3;\n"
                                    "uniform vec4 v4; uniform mat4 m; uniform ivec2 i2;\n"
                                    "layout(location = 0) out vec4 color;\n"
                                    "void main() { color = vec4(f + v2.y, i + v3.z, (m * v4).x, i2.y + EXTRA); }\n"}});
  gl::Device device(files, gl::Timers::Mode::off);
  const gl::Texture& target = device.target("t", {.format = GL_RGBA32F});
  {
    gl::Pass pass(device, {.name = "p", .colors = {{.texture = &target}}});
    gl::ProgramDesc desc = raster("a.frag");
    desc.defines = {{"EXTRA", "100"}};
    const gl::Program& program = pass.use(desc);
    program.set("f", 1.0f);
    program.set("i", 2);
    program.set("v2", glm::vec2(0, 3));
    program.set("v3", glm::vec3(0, 0, 4));
    program.set("v4", glm::vec4(5, 0, 0, 1));
    program.set("m", glm::mat4(2.0f));
    program.set("i2", glm::ivec2(0, 6));
    program.set("not there", 1.0f);
    pass.draw_full_screen();
  }
  EXPECT_EQ(gl::read_floats(target, 4), (std::vector<float>{4, 6, 10, 106}));
}

TEST_F(GlProgram, FilesAreWhatItDependsOn) {
  const auto files = shader_files({{"triangle.vert", triangle},
                                   {"lib/one.glsl", "float one() { return 1.0; }\n"},
                                   {"a.frag",
                                    "#include \"lib/one.glsl\"\nlayout(location = 0) out vec4 color;\n"
                                    "void main() { color = vec4(one()); }\n"}});
  EXPECT_EQ(gl::Program(raster("a.frag"), files).files(),
            (std::vector<std::string>{"a.frag", "lib/one.glsl", "triangle.vert"}));
}

class GlShaderLibrary : public test::GpuTest {
 protected:
  static constexpr const char* good = "layout(local_size_x = 4) in; void main() {}\n";
  static constexpr const char* good_too = "layout(local_size_x = 8) in; void main() {}\n";
  static constexpr const char* includes_new =
      "#include \"lib/new.glsl\"\nlayout(local_size_x = N) in; void main() {}\n";

  void change(const std::string& name, const std::string& text) {
    library.files().put(name, text);
    library.changed(name);
  }

  gl::ShaderLibrary library{shader_files({{"a.comp", good}})};
  gl::ProgramDesc desc{.name = "a", .compute = "a.comp"};
};

TEST_F(GlShaderLibrary, CompilesOnceAndKeeps) {
  const gl::Program* first = &library.get(desc);
  EXPECT_EQ(first, &library.get(desc));
  EXPECT_EQ(library.size(), 1u);
  EXPECT_EQ(first->group_size(), glm::ivec3(4, 1, 1));
}

TEST_F(GlShaderLibrary, AChangeIsSeenByTheNextGet) {
  const gl::Program& program = library.get(desc);
  change("unrelated.glsl", "");
  const GLuint id = program.id();
  EXPECT_EQ(library.get(desc).id(), id);
  change("a.comp", good_too);
  EXPECT_EQ(library.get(desc).group_size().x, 8);
  EXPECT_EQ(&library.get(desc), &program) << "references stay valid";
}

TEST_F(GlShaderLibrary, ABrokenChangeKeepsTheLastGoodProgramAndAFixClearsTheError) {
  library.get(desc);
  change("a.comp", "layout(local_size_x = 8) in;\nvoid main() { oops; }\n");
  EXPECT_EQ(library.get(desc).group_size().x, 4);
  ASSERT_EQ(library.errors().size(), 1u);
  EXPECT_NE(library.errors().front().find("glsl/a.comp:2:"), std::string::npos) << library.errors().front();
  EXPECT_EQ(library.get(desc).group_size().x, 4);
  change("a.comp", good_too);
  EXPECT_EQ(library.get(desc).group_size().x, 8);
  EXPECT_TRUE(library.errors().empty());
}

TEST_F(GlShaderLibrary, AFixInAFileThatOnlyTheBrokenVersionIncludesCountsToo) {
  library.get(desc);
  change("a.comp", includes_new);
  EXPECT_EQ(library.get(desc).group_size().x, 4);
  EXPECT_EQ(library.errors().size(), 1u);
  change("lib/new.glsl", "#define N 16\n");
  EXPECT_EQ(library.get(desc).group_size().x, 16);
  EXPECT_TRUE(library.errors().empty());
}

TEST_F(GlShaderLibrary, AFirstFailureIsThrownAndLeavesNothing) {
  library.files().put("bad.comp", "void main() { oops; }\n");
  const gl::ProgramDesc bad{.name = "bad", .compute = "bad.comp"};
  EXPECT_THROW(library.get(bad), Error);
  library.files().put("bad.comp", good);
  EXPECT_NO_THROW(library.get(bad));
}

}  // namespace
}  // namespace penumbra
