// The second layer of the shadow map: casters below others keep their shadows.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu/exact_penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr double pi = 3.14159265358979323846;

// A half-plane x < 0 at 4 m, and one x < -0.05 m at 1 m, which the first hides from the sun at the zenith.
constexpr float high = 4, low = 1, low_edge = -0.05f;
constexpr float angle = 8;

// `height`: of the picture. Below that of a tile, all pixels are computed.
TriangleScene ground_from_above(int height) {
  TriangleScene scene;
  scene.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  scene.receivers = shadow::Box{{-1, 0, -1}, {1, 0, 1}};
  scene.width = 128;
  scene.height = height;
  scene.view = glm::lookAt(glm::vec3(0, 0.5f, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.5f, 0.5f * static_cast<float>(height) / 128, 0.01f, 1);
  return scene;
}

TriangleScene half_planes(bool both, int height) {
  TriangleScene scene = ground_from_above(height);
  if (both) scene.add_quad({-12, low, -12}, {0, 0, 24}, {12 + low_edge, 0, 0});
  scene.add_quad({-12, high, -12}, {0, 0, 24}, {12, 0, 0});
  return scene;
}

TriangleScene two_half_planes() { return half_planes(/*both=*/true, 4); }

// The share of a disc that is not hidden by half-planes with parallel edges: of those above a receiver at x, that whose
// edge crosses the disc farthest hides the most, and the others nothing that it does not hide.
double exact(double x, bool both) {
  const double radius = std::tan(glm::radians(static_cast<double>(angle)) / 2);
  double t = x / (radius * static_cast<double>(high));
  if (both) t = std::min(t, (x - static_cast<double>(low_edge)) / (radius * static_cast<double>(low)));
  t = std::clamp(t, -1.0, 1.0);
  return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / pi;
}

// The largest error over the picture, of the mean of some seeds.
double worst_error(TriangleRenderer& renderer, int layers, bool both, int height = 4) {
  const TriangleScene scene = half_planes(/*both=*/true, height);
  ParamSet params = renderer.params();
  params.set("technique", std::string("slices"));
  params.set("sun.angle", angle);
  params.set("maps.layers", layers);
  params.set("cascades.size", 1024);
  for (const char* name : {"slices.azimuths", "slices.samples"}) params.set(name, 32);
  constexpr int seeds = 16;
  std::vector<double> sums;
  Shadowed last;
  for (int seed = 0; seed < seeds; ++seed) {
    params.set("sampling.seed", seed);
    last = renderer.render(scene, params, [](shadow::Inputs& inputs) { inputs.view.cut = true; });
    const std::vector<float> visibility = last.visibilities();
    sums.resize(visibility.size());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += static_cast<double>(visibility[i]) / seeds;
  }
  double worst = 0;
  for (int y = 0; y < last.height; ++y) {
    for (int x = 0; x < last.width; ++x) {
      const auto place = static_cast<double>(last.point(x, y).x);
      worst = std::max(worst, std::abs(sums[static_cast<std::size_t>(y * last.width + x)] - exact(place, both)));
    }
  }
  return worst;
}

class ShadowLayers : public TriangleTest {};

TEST_F(ShadowLayers, ACasterBelowAnotherKeepsItsShadow) {
  EXPECT_LT(worst_error(*renderer_, 2, /*both=*/true), 0.02);
  EXPECT_GT(worst_error(*renderer_, 1, /*both=*/true), 0.2) << "one layer does not show the lower half-plane";
  EXPECT_LT(worst_error(*renderer_, 1, /*both=*/false), 0.02);
}

TEST_F(ShadowLayers, TilesBelowWhichCastersOverlapReadBoth) {
  EXPECT_LT(worst_error(*renderer_, 2, /*both=*/true, 16), 0.02);
}

// A roof, a lower one beside it, and the wall between them, along which the light looks, so that no layer shows it: all
// light that passes the high roof's edge meets the wall. The second layer shows the ground below the high roof, or the
// roof's inner face.
TEST_F(ShadowLayers, NoLightPassesAWallBetweenAHighAndALowRoof) {
  constexpr float edge = 0.1f, thickness = 0.05f;
  for (const auto& [height, thick] : {std::pair(4, false), {16, false}, {4, true}, {16, true}}) {
    TriangleScene scene = ground_from_above(height);
    if (thick) scene.add_quad({-12, high - thickness, -12}, {0, 0, 24}, {12 + edge, 0, 0});
    scene.add_quad({-12, high, -12}, {0, 0, 24}, {12 + edge, 0, 0});
    scene.add_quad({edge, low, -12}, {0, 0, 24}, {0, high - low, 0});
    scene.add_quad({edge, low, -12}, {0, 0, 24}, {12 - edge, 0, 0});
    ParamSet params = renderer_->params();
    params.set("technique", std::string("slices"));
    params.set("sun.angle", angle);
    params.set("cascades.size", 1024);
    for (const int layers : {1, 2}) {
      SCOPED_TRACE(fmt::format("{} layers, {} rows, thick: {}", layers, height, thick));
      params.set("maps.layers", layers);
      EXPECT_LT(std::ranges::max(renderer_->render(scene, params).visibilities()), 0.01f);
    }
  }
}

// A half-plane at 1 m to the one or the other side of an edge, which a strip at 4 m hides from the sun at the zenith.
struct HiddenEdge {
  float x = 0;
  float side = -1;                       // of the half-plane: to that side along x
  static constexpr float strip = 0.18f;  // to both sides of the edge, beyond what the light shows of lower surfaces

  TriangleScene scene() const {
    TriangleScene scene = ground_from_above(16);
    scene.add_quad({side < 0 ? -12 : x, low, -12}, {0, 0, 24}, {side < 0 ? 12 + x : 12 - x, 0, 0});
    scene.add_quad({x - strip, high, -12}, {0, 0, 24}, {2 * strip, 0, 0});
    return scene;
  }
  // Below the side without the half-plane: it hides the sun's disc up to `of_low`, and the strip from `from` to `to`.
  double exact(double at) const {
    const double radius = std::tan(glm::radians(static_cast<double>(angle)) / 2), away = (x - at) * side;
    const double of_low = -away / (radius * low);
    const double from = (-strip - away) / (radius * high), to = (strip - away) / (radius * high);
    return of_low < from ? 1 - exact_disc(of_low) - exact_disc(to) + exact_disc(from)
                         : 1 - exact_disc(std::max(of_low, to));
  }
};

// A pyramid finds where the second layer ends in blocks of texels. Here that is between two blocks, or within one.
TEST_F(ShadowLayers, TilesBesideAnEdgeOfTheSecondLayerReadIt) {
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("sun.angle", angle);
  params.set("maps.layers", 2);
  params.set("cascades.count", 1);
  params.set("cascades.size", 1024);
  for (const char* name : {"slices.azimuths", "slices.samples"}) params.set(name, 32);
  for (const float side : {-1.0f, 1.0f}) {
    const auto draw = [&](const HiddenEdge& edge) {
      return renderer_->render(edge.scene(), params, [](shadow::Inputs& inputs) { inputs.view.cut = true; });
    };
    draw({.side = side});
    const shadow::Cascades cascades = renderer_->mask().lights[0].projection.cascades();
    const double texel = cascades.texel(0).x;
    const double origin = cascades.anchor.x + cascades.items[0].center.x - cascades.items[0].half_extent.x;
    const double between = origin + 8 * std::round(-origin / texel / 8) * texel;
    for (const int texels : {0, 3, 4}) {
      const HiddenEdge edge{.x = static_cast<float>(between + texels * texel), .side = side};
      const Shadowed shadowed = draw(edge);
      for (int x = 0; x < shadowed.width; ++x) {
        const double at = shadowed.point(x, 8).x, away = (edge.x - at) * side;
        if (away < 0 || away > 0.16) continue;
        double mean = 0;
        for (int y = 0; y < shadowed.height; ++y) mean += static_cast<double>(shadowed.visibility(x, y)) / 16;
        EXPECT_NEAR(mean, edge.exact(at), 0.01)
            << side << ", " << texels << " texels, " << away << " m beside the edge";
      }
    }
  }
}

// A roof that falls by 7 m per metre from its edge at 4 m, at x = 0: half as steep as the light's cone, so that it is
// one surface, though its samples differ much in height.
TEST_F(ShadowLayers, ASteepRoofLetsNoLightThroughBetweenSamples) {
  TriangleScene scene = half_planes(/*both=*/false, 4);
  scene.triangles.resize(2);
  scene.add_quad({-0.5f, high - 3.5f, -12}, {0, 0, 24}, {0.5f, 3.5f, 0});
  scene.add_quad({-12, high - 3.5f, -12}, {0, 0, 24}, {11.5f, 0, 0});
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("sun.angle", angle);
  params.set("maps.layers", 2);
  params.set("cascades.size", 1024);
  for (const char* name : {"slices.azimuths", "slices.samples"}) params.set(name, 32);
  const Shadowed shadowed = renderer_->render(scene, params);
  for (int x = 0; x < shadowed.width; ++x) {
    const auto at = static_cast<double>(shadowed.point(x, 2).x);
    double mean = 0;
    for (int y = 0; y < shadowed.height; ++y) mean += static_cast<double>(shadowed.visibility(x, y)) / shadowed.height;
    EXPECT_NEAR(mean, exact(at, /*both=*/false), 0.02) << at;
  }
}

// All tiles are then those of one layer: others have other samples.
TEST_F(ShadowLayers, WhereNoCastersOverlapThePictureIsThatOfOneLayer) {
  const auto mask = [&](bool both, int layers) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string("slices"));
    params.set("sun.angle", angle);
    params.set("maps.layers", layers);
    return renderer_->render(half_planes(both, 16), params, [](shadow::Inputs& inputs) { inputs.view.cut = true; })
        .mask;
  };
  EXPECT_EQ(mask(false, 2), mask(false, 1));
  EXPECT_NE(mask(true, 2), mask(true, 1));
}

