// Several samples of each pixel: the picture is the mean of all, and everything else that of the first.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "lib/tone_map.glsl"
#include "render/aov_picture.h"
#include "render/passes.h"
#include "render_scenes.h"

namespace penumbra::test {
namespace {

constexpr float edge_angle = 0.35f;  // radians, from upright
const glm::vec2 across(std::cos(edge_angle), std::sin(edge_angle));

// Pixels from the middle of the picture to a place in one, y upwards; row 0 is the top.
glm::vec2 from_middle(int x, int y, int width, int height, const glm::vec2& offset) {
  return glm::vec2(static_cast<float>(x) + 0.5f - static_cast<float>(width) * 0.5f,
                   static_cast<float>(height) * 0.5f - static_cast<float>(y) - 0.5f) +
         offset;
}

// A lit screen over one half of the picture, whose oblique edge goes through the middle. The ground behind it is in the
// screen's shadow, as far as it can be seen.
class SamplesTest : public RenderTest {
 protected:
  SamplesTest() {
    params.set("render.sky_light", 0.0f);
    params.set("render.ground_light", 0.0f);
    params.set("render.dither", false);
    params.set("exposure.auto", false);
    params.set("exposure.ev", -std::log2(1.2f));  // a luminance of 1 has the value 1
    params.set_text("technique", "hard");
    sun() = {.to_light = glm::normalize(glm::vec3(-4.0f * across, 1.0f)), .illuminance = glm::vec3(10)};
    stage.materials = {{.metallic = 0, .roughness = 1}};
    add(square(), glm::scale(glm::mat4(1), glm::vec3(10)));
    add(square(), screen_at(1));
  }

  void add(scene::Primitive primitive, const glm::mat4& place, int material = 0) {
    primitive.material = material;
    add_node(stage, std::move(primitive), place);
  }

  static glm::mat4 screen_at(float z) {
    const glm::mat4 turned = glm::rotate(glm::mat4(1), edge_angle, glm::vec3(0, 0, 1));
    return glm::scale(glm::translate(turned, {-8, 0, z}), glm::vec3(8));
  }

  // Red of the picture, as linear light.
  std::vector<float> red(int samples, int scale = 1) {
    inputs.samples = samples;
    inputs.width = width * scale;
    inputs.height = height * scale;
    draw(stage);
    const std::vector<float> color =
        render::reduced(renderer.read_aov("color"), width, height, 3, scale, render::Reduction::mean);
    std::vector<float> values;
    for (std::size_t i = 0; i < color.size(); i += 3) values.push_back(color[i]);
    return values;
  }

  // The share of a pixel's samples that show the screen; nothing where one is too near to the edge to tell.
  static std::optional<float> share(int x, int y, std::span<const glm::vec2> offsets) {
    int count = 0;
    for (const glm::vec2& offset : offsets) {
      const float distance = glm::dot(from_middle(x, y, width, height, offset), across);
      if (std::abs(distance) < 1e-3f) return {};
      count += distance < 0 ? 1 : 0;
    }
    return static_cast<float>(count) / static_cast<float>(offsets.size());
  }

  // Checks `seen` against `expected(share)` where the edge goes through pixels, and returns how many there are.
  template <class Expected>
  static int check_edges(std::span<const float> seen, int samples, float tolerance, Expected expected) {
    const std::vector<glm::vec2> offsets = render::sample_offsets(samples);
    int edges = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::optional<float> shown = share(x, y, offsets);
        if (!shown) continue;
        edges += *shown > 0 && *shown < 1 ? 1 : 0;
        EXPECT_NEAR(seen[static_cast<std::size_t>(y * width + x)], expected(*shown), tolerance) << x << ' ' << y;
      }
    }
    return edges;
  }

  scene::Scene stage;
};

// The screen's light: 10 lux at the sun's cosine, by glTF's rough white; its highlight varies by a little over the
// view.
constexpr float varies = 0.02f;

