// The G-buffer: depth, normals, motion, culling, alpha masks, instances.
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "render_scenes.h"

namespace penumbra::test {
namespace {

class GBufferTest : public RenderTest {};

// Turned about an oblique axis and moved.
glm::mat4 tilted() {
  return glm::rotate(glm::translate(glm::mat4(1), glm::vec3(0.2f, -0.1f, -0.5f)), 0.7f,
                     glm::normalize(glm::vec3(1, 2, 0.5f)));
}

TEST_F(GBufferTest, DepthIsTheDistanceFromTheCameraPlane) {
  scene::Scene scene;
  add_node(scene, square(), tilted());
  draw(scene);
  const glm::vec3 normal = glm::vec3(tilted()[2]), point(tilted()[3]), eye(0, 0, 4);
  const auto depth_at = [&](int x, int y) {
    const float distance = glm::dot(point - eye, normal) / glm::dot(ray(x, y), normal);
    return -(distance * ray(x, y)).z;
  };
  const std::vector<float> depths = renderer.read_aov("depth");
  int checked = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float depth = depths[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
      if (depth == 0) continue;
      const float exact = depth_at(x, y);
      // The rasteriser rounds vertices.
      const float beside = std::abs(depth_at(x + 1, y) - exact) + std::abs(depth_at(x, y + 1) - exact);
      EXPECT_NEAR(depth, exact, 2e-5f + device.vertex_rounding() * beside) << x << ", " << y;
      ++checked;
    }
  }
  EXPECT_GT(checked, 200);
}

TEST_F(GBufferTest, GeometricNormalIsExactAndFacesTheCamera) {
  for (const bool turned : {false, true}) {
    scene::Primitive quad = square();
    quad.normals.assign(4, glm::normalize(glm::vec3(0.3f, 0.2f, 1)));  // shading normals must not matter
    scene::Scene scene;
    scene.materials.push_back({.double_sided = true});
    quad.material = 0;
    const glm::mat4 world =
        glm::scale(turned ? glm::rotate(tilted(), 3.14159265f, glm::vec3(0, 1, 0)) : tilted(), glm::vec3(0.5f, 1, 3));
    add_node(scene, quad, world);
    draw(scene);
    glm::vec3 expected = glm::normalize(glm::cross(glm::vec3(world[0]), glm::vec3(world[1])));
    if (turned) expected = -expected;
    EXPECT_GT(glm::dot(expected, glm::vec3(0, 0, 1)), 0);
    const glm::vec3 seen = pixel3("geometric_normal", width / 2, height / 2);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], expected[i], 1e-6f) << "turned " << turned;
  }
}

// Corners on a line, which rounding on the screen moves apart by so much that some triangles cover a pixel's middle.
TEST_F(GBufferTest, GeometricNormalsOfTrianglesWithoutAreaAreTheSmoothOnes) {
  const glm::vec3 normal(0, 0.6f, 0.8f), edge(0.75f, 0.0625f, 0);
  scene::Primitive needles;
  for (int i = 0; i < 4000; ++i) {
    for (const float corner : {0.0f, 1.0f, 2.0f}) {
      needles.indices.push_back(static_cast<std::uint32_t>(needles.positions.size()));
      needles.positions.push_back(glm::vec3(-1, static_cast<float>(i) / 2048 - 1, 0) + corner * edge);
      needles.normals.push_back(normal);
    }
  }
  scene::Scene scene;
  add_node(scene, needles, glm::mat4(1));
  draw(scene);
  const std::vector<float> depth = renderer.read_aov("depth"), seen = renderer.read_aov("geometric_normal");
  int smooth = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] == 0) continue;
    const glm::vec3 found(seen[3 * i], seen[3 * i + 1], seen[3 * i + 2]);
    const bool is_smooth = glm::distance(found, normal) < 1e-4f;
    smooth += is_smooth ? 1 : 0;
    EXPECT_TRUE(is_smooth || found == glm::vec3(0, 0, 1)) << i << ": nor is it to the camera, without a smooth one";
  }
  EXPECT_GT(smooth, 0);
}