// The picture is 1 m high, and the high half-plane's penumbra 0.56 m wide.
TEST_F(ShadowLayers, SmallMapsShowWhetherCastersOverlapInWidePenumbrae) {
  struct Drawn {
    std::vector<float> mask;
    int size = 0;  // of the largest second layer, texels along a side
  };
  const auto draw = [&](bool both, int layers, float overlap) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string("slices"));
    params.set("sun.angle", angle);
    params.set("cascades.fit", std::string("penumbrae"));
    params.set("maps.layers", layers);
    params.set("maps.overlap", overlap);
    Drawn drawn;
    const auto watch = [&](shadow::Inputs& inputs) {
      inputs.view.cut = true;
      inputs.binds_forward = false;
      inputs.draw = [&drawn, draw = inputs.draw](const shadow::CasterPass& casters, gl::Pass& pass) {
        std::array<GLint, 4> viewport{};
        gl::glGetIntegerv(GL_VIEWPORT, viewport.data());
        if (casters.kind == shadow::CasterKind::second_depth) drawn.size = std::max(drawn.size, viewport[2]);
        draw(casters, pass);
      };
    };
    drawn.mask = renderer_->render(half_planes(both, 128), params, watch).mask;
    return drawn;
  };
  const Drawn one = draw(true, 1, 0), two = draw(true, 2, 0);
  ASSERT_NE(one.mask, two.mask);
  EXPECT_EQ(one.size, 0);
  EXPECT_GT(two.size, 0);
  const Drawn wide = draw(true, 2, 0.3f), too_wide = draw(true, 2, 0.9f);
  EXPECT_EQ(wide.mask, two.mask);
  EXPECT_EQ(wide.size, two.size);
  EXPECT_EQ(too_wide.mask, one.mask);
  EXPECT_GT(too_wide.size, 0) << "of the small maps";
  EXPECT_LT(too_wide.size, wide.size);
  EXPECT_EQ(draw(true, 2, 0.3f).mask, two.mask) << "after a frame without one";
  EXPECT_EQ(draw(false, 2, 0.01f).mask, draw(false, 1, 0).mask) << "nothing overlaps";
}