TEST_F(SamplesTest, AnEdgeIsTheMeanOfItsSamplesEachWithItsOwnSurfacesShadow) {
  const float lit = red(1)[height / 2 * width + width / 4];
  ASSERT_GT(lit, 0.1f);
  for (const int samples : {2, 5, 8, 64}) {
    SCOPED_TRACE(samples);
    EXPECT_GT(check_edges(red(samples), samples, varies * lit, [&](float share) { return share * lit; }), height / 4);
  }
}

TEST_F(SamplesTest, AnOrthographicCameraHasThemToo) {
  inputs.camera.orthographic = inputs.last_camera.orthographic = true;
  inputs.camera.half_height = inputs.last_camera.half_height = 2;
  const float lit = red(1)[height / 2 * width + width / 4];
  ASSERT_GT(lit, 0.1f);
  EXPECT_GT(check_edges(red(8), 8, varies * lit, [&](float share) { return share * lit; }), height / 2);
}

// The screen is the upper face of a box whose side, in the right half of the picture, faces away from the sun.
TEST_F(SamplesTest, WhereTwoFacesMeetEachHasItsOwnShadow) {
  stage.nodes.clear();
  stage.meshes.clear();
  stage.roots.clear();
  add(square(), screen_at(0));
  const glm::vec3 along(-across.y, across.x, 0), down(0.6f * across, -0.8f), normal(0.8f * across, 0.6f);
  add(square(), glm::mat4({8.0f * down, 0}, {8.0f * along, 0}, {normal, 0}, {8.0f * down, 1}));
  const float lit = red(1)[height / 2 * width + width / 4];
  ASSERT_GT(lit, 0.1f);
  EXPECT_GT(check_edges(red(8), 8, varies * lit, [&](float share) { return share * lit; }), height / 2);
}

// A lit wire that is half as wide as a pixel, before ground that is in shadow: most of its samples are in pixels whose
// middles show the ground.
TEST_F(SamplesTest, AWireIsLitThoughPixelsBesideItAreInShadow) {
  add(square(), glm::scale(glm::translate(screen_at(1.5f), {1.07f, 0, 0}), glm::vec3(0.015f / 8, 1, 1)));
  const auto brightness = [&](const std::vector<float>& picture) {
    float sum = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (glm::dot(from_middle(x, y, width, height, {}), across) > 2)
          sum += picture[static_cast<std::size_t>(y * width + x)];
    return sum;
  };
  const float reference = brightness(red(1, 8));
  EXPECT_GT(reference, 1);
  EXPECT_NEAR(brightness(red(16)), reference, 0.05f * reference);
}

// The largest difference between the share of points in a half plane and its share of the pixel's area.
float half_plane_discrepancy(const std::vector<glm::vec2>& points) {
  constexpr int directions = 90, steps = 60, fine = 40;
  float worst = 0;
  for (int i = 0; i < directions; ++i) {
    const float angle = 6.2832f * static_cast<float>(i) / directions;
    const glm::vec2 normal(std::cos(angle), std::sin(angle));
    for (int j = 0; j < steps; ++j) {
      const float edge = 1.5f * (static_cast<float>(j) + 0.5f) / steps - 0.75f;
      int area = 0;
      for (int at = 0; at < fine * fine; ++at) {
        const glm::ivec2 cell(at % fine, at / fine);
        const glm::vec2 place = (glm::vec2(cell) + 0.5f) / static_cast<float>(fine) - 0.5f;
        area += glm::dot(place, normal) < edge ? 1 : 0;
      }
      const auto in =
          std::ranges::count_if(points, [&](const glm::vec2& point) { return glm::dot(point, normal) < edge; });
      worst = std::max(worst, std::abs(static_cast<float>(in) / static_cast<float>(points.size()) -
                                       static_cast<float>(area) / (fine * fine)));
    }
  }
  return worst;
}