TEST_F(GBufferTest, NormalMapsLeanAsFarAsTheirScaleSays) {
  auto [scene, quad] = leaning_square();
  add_node(scene, quad, glm::mat4(1));
  for (const float scale : {1.0f, 0.5f, -2.0f}) {
    scene.materials[0].normal_scale = scale;
    draw(scene);
    const glm::vec3 expected = glm::normalize(glm::vec3(0.6f * scale, 0, 0.8f));
    EXPECT_LT(glm::distance(pixel3("normal", width / 2, height / 2), expected), 0.01f) << scale;
  }
}

TEST_F(GBufferTest, ShadingNormalsOfBackFacesTurnRound) {
  scene::Scene scene;
  scene.materials.push_back({.double_sided = true});
  scene::Primitive quad = square();
  quad.material = 0;
  add_node(scene, quad, glm::rotate(glm::mat4(1), 3.14159265f, glm::vec3(0, 1, 0)));
  draw(scene);
  const glm::vec3 normal = pixel3("normal", width / 2, height / 2);
  EXPECT_NEAR(normal.z, 1, 1e-4f);
}

// A texture of an opaque and a clear half, twice over a square, from the left to the right or from below upwards.
TEST_F(GBufferTest, TexturesAreRepeatedMirroredOrHeldAtTheirEdge) {
  using enum scene::Wrap;
  for (const auto& [wrap, expected] :
       {std::pair(repeat, "#.#."), std::pair(mirrored_repeat, "#..#"), std::pair(clamp_to_edge, "#...")}) {
    for (const bool upwards : {false, true}) {
      scene::Scene scene;
      scene.images.push_back({.name = "halves",
                              .width = upwards ? 1 : 2,
                              .height = upwards ? 2 : 1,
                              .rgba = {255, 255, 255, 255, 255, 255, 255, 0}});
      scene.textures.push_back(
          {.image = 0, .mag = scene::Filter::nearest, .min = scene::Filter::nearest, .mipmapped = false});
      (upwards ? scene.textures[0].wrap_t : scene.textures[0].wrap_s) = wrap;
      scene.materials.push_back({.base_color_texture = {.texture = 0}, .alpha_mode = scene::AlphaMode::mask});
      scene::Primitive quad = square();
      quad.uvs[0] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
      quad.material = 0;
      add_node(scene, quad, glm::mat4(1));
      draw(scene);
      std::string seen;
      for (const int at : {-9, -3, 2, 8}) {  // the middles of its quarters
        const int x = width / 2 + (upwards ? 0 : at), y = height / 2 - 1 - (upwards ? at : 0);
        seen += pixel("depth", x, y)[0] > 0 ? '#' : '.';
      }
      EXPECT_EQ(seen, expected) << (upwards ? "upwards" : "to the right");
    }
  }
}

TEST_F(GBufferTest, MotionOfAMovedCameraIsTheReprojection) {
  scene::Scene scene;
  add_node(scene, square(), tilted());
  inputs.last_camera = render::look_at({0.1f, -0.05f, 4.2f}, {0.02f, 0, 0}, 1.0f, 0.01f);
  draw(scene);
  const glm::mat4 last = render::projection_of(inputs.last_camera, float{width} / height) * inputs.last_camera.view;
  for (const glm::ivec2 at : {glm::ivec2(32, 24), glm::ivec2(28, 20), glm::ivec2(38, 27)}) {
    const float depth = pixel("depth", at.x, at.y)[0];
    ASSERT_GT(depth, 0);
    const glm::vec3 direction = ray(at.x, at.y);
    const glm::vec4 clip = last * glm::vec4(glm::vec3(0, 0, 4) + direction * (depth / -direction.z), 1);
    const glm::vec2 was((clip.x / clip.w * 0.5f + 0.5f) * width, (0.5f - clip.y / clip.w * 0.5f) * height);
    const std::vector<float> motion = pixel("motion", at.x, at.y);
    EXPECT_NEAR(motion[0], static_cast<float>(at.x) + 0.5f - was.x, 1e-3f);
    EXPECT_NEAR(motion[1], static_cast<float>(at.y) + 0.5f - was.y, 1e-3f);
  }
}