// The low half-plane, which the high one hides from the sun's centre, moves.
TEST_F(ShadowLayers, ACasterBelowAnotherLeavesNoShadowBehindWhereItMoves) {
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("sun.angle", angle);
  params.set("history.reuse", true);
  params.set("maps.layers", 2);
  for (const char* present : {"own_pass", "shadow_pass"}) {
    params.set("movement.present", std::string(present));
    TriangleScene scene = half_planes(/*both=*/false, 16);
    const std::size_t first = scene.triangles.size();
    scene.add_quad({-12, low, -12}, {0, 0, 24}, {12 + low_edge, 0, 0});
    const auto frame = [&](bool cut) {
      return renderer_
          ->render(scene, params,
                   [&](shadow::Inputs& inputs) {
                     inputs.view.cut = cut;
                     inputs.view.last_view = inputs.view.view;
                     inputs.view.last_projection = inputs.view.projection;
                   })
          .visibilities();
    };
    constexpr int frames = 8;
    for (int i = 0; i < frames; ++i) frame(/*cut=*/i == 0);
    scene.move_from(first, glm::vec3(-0.1f, 0, 0));
    const std::vector<float> with_history = frame(/*cut=*/false), alone = frame(/*cut=*/true);
    EXPECT_EQ(with_history, alone) << present;
  }
}

