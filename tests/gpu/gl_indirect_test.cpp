// Draws and dispatches whose counts are in a buffer, and geometry shaders.
#include "gl/api.h"
#include "gl/pass.h"
#include "gl_pass.h"

namespace penumbra {
namespace {

// A buffer of commands in which something else comes before the commands.
struct Commands {
  std::uint32_t unused = 12345;
  gl::DispatchCommand dispatch;
  gl::DrawArraysCommand arrays[2];
  gl::DrawElementsCommand elements[2];
};

// Each vertex leaves a mark of its index and instance; nothing is drawn.
constexpr const char* mark_text =
    "layout(std430, binding = 0) buffer Marks { uint marks[]; };\n"
    "void main() { atomicAdd(marks[gl_VertexID], 1u + 100u * uint(gl_InstanceID)); gl_Position = vec4(2, 2, 2, 1); }\n";

// A command for the next dispatch or draw, as a culling pass would write it.
constexpr const char* write_text =
    "layout(local_size_x = 1) in;\n"
    "layout(std430, binding = 0) buffer Commands { uint words[]; };\n"
    "void main() { words[1] = 3u; words[2] = 2u; words[3] = 1u; words[4] = 3u; words[5] = 1u; words[6] = 0u; words[7] "
    "= "
    "0u; }\n";

// The full-screen triangle, once for each layer, with the layer's number as its colour.
constexpr const char* layers_text =
    "layout(triangles) in;\nlayout(triangle_strip, max_vertices = 9) out;\nflat out float number;\n"
    "void main() {\n  for (int layer = 0; layer < 3; ++layer) {\n    for (int i = 0; i < 3; ++i) {\n"
    "      gl_Layer = layer;\n      number = float(layer) + OFFSET;\n      gl_Position = gl_in[i].gl_Position;\n"
    "      EmitVertex();\n    }\n    EndPrimitive();\n  }\n}\n";

class GlIndirect : public test::GlPassTest {
 protected:
  GlIndirect() {
    gl::ShaderFiles& files = device.shaders.files();
    files.put("mark.vert", mark_text);
    files.put("write.comp", write_text);
    files.put("layers.geom", layers_text);
    files.put("number.frag",
              "flat in float number;\nlayout(location = 0) out float color;\nvoid main() { color = number; }\n");
    for (gl::DrawArraysCommand& command : commands.arrays) command.instance_count = 0;
    for (gl::DrawElementsCommand& command : commands.elements) command.instance_count = 0;
  }

  const gl::Buffer& upload() {
    const gl::Buffer& buffer = device.scratch("commands", sizeof(Commands));
    gl::write_value(buffer, commands);
    return buffer;
  }

  // The marks that the first vertices left when `draw` drew them.
  template <class Draw>
  std::vector<unsigned> marks(Draw draw) {
    constexpr std::size_t vertices = 8;
    const gl::Buffer& buffer = device.scratch("marks", vertices * sizeof(unsigned));
    std::vector<unsigned> seen(vertices);
    buffer.write(std::as_bytes(std::span(seen)));
    {
      gl::Pass pass(device, {.name = "mark", .colors = {{.texture = &color}}});
      pass.use({.name = "mark", .vertex = "mark.vert"});
      buffer.bind_storage(0);
      draw(pass);
      pass.barrier();
    }
    gl::glGetNamedBufferSubData(buffer.id(), 0, sizeof(unsigned) * vertices, seen.data());
    return seen;
  }

