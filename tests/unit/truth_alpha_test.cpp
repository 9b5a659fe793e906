// Masked and blended surfaces have holes in the same places as when they are rasterised.

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <random>
#include <utility>

#include "truth/alpha.h"
#include "unit/truth_scene.h"

namespace penumbra::test {
namespace {

using scene::AlphaMode;
using scene::Filter;
using scene::Wrap;
using truth::TracedSun;

// A quad at y = 1 over x and z from 0 to 4, with u = x / 4 and v = z / 4, that casts by alpha.
struct Masked {
  TruthScene scene;
  scene::Primitive* primitive = nullptr;

  explicit Masked(const std::vector<std::uint8_t>& alphas, int width = 2) {
    scene::Image image{.width = width, .height = static_cast<int>(alphas.size()) / width};
    for (const std::uint8_t alpha : alphas) image.rgba.insert(image.rgba.end(), {255, 255, 255, alpha});
    scene.scene.images.push_back(std::move(image));
    scene.scene.textures.push_back({.image = 0});
    scene.scene.materials.push_back({.alpha_mode = AlphaMode::mask});
    material().base_color_texture.texture = 0;
    primitive = &scene.add_primitive();
    primitive->positions = {{0, 1, 0}, {4, 1, 0}, {4, 1, 4}, {0, 1, 4}};
    primitive->indices = {0, 1, 2, 0, 2, 3};
    primitive->material = 0;
    primitive->uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.place(*primitive).casts = scene::CastMode::by_alpha;
  }

  scene::Material& material() { return scene.scene.materials[0]; }
  scene::Texture& texture() { return scene.scene.textures[0]; }

  // Scales the quad's u and v to these maxima.
  void set_uv_scale(float scale) {
    for (glm::vec2& uv : primitive->uvs[0]) uv *= scale;
  }

  // Expects a shadow at (u, v) = (x / 4, z / 4) exactly where `there` returns true; points very near an edge are left
  // out.
  void expect(const std::function<bool(double u, double v)>& there, const std::string& what) const {
    std::vector<truth::Receiver> receivers;
    std::vector<bool> exact;
    for (int k = 0; k < 33; ++k) {
      for (int i = 0; i < 401; ++i) {
        const double u = (i + 0.37) / 401.8, v = (k + 0.41) / 34.1, hair = 2e-4;
        const bool inside = there(u, v);
        if (there(u - hair, v) != inside || there(u + hair, v) != inside || there(u, v - hair) != inside ||
            there(u, v + hair) != inside)
          continue;
        receivers.push_back(receiver_at({4 * u, 0, 4 * v}, {0, 1, 0}));
        exact.push_back(inside);
      }
    }
    ASSERT_GT(receivers.size(), 8000U) << what;
    const auto traced = trace_row(scene.tracer(), receivers, TracedSun{.angle = 0}, {.samples = 8});
    int wrong = 0;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      wrong += (traced.hard[i] == 0) != exact[i] || traced.visibility[i] != traced.hard[i] ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0) << what;
  }
};

double fraction(double x) { return x - std::floor(x); }

TEST(TruthAlpha, LinearFilterCutsBetweenTexelCentres) {
  Masked scene({0, 255, 0, 255});
  for (const float cutoff : {0.25f, 0.5f, 0.8f}) {
    scene.material().alpha_cutoff = cutoff;
    scene.texture().wrap_s = Wrap::clamp_to_edge;
    scene.expect([&](double u, double) { return u >= 0.25 + 0.5 * cutoff; }, "clamp");
    scene.texture().wrap_s = Wrap::repeat;
    // The last texel and the first texel of the next repeat are neighbours.
    const auto repeated = [&](double u, double) {
      return (u >= 0.25 + 0.5 * cutoff && u <= 1.25 - 0.5 * cutoff) || u <= 0.25 - 0.5 * cutoff;
    };
    scene.expect(repeated, "repeat");
    scene.texture().wrap_s = Wrap::mirrored_repeat;
    scene.expect([&](double u, double) { return u >= 0.25 + 0.5 * cutoff; }, "mirrored");
  }
}

TEST(TruthAlpha, WrapModesGoOnBeyondTheTexture) {
  Masked scene({0, 255, 0, 255});
  scene.set_uv_scale(5);
  scene.material().alpha_cutoff = 0.25f;
  scene.texture().wrap_s = Wrap::clamp_to_edge;
  scene.expect([&](double u, double) { return 5 * u >= 0.375; }, "clamp");
  scene.texture().wrap_s = Wrap::repeat;
  scene.expect([&](double u, double) { return fraction(5 * u) >= 0.375 || fraction(5 * u) <= 0.125; }, "repeat");
  scene.texture().wrap_s = Wrap::mirrored_repeat;
  scene.expect([&](double u, double) { return 1 - std::abs(2 * fraction(2.5 * u) - 1) >= 0.375; }, "mirrored");
  for (glm::vec2& uv : scene.primitive->uvs[0]) uv -= glm::vec2(3.5f, 0);
  scene.expect([&](double u, double) { return 1 - std::abs(2 * fraction((5 * u - 3.5) / 2) - 1) >= 0.375; },
               "negative");
  scene.texture().wrap_s = Wrap::clamp_to_edge;
  scene.expect([&](double u, double) { return 5 * u - 3.5 >= 0.375; }, "negative clamp");
}

TEST(TruthAlpha, NearestFilterCutsAtTexelEdges) {
  Masked scene({0, 255, 255, 0, 255, 255, 0, 0}, 4);  // rows top to bottom: v grows downwards
  scene.texture().mag = Filter::nearest;
  scene.texture().min = Filter::linear;
  const auto there = [](double u, double v) { return v < 0.5 ? u >= 0.25 && u < 0.75 : u < 0.5; };
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp_to_edge, Wrap::mirrored_repeat}) {
    scene.texture().wrap_s = scene.texture().wrap_t = wrap;
    scene.expect(there, "nearest");
  }
}

