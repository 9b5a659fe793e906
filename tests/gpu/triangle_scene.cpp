#include "triangle_scene.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <utility>

namespace penumbra::test {

namespace {

constexpr const char* receiver_vertex_text = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 world_to_clip;
flat out vec3 world_normal;
void main() {
  gl_Position = world_to_clip * vec4(position, 1.0);
  world_normal = normal;
}
)";

constexpr const char* receiver_fragment_text = R"(
#include "lib/octahedral.glsl"
flat in vec3 world_normal;
layout(location = 0) out vec2 encoded;
void main() { encoded = octahedral_encode(gl_FrontFacing ? world_normal : -world_normal); }
)";

constexpr const char* caster_vertex_text = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec3 moved_by;
uniform mat4 world_to_clip;
uniform int only_moved;
uniform float poses_ago;
invariant gl_Position;
flat out float caster_moved;
void main() {
  caster_moved = moved_by != vec3(0.0) ? 1.0 : 0.0;
  gl_Position = world_to_clip * vec4(position - poses_ago * moved_by, 1.0);
  if (only_moved != 0 && caster_moved == 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
)";

constexpr const char* caster_fragment_text = R"(
flat in float caster_moved;
layout(location = 0) out float moved;
void main() { moved = caster_moved; }
)";

constexpr const char* behind_fragment_text = R"(
uniform float gap;
layout(location = 0) out float depth;
void main() { depth = gl_FragCoord.z + gap; }
)";

const gl::ProgramDesc receiver_program{
    .name = "test receivers", .vertex = "test/receiver.vert", .fragment = "test/receiver.frag"};

gl::ProgramDesc caster_program(const shadow::CasterPass& casters) {
  gl::ProgramDesc program{.name = "test casters", .vertex = "test/caster.vert", .fragment = "test/caster.frag"};
  if (casters.kind == shadow::CasterKind::depth) program.fragment = "";
  if (casters.kind == shadow::CasterKind::second_depth) program.fragment = "test/behind.frag";
  if (casters.kind == shadow::CasterKind::geometry) {
    program = casters.program;
    program.vertex = "test/caster.vert";
  }
  return program;
}

struct Vertex {
  glm::vec3 position, normal, moved_by;
};

shadow::Box bounds_of(const TriangleScene& scene) {
  shadow::Box box{glm::vec3(1e30f), glm::vec3(-1e30f)};
  for (const Triangle& t : scene.triangles) {
    for (const glm::vec3& corner : {t.a, t.b, t.c}) box = {glm::min(box.min, corner), glm::max(box.max, corner)};
  }
  return box;
}

// For passes, whose clip-space z is in 0..1.
glm::mat4 drawn_projection(const TriangleScene& scene) {
  glm::mat4 drawn(1);
  if (!scene.conventions.depth_zero_to_one) drawn[2][2] = drawn[3][2] = 0.5f;
  drawn[3][0] = 2 * scene.drawn_beside.x / static_cast<float>(scene.width);
  drawn[3][1] = 2 * scene.drawn_beside.y / static_cast<float>(scene.height);
  return drawn * scene.projection;
}

const gl::Texture& in_half_floats(gl::Device& device, const gl::Texture& depth) {
  const gl::Texture& half =
      device.target("test depth in half floats", {.format = GL_R16F, .width = depth.width(), .height = depth.height()});
  const std::vector<float> values = gl::read_floats(depth, 1);
  half.upload(GL_RED, GL_FLOAT, std::as_bytes(std::span(values)));
  return half;
}

// Of clip space.
double clip_depth(const TriangleScene& scene, double stored) {
  return scene.conventions.depth_zero_to_one ? stored : 2 * stored - 1;
}

}  // namespace

void TriangleScene::add_quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  triangles.push_back({corner, corner + u, corner + u + v});
  triangles.push_back({corner, corner + u + v, corner + v});
}

void TriangleScene::add_box(const glm::vec3& min, const glm::vec3& max) {
  const glm::vec3 size = max - min;
  const glm::vec3 x{size.x, 0, 0};
  const glm::vec3 y{0, size.y, 0};
  const glm::vec3 z{0, 0, size.z};
  add_quad(min, y, x);
  add_quad(min + z, x, y);
  add_quad(min, z, y);
  add_quad(min + x, y, z);
  add_quad(min, x, z);
  add_quad(min + y, z, x);
}

