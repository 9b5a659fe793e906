// Masks of which the technique computes only every n-th pixel (mask.scale).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gl_calls.h"
#include "gpu/triangle_scene.h"
#include "lib/packed_texel.glsl"

namespace penumbra::test {
namespace {

class ShadowScale : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    params = renderer_->params();
    params.set("sun.angle", 4.0f);
    params.set("cascades.size", 512);
    params.set("sampling.noise", std::string("none"));
  }
  Shadowed render(const TriangleScene& scene, int scale, const TriangleRenderer::Adjust& adjust = {}) {
    params.set("mask.scale", scale);
    return renderer_->render(scene, params, [&](shadow::Inputs& in) {
      in.view.last_view = last_view.value_or(in.view.view);
      in.view.last_projection = in.view.projection;
      in.view.id = scale;
      if (adjust) adjust(in);
    });
  }

  ParamSet params;
  std::optional<glm::mat4> last_view;
};

double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - b[i], 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TriangleScene box_on_ground(int width, int height) {
  TriangleScene scene = test::box_on_ground();
  scene.width = width;
  scene.height = height;
  scene.projection = perspective(0.8f, static_cast<float>(width) / static_cast<float>(height), 0.1f);
  return scene;
}

TEST_F(ShadowScale, PixelsThatAreComputedAreThoseOfTheFullMaskWhateverTheSize) {
  for (const auto& [width, height] : {std::pair{120, 80}, {121, 83}, {7, 5}, {6, 90}}) {
    const TriangleScene scene = box_on_ground(width, height);
    const Shadowed full = render(scene, 1);
    for (const int scale : {2, 3, 4}) {
      SCOPED_TRACE(testing::Message() << width << "×" << height << " scale " << scale);
      const Shadowed scaled = render(scene, scale);
      int apart = 0, of = 0;
      for (int y = 0; y < height; y += scale) {
        for (int x = 0; x < width; x += scale, ++of)
          apart += std::abs(full.visibility(x, y) - scaled.visibility(x, y)) > 0.01f ? 1 : 0;
      }
      EXPECT_LE(apart, of / 200);
    }
  }
}

// Before others are interpolated from them; denoisers and histories read these. Those of decided tiles come from the
// decisions for all pixels.
TEST_F(ShadowScale, TheMaskOfEveryNthPixelIsTheFullOneThere) {
  const auto scaled_mask = [&](int scale) {
    const std::string end = fmt::format("scale {}/mask", scale);
    for (const gl::Device::NamedTarget& target : renderer_->device().targets()) {
      if (target.name.ends_with(end)) return target.texture;
    }
    throw Error("no mask of " + end);
  };
  for (const auto& [width, height] : {std::pair{320, 240}, {243, 137}, {169, 203}}) {
    const TriangleScene scene = box_on_ground(width, height);
    const Shadowed full = render(scene, 1);
    for (const int scale : {2, 3, 4}) {
      SCOPED_TRACE(testing::Message() << width << "×" << height << " scale " << scale);
      render(scene, scale);
      const gl::Texture& mask = *scaled_mask(scale);
      const std::vector<float> values = gl::read_floats(mask, 1);
      int apart = 0, marked = 0, of = 0;
      for (int y = 0; y * scale < height; ++y) {
        for (int x = 0; x * scale < width; ++x, ++of) {
          const float value = values.at(static_cast<std::size_t>(y * mask.width() + x));
          marked += value < 0 ? 1 : 0;
          const float visibility = value < 0 ? -1 - value : value;
          apart += std::abs(full.visibility(x * scale, y * scale) - visibility) > 0.01f ? 1 : 0;
        }
      }
      EXPECT_LE(apart, of / 200);
      EXPECT_GT(marked, of / 4);
    }
  }
}