TEST(TruthAlpha, TextureTransformAndSecondSetAreUsed) {
  Masked scene({0, 255, 0, 255});
  scene.texture().mag = Filter::nearest;
  scene.texture().wrap_s = Wrap::clamp_to_edge;
  // u' = 2 v − 0.25: turned, scaled, moved.
  scene.material().base_color_texture.uv_transform = glm::mat3x2(0, 1, 2, 0, -0.25f, 0);
  scene.expect([](double, double v) { return 2 * v - 0.25 >= 0.5; }, "transform");
  scene.primitive->uvs[1] = {{0, 1}, {0, 0}, {0, 0}, {0, 1}};  // v = 1 − x / 4
  scene.material().base_color_texture.uv_set = 1;
  scene.expect([](double u, double) { return 2 * (1 - u) - 0.25 >= 0.5; }, "second set");
}

TEST(TruthAlpha, ColoursMultiply) {
  Masked scene({204, 204, 204, 204});
  scene.primitive->colors = {{1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 0}};  // alpha = u
  scene.material().base_color.a = 0.75f;
  scene.material().alpha_cutoff = 0.3f;
  scene.expect([](double u, double) { return u * 0.8 * 0.75 >= 0.3; }, "mask");
  scene.material().base_color.a = 1;
  scene.material().alpha_mode = AlphaMode::blend;
  scene.expect([](double u, double) { return u * 0.8 > 0.5; }, "blend");
  scene.material().base_color_texture.texture = -1;
  scene.expect([](double u, double) { return u > 0.5; }, "no texture");
}