void TriangleScene::move_from(size_t first, const glm::vec3& by) {
  for (size_t i = first; i < triangles.size(); ++i) {
    Triangle& t = triangles[i];
    t = {t.a + by, t.b + by, t.c + by, t.moved_by + by};
  }
}

shadow::Box TriangleScene::moved() const {
  shadow::Box box{glm::vec3(1e30f), glm::vec3(-1e30f)};
  for (const Triangle& t : triangles) {
    if (t.moved_by == glm::vec3(0)) continue;
    for (const glm::vec3& corner : {t.a, t.b, t.c}) {
      for (const glm::vec3& at : {corner, corner - t.moved_by}) box = {glm::min(box.min, at), glm::max(box.max, at)};
    }
  }
  return box;
}

Geometry::Geometry(const TriangleScene& scene) {
  std::vector<Vertex> vertices;
  for (const Triangle& t : scene.triangles) {
    const glm::vec3 normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
    for (const glm::vec3& corner : {t.a, t.b, t.c}) vertices.push_back({corner, normal, t.moved_by});
  }
  count_ = static_cast<GLsizei>(vertices.size());
  buffer_ = gl::Buffer::of("test vertices", std::span<const Vertex>(vertices));
  gl::glCreateVertexArrays(1, &array_);
  gl::glVertexArrayVertexBuffer(array_, 0, buffer_.id(), 0, sizeof(Vertex));
  for (GLuint i = 0; i < 3; ++i) {
    gl::glEnableVertexArrayAttrib(array_, i);
    gl::glVertexArrayAttribFormat(array_, i, 3, GL_FLOAT, GL_FALSE, i * sizeof(glm::vec3));
    gl::glVertexArrayAttribBinding(array_, i, 0);
  }
}

Geometry::~Geometry() { gl::glDeleteVertexArrays(1, &array_); }

void Geometry::put_shaders(gl::ShaderFiles& files) {
  files.put("test/receiver.vert", receiver_vertex_text);
  files.put("test/receiver.frag", receiver_fragment_text);
  files.put("test/caster.vert", caster_vertex_text);
  files.put("test/caster.frag", caster_fragment_text);
  files.put("test/behind.frag", behind_fragment_text);
}

void Geometry::draw() const {
  gl::glBindVertexArray(array_);
  gl::glDrawArrays(GL_TRIANGLES, 0, count_);
}

shadow::DrawCasters Geometry::casters() const {
  return [this](const shadow::CasterPass& casters, gl::Pass& pass) {
    using enum shadow::CasterKind;
    const gl::Program& program = pass.use(caster_program(casters));
    program.set("world_to_clip", casters.world_to_clip);
    program.set("only_moved", casters.kind == moved_now || casters.kind == moved_last ? 1 : 0);
    program.set("poses_ago", casters.kind == moved_last ? 1.0f : 0.0f);
    if (casters.kind == second_depth) program.set("gap", casters.gap);
    draw();
  };
}

TriangleScene box_on_ground(int side) {
  TriangleScene scene;
  scene.add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  scene.add_box({-1, 0, -1}, {1, 2, 1});
  scene.view = glm::lookAt(glm::vec3(2, 5, 6), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.8f, 1, 0.1f);
  scene.width = scene.height = side;
  scene.to_light = sun_direction(60, 40);
  return scene;
}

