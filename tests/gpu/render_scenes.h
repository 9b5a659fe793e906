#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>
#include <vector>

#include "gpu_test.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "scene/scene.h"

namespace penumbra::test {

// A square of side 2 in the plane z = 0 that faces +Z.
inline scene::Primitive square() {
  scene::Primitive square;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.normals.assign(4, {0, 0, 1});
  square.indices = {0, 1, 2, 0, 2, 3};
  return square;
}

// A scene whose material 0 has a normal map that leans to the side of the tangents, and a square of that material.
inline std::pair<scene::Scene, scene::Primitive> leaning_square() {
  scene::Primitive quad = square();
  quad.tangents.assign(4, {1, 0, 0, 1});
  quad.uvs[0].assign(4, {0.5f, 0.5f});
  quad.material = 0;
  scene::Scene scene;
  scene.images.push_back({.name = "leaning to the right", .rgba = {204, 128, 230, 255}});
  scene.textures.push_back({.image = 0});
  scene.materials.push_back({.normal_texture = {.texture = 0}});
  return {scene, quad};
}

// Adds a node that draws one primitive.
inline scene::Node& add_node(scene::Scene& scene, scene::Primitive primitive, const glm::mat4& world) {
  scene::Node node;
  node.matrix = world;
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back({.name = "mesh", .primitives = {std::move(primitive)}});
  scene.roots.push_back(static_cast<int>(scene.nodes.size()));
  scene.nodes.push_back(std::move(node));
  return scene.nodes.back();
}

// A renderer, and small pictures of scenes that a test builds.
class RenderTest : public GpuTest {
 protected:
  static constexpr int width = 64, height = 48;

  RenderTest() {
    inputs.width = width;
    inputs.height = height;
    inputs.camera = inputs.last_camera = render::look_at({0, 0, 4}, {0, 0, 0}, 1.0f, 0.01f);
    params.set_text("technique", "none");
  }

  // The light of the frames.
  render::SunLight& sun() { return std::get<render::SunLight>(inputs.lights.front()); }

  const render::Frame& draw(const scene::Scene& scene) {
    gpu_scene.emplace(device, scene);
    return renderer.draw(*gpu_scene, inputs, params);
  }

  // One pixel of an AOV; row 0 is the top.
  std::vector<float> pixel(std::string_view aov, int x, int y) const {
    const std::vector<float> values = renderer.read_aov(aov);
    const std::size_t channels = values.size() / (width * height);
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y * width + x) * channels);
    return {first, first + static_cast<std::ptrdiff_t>(channels)};
  }
  glm::vec3 pixel3(std::string_view aov, int x, int y) const {
    const std::vector<float> values = pixel(aov, x, y);
    return {values.at(0), values.at(1), values.at(2)};
  }
  int covered_pixels() const {
    int covered = 0;
    for (const float depth : renderer.read_aov("depth")) covered += depth > 0 ? 1 : 0;
    return covered;
  }

  // Unit vector from the eye through a pixel's centre, world space.
  glm::vec3 ray(int x, int y) const {
    const float tangent = std::tan(inputs.camera.fov_y * 0.5f);
    const float u = (2.0f * (static_cast<float>(x) + 0.5f) / width - 1.0f) * tangent * width / height;
    const float v = (1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / height) * tangent;
    return glm::normalize(glm::inverse(glm::mat3(inputs.camera.view)) * glm::vec3(u, v, -1.0f));
  }

  gl::Device device{gl::ShaderFiles(), gl::Timers::Mode::off};
  render::Renderer renderer{device};
  ParamSet params{render::Renderer::params(renderer.registry())};
  render::FrameInputs inputs;
  std::optional<scene::GpuScene> gpu_scene;
};

}  // namespace penumbra::test
