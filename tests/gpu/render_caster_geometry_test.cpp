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

// A triangle's nine coordinates, in rounded thousandths.
using Corners = std::array<long, 9>;

std::vector<Corners> sorted(std::vector<Corners> triangles) {
  std::ranges::sort(triangles);
  return triangles;
}

bool has_area(const Corners& c) {
  return !std::equal(c.begin(), c.begin() + 3, c.begin() + 3) || !std::equal(c.begin(), c.begin() + 3, c.begin() + 6);
}

// The triangles that reached the technique, without those that have all corners in one place.
std::vector<Corners> collected(gl::Device& device) {
  const gl::Buffer& list = device.scratch("collected", 0);
  std::vector<float> contents(list.size() / sizeof(float));
  gl::glGetNamedBufferSubData(list.id(), 0, static_cast<GLsizeiptr>(list.size()), contents.data());
  const std::size_t count = std::bit_cast<unsigned>(contents.front());
  std::vector<Corners> triangles(std::min(count, most_triangles));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 9; ++k) triangles[i][k] = std::lround(1000 * contents[1 + 9 * i + k]);
  }
  std::erase_if(triangles, [](const Corners& corners) { return !has_area(corners); });
  return sorted(std::move(triangles));
}

// Whether a triangle with these corners, in world space, casts a shadow in the light from that direction.
bool casts(const scene::PosedSurface& surface, const std::array<glm::vec3, 3>& c, const glm::vec3& to_light) {
  if (surface.faces == scene::CasterFaces::both) return true;
  const bool front = (glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), to_light) > 0) != surface.mirrored;
  return front == (surface.faces == scene::CasterFaces::front);
}

// The triangles that cast shadows in that light, except those of one material, computed on the CPU.
std::vector<Corners> expected(const scene::GpuScene& scene, int without, const glm::vec3& to_light) {
  std::vector<Corners> triangles;
  const scene::PosedGeometry posed = scene.posed_geometry();
  for (const scene::PosedSurface& surface : posed.surfaces) {
    const scene::Primitive& primitive = *surface.primitive;
    if (primitive.topology != scene::Topology::triangles || primitive.material == without) continue;
    const std::vector<std::uint32_t>& indices = primitive.indices;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      std::array<glm::vec3, 3> world{};
      for (std::size_t k = 0; k < 3; ++k) world[k] = surface.world * glm::vec4(surface.positions[indices[i + k]], 1);
      if (!casts(surface, world, to_light)) continue;
      Corners& corners = triangles.emplace_back();
      for (std::size_t k = 0; k < 9; ++k) corners[k] = std::lround(1000 * world[k / 3][static_cast<int>(k % 3)]);
    }
  }
  return sorted(std::move(triangles));
}

class RenderCasterGeometry : public RenderTest {
 protected:
  RenderCasterGeometry() : collector(device, with_collecting()) {
    device.shaders.files().put("test/collect.geom", collect_text);
    scene.materials = {{.name = "leaf", .alpha_mode = scene::AlphaMode::mask},
                       {.name = "glass", .alpha_mode = scene::AlphaMode::blend},
                       {.name = "cloth", .double_sided = true}};
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
    primitive.colors = {
        {1, 1, 1, 1}, {1, 1, 1, 0.75f}, {1, 1, 1, 0.25f}, {1, 1, 1, 0}};  // a part casts, the rest does not
    return primitive;
  }

  static constexpr int leaf = 0, glass = 1, cloth = 2;
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
  EXPECT_EQ(triangles, expected(*gpu_scene, glass, sun().to_light));
}

TEST_F(RenderCasterGeometry, OnlyTheFacesThatCastReachTheTechniquesShader) {
  GLint blocks = 0;
  gl::glGetIntegerv(GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS, &blocks);
  if (blocks == 0) GTEST_SKIP() << "no storage buffers in geometry shaders";
  const glm::mat4 turned = glm::rotate(glm::mat4(1), 3.0f, {0, 1, 0});
  add_node(scene, square(), glm::translate(turned, {0, 0, 0.5f}));
  add_node(scene, square(), glm::scale(turned, {1, -1, 1}));  // mirrored
  scene::Primitive two_sided = square();
  two_sided.material = cloth;
  add_node(scene, two_sided, turned);
  sun().to_light = glm::normalize(glm::vec3(0.3f, 0.2f, 1));
  gpu_scene.emplace(device, scene);
  std::size_t counts[3] = {};
  for (const auto& [i, faces] : {std::pair(0, "both"), {1, "front"}, {2, "back"}}) {
    SCOPED_TRACE(faces);
    collecting_params.set_text("casters.faces", faces);
    collector.draw(*gpu_scene, inputs, collecting_params);
    const std::vector<Corners> triangles = collected(device);
    counts[i] = triangles.size();
    EXPECT_EQ(triangles, expected(*gpu_scene, glass, sun().to_light));
  }
  EXPECT_EQ(counts[0], 14u);
  EXPECT_EQ(counts[1], 10u) << "four squares that face the light, and the one with two sides";
  EXPECT_EQ(counts[2], 6u) << "two squares that face away from it, and the one with two sides";
}

TEST_F(RenderCasterGeometry, ItsProgramsAreListedWholeForTheChecks) {
  int own = 0;
  for (const gl::ProgramDesc& program : collector.all_programs(collecting_params)) {
    if (program.name != "collecting: collect") continue;
    EXPECT_TRUE(program.vertex == "scene/caster.vert" || program.vertex == "scene/caster_face.vert") << program.vertex;
    EXPECT_NO_THROW(gl::Program(program, device.shaders.files()));
    ++own;
  }
  EXPECT_EQ(own, 8)
      << "points rotated and shifted, suns and lamps, surfaces of which both faces cast and one face does";
}

}  // namespace
}  // namespace penumbra::test