// The names of all programs but those of the scene itself.
std::multiset<std::string> compiled_programs() {
  std::multiset<std::string> names;
  constexpr GLuint most = 1000;
  for (GLuint id = 1; id < most; ++id) {
    if (gl::glIsProgram(id) == GL_FALSE) continue;
    std::array<char, 100> name{};
    gl::glGetObjectLabel(GL_PROGRAM, id, static_cast<GLsizei>(name.size()), nullptr, name.data());
    if (!std::string_view(name.data()).starts_with("test ")) names.emplace(name.data());
  }
  return names;
}

TEST_F(ShadowLayers, AfterAWarmUpNoFrameCompilesAProgramWhetherCastersOverlapOrNot) {
  TriangleRenderer renderer;
  ParamSet params = renderer.params();
  params.set("technique", std::string("slices"));
  params.set("sun.angle", angle);
  params.set("cascades.fit", std::string("penumbrae"));
  params.set("maps.layers", 2);
  params.set("maps.overlap", 0.3f);
  const TriangleScene scene = half_planes(true, 128);
  const shadow::Light light{.source = shadow::Sun{scene.to_light}, .overrides = {}, .maps = {}};
  renderer.shadows().warm_up({.lights = {&light, 1}, .mask_details = true, .binds_forward = false}, params);
  const auto frames = [&](bool binds_forward) {
    for (const bool both : {false, true}) {
      renderer.render(half_planes(both, 128), params, [&](shadow::Inputs& inputs) {
        inputs.view.cut = true;
        inputs.binds_forward = binds_forward;
      });
    }
  };
  const std::multiset<std::string> warm = compiled_programs();
  frames(/*binds_forward=*/false);
  EXPECT_EQ(compiled_programs(), warm);
  frames(/*binds_forward=*/true);
  EXPECT_EQ(compiled_programs(), warm);
}

// Whether casters overlap is known of pictures with small maps alone.
TEST_F(ShadowLayers, OtherMapsHaveNoSecondLayerWhereItDependsOnOverlaps) {
  for (const char* fit : {"stable", "visible"}) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string("slices"));
    params.set("sun.angle", angle);
    params.set("cascades.fit", std::string(fit));
    const auto mask = [&](int layers, bool binds_forward) {
      params.set("maps.layers", layers);
      return renderer_
          ->render(half_planes(true, 16), params,
                   [&](shadow::Inputs& inputs) {
                     inputs.view.cut = true;
                     inputs.binds_forward = binds_forward;
                   })
          .mask;
    };
    const std::vector<float> one = mask(1, false), two = mask(2, false);
    EXPECT_NE(two, one) << fit;
    params.set("maps.overlap", 0.01f);
    EXPECT_EQ(mask(2, false), one) << fit;
    EXPECT_EQ(mask(2, true), two) << fit << ": programs of blended surfaces read it";
  }
}

TEST_F(ShadowLayers, WhatIsNearerToTheFirstSurfaceThanTheGapIsLeftOut) {
  const auto with_gap = [&](float gap) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string("slices"));
    params.set("sun.angle", angle);
    params.set("maps.layers", 2);
    params.set("maps.gap", gap);
    return renderer_->render(two_half_planes(), params, [](shadow::Inputs& inputs) { inputs.view.cut = true; }).mask;
  };
  const std::vector<float> none = with_gap(0);
  EXPECT_EQ(with_gap(high - low - 0.1f), none);
  EXPECT_NE(with_gap(high - low + 0.1f), none);
}