TriangleScene half_plane_over_ground(int side) {
  TriangleScene scene;
  scene.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  scene.add_quad({-20, 5, -20}, {0, 0, 40}, {20, 0, 0});
  scene.receivers = shadow::Box{{-2, 0, -2}, {2, 0, 2}};
  scene.width = scene.height = side;
  scene.view = glm::lookAt(glm::vec3(0, 2.5f, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  return scene;
}

glm::mat4 orthographic(float half_width, float half_height, float near, float far) {
  glm::mat4 m(1);
  m[0][0] = 1 / half_width;
  m[1][1] = 1 / half_height;
  m[2][2] = 1 / (far - near);
  m[3][2] = far / (far - near);
  return m;
}

glm::mat4 perspective(float fov_y, float aspect, float near) {
  const float scale = 1 / std::tan(fov_y / 2);
  glm::mat4 m(0);
  m[0][0] = scale / aspect;
  m[1][1] = scale;
  m[2][3] = -1;
  m[3][2] = near;
  return m;
}

glm::mat4 standard_perspective(float fov_y, float aspect, float near, float far) {
  return glm::perspectiveRH_NO(fov_y, aspect, near, far);
}

glm::vec3 sun_direction(float azimuth_degrees, float elevation_degrees) {
  const float azimuth = glm::radians(azimuth_degrees);
  const float elevation = glm::radians(elevation_degrees);
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

TriangleRenderer::TriangleRenderer(shadow::Registry registry)
    : device_(gl::ShaderFiles(), gl::Timers::Mode::off), shadows_(device_, std::move(registry)) {
  Geometry::put_shaders(device_.shaders.files());
}

Shadowed TriangleRenderer::render(const TriangleScene& scene, const ParamSet& params, const Adjust& adjust,
                                  const std::function<void()>& after) {
  const Geometry geometry(scene);
  // A texture of another format can get the last one's name.
  if (std::exchange(depth_format_, scene.depth_format) != scene.depth_format) shadows_.forget_view(0);
  const bool half = scene.depth_format == GL_R16F;
  const gl::Texture& drawn_depth =
      device_.target("test depth", {.format = half ? GLenum{GL_DEPTH_COMPONENT32F} : scene.depth_format,
                                    .width = scene.width,
                                    .height = scene.height});
  const gl::Texture& normals =
      device_.target("test normals", {.format = GL_RG32F, .width = scene.width, .height = scene.height});
  const bool reversed = scene.conventions.reversed_z;
  const float sky_depth = reversed ? 0.0f : 1.0f;
  {
    gl::Pass pass(device_, {.name = "receivers",
                            .colors = {{.texture = &normals, .clear = glm::vec4(0)}},
                            .depth = gl::Attachment{.texture = &drawn_depth, .clear = glm::vec4(sky_depth)},
                            .depth_test = reversed ? gl::DepthTest::greater_equal : gl::DepthTest::less_equal,
                            .depth_write = true});
    pass.use(receiver_program).set("world_to_clip", drawn_projection(scene) * scene.view);
    geometry.draw();
  }
  // As engines that draw so have it.
  gl::glClipControl(GL_LOWER_LEFT, scene.conventions.depth_zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  const gl::Texture& depth = half ? in_half_floats(device_, drawn_depth) : drawn_depth;
  const shadow::Light light{.source = shadow::Sun{scene.to_light}};
  shadow::Inputs inputs{.view = {.view = scene.view, .projection = scene.projection},
                        .conventions = scene.conventions,
                        .depth = {depth.id(), scene.width, scene.height},
                        .normals = {normals.id(), scene.width, scene.height},
                        .lights = {&light, 1},
                        .casters = scene.casters.value_or(bounds_of(scene)),
                        .receivers = scene.receivers.value_or(bounds_of(scene)),
                        .moved = scene.moved(),
                        .mask_details = true,
                        .draw = geometry.casters()};
  if (adjust) adjust(inputs);
  mask_ = shadows_.render(inputs, params);
  if (after) after();
  Shadowed result{.width = scene.width,
                  .height = scene.height,
                  .mask = gl::read_floats(*mask_.texture, 4),
                  .depth = gl::read_floats(depth, 1),
                  .points = {},
                  .sky_depth = sky_depth};
  const glm::dmat4 clip_to_world = glm::inverse(glm::dmat4(scene.projection) * glm::dmat4(scene.view));
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const double stored = result.depth[static_cast<size_t>(y * scene.width + x)];
      const glm::dvec4 p = clip_to_world * glm::dvec4((x + 0.5) / scene.width * 2 - 1, (y + 0.5) / scene.height * 2 - 1,
                                                      clip_depth(scene, stored), 1);
      result.points.emplace_back(glm::dvec3(p) / p.w);
    }
  }
  return result;
}

}  // namespace penumbra::test