  Commands commands;
};

TEST_F(GlIndirect, DispatchesAsManyGroupsAsTheCommandAtTheOffsetSays) {
  const gl::Texture& array = device.target(
      "array", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 24, .height = 16, .layers = 1});
  test::clear(device, {.name = "clear", .colors = {{.texture = &array, .clear = glm::vec4(-1)}}});
  commands.dispatch = {2, 1, 1};
  {
    gl::Pass pass(device, {.name = "fill"});
    pass.use(test::fill_program);
    array.bind_image(0, GL_WRITE_ONLY);
    pass.dispatch_indirect(upload(), offsetof(Commands, dispatch));
  }
  const std::vector<float> filled = gl::read_floats(array, 1);
  EXPECT_EQ(filled[15], 15.0f);
  EXPECT_EQ(filled[16], -1.0f) << "two groups of eight";
  EXPECT_EQ(filled[24 * 8], -1.0f);
}

TEST_F(GlIndirect, ACommandThatAShaderWroteIsSeen) {
  const gl::Texture& array = device.target(
      "array", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 32, .height = 32, .layers = 1});
  test::clear(device, {.name = "clear", .colors = {{.texture = &array, .clear = glm::vec4(-1)}}});
  const gl::Buffer& buffer = upload();
  {
    gl::Pass pass(device, {.name = "fill"});
    pass.use({.name = "write", .compute = "write.comp"});
    buffer.bind_storage(0);
    pass.dispatch(1, 1);
    pass.use(test::fill_program);
    array.bind_image(0, GL_WRITE_ONLY);
    pass.dispatch_indirect(buffer, offsetof(Commands, dispatch));
  }
  const std::vector<float> filled = gl::read_floats(array, 1);
  EXPECT_EQ(filled[32 * 15 + 23], 23.0f + 150.0f);
  EXPECT_EQ(filled[24], -1.0f);
  EXPECT_EQ(filled[32 * 16], -1.0f);
  const auto seen = marks([&](gl::Pass& pass) {
    pass.draw_arrays_indirect(GL_TRIANGLES, {buffer, offsetof(Commands, arrays)});
  });
  EXPECT_EQ(seen, (std::vector<unsigned>{1, 1, 1, 0, 0, 0, 0, 0}));
}

TEST_F(GlIndirect, DrawsEachCommandOfTheList) {
  commands.arrays[0] = {.vertex_count = 1, .instance_count = 1, .first_vertex = 1};
  commands.arrays[1] = {.vertex_count = 1, .instance_count = 2, .first_vertex = 3};
  const auto seen = marks([&](gl::Pass& pass) {
    pass.draw_arrays_indirect(GL_POINTS, {upload(), offsetof(Commands, arrays), 2});
  });
  EXPECT_EQ(seen, (std::vector<unsigned>{0, 1, 0, 102, 0, 0, 0, 0}));
}

TEST_F(GlIndirect, DrawsWithIndices) {
  const std::vector<std::uint32_t> numbers{7, 0, 2, 5};
  const gl::Buffer indices = gl::Buffer::of("indices", std::span<const std::uint32_t>(numbers));
  GLuint array = 0;
  gl::glCreateVertexArrays(1, &array);
  gl::glVertexArrayElementBuffer(array, indices.id());
  commands.elements[0] = {.index_count = 2, .instance_count = 1, .first_index = 1, .base_vertex = 1};
  commands.elements[1] = {.index_count = 1, .instance_count = 1, .first_index = 3, .base_vertex = -1};
  const auto seen = marks([&](gl::Pass& pass) {
    gl::glBindVertexArray(array);
    pass.draw_elements_indirect(GL_POINTS, GL_UNSIGNED_INT, {upload(), offsetof(Commands, elements), 2});
  });
  EXPECT_EQ(seen, (std::vector<unsigned>{0, 1, 0, 1, 1, 0, 0, 0}));
  gl::glDeleteVertexArrays(1, &array);
}

TEST_F(GlIndirect, AGeometryShaderDrawsToEveryLayer) {
  const gl::Texture& array =
      device.target("array", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 4, .height = 4, .layers = 3});
  {
    gl::Pass pass(device,
                  {.name = "layers",
                   .colors = {{.texture = &array, .layer = gl::Attachment::all_layers, .clear = glm::vec4(-1)}}});
    pass.set_viewport(0, 0, 4, 2);
    pass.use({.name = "layers",
              .vertex = "triangle.vert",
              .geometry = "layers.geom",
              .fragment = "number.frag",
              .defines = {{"OFFSET", "10.0"}}});
    pass.draw_full_screen();
  }
  for (int layer = 0; layer < 3; ++layer) {
    const std::vector<float> texels = gl::read_floats(array, 1, 0, layer);
    EXPECT_EQ(texels.front(), 10.0f + static_cast<float>(layer));
    EXPECT_EQ(texels.back(), -1.0f) << "cleared, layer " << layer;
  }
}

TEST_F(GlIndirect, AFaultOfAGeometryShaderNamesTheStage) {
  device.shaders.files().put("bad.geom", "layout(triangles) in;\nvoid main() { oops; }\n");
  const std::string message = test::message_of([&] {
    gl::Program({.name = "volumes", .vertex = "triangle.vert", .geometry = "bad.geom"}, device.shaders.files());
  });
  EXPECT_EQ(message.find("program 'volumes': the geometry shader does not compile\n"), 0u) << message;
  EXPECT_NE(message.find("glsl/bad.geom:2: "), std::string::npos) << message;
}

}  // namespace
}  // namespace penumbra