TEST_F(SamplesTest, EdgesAreThoseOfAPictureThatIsDrawnLargerAndAveraged) {
  constexpr int scale = 8, samples = 32;
  std::vector<glm::vec2> grid;
  for (int i = 0; i < scale * scale; ++i)
    grid.push_back((glm::vec2(i % scale, i / scale) + 0.5f) / static_cast<float>(scale) - 0.5f);
  const std::vector<float> reference = red(1, scale), once = red(1), smooth = red(samples);
  const float lit = once[height / 2 * width + width / 4];
  const auto worst = [&](const std::vector<float>& picture) {
    float most = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) most = std::max(most, std::abs(picture[i] - reference[i]) / lit);
    return most;
  };
  // One straight edge in a pixel: either picture's error is at most the discrepancy of its points.
  const float tolerance =
      half_plane_discrepancy(render::sample_offsets(samples)) + half_plane_discrepancy(grid) + varies;
  EXPECT_LT(tolerance, 0.25f);
  EXPECT_LT(worst(smooth), tolerance);
  EXPECT_GT(worst(once), tolerance) << "a staircase";
}

TEST_F(SamplesTest, AnEdgeOfADazzlingSurfaceIsSmoothOnTheDisplay) {
  sun().illuminance = glm::vec3(10000);
  red(8);
  const std::vector<std::uint8_t> shown = renderer.read_display();
  std::vector<float> red_bytes;
  for (std::size_t i = 0; i < shown.size(); i += 3) red_bytes.push_back(shown[i]);
  const float white = glsl::tone_map(glm::vec3(1000)).r, black = glsl::tone_map(glm::vec3(0)).r;
  EXPECT_GT(check_edges(red_bytes, 8, 1.5f,
                        [&](float share) { return 255 * glsl::srgb_encode(black + share * (white - black)); }),
            height / 2);
}

TEST_F(SamplesTest, EdgesOfBlendedSurfacesAreSmoothToo) {
  stage = {};
  stage.materials = {{.base_color = {1, 1, 1, 1}, .unlit = true},
                     {.base_color = {0, 0, 0, 0.5f}, .alpha_mode = scene::AlphaMode::blend, .unlit = true}};
  add(square(), glm::scale(glm::mat4(1), glm::vec3(10)));
  add(square(), screen_at(1), 1);
  EXPECT_GT(check_edges(red(8), 8, 5e-3f, [](float share) { return 1.0f - 0.5f * share; }), height / 2);
}

TEST_F(SamplesTest, TheFirstSampleCanBeShownBeforeTheOthersWhichItDoesNotChange) {
  params.set("render.dither", true);
  for (const char* technique : {"hard", "slices_denoised", "thesis"}) {
    SCOPED_TRACE(technique);
    renderer.registry().select(params, technique);
    red(1);
    const std::vector<std::uint8_t> once = renderer.read_display();
    red(4);
    const std::vector<std::uint8_t> wanted = renderer.read_display();
    std::vector<float> first;
    int calls = 0;
    inputs.show_first = [&](const gl::Texture& display) {
      ++calls;
      first = gl::read_floats(display, 3);
      clear(device, {.name = "own",
                     .colors = {{.texture = &device.target("own", {.width = 4, .height = 4}), .clear = glm::vec4(1)}}});
    };
    red(4);
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(renderer.read_display(), wanted);
    ASSERT_EQ(first.size(), once.size());
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    for (std::size_t i = 0; i < once.size(); ++i) {
      const std::size_t turned = (static_cast<std::size_t>(height) - 1 - i / row) * row + i % row;
      ASSERT_EQ(std::lround(first[turned] * 255), once[i]);
    }
    inputs.samples = 1;
    draw(stage);
    EXPECT_EQ(calls, 1) << "of one sample there is no other picture";
    inputs.show_first = nullptr;
  }
}

TEST_F(SamplesTest, AllElseIsThatOfTheFirstSampleInEveryFrameOfAHistory) {
  params.set_text("technique", "pcss");
  renderer.registry().select(params, "thesis");
  inputs.mask_details = true;
  gpu_scene.emplace(device, stage);
  for (int frame = 0; frame < 4; ++frame) {
    std::vector<std::vector<float>> once;
    for (const int samples : {1, 8}) {
      inputs.samples = samples;
      inputs.view = samples;  // each with a history of its own
      renderer.draw(*gpu_scene, inputs, params);
      for (std::size_t i = 0; i < render::aovs().size(); ++i) {
        std::vector<float> values = renderer.read_aov(render::aovs()[i].name);
        if (samples == 1) {
          once.push_back(std::move(values));
        } else if (render::aovs()[i].name == "color") {
          EXPECT_NE(values, once[i]);
        } else {
          EXPECT_EQ(values, once[i]) << render::aovs()[i].name << " of frame " << frame;
        }
      }
    }
    inputs.last_camera = inputs.camera;
    inputs.camera.view[3][0] += 0.013f;
    inputs.last_time = inputs.time;
    inputs.time += 0.1;
  }
}