TEST_F(ShadowScale, ThePixelsBetweenAreNearTheFullMaskUnderLamps) {
  const TriangleScene scene = box_on_ground(240, 159);
  for (const float cone : {0.0f, 0.5f}) {
    shadow::Lamp lamp{.position = {3, 5, 2}, .radius = 0.15f};
    if (cone > 0) lamp.axis = glm::normalize(-lamp.position), lamp.cone = cone;
    const shadow::Light light{.source = lamp};
    const auto under_lamp = [&](shadow::Inputs& in) { in.lights = {&light, 1}; };
    const std::vector<float> full = render(scene, 1, under_lamp).visibilities();
    for (const int scale : {2, 4}) {
      SCOPED_TRACE(testing::Message() << "cone " << cone << " scale " << scale);
      const double error = rms(full, render(scene, scale, under_lamp).visibilities());
      EXPECT_LT(error, 0.012 * scale);
      EXPECT_GT(error, 0.0) << "something is interpolated";
    }
  }
}

TEST_F(ShadowScale, ThePixelsBetweenAreNearTheFullMask) {
  const TriangleScene scene = box_on_ground(240, 159);
  for (const char* technique : {"pcss", "slices", "vsm", "thesis"}) {
    renderer_->shadows().registry().select(params, technique);
    params.set("history.reuse", false);
    params.set("sampling.noise", std::string("none"));
    const std::vector<float> full = render(scene, 1).visibilities();
    for (const int scale : {2, 4}) {
      SCOPED_TRACE(testing::Message() << technique << " scale " << scale);
      const std::vector<float> scaled = render(scene, scale).visibilities();
      const double error = rms(full, scaled);
      EXPECT_LT(error, 0.012 * scale);
      EXPECT_GT(error, 0.0) << "something is interpolated";
    }
  }
}

// Where computed pixels differ by more than a quarter there is an edge between them, and those between are computed
// too.
TEST_F(ShadowScale, PixelsBetweenOnesThatDifferMuchAreThoseOfTheFullMask) {
  const TriangleScene scene = box_on_ground(240, 159);
  params.set("sun.angle", 12.0f);
  const Shadowed full = render(scene, 1);
  for (const int scale : {2, 3, 4}) {
    const Shadowed scaled = render(scene, scale);
    int between = 0, apart = 0;
    for (int y = 0; y + scale < scene.height; ++y) {
      for (int x = 0; x + scale < scene.width; ++x) {
        const int left = x / scale * scale, low = y / scale * scale;
        if (left == x || low == y) continue;  // two of the four say all
        float least = 1, most = 0;
        bool on_ground = true;
        for (const glm::ivec2 at :
             {glm::ivec2(left, low), {left + scale, low}, {left, low + scale}, {left + scale, low + scale}}) {
          on_ground = on_ground && std::abs(full.point(at.x, at.y).y) < 1e-3f;
          least = std::min(least, full.visibility(at.x, at.y));
          most = std::max(most, full.visibility(at.x, at.y));
        }
        on_ground = on_ground && std::abs(full.point(x, y).y) < 1e-3f;
        if (!on_ground || most - least < 0.26f) continue;
        ++between;
        apart += scaled.visibility(x, y) != full.visibility(x, y) ? 1 : 0;
      }
    }
    EXPECT_GT(between, 40) << scale;
    EXPECT_EQ(apart, 0) << scale;
  }
}

// There is nothing to interpolate with on their other side.
TEST_F(ShadowScale, PixelsBeyondTheLastComputedOnesAreThoseOfTheFullMask) {
  // Slats askew above the camera, whose shadows cross the ends of rows and columns.
  TriangleScene scene;
  scene.add_quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20});
  for (int i = 0; i < 25; ++i) scene.add_quad({-8, 2.5f, -12 + static_cast<float>(i)}, {16, 0, 10}, {0, 0, 0.5f});
  scene.width = 240;
  scene.height = 159;
  scene.view = glm::lookAt(glm::vec3(0, 2, 0), glm::vec3(0, 0, 0), glm::vec3(0, 0, -1));
  scene.projection = perspective(0.8f, 240.0f / 159.0f, 0.1f);
  const Shadowed full = render(scene, 1);
  int penumbra = 0;
  for (int y = 0; y < scene.height; ++y) {
    const float at_end = full.visibility(scene.width - 1, y);
    penumbra += at_end > 0.1f && at_end < 0.9f ? 1 : 0;
  }
  EXPECT_GT(penumbra, 10);
  for (const int scale : {2, 3, 4}) {
    const Shadowed scaled = render(scene, scale);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = (scene.width - 1) / scale * scale + 1; x < scene.width; ++x)
        ASSERT_NEAR(full.visibility(x, y), scaled.visibility(x, y), 0.01f) << x << " " << y << " scale " << scale;
    }
  }
}

