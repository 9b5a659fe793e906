// Shadow maps, and what is made from them, are not drawn again where nothing changed; and are wherever something did.

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

using Layers = std::vector<int>;

const Layers all_layers{0, 1, 2, 3};

// A recipe that reads nothing but the shadow map, and counts how often it is made.
int builds = 0;

shadow::Recipe counted_recipe() {
  return {.name = "counted",
          .summary = "A texel that nobody reads.",
          .source = "made up",
          .params = {{"counted.value", 0.5f, 0, 1, "", "What the texel holds.", ParamBinding::host}},
          .depends_only_on_needs = true,
          .reads_light_discs = true,
          .build = [](const shadow::PassContext& context) -> const gl::Texture& {
            ++builds;
            const gl::Texture& texel = context.target("texel", {.format = GL_R32F});
            const float value = context.params().get_float("counted.value");
            gl::glClearTexImage(texel.id(), 0, GL_RED, GL_FLOAT, &value);
            return texel;
          }};
}

// The built-in techniques; pcss asks for the counted product too.
shadow::Registry registry_with_counted() {
  shadow::Registry::Contents contents = shadow::built_in_registry().contents();
  contents.recipes.push_back(counted_recipe());
  for (shadow::Technique& technique : contents.techniques) {
    if (technique.name == "pcss") technique.needs.emplace_back("counted");
  }
  return shadow::Registry(std::move(contents));
}

class ShadowKeep : public GpuTest {
 protected:
  ShadowKeep() : params(renderer.params()), scene(box_on_ground(32)) {
    params.set("cascades.size", 64);
    scene.casters = scene.receivers = shadow::Box{{-5, 0, -5}, {5, 3, 5}};  // so that a move changes no projection
  }

  // Draws the next frame of a camera that does not move; returns the layers that were drawn, in order.
  Layers frame(const TriangleRenderer::Adjust& adjust = {}) {
    drawn.clear();
    builds = 0;
    last = renderer.render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      inputs.draw = [this, draw = inputs.draw](const shadow::CasterPass& casters, gl::Pass& pass) {
        if (casters.kind == shadow::CasterKind::depth) drawn.push_back(casters.layer);
        draw(casters, pass);
      };
      if (adjust) adjust(inputs);
    });
    const shadow::LightFrame& light = renderer.mask().lights[0];
    for (std::size_t i = 0; light.depth != 0 && i < static_cast<std::size_t>(light.projection.layers()); ++i)
      EXPECT_NE(std::ranges::find(drawn, static_cast<int>(i)) != drawn.end(), light.kept_layers[i]) << i;
    return drawn;
  }

  // Two frames, of which the second draws nothing.
  void settle() {
    frame();
    EXPECT_EQ(frame(), Layers());
    EXPECT_EQ(builds, 0);
  }

  TriangleRenderer renderer{registry_with_counted()};
  ParamSet params;
  TriangleScene scene;
  Shadowed last;
  Layers drawn;
};

TEST_F(ShadowKeep, NothingIsDrawnAgainWhereNothingChanged) {
  EXPECT_EQ(frame(), all_layers);
  EXPECT_EQ(builds, 1);
  const std::vector<float> first = last.mask;
  EXPECT_EQ(frame(), Layers());
  EXPECT_EQ(builds, 0);
  EXPECT_EQ(last.mask, first);
  params.set("maps.keep", false);
  EXPECT_EQ(frame(), all_layers);
  EXPECT_EQ(builds, 1);
  EXPECT_EQ(last.mask, first);
  params.set("maps.keep", true);
  frame();
  EXPECT_EQ(frame(), Layers());
}

// Those that show first where penumbrae are, too.
TEST_F(ShadowKeep, MapsFittedToPenumbraeRestWithThePicture) {
  params.set("cascades.fit", "penumbrae");
  const Layers all = frame();
  const int of_light = renderer.mask().lights[0].projection.layers();
  EXPECT_GT(static_cast<int>(all.size()), of_light);
  const std::vector<float> first = last.mask;
  EXPECT_EQ(frame(), Layers());
  EXPECT_EQ(builds, 0);
  EXPECT_EQ(last.mask, first);
  EXPECT_EQ(frame([](shadow::Inputs& in) { in.moved = shadow::Box{{-5, 0, -5}, {5, 3, 5}}; }), all);
  EXPECT_EQ(last.mask, first);
}