TEST(TruthAlpha, MaskKeepsItsCutoffAndBlendDropsAHalf) {
  Masked scene({255, 255, 255, 255});
  const auto everywhere = [](double, double) { return true; };
  const auto nowhere = [](double, double) { return false; };
  scene.material().base_color.a = 0.5f;
  scene.material().alpha_cutoff = 0.5f;
  scene.expect(everywhere, "mask at its cutoff");
  scene.material().alpha_cutoff = std::nextafter(0.5f, 1.0f);
  scene.expect(nowhere, "mask under its cutoff");
  scene.material().alpha_mode = AlphaMode::blend;
  scene.material().alpha_cutoff = 0.1f;
  scene.expect(nowhere, "blend of a half");
  scene.material().base_color.a = 0.51f;
  scene.expect(everywhere, "blend over a half");
}

// Rays continue behind a hole.
TEST(TruthAlpha, WhatIsBehindAHoleStillCasts) {
  Masked scene({0, 255, 0, 255});
  scene.texture().mag = Filter::nearest;
  scene.texture().wrap_s = Wrap::clamp_to_edge;
  scene.scene.add_quad({0, 2, 2}, {4, 0, 0}, {0, 0, 2});
  scene.expect([](double u, double v) { return u >= 0.5 || v >= 0.5; }, "a quad behind");
}

TEST(TruthAlpha, SharedTrianglesHaveTheSameHoles) {
  Masked scene({0, 255, 255, 0});
  scene.texture().mag = Filter::nearest;
  scene::Primitive& primitive = *scene.primitive;
  primitive.indices.resize(3 * 64, 0);  // enough to be shared; those without area don't count
  glm::mat4 aside(1);
  aside[3].x = 4;
  scene.scene.place(primitive, aside).casts = scene::CastMode::by_alpha;
  std::vector<truth::Receiver> receivers;
  for (int i = 0; i < 1600; ++i) {
    const int z = i / 80;
    receivers.push_back(receiver_at({(i % 80 + 0.5) * 0.1, 0, (z + 0.5) * 0.2}, {0, 1, 0}));
  }
  const TracedSun sun{.angle = 0.05};
  const auto flat = trace_row(scene.scene.tracer(), receivers, sun);
  const truth::Tracer tracer = scene.scene.tracer({.flat_triangles = 0});
  ASSERT_EQ(tracer.stats().instances, 2U);
  EXPECT_EQ(trace_row(tracer, receivers, sun).visibility, flat.visibility);
  EXPECT_GT(std::ranges::count(flat.hard, 1), 700);
}

// Alpha tests are settled by these bounds where they can be.
TEST(TruthAlpha, BoundsHoldWhatIsReadAndAreExactWhereAlphaIsTheSame) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-2, 3);
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 5}, {4, 8}, {17, 6}, {32, 32}}) {
    scene::Image image{.width = width, .height = height};
    for (int i = 0; i < width * height; ++i)
      image.rgba.insert(image.rgba.end(), {0, 0, 0, static_cast<std::uint8_t>(random() % 256)});
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
      for (const Filter filter : {Filter::nearest, Filter::linear}) {
        const truth::AlphaTexture texture({.image = 0, .wrap_s = wrap, .wrap_t = wrap, .mag = filter}, image);
        for (int i = 0; i < 2000; ++i) {
          const glm::vec2 uv(place(random), place(random));
          const truth::AlphaTexture::Bounds bounds = texture.bounds_at(uv);
          ASSERT_GE(texture.at(uv), bounds.least) << width << " texels, " << uv.x << " " << uv.y;
          ASSERT_LE(texture.at(uv), bounds.greatest) << width << " texels, " << uv.x << " " << uv.y;
        }
      }
    }
  }
  scene::Image halves{.width = 32, .height = 1};
  for (int i = 0; i < 32; ++i)
    halves.rgba.insert(halves.rgba.end(), {0, 0, 0, i < 16 ? std::uint8_t{0} : std::uint8_t{255}});
  const truth::AlphaTexture texture({.image = 0, .wrap_s = Wrap::clamp_to_edge}, halves);
  EXPECT_NEAR(texture.bounds_at({0.3f, 0.5f}).greatest, 0, 1e-4);
  EXPECT_NEAR(texture.bounds_at({0.7f, 0.5f}).least, 1, 1e-4);
}

}  // namespace
}  // namespace penumbra::test