// Posts of about a pixel before a ground that lies in shadow where they shine, and the other way round.
TEST_F(ShadowScale, ThinSurfacesKeepTheirOwnLight) {
  TriangleScene scene;
  scene.add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  scene.add_quad({-5, 3, 1}, {10, 0, 0}, {0, 0, -3});
  constexpr float post = 0.03f;
  for (int i = 0; i < 12; ++i) {
    const float x = -2.2f + 0.37f * static_cast<float>(i);
    scene.add_box({x, 0, 1.5f}, {x + post, 1.5f, 1.5f + post});
  }
  scene.view = glm::lookAt(glm::vec3(0, 1.5f, 7), glm::vec3(0, 0.5f, 0), glm::vec3(0, 1, 0));
  scene.width = 160;
  scene.height = 120;
  scene.projection = perspective(0.8f, 4.0f / 3, 0.1f);
  scene.to_light = sun_direction(20, 70);
  const Shadowed full = render(scene, 1);
  for (const int scale : {2, 4}) {
    const Shadowed scaled = render(scene, scale);
    int posts = 0, lit = 0;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const glm::vec3& at = full.point(x, y);
        if (full.sky(x, y) || at.y < 0.05f || at.y > 1.4f || at.z < 1.4f) continue;
        ++posts;
        lit += full.visibility(x, y) > 0.9f ? 1 : 0;
        ASSERT_NEAR(scaled.visibility(x, y), full.visibility(x, y), 0.02f) << x << ", " << y << " scale " << scale;
      }
    }
    EXPECT_GT(posts, 200);
    EXPECT_GT(lit, 50);
  }
}

// Bars whose shadows are about a pixel wide, so that most of them fall between the pixels that are computed at first.
TEST_F(ShadowScale, NarrowShadowsAreNotLost) {
  TriangleScene scene;
  scene.add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  for (int i = 0; i < 24; ++i) {
    const float z = -3.0f + 0.25f * static_cast<float>(i);
    scene.add_box({-2, 0.3f, z}, {2, 0.34f, z + 0.04f});
  }
  scene.view = glm::lookAt(glm::vec3(0, 5, 7), glm::vec3(0, 0, 0), glm::vec3(0, 1, 0));
  scene.width = 200;
  scene.height = 150;
  scene.projection = perspective(0.8f, 4.0f / 3, 0.1f);
  params.set("sun.angle", 0.5f);
  params.set("cascades.size", 2048);
  params.set("lamps.size", 2048);
  const shadow::Light sun{.source = shadow::Sun{scene.to_light}};
  const shadow::Light lamp{.source = shadow::Lamp{.position = {2.5f, 3.5f, 1.5f}, .radius = 0.015f}};
  for (const auto& [technique, light] : {std::pair{"pcss", sun}, {"slices", sun}, {"pcss", lamp}}) {
    SCOPED_TRACE(testing::Message() << technique << (light.source.index() == 0 ? " sun" : " lamp"));
    params.set("technique", std::string(technique));
    const auto under_light = [&, &from = light](shadow::Inputs& in) { in.lights = {&from, 1}; };
    const Shadowed full = render(scene, 1, under_light);
    int narrow = 0;
    for (int y = 1; y + 1 < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        narrow += full.visibility(x, y) < 0.5f && full.visibility(x, y - 1) > 0.9f && full.visibility(x, y + 1) > 0.9f;
      }
    }
    EXPECT_GT(narrow, 200);
    for (const int scale : {2, 3, 4}) {
      const std::vector<float> expected = full.visibilities();
      const std::vector<float> scaled = render(scene, scale, under_light).visibilities();
      int lost = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) lost += std::abs(scaled[i] - expected[i]) > 0.2f ? 1 : 0;
      EXPECT_EQ(lost, 0) << "scale " << scale;
    }
  }
}