// Where a view shows only sky, its maps are fitted to the frustum, for surfaces that are drawn forward.
TEST_F(ShadowKeep, MapsOfAViewThatShowsNothingAnyMoreAreDrawnWhole) {
  params.set("cascades.size", 512);
  params.set("cascades.fit", "visible");
  scene.receivers = shadow::Box{{-50, 0, -50}, {50, 3, 50}};
  const gl::Texture sky("sky", {.format = GL_DEPTH_COMPONENT32F, .width = scene.width, .height = scene.height});
  const float far = 0;
  gl::glClearTexImage(sky.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
  const auto drawn_texels = [&](int view, bool shows_sky) {
    frame([&](shadow::Inputs& in) {
      in.view.id = view;
      if (shows_sky) in.depth.id = sky.id();
    });
    const shadow::LightProjection& projection = renderer.mask().lights[0].projection;
    std::vector<shadow::TexelRange> texels;
    for (int i = 0; i < projection.layers(); ++i) texels.push_back(projection.drawn_texels(i));
    return texels;
  };
  const std::vector<shadow::TexelRange> expected = drawn_texels(1, true);
  EXPECT_NE(drawn_texels(0, false), expected);
  EXPECT_EQ(drawn_texels(0, true), expected);
}

TEST_F(ShadowKeep, TuningWhatReadsTheMapsDoesNotDrawThem) {
  params.set("denoiser", std::string("history_and_filters"));
  settle();
  for (const auto& [name, value] : {std::pair("filter.visibility", "bilateral"),
                                    {"filter.width", "0.2"},
                                    {"pcss.filter_taps", "8"},
                                    {"sampling.filter_pattern", "vogel"},
                                    {"history.reuse", "true"},
                                    {"driver", "compute"},
                                    {"bias.constant", "1"},
                                    {"denoiser", "none"}}) {
    params.set_text(name, value);
    EXPECT_EQ(frame(), Layers()) << name;
    EXPECT_EQ(builds, 0) << name;
    EXPECT_EQ(frame(), Layers()) << name;
    EXPECT_EQ(builds, 0) << name << ", after what the change left unused was released";
  }
  const std::vector<float> kept = last.mask;
  frame([](shadow::Inputs& inputs) { inputs.view.cut = true; });
  EXPECT_EQ(last.mask, kept);
}

TEST_F(ShadowKeep, MapsMoveByPartsOfATexelWithAHistoryAndWithTheSeed) {
  settle();
  params.set("sampling.seed", 1);
  EXPECT_EQ(frame(), Layers());
  params.set("maps.jitter", true);
  EXPECT_EQ(frame(), all_layers);
  EXPECT_EQ(frame(), Layers());
  params.set("sampling.seed", 0);
  EXPECT_EQ(frame(), all_layers);
  EXPECT_EQ(frame(), Layers());
  params.set("denoiser", std::string("history_and_filters"));
  params.set("history.reuse", false);
  frame();
  EXPECT_EQ(frame(), Layers());
  params.set("history.reuse", true);
  frame();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(frame(), all_layers);
  const auto see_glass = [](shadow::Inputs& in) { in.forward_receivers = {{-1, 0, -1}, {1, 1, 1}}; };
  frame(see_glass);
  EXPECT_EQ(frame(see_glass), Layers());
}

// However little the camera moves: far from the world's origin its matrix hardly changes.
TEST_F(ShadowKeep, MapsOfAMovingCameraDoNotMoveByPartsOfATexel) {
  params.set("denoiser", std::string("history_and_filters"));
  params.set("history.reuse", true);
  params.set("maps.jitter", true);
  const auto part_of_texel = [&](float walked) {
    const auto walk = [&](shadow::Inputs& in) {
      in.view.last_view = glm::translate(in.view.view, glm::vec3(0, 0, walked - (walked > 0 ? 1e-6f : 0)));
      in.view.view = glm::translate(in.view.view, glm::vec3(0, 0, walked));
    };
    frame(walk);
    const shadow::Cascades& cascades = renderer.mask().lights[0].projection.cascades();
    const glm::dvec3 anchor = cascades.world_to_light * cascades.anchor;
    const glm::dvec2 texels =
        (glm::dvec2(cascades.items[0].center) + glm::dvec2(anchor)) / glm::dvec2(cascades.texel(0));
    return texels - glm::round(texels);
  };
  const glm::dvec2 first = part_of_texel(0);
  EXPECT_GT(glm::length(part_of_texel(0) - first), 0.1);
  const glm::dvec2 at_rest = part_of_texel(0);
  EXPECT_LT(glm::length(part_of_texel(1e-6f) - at_rest), 0.01);
}

TEST_F(ShadowKeep, AProductIsMadeAgainWhereItsOwnParameterChanges) {
  settle();
  params.set("counted.value", 0.25f);
  EXPECT_EQ(frame(), Layers());
  EXPECT_EQ(builds, 1);
  frame();
  EXPECT_EQ(builds, 0);
  params.set("sun.angle", 2.0f);
  frame();
  EXPECT_EQ(builds, 1) << "another size of the light";
  params.set("technique", std::string("hard"));
  frame();
  params.set("technique", std::string("pcss"));
  EXPECT_EQ(frame(), Layers());
  EXPECT_EQ(builds, 1) << "nobody needed it in the last frame, so it was released";
}

TEST_F(ShadowKeep, OnlyLayersThatHoldWhatMovedAreDrawnAgain) {
  settle();
  // Far from the finest cascade's column.
  const shadow::Box corner{{-5, 0, -5}, {-4.9f, 0.1f, -4.9f}};
  const Layers reached = frame([&](shadow::Inputs& inputs) { inputs.moved = corner; });
  ASSERT_FALSE(reached.empty());
  EXPECT_LT(reached.size(), all_layers.size());
  EXPECT_EQ(reached.back(), 3) << "the last cascade holds everything";
  EXPECT_EQ(builds, 1);
  const Layers everywhere = frame([](shadow::Inputs& inputs) { inputs.moved = inputs.casters; });
  EXPECT_EQ(everywhere, all_layers);
  EXPECT_EQ(frame([](shadow::Inputs& inputs) { inputs.moved.reset(); }), all_layers) << "unknown";
  EXPECT_EQ(frame(), Layers());
}

TEST_F(ShadowKeep, AMovedCasterHasItsShadowWhereItIs) {
  settle();
  scene.move_from(2, {0.5f, 0, 0});
  frame();
  const std::vector<float> moved = last.mask;
  params.set("maps.keep", false);
  frame();
  EXPECT_EQ(last.mask, moved);
}

TEST_F(ShadowKeep, FramesWithSomeLayersKeptAreTheSame) {
  const std::size_t first = scene.triangles.size();
  scene.add_box({-4.9f, 0, -4.9f}, {-4.7f, 0.5f, -4.7f});
  // Along the ground, to the small box at its far end.
  scene.view = glm::lookAt(glm::vec3(-4.5f, 1, 4.5f), glm::vec3(-4.5f, 0, -4.5f), glm::vec3(0, 1, 0));
  settle();
  std::vector<float> still = last.mask;
  for (int i = 0; i < 3; ++i) {
    for (Triangle& triangle : scene.triangles) triangle.moved_by = glm::vec3(0);
    scene.move_from(first, {0.3f, 0, 0.1f});
    const std::size_t count = frame().size();
    EXPECT_GT(count, 0u);
    EXPECT_LT(count, all_layers.size());
    const std::vector<float> kept = last.mask;
    EXPECT_NE(kept, still) << "its shadow is in the picture";
    TriangleRenderer other(registry_with_counted());
    EXPECT_EQ(other.render(scene, params).mask, kept);
    still = kept;
  }
}

TEST_F(ShadowKeep, WhateverChangesDrawsAllLayers) {
  const std::vector<std::pair<const char*, TriangleRenderer::Adjust>> changes{
      {"a cut", [](shadow::Inputs& inputs) { inputs.view.cut = true; }},
      {"matrices of another frame", [](shadow::Inputs& inputs) { inputs.view.last_view[3][0] += 1; }},
      {"other bounds", [](shadow::Inputs& inputs) { inputs.casters.max.y += 1; }},
  };
  for (const auto& [name, change] : changes) {
    settle();
    EXPECT_EQ(frame(change), all_layers) << name;
    EXPECT_EQ(builds, 1) << name;
    frame();
  }
  settle();
  scene.to_light = sun_direction(61, 40);
  EXPECT_EQ(frame(), all_layers) << "another direction";
  settle();
  scene.view[3][2] -= 0.5f;
  EXPECT_EQ(frame(), all_layers) << "another camera";
  settle();
  params.set("cascades.size", 32);
  EXPECT_EQ(frame(), all_layers) << "another size";
  settle();
  params.set("cascades.split", 0.5f);
  EXPECT_EQ(frame(), Layers({0, 1, 2})) << "the last cascade still covers everything";
  settle();
  renderer.device().shaders.changed("test/caster.vert");
  EXPECT_EQ(frame(), all_layers) << "a shader";
  EXPECT_EQ(builds, 1);
}

TEST_F(ShadowKeep, ARestartEndsTheHistoryAlone) {
  params.set("denoiser", std::string("history_and_filters"));
  params.set("history.reuse", true);
  settle();
  EXPECT_TRUE(renderer.mask().lights[0].history);
  EXPECT_EQ(frame([](shadow::Inputs& inputs) { inputs.view.restart = true; }), Layers());
  EXPECT_FALSE(renderer.mask().lights[0].history);
}

TEST_F(ShadowKeep, ARefusedFrameDrawsAllLayersInTheNext) {
  settle();
  EXPECT_THROW(frame([](shadow::Inputs& inputs) { inputs.normals.width = 1; }), Error);
  EXPECT_EQ(frame(), all_layers);
  settle();
  const auto broken = [](shadow::Inputs& inputs) {
    inputs.moved.reset();
    inputs.draw = [](const shadow::CasterPass& casters, gl::Pass&) {
      if (casters.layer == 2) fail("the callback fails");
    };
  };
  EXPECT_THROW(frame(broken), Error);
  EXPECT_EQ(frame(), all_layers);
}

TEST_F(ShadowKeep, AFrameWithoutTheMapOrTheLightForgetsIt) {
  settle();
  params.set("technique", std::string("none"));
  frame();
  params.set("technique", std::string("pcss"));
  EXPECT_EQ(frame(), all_layers) << "the map was released";
  settle();
  const shadow::Light other{.id = 7, .source = shadow::Sun{scene.to_light}};
  EXPECT_EQ(frame([&](shadow::Inputs& inputs) { inputs.lights = {&other, 1}; }), all_layers) << "another light";
  EXPECT_EQ(frame(), all_layers) << "the first light was left out";
  settle();
  EXPECT_EQ(frame([](shadow::Inputs& inputs) { inputs.view.id = 1; }), all_layers) << "another view has its own maps";
  EXPECT_EQ(frame(), Layers());
  renderer.shadows().forget_view(0);
  EXPECT_EQ(frame(), all_layers);
}

TEST_F(ShadowKeep, MapsOfTheCallerAreNotKept) {
  settle();
  const shadow::LightFrame& own = renderer.mask().lights[0];
  const gl::Texture copy("copy", {.target = GL_TEXTURE_2D_ARRAY,
                                  .format = GL_DEPTH_COMPONENT32F,
                                  .width = own.projection.size(),
                                  .height = own.projection.size(),
                                  .layers = own.projection.layers()});
  const float far = 1;
  gl::glClearTexImage(copy.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
  const shadow::Light light{.source = shadow::Sun{scene.to_light},
                            .maps = shadow::FinishedMaps{{copy.id(), copy.width(), copy.height()}, own.projection}};
  for (int i = 0; i < 2; ++i) {
    drawn.clear();
    builds = 0;
    renderer.render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      inputs.lights = {&light, 1};
    });
    EXPECT_EQ(builds, 1) << "the caller may have drawn it again";
  }
  EXPECT_EQ(frame(), all_layers);
}

TEST_F(ShadowKeep, RenderersDoNotShareMaps) {
  settle();
  shadow::SoftShadows other(renderer.device(), registry_with_counted());
  {
    shadow::Mask mask;
    renderer.render(scene, params, [&](shadow::Inputs& inputs) { mask = other.render(inputs, params); });
    EXPECT_TRUE(mask.lights[0].kept_layers.none());
  }
  EXPECT_EQ(frame([](shadow::Inputs&) {}), Layers()) << "the other one has not touched them";
}

}  // namespace
}  // namespace penumbra::test