TEST_F(GBufferTest, WhatWasBehindTheCameraHasNoMotion) {
  scene::Scene scene;
  add_node(scene, square(), glm::mat4(1));
  inputs.last_camera = render::look_at({0, 0, 4}, {0, 0, 8}, 1.0f, 0.01f);
  draw(scene);
  EXPECT_EQ(pixel("motion", width / 2 + 5, height / 2 + 3), (std::vector<float>{0, 0}));
}

TEST_F(GBufferTest, MotionOfAMovedObjectIsItsPath) {
  scene::Scene scene;
  scene::Node& node = add_node(scene, square(), glm::mat4(1));
  node.matrix.reset();
  scene.animations.push_back(
      {.name = "slide", .channels = {{.node = 0, .times = {0, 1}, .values = {0, 0, 0, 1, 0, 0}}}, .duration = 1});
  inputs.last_time = 0.25;
  inputs.time = 0.5;
  draw(scene);
  const float expected = 0.25f / (4.0f * std::tan(0.5f)) * height / 2;
  const std::vector<float> motion = pixel("motion", width / 2 + 4, height / 2);
  EXPECT_NEAR(motion[0], expected, 1e-3f);
  EXPECT_NEAR(motion[1], 0, 1e-4f);
  EXPECT_TRUE(gpu_scene->moved());
  inputs.last_time = inputs.time;
  renderer.draw(*gpu_scene, inputs, params);
  EXPECT_NEAR(pixel("motion", width / 2 + 4, height / 2)[0], 0, 1e-6f);
  EXPECT_FALSE(gpu_scene->moved());
}

TEST_F(GBufferTest, MirroredNodesShowTheirFrontFaces) {
  for (const glm::vec3 scale : {glm::vec3(1), glm::vec3(-1, 1, 1), glm::vec3(1, -1, 1)}) {
    scene::Scene scene;
    add_node(scene, square(), glm::scale(glm::mat4(1), scale));
    draw(scene);
    EXPECT_GT(covered_pixels(), 400) << scale.x << ", " << scale.y;
    EXPECT_NEAR(pixel3("normal", width / 2, height / 2).z, 1, 1e-4f);
    EXPECT_NEAR(pixel3("geometric_normal", width / 2, height / 2).z, 1, 1e-6f);
  }
  scene::Scene behind;
  add_node(behind, square(), glm::scale(glm::mat4(1), glm::vec3(1, 1, -1)));
  draw(behind);
  EXPECT_EQ(covered_pixels(), 0) << "mirrored along its normal, the square shows its back";
}

TEST_F(GBufferTest, MaskCutsOutWhatItsTextureLeavesOpen) {
  scene::Scene scene;
  scene.images.push_back({.name = "halves", .width = 2, .height = 1, .rgba = {255, 255, 255, 255, 255, 255, 255, 0}});
  scene.textures.push_back(
      {.image = 0, .mag = scene::Filter::nearest, .min = scene::Filter::nearest, .mipmapped = false});
  scene.materials.push_back({.base_color_texture = {.texture = 0}, .alpha_mode = scene::AlphaMode::mask});
  scene::Primitive quad = square();
  quad.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  quad.material = 0;
  add_node(scene, quad, glm::mat4(1));
  draw(scene);
  EXPECT_GT(pixel("depth", width / 2 - 5, height / 2)[0], 0);
  EXPECT_EQ(pixel("depth", width / 2 + 5, height / 2)[0], 0);
}

TEST_F(GBufferTest, CopiesStandWhereTheirTransformsPutThem) {
  scene::Scene scene;
  scene::Node& node = add_node(scene, square(), glm::translate(glm::mat4(1), glm::vec3(0, 0.5f, 0)));
  for (const float x : {-1.0f, 0.0f, 1.0f}) {
    node.instances.push_back({.translation = glm::vec3(x, 0, x), .scale = glm::vec3(0.2f)});
  }
  draw(scene);
  for (const float x : {-1.0f, 0.0f, 1.0f}) {
    const glm::vec4 clip =
        render::projection_of(inputs.camera, float{width} / height) * inputs.camera.view * glm::vec4(x, 0.5f, x, 1);
    const auto column = static_cast<int>((clip.x / clip.w * 0.5f + 0.5f) * width);
    const auto row = static_cast<int>((0.5f - clip.y / clip.w * 0.5f) * height);
    EXPECT_NEAR(pixel("depth", column, row)[0], 4 - x, 1e-4f);
  }
}