// On ground that is seen at a slant, penumbrae are wide along rows of pixels and narrow from row to row, so that many
// pixels are computed between the others.
TEST_F(ShadowScale, PixelsThatAreComputedBetweenOthersAreFilteredIfTheyHaveNoise) {
  TriangleScene scene;
  scene.add_quad({-20, 0, 8}, {40, 0, 0}, {0, 0, -40});
  for (int i = 0; i < 16; ++i) scene.add_quad({-8.0f + static_cast<float>(i), 3, 3}, {0.4f, 0, 0}, {0, 0, -6});
  scene.view = glm::lookAt(glm::vec3(0, 0.7f, 8), glm::vec3(0, 0.2f, 0), glm::vec3(0, 1, 0));
  scene.width = 320;
  scene.height = 120;
  scene.projection = perspective(0.4f, 8.0f / 3, 0.1f);
  scene.to_light = sun_direction(200, 40);
  params.set("cascades.size", 1024);
  params.set("sun.angle", 2.0f);
  params.set("technique", std::string("slices"));
  params.set("sampling.noise", std::string("interleaved_gradient"));
  const auto draw = [&](int scale, int azimuths, const char* filter) {
    params.set("slices.azimuths", azimuths);
    params.set("filter.visibility", std::string(filter));
    return render(scene, scale).visibilities();
  };
  for (const int filter_radius : {0, 16}) {
    params.set("slices.filter_radius", filter_radius);
    const std::vector<float> converged = draw(1, 128, "none"), full = draw(1, 6, "none");
    const std::vector<float> sampled = draw(2, 6, "none"), filtered = draw(2, 6, "isophote");
    int computed = 0, changed = 0;
    double before = 0, after = 0;
    for (std::size_t i = 0; i < full.size(); ++i) {
      const std::size_t x = i % static_cast<std::size_t>(scene.width), y = i / static_cast<std::size_t>(scene.width);
      const bool between = x % 2 != 0 || y % 2 != 0;
      if (!between || sampled[i] != full[i] || full[i] <= 0.02f || full[i] >= 0.98f) continue;
      ++computed;
      changed += filtered[i] != sampled[i] ? 1 : 0;
      before += std::pow(sampled[i] - converged[i], 2);
      after += std::pow(filtered[i] - converged[i], 2);
    }
    std::printf("filter_radius %d: %d pixels, %d changed, RMS %.4f to %.4f\n", filter_radius, computed, changed,
                std::sqrt(before / computed), std::sqrt(after / computed));
    EXPECT_GT(computed, 2000);
    EXPECT_LT(after, 0.6 * before);
    if (filter_radius == 0) {
      EXPECT_GT(changed, 0.9 * computed);
    } else {
      EXPECT_LT(changed, 0.6 * computed) << "filtered texels have no noise";
    }
    EXPECT_EQ(draw(2, 6, "isophote"), filtered);
  }
}

// Wide penumbrae are what the scale is for: under a wide sun, few of the other pixels are computed.
TEST_F(ShadowScale, MostOfAWidePenumbraIsInterpolated) {
  params.set("technique", std::string("slices"));
  params.set("sun.angle", 12.0f);
  const TriangleScene scene = box_on_ground(600, 450);
  const std::vector<float> full = render(scene, 1).visibilities(), scaled = render(scene, 2).visibilities();
  int penumbra = 0, interpolated = 0;
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (full[i] <= 0.02f || full[i] >= 0.98f) continue;
    ++penumbra;
    interpolated += scaled[i] != full[i] ? 1 : 0;
  }
  EXPECT_GT(penumbra, 3000);
  EXPECT_GT(interpolated, penumbra / 2);
  EXPECT_LT(rms(full, scaled), 0.02);
}

