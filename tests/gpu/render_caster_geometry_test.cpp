// CasterKind::geometry: a technique's own shaders get the triangles of the scene's casters, in world space.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "gl/api.h"
#include "render_scenes.h"

namespace penumbra::test {
namespace {

constexpr GLuint triangles_binding = 4;

// Appends each triangle to a list and draws nothing.
constexpr const char* collect_text = R"(
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(std430, binding = 4) buffer Triangles { uint count; float positions[]; };
void main() {
  uint first = 9u * atomicAdd(count, 1u);
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) positions[first + 3u * uint(i) + uint(axis)] = gl_in[i].gl_Position[axis];
  }
}
)";

constexpr std::size_t most_triangles = 64;

void resolve(const shadow::PassContext& context) {
  const gl::Buffer& list = context.device().scratch("collected", sizeof(float) * (1 + 9 * most_triangles));
  gl::write_value(list, 0u);
  const gl::Attachment mask{.texture = &context.mask(), .layer = context.frame().layer, .clear = glm::vec4(1)};
  gl::Pass pass(context.device(), {.name = "collect", .colors = {mask}});
  list.bind_storage(triangles_binding);
  context.draw_caster_geometry(pass, "collect", glm::mat4(1));
  pass.barrier();
}

shadow::Technique collecting() {
  return {.name = "collecting",
          .summary = "Collects casters.",
          .source = "made up",
          .glsl = {},
          .needs = {},
          .resolve = resolve,
          .programs = [](const ParamSet&) -> std::vector<gl::ProgramDesc> {
            return {{.name = "collect", .geometry = "test/collect.geom"}};
          },
          .stand_in = "none"};
}

shadow::Registry with_collecting() {
  shadow::Registry::Contents contents = shadow::built_in_registry().contents();
  contents.techniques.push_back(collecting());
  contents.default_technique = "collecting";
  return shadow::Registry(std::move(contents));
}

// A triangle's nine coordinates, each by its nearest thousandth.
using Corners = std::array<long, 9>;

std::vector<Corners> sorted(std::vector<Corners> triangles) {
  std::ranges::sort(triangles);
  return triangles;
}

std::vector<Corners> collected(gl::Device& device) {
  const gl::Buffer& list = device.scratch("collected", 0);
  std::vector<float> contents(list.size() / sizeof(float));
  gl::glGetNamedBufferSubData(list.id(), 0, static_cast<GLsizeiptr>(list.size()), contents.data());
  const std::size_t count = std::bit_cast<unsigned>(contents.front());
  std::vector<Corners> triangles(std::min(count, most_triangles));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 9; ++k) triangles[i][k] = std::lround(1000 * contents[1 + 9 * i + k]);
  }
  return sorted(std::move(triangles));
}

// The triangles of all surfaces but lines and those of a material, from the CPU's side.
std::vector<Corners> expected(const scene::GpuScene& scene, int without) {
  std::vector<Corners> triangles;
  const scene::PosedGeometry posed = scene.posed_geometry();
  for (const scene::PosedSurface& surface : posed.surfaces) {
    const scene::Primitive& primitive = *surface.primitive;
    if (primitive.topology != scene::Topology::triangles || primitive.material == without) continue;
    const std::vector<std::uint32_t>& indices = primitive.indices;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      Corners& corners = triangles.emplace_back();
      for (std::size_t k = 0; k < 9; ++k) {
        const glm::vec4 local(surface.positions[indices[i + k / 3]], 1);
        corners[k] = std::lround(1000 * (surface.world * local)[static_cast<int>(k % 3)]);
      }
    }
  }
  return sorted(std::move(triangles));
}

class RenderCasterGeometry : public RenderTest {
 protected:
  RenderCasterGeometry() : collector(device, with_collecting()) {
    device.shaders.files().put("test/collect.geom", collect_text);
    scene.materials = {{.name = "leaf", .alpha_mode = scene::AlphaMode::mask},
                       {.name = "glass", .alpha_mode = scene::AlphaMode::blend}};
    add_node(scene, square(), glm::translate(glm::mat4(1), {0.5f, 0, 0}));
    add_node(scene, square(), glm::scale(glm::mat4(1), {-1, 0.5f, 2}));  // mirrored
    scene::Primitive morphed = square();
    morphed.targets = {{.positions = std::vector<glm::vec3>(4, {0, 0, 0.25f}), .normals = {}, .tangents = {}}};
    add_node(scene, morphed, glm::mat4(1));
    scene.meshes.back().default_weights = {1};
    add_node(scene, with_material(leaf), glm::translate(glm::mat4(1), {0, 0, -1}));
    add_node(scene, with_material(glass), glm::mat4(1));
    scene::Primitive lines = square();
    lines.topology = scene::Topology::lines;
    lines.indices = {0, 1, 1, 2};
    add_node(scene, lines, glm::mat4(1));
  }
  static scene::Primitive with_material(int material) {
    scene::Primitive primitive = square();
    primitive.material = material;
    primitive.colors = {{1, 1, 1, 1}, {1, 1, 1, 0.75f}, {1, 1, 1, 0.25f}, {1, 1, 1, 0}};  // parts cast, parts do not
    return primitive;
  }

  static constexpr int leaf = 0, glass = 1;
  scene::Scene scene;
  render::Renderer collector;
  ParamSet collecting_params{render::Renderer::params(collector.registry())};
};

TEST_F(RenderCasterGeometry, EveryCastersTrianglesReachTheTechniquesShaderInWorldSpace) {
  GLint blocks = 0;
  gl::glGetIntegerv(GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS, &blocks);
  if (blocks == 0) GTEST_SKIP() << "no storage buffers in geometry shaders";
  gpu_scene.emplace(device, scene);
  collector.draw(*gpu_scene, inputs, collecting_params);
  const std::vector<Corners> triangles = collected(device);
  EXPECT_EQ(triangles.size(), 8u);
  EXPECT_EQ(triangles, expected(*gpu_scene, glass));
}

TEST_F(RenderCasterGeometry, ItsProgramsAreListedWholeForTheChecks) {
  int own = 0;
  for (const gl::ProgramDesc& program : collector.all_programs(collecting_params)) {
    if (program.name != "collecting: collect") continue;
    EXPECT_EQ(program.vertex, "scene/caster.vert");
    EXPECT_NO_THROW(gl::Program(program, device.shaders.files()));
    ++own;
  }
  EXPECT_EQ(own, 2) << "points rotated and shifted";
}

}  // namespace
}  // namespace penumbra::test