TEST_F(GBufferTest, OfSurfacesAtTheSameDepthTheSameOneIsSeenFromEverywhere) {
  // Two coincident squares of different colours, each beside a wall that makes its object the nearer one for one of the
  // cameras.
  scene::Scene scene;
  for (const float side : {-1.0f, 1.0f}) {
    scene.materials.push_back({.base_color = side < 0 ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1), .unlit = true});
    scene::Primitive primitive = square();
    for (const glm::vec3& corner : square().positions)
      primitive.positions.push_back(glm::vec3(side * 3, 0, 2) + corner * 0.1f);
    primitive.normals.assign(8, {0, 0, 1});
    for (const std::uint32_t index : square().indices) primitive.indices.push_back(index + 4);
    primitive.material = static_cast<int>(scene.materials.size()) - 1;
    add_node(scene, primitive, glm::mat4(1));
  }
  std::vector<glm::vec3> seen;
  for (const float x : {-2.0f, 2.0f}) {
    inputs.camera = inputs.last_camera = render::look_at({x, 0, 3}, {0, 0, 0}, 1.0f, 0.01f);
    draw(scene);
    seen.push_back(pixel3("albedo", width / 2, height / 2));
    EXPECT_NEAR(seen.back().r + seen.back().g, 1, 1e-3f);
  }
  EXPECT_EQ(seen[0], seen[1]);
}

TEST_F(GBufferTest, AMaskedSurfaceAtTheDepthOfAnOpaqueOneIsSeenOnlyWhereItIsNotCutOut) {
  // On a red square a green one whose left half is cut out.
  scene::Scene scene;
  scene.images.push_back(
      {.name = "left half cut out", .width = 2, .height = 1, .rgba = {0, 255, 0, 0, 0, 255, 0, 255}});
  scene.textures.push_back(
      {.image = 0, .mag = scene::Filter::nearest, .min = scene::Filter::nearest, .mipmapped = false});
  scene.materials = {{.base_color = {1, 0, 0, 1}, .unlit = true},
                     {.base_color_texture = {.texture = 0}, .alpha_mode = scene::AlphaMode::mask, .unlit = true}};
  for (int material = 0; material < 2; ++material) {
    scene::Primitive quad = square();
    for (const glm::vec3& corner : quad.positions) quad.uvs[0].emplace_back(corner.x < 0 ? 0.0f : 1.0f, 0.5f);
    quad.material = material;
    add_node(scene, quad, glm::mat4(1));
  }
  inputs.camera = inputs.last_camera = render::look_at({0, 0, 3}, {0, 0, 0}, 1.0f, 0.01f);
  draw(scene);
  const glm::vec3 left = pixel3("albedo", width / 2 - 4, height / 2);
  const glm::vec3 right = pixel3("albedo", width / 2 + 4, height / 2);
  EXPECT_GT(left.r, 0.99f);
  EXPECT_LT(left.g, 0.01f);
  EXPECT_LT(right.r, 0.01f);
  EXPECT_GT(right.g, 0.99f);
}

TEST_F(GBufferTest, EachSurfaceHasWhatItsOwnMaterialHas) {
  // Side by side: textured, coloured at its vertices, emissive, and plain; drawn by programs of their own.
  scene::Scene scene;
  scene.images.push_back({.name = "red", .rgba = {255, 0, 0, 255}});
  scene.textures.push_back({.image = 0, .mipmapped = false});
  scene.materials = {{.base_color_texture = {.texture = 0}}, {}, {.emissive = {0, 0, 2}}, {.base_color = {0, 0, 1, 1}}};
  for (int i = 0; i < 4; ++i) {
    scene::Primitive quad = square();
    quad.uvs[0].assign(4, {0.5f, 0.5f});
    if (i == 1) quad.colors.assign(4, {0, 1, 0, 1});
    quad.material = i;
    const glm::vec3 place(static_cast<float>(i) - 1.5f, 0, 0);
    add_node(scene, quad, glm::scale(glm::translate(glm::mat4(1), place), glm::vec3(0.4f)));
  }
  draw(scene);
  const std::array albedo{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(1), glm::vec3(0, 0, 1)};
  for (int i = 0; i < 4; ++i) {
    const auto x = width / 2 + static_cast<int>((static_cast<float>(i) - 1.5f) / (4 * std::tan(0.5f)) * 0.5f * height);
    EXPECT_LT(glm::distance(pixel3("albedo", x, height / 2), albedo.at(static_cast<std::size_t>(i))), 1e-3f) << i;
    EXPECT_LT(glm::distance(pixel3("emission", x, height / 2), glm::vec3(0, 0, i == 2 ? 2 : 0)), 1e-2f) << i;
  }
}