TEST_F(SamplesTest, AovsAreMeansOfAllSamplesWhereThatIsAskedForAndMeansSomething) {
  // The ground is darker than the screen before it.
  stage.materials.push_back({.base_color = {0.25f, 0.25f, 0.25f, 1}, .metallic = 0, .roughness = 1});
  stage.meshes.front().primitives.front().material = 1;
  params.set_text("technique", "pcss");  // which has blocker distances
  inputs.mask_details = true;
  for (const render::Aov& aov : render::aovs()) inputs.averaged_aovs.push_back(aov.name);
  const auto all = [&](int samples) {
    red(samples);
    std::map<std::string, std::vector<float>> values;
    for (const render::Aov& aov : render::aovs()) values[aov.name] = renderer.read_aov(aov.name);
    return values;
  };
  const auto once = all(1), means = all(8);
  EXPECT_EQ(means, all(8));
  EXPECT_EQ(renderer.read_aov("shadow", {width / 2, height / 2})[0],
            means.at("shadow")[height / 2 * width + width / 2]);
  std::vector<float> albedo;
  for (std::size_t i = 0; i < means.at("albedo").size(); i += 3) albedo.push_back(means.at("albedo")[i]);
  EXPECT_GT(check_edges(albedo, 8, 2e-3f, [](float share) { return 0.25f + 0.75f * share; }), height / 2);
  // The screen is lit, and the ground behind its edge in its shadow.
  EXPECT_GT(check_edges(means.at("shadow"), 8, 1e-3f, [](float share) { return share; }), height / 2);
  // What hides the sun from the ground is at the screen's distance, and nothing hides it from the screen: the mean is
  // of the ground alone.
  const float distance = 1 / sun().to_light.z;
  EXPECT_GT(
      check_edges(means.at("blocker"), 8, 0.02f * distance, [&](float share) { return share < 1 ? distance : 0.0f; }),
      height / 2);
  for (const render::Aov& aov : render::aovs()) {
    if (aov.reduction == render::Reduction::nearest_center) {
      EXPECT_EQ(means.at(aov.name), once.at(aov.name)) << aov.name;
    }
  }
  inputs.averaged_aovs.clear();
  const auto of_first = all(8);
  EXPECT_EQ(of_first.at("color"), means.at("color"));
  EXPECT_EQ(of_first.at("shadow"), once.at("shadow"));
}

TEST_F(SamplesTest, AMeanOverTheSkyHasThatInTheLight) {
  stage.roots.erase(stage.roots.begin());  // no ground
  inputs.averaged_aovs = {"shadow"};
  red(8);
  for (const float visibility : renderer.read_aov("shadow")) EXPECT_EQ(visibility, 1.0f);
}