// Which layers the second pass draws when a part of the scene moves.
TEST_F(ShadowLayers, OnlyLayersThatHoldWhatMovedAreDrawnAgain) {
  TriangleScene scene = box_on_ground(32);
  scene.casters = scene.receivers = shadow::Box{{-5, 0, -5}, {5, 3, 5}};
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("cascades.size", 64);
  params.set("maps.layers", 2);
  const auto frame = [&](const TriangleRenderer::Adjust& adjust = {}) {
    std::vector<int> drawn;
    renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      inputs.draw = [&drawn, draw = inputs.draw](const shadow::CasterPass& casters, gl::Pass& pass) {
        if (casters.kind == shadow::CasterKind::second_depth) drawn.push_back(casters.layer);
        draw(casters, pass);
      };
      if (adjust) adjust(inputs);
    });
    return drawn;
  };
  const std::vector<int> all{0, 1, 2, 3};
  EXPECT_EQ(frame(), all);
  EXPECT_EQ(frame(), std::vector<int>());
  // Far from the finest cascade's column.
  const auto corner = [](shadow::Inputs& inputs) { inputs.moved = shadow::Box{{-5, 0, -5}, {-4.9f, 0.1f, -4.9f}}; };
  const std::vector<int> reached = frame(corner);
  ASSERT_FALSE(reached.empty());
  EXPECT_LT(reached.size(), all.size());
  params.set("maps.gap", 0.1f);
  EXPECT_EQ(frame(corner), all) << "another gap";
  params.set("maps.layers", 1);
  EXPECT_EQ(frame(corner), std::vector<int>());
  params.set("maps.layers", 2);
  EXPECT_EQ(frame(), all) << "the frame before had none";
  params.set("technique", std::string("pcss"));
  EXPECT_EQ(frame(corner), std::vector<int>()) << "does not read it";
}

// The pass tests against the maps' own depths.
TEST_F(ShadowLayers, FinishedMapsOfADepthFormatCanHaveOne) {
  const TriangleScene scene = box_on_ground(32);
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("maps.layers", 2);
  const std::vector<float> expected = renderer_->render(scene, params).mask;
  const shadow::LightFrame made = renderer_->mask().lights[0];
  const int size = made.projection.size();
  const gl::Texture colour("engine's maps", {.target = GL_TEXTURE_2D_ARRAY,
                                             .format = GL_R32F,
                                             .width = size,
                                             .height = size,
                                             .layers = made.projection.layers()});
  const auto draw_with = [&](unsigned maps) {
    return renderer_
        ->render(scene, params,
                 [&](shadow::Inputs& inputs) {
                   static std::vector<shadow::Light> lights;
                   lights.assign(inputs.lights.begin(), inputs.lights.end());
                   lights[0].maps = shadow::FinishedMaps{{maps, size, size}, made.projection};
                   inputs.lights = lights;
                 })
        .mask;
  };
  EXPECT_EQ(draw_with(made.depth), expected);
  EXPECT_EQ(
      message_of([&] { draw_with(colour.id()); }),
      "soft shadows: the maps of light 0 are R32F, whose depths technique 'slices' can't compare: use a depth format");
}

TEST_F(ShadowLayers, FinishedMapsWithoutCastersCannotHaveOne) {
  const TriangleScene scene = box_on_ground(32);
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  renderer_->render(scene, params);
  const shadow::LightFrame made = renderer_->mask().lights[0];
  params.set("maps.layers", 2);
  try {
    renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      static std::vector<shadow::Light> lights;
      lights.assign(inputs.lights.begin(), inputs.lights.end());
      const int size = made.projection.size();
      lights[0].maps = shadow::FinishedMaps{{made.depth, size, size}, made.projection};
      inputs.lights = lights;
      inputs.draw = nullptr;
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "soft shadows: light 0: maps.layers=2 draws casters, and there is no caster callback");
  }
}

}  // namespace
}  // namespace penumbra::test