TEST_F(GBufferTest, TexturesAreReadWhereTheirMaterialsPlaceThem) {
  // Squares that all lie at the red half of a texture by their first coordinates; by the second ones, or moved by half
  // of it, they lie at the green half, whose alpha is less. The first three are opaque, the others masked: of these
  // only the first is left.
  scene::Scene scene;
  scene.images.push_back({.name = "halves", .width = 2, .height = 1, .rgba = {255, 0, 0, 255, 0, 255, 0, 0}});
  scene.textures.push_back(
      {.image = 0, .mag = scene::Filter::nearest, .min = scene::Filter::nearest, .mipmapped = false});
  const std::array<scene::TextureRef, 3> placed{
      {{.texture = 0}, {.texture = 0, .uv_set = 1}, {.texture = 0, .uv_transform = {1, 0, 0, 1, 0.5f, 0}}}};
  for (int i = 0; i < 6; ++i) {
    const bool masked = i >= 3;
    scene.materials.push_back({.base_color_texture = placed.at(static_cast<std::size_t>(i % 3)),
                               .alpha_mode = masked ? scene::AlphaMode::mask : scene::AlphaMode::opaque});
    scene::Primitive quad = square();
    quad.uvs[0].assign(4, {0.25f, 0.5f});
    quad.uvs[1].assign(4, {0.75f, 0.5f});
    quad.material = i;
    const glm::vec3 place(static_cast<float>(i % 3) - 1.0f, masked ? -0.5f : 0.5f, 0);
    add_node(scene, quad, glm::scale(glm::translate(glm::mat4(1), place), glm::vec3(0.4f)));
  }
  draw(scene);
  const std::array<glm::vec3, 6> albedo{{{1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, glm::vec3(0), glm::vec3(0)}};
  const float pixels_per_metre = 0.5f * height / (4 * std::tan(0.5f));
  for (int i = 0; i < 6; ++i) {
    const float x = static_cast<float>(i % 3) - 1.0f, y = i >= 3 ? -0.5f : 0.5f;
    const glm::vec3 seen = pixel3("albedo", width / 2 + static_cast<int>(x * pixels_per_metre),
                                  height / 2 - static_cast<int>(y * pixels_per_metre));
    EXPECT_LT(glm::distance(seen, albedo.at(static_cast<std::size_t>(i))), 1e-3f) << i;
  }
}

// Four materials: plain, and with one, two and three of the textures base colour, occlusion and normal map. The normal
// map has a program of its own.
TEST_F(GBufferTest, SurfacesShareTheProgramOfThoseWithOneTextureMore) {
  scene::Scene scene;
  scene.images = {{.name = "grey", .rgba = {128, 128, 255, 255}}};
  scene.textures.push_back({.image = 0, .mipmapped = false});
  scene.materials = {
      {.base_color = {1, 0, 0, 1}},
      {.base_color = {0, 1, 0, 1}, .occlusion_texture = {.texture = 0}},
      {.base_color_texture = {.texture = 0}, .occlusion_texture = {.texture = 0}},
      {.base_color_texture = {.texture = 0}, .normal_texture = {.texture = 0}, .occlusion_texture = {.texture = 0}}};
  const auto draw_up_to = [&](std::size_t count) {
    scene.meshes.clear();
    scene.nodes.clear();
    scene.roots.clear();
    for (std::size_t i = 0; i < count; ++i) {
      scene::Primitive quad = square();
      quad.uvs[0].assign(4, {0.5f, 0.5f});
      quad.material = static_cast<int>(i);
      const glm::vec3 place(static_cast<float>(i) - 1.5f, 0, 0);
      add_node(scene, quad, glm::scale(glm::translate(glm::mat4(1), place), glm::vec3(0.4f)));
    }
    draw(scene);
  };
  const auto seen = [&](std::size_t i, const char* aov) {
    const float offset = (static_cast<float>(i) - 1.5f) / (4 * std::tan(0.5f)) * 0.5f;
    return pixel3(aov, width / 2 + static_cast<int>(offset * height), height / 2);
  };
  draw_up_to(3);
  const std::size_t shared = device.shaders.size();
  const std::array albedo{seen(0, "albedo"), seen(1, "albedo")};
  EXPECT_LT(glm::distance(albedo[0], glm::vec3(1, 0, 0)), 1e-3f);
  EXPECT_LT(glm::distance(albedo[1], glm::vec3(0, 1, 0)), 1e-3f);
  draw_up_to(4);
  EXPECT_EQ(device.shaders.size(), shared + 1);
  draw_up_to(2);
  EXPECT_EQ(device.shaders.size(), shared + 2) << "two materials without a base colour texture need none to be read";
  EXPECT_EQ(seen(0, "albedo"), albedo[0]);
  EXPECT_EQ(seen(1, "albedo"), albedo[1]);
  draw_up_to(1);
  EXPECT_EQ(device.shaders.size(), shared + 3);
  EXPECT_EQ(seen(0, "albedo"), albedo[0]);
}

TEST_F(GBufferTest, ASurfaceWithoutAMaterialIsNotOccludedByTheTextureOfAnother) {
  scene::Scene scene;
  scene.images = {{.name = "dark", .rgba = {0, 0, 0, 255}}};
  scene.textures.push_back({.image = 0, .mipmapped = false});
  scene.materials = {{.occlusion_texture = {.texture = 0}}};
  for (const int material : {0, -1}) {
    scene::Primitive quad = square();
    quad.uvs[0].assign(4, {0.5f, 0.5f});
    quad.material = material;
    const glm::vec3 place(material == 0 ? -1 : 1, 0, 0);
    add_node(scene, quad, glm::scale(glm::translate(glm::mat4(1), place), glm::vec3(0.5f)));
  }
  draw(scene);
  EXPECT_EQ(pixel3("material", width / 2 - 11, height / 2).z, 0);
  EXPECT_EQ(pixel3("material", width / 2 + 11, height / 2).z, 1);
}

TEST_F(GBufferTest, HasTwentyBytesAPixelBesidesDepthUntilMoreIsRead) {
  const auto bytes = [&] {
    std::size_t sum = 0;
    for (const char* name : {"albedo", "shading normal", "geometric normal", "material", "emission", "motion"})
      sum += device.target_bytes(name);
    return sum;
  };
  scene::Scene scene;
  add_node(scene, square(), glm::mat4(1));
  params.set_text("technique", "pcss");
  draw(scene);
  EXPECT_EQ(bytes(), width * height * 20U);
  EXPECT_EQ(pixel3("emission", width / 2, height / 2), glm::vec3(0));
  params.set("history.reuse", true);
  draw(scene);
  EXPECT_EQ(bytes(), width * height * 28U);
  scene.materials.push_back({.emissive = {1, 1, 1}});
  scene.meshes[0].primitives[0].material = 0;
  draw(scene);
  EXPECT_EQ(bytes(), width * height * 32U);
}

TEST_F(GBufferTest, LinesAndPointsAreDrawn) {
  scene::Primitive line;
  line.topology = scene::Topology::lines;
  line.positions = {{-1, 0, 0}, {1, 0.01f, 0}};
  line.normals.assign(2, {0, 1, 0});
  line.indices = {0, 1};
  scene::Scene scene;
  add_node(scene, line, glm::mat4(1));
  draw(scene);
  EXPECT_GT(covered_pixels(), 15);
}

}  // namespace
}  // namespace penumbra::test