// A shadow's edge on the ground, all of which shows in one surface.
TEST_F(SamplesTest, WithShadowsOfTheirOwnEdgesOfShadowsAreThoseOfAPictureThatIsDrawnLargerAndAveraged) {
  constexpr int scale = 8, samples = 32;
  stage.nodes.clear();
  stage.meshes.clear();
  add(square(), glm::scale(glm::mat4(1), glm::vec3(10)));
  add(square(), screen_at(8));
  sun() = {.to_light = glm::normalize(glm::vec3(0.02f, 0.01f, 1)), .illuminance = glm::vec3(10)};
  inputs.camera = inputs.last_camera = render::look_at({0.3f, -4, 2.5f}, {0.3f, 0, 0}, 0.8f, 0.1f);
  const std::vector<float> reference = red(1, scale), shared = red(samples);
  inputs.own_shadows = true;
  inputs.averaged_aovs = {"shadow"};
  const std::vector<float> own = red(samples), visibility = renderer.read_aov("shadow");
  const float lit = *std::ranges::max_element(reference), dark = *std::ranges::min_element(reference);
  int edges = 0;
  float worst_shared = 0, worst_own = 0, worst_mean = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const bool edge = reference[i] > 0.1f * lit && reference[i] < 0.9f * lit;
    edges += edge ? 1 : 0;
    worst_shared = std::max(worst_shared, std::abs(shared[i] - reference[i]) / lit);
    worst_own = std::max(worst_own, std::abs(own[i] - reference[i]) / lit);
    // Where the ground ends at the sky, all samples are lit.
    if (edge && visibility[i] < 1)
      worst_mean = std::max(worst_mean, std::abs(own[i] - glm::mix(dark, lit, visibility[i])) / lit);
  }
  EXPECT_GT(edges, height / 4);
  EXPECT_LT(worst_own, 0.15f);
  EXPECT_GT(worst_shared, 0.25f) << "a staircase";
  EXPECT_LT(worst_mean, 0.02f) << "masks that are averaged are those of the samples";
}

TEST_F(SamplesTest, ShadowsOfTheirOwnLeaveHistoriesAndAllElseAsTheyAre) {
  for (const char* technique : {"slices_denoised", "thesis"}) {
    SCOPED_TRACE(technique);
    renderer.registry().select(params, technique);
    inputs.mask_details = true;
    inputs.samples = 4;
    gpu_scene.emplace(device, stage);
    for (int frame = 0; frame < 3; ++frame) {
      std::vector<std::vector<float>> shared;
      for (const bool own : {false, true}) {
        inputs.own_shadows = own;
        inputs.view = own ? 1 : 0;
        renderer.draw(*gpu_scene, inputs, params);
        for (std::size_t i = 0; i < render::aovs().size(); ++i) {
          std::vector<float> values = renderer.read_aov(render::aovs()[i].name);
          if (!own) {
            shared.push_back(std::move(values));
          } else if (render::aovs()[i].name != "color") {
            EXPECT_EQ(values, shared[i]) << render::aovs()[i].name << " of frame " << frame;
          }
        }
      }
    }
    renderer.forget_view(0);
    renderer.forget_view(1);
  }
}

TEST_F(SamplesTest, ShadowsOfTheirOwnKeepNoMemoryAfterTheFrame) {
  renderer.registry().select(params, "slices_denoised");
  inputs.samples = 4;
  red(4);
  const std::size_t shared = device.target_bytes("shadow ");
  EXPECT_GT(shared, 0u);
  inputs.own_shadows = true;
  red(4);
  EXPECT_EQ(device.target_bytes("shadow "), shared);
}

TEST_F(SamplesTest, TheirNumberAndThatOfTheViewAreChecked) {
  inputs.view = -1;
  EXPECT_EQ(message_of([&] { draw(stage); }), "view -1 can't be drawn: views have numbers from 0 on");
  inputs.view = 0;
  for (const int samples : {0, -1, render::max_samples + 1}) {
    inputs.samples = samples;
    EXPECT_NE(message_of([&] { draw(stage); }).find("1 to 256 can be drawn"), std::string::npos) << samples;
  }
}

TEST(SampleOffsets, TheFirstIsTheMiddleAndTheirMeanIsNear) {
  for (const int count : {1, 2, 4, 8, 64, 256}) {
    const std::vector<glm::vec2> offsets = render::sample_offsets(count);
    ASSERT_EQ(offsets.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(offsets.front(), glm::vec2(0));
    glm::vec2 sum(0);
    for (const glm::vec2& offset : offsets) {
      EXPECT_LE(std::max(std::abs(offset.x), std::abs(offset.y)), 0.5f);
      sum += offset;
    }
    EXPECT_LE(glm::length(sum), 1.0f) << count;  // so pictures of different numbers lie on each other
  }
}

}  // namespace
}  // namespace penumbra::test