// The picture shows a side of a box that faces away from the sun, and its top.
TEST_F(ShadowScale, PixelsBesideASurfaceThatFacesAwayKeepTheirLight) {
  TriangleScene scene;
  scene.add_box({-1, 0, -1}, {1, 1, 1});
  scene.to_light = sun_direction(0, 60);
  const glm::vec3 away = glm::normalize(glm::vec3(scene.to_light.x, 0, scene.to_light.z));
  scene.view = glm::lookAt(-6.0f * away + glm::vec3(0.4f, 3, 0.3f), glm::vec3(0, 0.7f, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.5f, 1.5f, 0.1f);
  scene.width = 241;
  scene.height = 161;
  scene.receivers = scene.casters = shadow::Box{{-1, 0, -1}, {1, 1, 1}};
  params.set("sun.angle", 0.5f);
  const std::vector<float> full = render(scene, 1).visibilities();
  for (const int scale : {2, 3, 4}) {
    const std::vector<float> scaled = render(scene, scale).visibilities();
    int lost = 0;
    for (std::size_t i = 0; i < full.size(); ++i) lost += full[i] == 1 && scaled[i] < 0.5f ? 1 : 0;
    EXPECT_EQ(lost, 0) << scale;
  }
}

TEST_F(ShadowScale, AnEdgeStaysSharp) {
  params.set("technique", std::string("hard"));
  const TriangleScene scene = box_on_ground(160, 120);
  const Shadowed full = render(scene, 1), scaled = render(scene, 4);
  int between = 0;
  for (const float value : scaled.visibilities()) between += value > 0.25f && value < 0.75f ? 1 : 0;
  EXPECT_LE(between, 10);
  EXPECT_LT(rms(full.visibilities(), scaled.visibilities()), 0.05);
}

TEST_F(ShadowScale, ForTechniquesWithPassesOfTheirOwnTheMaskIsThatOfAllPixels) {
  const TriangleScene scene = box_on_ground(61, 47);
  for (const char* technique : {"shadow_volume", "ssss"}) {
    params.set("technique", std::string(technique));
    EXPECT_EQ(render(scene, 1).mask, render(scene, 2).mask) << technique;
  }
}

TEST_F(ShadowScale, LightsMayHaveDifferentScales) {
  const TriangleScene scene = box_on_ground(61, 47);
  const auto of = [&](const std::vector<std::string>& scales) {
    std::vector<shadow::Light> lights;
    for (const std::string& scale : scales) {
      const int id = static_cast<int>(lights.size());
      lights.push_back({.id = id,
                        .source = shadow::Sun{sun_direction(60.0f * static_cast<float>(id), 40)},
                        .overrides = {"mask.scale=" + scale},
                        .maps = {}});
    }
    render(scene, 1, [&](shadow::Inputs& in) { in.lights = lights; });
    std::vector<std::vector<float>> layers;
    for (int layer = 0; layer < static_cast<int>(lights.size()); ++layer)
      layers.push_back(gl::read_floats(*renderer_->mask().texture, 4, 0, layer));
    return layers;
  };
  const auto mixed = of({"2", "1", "4", "2"}), twos = of({"2", "2", "2", "2"}), ones = of({"1", "1", "1", "1"});
  EXPECT_EQ(mixed[0], twos[0]);
  EXPECT_EQ(mixed[1], ones[1]);
  EXPECT_EQ(mixed[3], twos[3]);
  EXPECT_NE(mixed[2], twos[2]);
  of({"1", "1", "1", "1"});
  for (const gl::Device::NamedTarget& target : renderer_->device().targets())
    EXPECT_EQ(target.name.find("/scale "), std::string::npos) << target.name << " is kept though nothing uses it";
}

// The share of the receivers whose history the second frame keeps.
TEST_F(ShadowScale, TheHistoryIsFoundWhereTheSurfaceWas) {
  renderer_->shadows().registry().select(params, "thesis");
  params.set("history.reuse", true);
  params.set("cascades.size", 512);
  for (const int width : {120, 121, 123}) {
    TriangleScene scene = box_on_ground(width, 83);
    for (const bool moves : {false, true}) {
      SCOPED_TRACE(testing::Message() << width << (moves ? " a camera that moves" : ""));
      last_view.reset();
      render(scene, 4, [](shadow::Inputs& in) { in.view.cut = true; });
      const TriangleScene before = scene;
      if (moves) scene.view = glm::translate(glm::mat4(1), {0.4f, 0, 0}) * scene.view;
      last_view = before.view;
      const Shadowed shadowed = render(scene, 4);
      const gl::Texture& notes = *renderer_->mask().lights[0].notes;
      const std::vector<unsigned> bits = gl::read_uints(notes, 1);
      int receivers = 0, kept = 0;
      for (int y = 0; y < notes.height(); ++y) {
        for (int x = 0; x < notes.width(); ++x) {
          if (shadowed.sky(4 * x, 4 * y)) continue;
          ++receivers;
          const unsigned note = bits[static_cast<std::size_t>(y * notes.width() + x)];
          kept += glsl::notes_refusal(note) == HISTORY_KEPT ? 1 : 0;
        }
      }
      EXPECT_GT(receivers, 300);
      EXPECT_GE(kept, moves ? receivers * 85 / 100 : receivers);
    }
  }
}

// They are made from the depths of all pixels, so those of the pixels that are computed are the same.
TEST_F(ShadowScale, WithoutNormalsThePixelsThatAreComputedAreThoseOfTheFullMask) {
  const TriangleScene scene = box_on_ground(121, 83);
  const auto without = [](shadow::Inputs& in) { in.normals = {}; };
  const Shadowed full = render(scene, 1, without);
  for (const int scale : {2, 3, 4}) {
    SCOPED_TRACE(scale);
    const Shadowed scaled = render(scene, scale, without);
    EXPECT_EQ(renderer_->mask().lights[0].scale, scale);
    int apart = 0, of = 0;
    for (int y = 0; y < scene.height; y += scale) {
      for (int x = 0; x < scene.width; x += scale, ++of)
        apart += std::abs(full.visibility(x, y) - scaled.visibility(x, y)) > 0.01f ? 1 : 0;
    }
    EXPECT_LE(apart, of / 200);
    EXPECT_LT(rms(full.visibilities(), scaled.visibilities()), 0.03);
  }
}

// A quad above a ground, by a camera that sees the ground alone: depths give its normals exactly but for their
// rounding.
TEST_F(ShadowScale, OnFlatGroundNormalsFromDepthGiveTheMaskOfThoseThatAreBrought) {
  TriangleScene scene;
  scene.add_quad({-8, 0, -8}, {0, 0, 16}, {16, 0, 0});
  scene.add_quad({-1, 4, -1}, {0, 0, 2}, {2, 0, 0});
  scene.width = 121;
  scene.height = 83;
  scene.view = glm::lookAt(glm::vec3(2, 3, 4), glm::vec3(0, 0, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.8f, 121.0f / 83.0f, 0.1f);
  for (const int scale : {2, 4}) {
    const Shadowed with = render(scene, scale);
    const Shadowed without = render(scene, scale, [](shadow::Inputs& in) {
      in.view.id = 20;
      in.normals = {};
    });
    const std::vector<float> a = with.visibilities(), b = without.visibilities();
    EXPECT_GT(std::ranges::count_if(a, [](float value) { return value > 0.1f && value < 0.9f; }), 100) << scale;
    float most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    EXPECT_LE(most, 0.01f) << scale;
  }
}

// As with a size that follows the time that frames take.
TEST(ShadowScaleSteady, AViewportThatVariesMakesNothing) {
  const auto context = gl::make_context(backend_name(), {.debug = false});
  TriangleRenderer renderer;
  const TriangleScene scene = box_on_ground(160, 120);
  for (const char* technique : {"pcss", "slices_denoised"}) {
    ParamSet params = renderer.params();
    renderer.shadows().registry().select(params, technique);
    params.set("cascades.size", 64);
    params.set("mask.scale", 2);
    std::map<std::string, int> counts;
    for (int frame = 0; frame < 8; ++frame) {
      std::optional<GlCalls> calls;
      renderer.render(
          scene, params,
          [&](shadow::Inputs& in) {
            in.view.last_view = in.view.view;
            in.view.last_projection = in.view.projection;
            // Small at first, then larger and smaller.
            const int less = frame < 2 ? 7 : frame * 3 % 8;
            in.viewport = {0, 0, 160 - 9 * less, 120 - 7 * less};
            calls.emplace(GlCalls::Kind::creations);
          },
          [&] {
            counts = calls->counts();
            calls.reset();
          });
      if (frame > 1) {
        EXPECT_EQ(counts, (std::map<std::string, int>())) << technique << " frame " << frame;
      }
    }
  }
}

// Nothing of a larger or smaller part of the textures, which earlier frames covered, is left in a later one.
TEST(ShadowScaleSteady, AViewportThatVariesGivesTheMaskOfAFreshRenderer) {
  const auto context = gl::make_context(backend_name(), {.debug = false});
  const TriangleScene scene = box_on_ground(160, 160);
  constexpr shadow::Rect parts[] = {{0, 0, 160, 160}, {0, 0, 141, 143}, {0, 0, 160, 126}, {9, 4, 103, 109},
                                    {0, 0, 103, 92},  {0, 0, 160, 160}, {0, 0, 84, 75}};
  for (const char* technique : {"pcss", "slices_denoised"}) {
    TriangleRenderer renderer;
    ParamSet params = renderer.params();
    renderer.shadows().registry().select(params, technique);
    params.set("mask.scale", 2);
    for (const shadow::Rect& part : parts) {
      const auto visibilities = [&](TriangleRenderer& with) {
        return with
            .render(scene, params,
                    [&](shadow::Inputs& in) {
                      in.view.last_view = in.view.view;
                      in.view.last_projection = in.view.projection;
                      in.viewport = part;
                    })
            .visibilities();
      };
      TriangleRenderer fresh;
      const std::vector<float> found = visibilities(renderer), expected = visibilities(fresh);
      int different = 0, shadowed = 0;
      for (int y = part.y; y < part.y + part.height; ++y) {
        for (int x = part.x; x < part.x + part.width; ++x) {
          const auto i = static_cast<std::size_t>(y * scene.width + x);
          different += found[i] != expected[i] ? 1 : 0;
          shadowed += expected[i] < 0.5f ? 1 : 0;
        }
      }
      EXPECT_EQ(different, 0) << technique << ", " << part.width << "×" << part.height;
      EXPECT_GT(shadowed, 200);
    }
  }
}

// What was stored for a history was made with other normals.
TEST_F(ShadowScale, AFrameThatBeginsOrCeasesToBringNormalsHasNoHistory) {
  renderer_->shadows().registry().select(params, "thesis");
  params.set("history.reuse", true);
  const TriangleScene scene = box_on_ground(120, 83);
  const auto frame = [&](int view, bool normals) {
    const Shadowed shadowed = render(scene, 2, [&](shadow::Inputs& in) {
      in.view.id = view;
      if (!normals) in.normals = {};
    });
    return shadowed.visibilities();
  };
  const std::vector<float> first_without = frame(10, false), first_with = frame(11, true);
  EXPECT_NE(frame(11, true), first_with) << "the second frame has a history";
  EXPECT_EQ(frame(11, false), first_without);
  EXPECT_EQ(frame(11, true), first_with);
}

}  // namespace
}  // namespace penumbra::test
