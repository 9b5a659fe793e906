// Lighting of surfaces, exposure and tone mapping.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render_scenes.h"

namespace penumbra::test {
namespace {

class LightingTest : public RenderTest {
 protected:
  LightingTest() {
    params.set("render.sky_light", 0.0f);
    params.set("render.ground_light", 0.0f);
    params.set("exposure.auto", false);
    sun() = {.to_light = {0, 0, 1}, .illuminance = glm::vec3(1000)};
  }

  // The EV at which a luminance of 1 has the value 1 in the picture.
  static float unit_ev() { return -std::log2(1.2f); }
};

scene::Scene white_square(const scene::Material& material) {
  scene::Scene scene;
  scene.materials.push_back(material);
  scene::Primitive quad = square();
  quad.material = 0;
  add_node(scene, quad, glm::mat4(1));
  return scene;
}

// glTF 2.0, appendix B, where the half vector is the normal: for white light from the mirror image of the eye, at that
// cosine to both.
glm::vec3 mirrored_radiance(const scene::Material& material, float cosine) {
  const float alpha = std::max(material.roughness * material.roughness, 0.005f), square = alpha * alpha;
  const glm::vec3 color(material.base_color), at_normal = glm::mix(glm::vec3(0.04f), color, material.metallic);
  const glm::vec3 fresnel = at_normal + (1.0f - at_normal) * std::pow(1 - cosine, 5.0f);
  const float visibility = 0.25f / (cosine * std::sqrt(cosine * cosine * (1 - square) + square));
  const glm::vec3 diffuse = (1.0f - fresnel) * color * (1 - material.metallic);
  return cosine * glm::one_over_pi<float>() * (diffuse + fresnel * visibility / square);
}

TEST_F(LightingTest, DiffuseAndMirroredLightAreThoseOfGltf) {
  params.set("exposure.ev", unit_ev());
  for (const float cosine : {1.0f, 0.2f}) {
    const glm::vec3 back(0, -std::sqrt(1 - cosine * cosine), cosine);
    inputs.camera = render::look_at(4.0f * back, {0, 0, 0}, 1, 0.01f);
    inputs.camera.orthographic = true;
    inputs.camera.half_height = 0.5f * cosine;
    inputs.last_camera = inputs.camera;
    sun() = {.to_light = {0, -back.y, back.z}, .illuminance = glm::vec3(2)};
    for (const float roughness : {1.0f, 0.2f, 0.0f}) {
      const float tolerance = roughness > 0 ? 0.01f : 0.05f;  // the narrowest highlight shows that normals are rounded
      for (const float metallic : {0.0f, 0.6f, 1.0f}) {
        const scene::Scene scene =
            white_square({.base_color = {0.8f, 0.4f, 0.2f, 1}, .metallic = metallic, .roughness = roughness});
        draw(scene);
        const glm::vec3 seen = pixel3("color", width / 2, height / 2);
        const glm::vec3 expected = 2.0f * mirrored_radiance(scene.materials[0], cosine);
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(seen[i], expected[i], tolerance * expected[i]) << cosine << ' ' << roughness << ' ' << metallic;
      }
    }
  }
}

TEST_F(LightingTest, ObliqueSunFallsOffWithItsCosine) {
  const scene::Scene scene = white_square({.metallic = 0, .roughness = 1});
  inputs.camera = inputs.last_camera = render::look_at({0, 0, 40}, {0, 0, 0}, 0.08f, 0.01f);
  params.set("exposure.ev", unit_ev());
  sun() = {.to_light = {0, 0, 1}, .illuminance = glm::vec3(2)};
  draw(scene);
  const float straight = pixel("color", width / 2, height / 2)[0];
  sun().to_light = {std::sqrt(0.75f), 0, 0.5f};
  draw(scene);
  EXPECT_NEAR(pixel("color", width / 2, height / 2)[0] / straight, 0.5f, 0.02f);
}

TEST_F(LightingTest, ShadowTakesTheSunAndLeavesTheSky) {
  params.set_text("technique", "hard");
  params.set("render.sky_light", 0.5f);
  scene::Scene scene = white_square({.metallic = 0, .roughness = 1});
  add_node(scene, square(), glm::translate(glm::scale(glm::mat4(1), glm::vec3(0.5f)), glm::vec3(0, 0, 20)));
  scene.nodes[1].matrix = glm::translate(glm::mat4(1), glm::vec3(6, 6, 3));  // off screen, towards the sun
  sun() = {.to_light = glm::normalize(glm::vec3(6, 6, 3)), .illuminance = glm::vec3(2)};
  params.set("exposure.ev", unit_ev());
  draw(scene);
  EXPECT_EQ(pixel("shadow", width / 2, height / 2)[0], 0);
  const glm::vec3 shaded = pixel3("color", width / 2, height / 2);
  EXPECT_GT(shaded.g, 0.05f);
  EXPECT_LT(shaded.g, 0.3f);
}

TEST_F(LightingTest, UnlitSurfacesKeepTheirColour) {
  const scene::Scene scene = white_square({.base_color = {0.25f, 0.5f, 0.75f, 1}, .unlit = true});
  draw(scene);
  const glm::vec3 seen = pixel3("color", width / 2, height / 2);
  EXPECT_NEAR(seen.r, 0.25f, 2e-3f);
  EXPECT_NEAR(seen.g, 0.5f, 2e-3f);
  EXPECT_NEAR(seen.b, 0.75f, 2e-3f);
}

TEST_F(LightingTest, AutomaticExposureSuitsBrightSunsAndDimOnes) {
  const scene::Scene scene = white_square({.base_color = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0, .roughness = 1});
  params.reset("exposure.auto");
  params.reset("render.sky_light");
  std::vector<std::uint8_t> first;
  for (const float lux : {1.0f, 3.0f, 100000.0f}) {
    sun().illuminance = glm::vec3(lux);
    draw(scene);
    const std::vector<std::uint8_t> shown = renderer.read_display();
    const int grey = shown[(height / 2 * width + width / 2) * 3 + 1];
    EXPECT_GT(grey, 130) << lux;
    EXPECT_LT(grey, 220) << lux;
    if (!first.empty()) {
      EXPECT_NEAR(grey, first[(height / 2 * width + width / 2) * 3 + 1], 2) << lux;
    }
    first = shown;
  }
}

TEST_F(LightingTest, AutomaticExposureIsThatOfAnIncidentMeter) {
  params.reset("exposure.auto");
  params.reset("render.sky_light");
  for (const float elevation : {15.0f, 45.0f, 75.0f}) {
    sun().to_light = render::direction_to(0.5f, glm::radians(elevation));
    const auto shown = [&](float albedo) {
      scene::Scene ground = white_square({.base_color = {albedo, albedo, albedo, 1}, .metallic = 0});
      ground.nodes[0].matrix = glm::scale(glm::rotate(glm::mat4(1), -glm::half_pi<float>(), {1, 0, 0}), glm::vec3(10));
      inputs.camera = inputs.last_camera = render::look_at({0, 5, 1}, {0, 0, 0}, 1.0f, 0.01f);
      draw(ground);
      return renderer.read_display()[(height / 2 * width + width / 2) * 3 + 1];
    };
    EXPECT_NEAR(shown(0.18f), 118, 8) << "a grey card, " << elevation;
    EXPECT_NEAR(shown(0.5f), 189, 8) << "the ground, " << elevation;
    EXPECT_NEAR(shown(0.9f), 220, 8) << "white paint, which is not clipped, " << elevation;
  }
}

TEST_F(LightingTest, DarkMaterialsStayDark) {
  params.reset("exposure.auto");
  params.reset("render.sky_light");
  draw(white_square({.base_color = {0.03f, 0.03f, 0.03f, 1}, .metallic = 0, .roughness = 1}));
  EXPECT_LT(renderer.read_display()[(height / 2 * width + width / 2) * 3 + 1], 90);
}

TEST_F(LightingTest, BlendedSurfacesLieOverWhatIsBehind) {
  scene::Scene scene = white_square({.base_color = {1, 1, 1, 1}, .unlit = true});
  for (const float z : {1.0f, 0.5f}) {  // the nearer first in the file
    scene.materials.push_back({.base_color = z == 1.0f ? glm::vec4(1, 0, 0, 0.5f) : glm::vec4(0, 1, 0, 0.5f),
                               .alpha_mode = scene::AlphaMode::blend,
                               .unlit = true});
    scene::Primitive quad = square();
    quad.material = static_cast<int>(scene.materials.size()) - 1;
    add_node(scene, quad, glm::translate(glm::mat4(1), glm::vec3(0, 0, z)));
  }
  draw(scene);
  // Back to front: white, half green, half red.
  const glm::vec3 seen = pixel3("color", width / 2, height / 2);
  EXPECT_NEAR(seen.r, 0.75f, 5e-3f);
  EXPECT_NEAR(seen.g, 0.5f, 5e-3f);
  EXPECT_NEAR(seen.b, 0.25f, 5e-3f);
}

// The nearer one reaches so far to the side that its centre is farther from the eye.
TEST_F(LightingTest, BlendedSurfacesLieOverWhatIsBehindInAnOrthographicPicture) {
  inputs.camera.orthographic = inputs.last_camera.orthographic = true;
  inputs.camera.half_height = inputs.last_camera.half_height = 1;
  scene::Scene scene = white_square({.base_color = {1, 1, 1, 1}, .unlit = true});
  for (const float z : {1.0f, 0.5f}) {
    const bool near = z == 1.0f;
    scene.materials.push_back({.base_color = near ? glm::vec4(1, 0, 0, 0.5f) : glm::vec4(0, 1, 0, 0.5f),
                               .alpha_mode = scene::AlphaMode::blend,
                               .unlit = true});
    scene::Primitive quad = square();
    quad.material = static_cast<int>(scene.materials.size()) - 1;
    const glm::mat4 place = glm::translate(glm::mat4(1), glm::vec3(near ? 6 : 0, 0, z));
    add_node(scene, quad, glm::scale(place, glm::vec3(near ? 8 : 1, 1, 1)));
  }
  draw(scene);
  const glm::vec3 seen = pixel3("color", width / 2, height / 2);
  EXPECT_NEAR(seen.r, 0.75f, 5e-3f);
  EXPECT_NEAR(seen.g, 0.5f, 5e-3f);
  EXPECT_NEAR(seen.b, 0.25f, 5e-3f);
}

// In a file without lights, an emission of 1 is the luminance of white in the sun; otherwise it is in nits.
TEST_F(LightingTest, EmissionIsAddedToTheLightOfASurface) {
  params.set("exposure.ev", unit_ev());
  scene::Scene scene = white_square({.roughness = 1, .emissive = {2, 0.5f, 0.25f}});
  sun() = {.to_light = {0, 0, -1}, .illuminance = glm::vec3(3)};
  draw(scene);
  const glm::vec3 expected = scene.materials[0].emissive;
  const glm::vec3 by_white = pixel3("color", width / 2, height / 2) * glm::pi<float>() / 3.0f;
  scene.lights = {{.intensity = 1}};
  scene.nodes[0].light = 0;
  draw(scene);
  const glm::vec3 in_nits = pixel3("color", width / 2, height / 2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(by_white[i], expected[i], 0.01f * expected[i]);
    EXPECT_NEAR(in_nits[i], expected[i], 0.01f * expected[i]);
  }
}

TEST_F(LightingTest, ABlendedSurfaceOfFullAlphaLooksLikeAnOpaqueOne) {
  params.set("exposure.ev", unit_ev());
  params.set("render.sky_light", 0.5f);
  sun() = {.to_light = glm::normalize(glm::vec3(0.5f, 0.3f, 1)), .illuminance = glm::vec3(2)};
  scene::Scene scene = white_square({.base_color = {0.8f, 0.4f, 0.2f, 1},
                                     .metallic = 0.2f,
                                     .roughness = 0.4f,
                                     .occlusion_texture = {.texture = 0},
                                     .emissive = {0.25f, 0.125f, 0.25f}});
  scene.images.push_back({.name = "occluded", .rgba = {51, 0, 0, 255}});
  scene.textures.push_back({.image = 0});
  scene.meshes[0].primitives[0].uvs[0].assign(4, {0.5f, 0.5f});
  draw(scene);
  const std::vector<float> opaque = renderer.read_aov("color");
  scene.materials[0].alpha_mode = scene::AlphaMode::blend;
  draw(scene);
  const std::vector<float> blended = renderer.read_aov("color");
  for (std::size_t i = 0; i < opaque.size(); ++i) ASSERT_NEAR(blended[i], opaque[i], 0.01f * opaque[i]) << i;
}

TEST_F(LightingTest, StrongEmissionKeepsItsHue) {
  draw(white_square({.emissive = {1e6f, 2.5e5f, 0}}));
  const glm::vec3 seen = pixel3("emission", width / 2, height / 2);
  EXPECT_NEAR(seen.r, 64000, 1000);
  EXPECT_NEAR(seen.g, 16000, 500);
  EXPECT_EQ(seen.b, 0);
}

TEST_F(LightingTest, NoAovHoldsAnythingNotFinite) {
  scene::Primitive bad = square();
  bad.normals.assign(4, {0, 0, 0});
  bad.tangents.assign(4, {0, 0, 0, 1});
  bad.indices = {0, 1, 2, 0, 2, 3, 0, 0, 1};
  scene::Scene scene;
  scene.materials.push_back({.metallic = 1, .roughness = 0, .emissive = glm::vec3(1e30f)});
  bad.material = 0;
  add_node(scene, bad, glm::mat4(1));
  add_node(scene, square(), glm::scale(glm::translate(glm::mat4(1), glm::vec3(0, 0, 1)), glm::vec3(1, 0, 1)));
  const scene::Primitive line{.topology = scene::Topology::lines,
                              .indices = {0, 1},
                              .positions = {{0, -1, 2}, {0, 1, 2}},
                              .normals = {{0, 1, 0}, {0, 1, 0}}};
  add_node(scene, line, glm::scale(glm::mat4(1), glm::vec3(0, 1, 1)));  // which leaves its normal no length
  params.set_text("technique", "pcss");
  inputs.mask_details = true;
  draw(scene);
  for (const render::Aov& aov : render::aovs()) {
    const std::vector<float> values = renderer.read_aov(aov.name);
    EXPECT_EQ(values.size(), aov.channels.size() * width * height) << aov.name;
    for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << aov.name;
  }
}

TEST_F(LightingTest, UnknownAovNamesNearOnes) {
  draw(white_square({}));
  EXPECT_NE(message_of([&] { renderer.read_aov("depht"); }).find("depth"), std::string::npos);
}

}  // namespace
}  // namespace penumbra::test
