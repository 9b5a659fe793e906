// History: a surface that appears from behind another one does not use the other's history.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"
#include "lib/packed_texel.glsl"

namespace penumbra::test {
namespace {

constexpr float pixel = 0.1f;  // of the wall, metres

// A screen in front of a wall, at half the wall's distance. A caster out of view shadows all of the screen and no other
// visible surface.
TriangleScene screen_before_wall(float eye_x) {
  TriangleScene scene;
  scene.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  scene.add_quad({-40, -20, -8}, {80, 0, 0}, {0, 40, 0});
  scene.add_quad({-2, 4, 6}, {4, 0, 0}, {0, 4, 0});
  scene.to_light = glm::normalize(glm::vec3(0, 1, 1));
  scene.view = glm::lookAt(glm::vec3(eye_x, 0, 8), glm::vec3(eye_x, 0, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(2 * std::atan(0.3f), 1, 0.1f);
  scene.width = scene.height = 96;
  return scene;
}

class ShadowHistory : public TriangleTest {
 protected:
  // The number of pixels that are neither dark nor lit after some steps of the camera to the side; each step moves
  // the wall by `step` pixels.
  int mixed_pixels(const ParamSet& params, float step) {
    int mixed = 0;
    glm::mat4 last_view(1);
    for (int frame = 0; frame < 8; ++frame) {
      const TriangleScene scene = screen_before_wall(step * pixel * static_cast<float>(frame));
      const Shadowed shadowed = renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
        inputs.view.last_view = last_view;
        inputs.view.last_projection = scene.projection;
      });
      last_view = scene.view;
      mixed = 0;
      for (const float visibility : shadowed.visibilities()) mixed += visibility > 0 && visibility < 1 ? 1 : 0;
    }
    return mixed;
  }
};

TEST_F(ShadowHistory, NothingTrailsBehindAnEdge) {
  ParamSet params = renderer_->params();
  params.set("history.reuse", true);
  for (const char* driver : {"fragment", "compute"}) {
    params.set("driver", std::string(driver));
    for (const float step : {1.0f, 0.5f, 1.37f}) EXPECT_EQ(mixed_pixels(params, step), 0) << driver << ", " << step;
  }
  params.set("history.distance", 100.0f);
  EXPECT_GT(mixed_pixels(params, 1), 20) << "the picture shows no trail at all";
}

// A penumbra over the whole picture. Every texel is read, so it is a smooth function of the position.
TriangleScene wide_penumbra() {
  TriangleScene scene = half_plane_over_ground(64);
  scene.view = glm::lookAt(glm::vec3(0, 2.5f, 0.4f), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = perspective(0.2f, 1, 0.05f);
  return scene;
}

// Draws two frames, each with its own jitter. Returns the largest difference of the blend from the second frame without
// history.
double most_off(TriangleRenderer& renderer, const ParamSet& plain, const shadow::Rect& viewport) {
  ParamSet blended = plain;
  blended.set("history.reuse", true);
  const TriangleScene still = wide_penumbra();
  const std::array jitters{glm::vec2(0.9f, -0.7f) / 64.0f, glm::vec2(-0.8f, 0.6f) / 64.0f};
  std::vector<Shadowed> drawn;
  for (const ParamSet& params : {plain, blended}) {
    for (int frame = 0; frame < 2; ++frame) {
      const glm::vec2 jitter = jitters.at(static_cast<std::size_t>(frame));
      TriangleScene scene = still;
      scene.projection = glm::translate(glm::mat4(1), glm::vec3(jitter, 0)) * still.projection;
      drawn.push_back(renderer.render(scene, params, [&](shadow::Inputs& inputs) {
        inputs.view.projection = inputs.view.last_projection = still.projection;
        inputs.view.last_view = inputs.view.view;
        inputs.view.jitter = jitter;
        inputs.view.cut = frame == 0;
        inputs.viewport = viewport;
      }));
    }
  }
  double most = 0;
  for (int y = viewport.y + 1; y < viewport.y + viewport.height - 1; ++y) {
    for (int x = viewport.x + 1; x < viewport.x + viewport.width - 1; ++x) {
      most = std::max<double>(most, std::abs(drawn[3].visibility(x, y) - drawn[1].visibility(x, y)));
    }
  }
  return most;
}

TEST_F(ShadowHistory, JitterMovesNothing) {
  ParamSet params = renderer_->params();
  params.set("technique", std::string("brute_force"));
  params.set("brute_force.every_texel", true);
  params.set("sun.angle", 8.0f);
  params.set("cascades.count", 1);
  params.set("cascades.size", 256);
  params.set("history.alpha", 0.05f);
  EXPECT_LT(most_off(*renderer_, params, {0, 0, 64, 64}), 0.004);
}

// Ground and caster move together by three pixels a frame, so the shadow does not move on the ground. Returns the
// largest error of the blend if the motion vectors say that everything moved by so many pixels.
double off_by_motion(TriangleRenderer& renderer, float pixels) {
  constexpr int side = 64;
  constexpr float half = 0.3f;
  const gl::Texture motion("motion", {.format = GL_RG32F, .width = side, .height = side});
  const std::vector<glm::vec2> vectors(std::size_t{side} * side, glm::vec2(pixels * 2 / side, 0));
  motion.upload(GL_RG, GL_FLOAT, std::as_bytes(std::span(vectors)));
  ParamSet plain = renderer.params();
  plain.set("sun.angle", 8.0f);
  plain.set("pcss.blocker_taps", 64);
  plain.set("pcss.filter_taps", 64);
  plain.set("sampling.noise", std::string("none"));
  plain.set("movement.map", std::string("none"));
  ParamSet blended = plain;
  blended.set("history.reuse", true);
  std::vector<Shadowed> drawn;
  for (const ParamSet& params : {plain, blended}) {
    for (int frame = 0; frame < 2; ++frame) {
      TriangleScene scene = wide_penumbra();
      scene.projection = orthographic(half, half, 0.05f, 5);
      const glm::vec3 way(3 * 2 * half / side * static_cast<float>(frame), 0, 0);
      for (Triangle& triangle : scene.triangles) triangle = {triangle.a + way, triangle.b + way, triangle.c + way};
      drawn.push_back(renderer.render(scene, params, [&](shadow::Inputs& inputs) {
        inputs.motion = {motion.id(), side, side};
        inputs.moved.reset();
        inputs.view.last_view = inputs.view.view;
        inputs.view.last_projection = inputs.view.projection;
        inputs.view.cut = frame == 0;
      }));
    }
  }
  double most = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 4; x < side; ++x) {
      most = std::max<double>(most, std::abs(drawn[3].visibility(x, y) - drawn[1].visibility(x, y)));
    }
  }
  return most;
}

TEST_F(ShadowHistory, FollowsReceiversByTheirMotion) {
  EXPECT_LT(off_by_motion(*renderer_, 3), 0.01);
  EXPECT_GT(off_by_motion(*renderer_, 0), 0.03) << "the ground did move";
  EXPECT_GT(off_by_motion(*renderer_, -3), 0.06);
}

// The camera moves by three pixels after four frames, so that three columns of the picture have a history of one frame
// less than the others, then back by half a pixel. Then the half-plane has moved, of which the history is not told: how
// much of the change a pixel shows is the weight of the present frame.
TEST_F(ShadowHistory, AMeanCountsTheFramesOfTheYoungestPixelThatItReads) {
  constexpr int side = 64;
  constexpr float half = 0.3f, step = 2 * half / side;
  ParamSet plain = renderer_->params();
  plain.set("sun.angle", 8.0f);
  plain.set("pcss.blocker_taps", 64);
  plain.set("pcss.filter_taps", 64);
  plain.set("sampling.noise", std::string("none"));
  plain.set("movement.map", std::string("none"));
  ParamSet blended = plain;
  blended.set("history.reuse", true);
  blended.set("history.mean", true);
  blended.set("history.alpha", 0.05f);
  std::optional<glm::mat4> last_view;
  const auto draw = [&](const ParamSet& params, float pixels, bool moved, bool cut) {
    TriangleScene scene = wide_penumbra();
    scene.projection = orthographic(half, half, 0.05f, 5);
    scene.view = glm::translate(glm::mat4(1), glm::vec3(-pixels * step, 0, 0)) * scene.view;
    if (moved) {
      for (std::size_t i = 2; i < scene.triangles.size(); ++i) {
        for (glm::vec3* corner : {&scene.triangles[i].a, &scene.triangles[i].b, &scene.triangles[i].c})
          corner->x += 0.1f;
      }
    }
    Shadowed shadowed = renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.moved = shadow::Box{glm::vec3(1), glm::vec3(-1)};
      inputs.view.last_view = last_view.value_or(inputs.view.view);
      inputs.view.last_projection = inputs.view.projection;
      inputs.view.cut = cut;
    });
    last_view = scene.view;
    return shadowed;
  };
  const Shadowed before = draw(plain, 2.5f, false, true), after = draw(plain, 2.5f, true, true);
  for (int frame = 0; frame < 4; ++frame) draw(blended, 0, false, frame == 0);
  draw(blended, 3, false, false);
  const Shadowed blend = draw(blended, 2.5f, true, false);
  constexpr int first_new = side - 3;  // the first column that has two frames, or reads one that has
  for (int x = 20; x < side; ++x) {    // where the half-plane changes much
    double weight = 0;
    for (int y = 8; y < side - 8; ++y) {
      const double change = after.visibility(x, y) - before.visibility(x, y);
      weight += (blend.visibility(x, y) - before.visibility(x, y)) / change / (side - 16);
    }
    EXPECT_NEAR(weight, x < first_new ? 1.0 / 6 : 1.0 / 2, 0.08) << "column " << x;
  }
}

// The maps of the last frame, passed in as maps that an engine has drawn.
shadow::FinishedMaps finished(const shadow::LightFrame& light, const gl::Texture& copy) {
  gl::glCopyImageSubData(light.depth, GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, copy.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0,
                         copy.width(), copy.height(), 1);
  return {{copy.id(), copy.width(), copy.height()}, light.projection};
}

TEST_F(ShadowHistory, WithoutCastersToDrawItIsKeptOnlyWhereNothingMoved) {
  ParamSet params = renderer_->params();
  params.set("history.reuse", true);
  params.set("cascades.count", 1);
  params.set("cascades.size", 256);
  const TriangleScene scene = wide_penumbra();
  renderer_->render(scene, params);
  const gl::Texture copy("copy",
                         {.target = GL_TEXTURE_2D_ARRAY, .format = GL_DEPTH_COMPONENT32F, .width = 256, .height = 256});
  const shadow::Light light{.source = shadow::Sun{scene.to_light}, .maps = finished(renderer_->mask().lights[0], copy)};
  const shadow::Box nothing{glm::vec3(1), glm::vec3(-1)};
  const shadow::Box all{glm::vec3(-20), glm::vec3(20)};
  const auto refusal = [&](const std::optional<shadow::Box>& moved) {
    renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.lights = {&light, 1};
      inputs.draw = {};
      inputs.moved = moved;
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
    });
    const std::vector<unsigned> notes = gl::read_uints(*renderer_->mask().lights[0].notes, 1);
    return glsl::notes_refusal(notes[notes.size() / 2]);
  };
  refusal(nothing);
  EXPECT_EQ(refusal(nothing), HISTORY_KEPT);
  EXPECT_EQ(refusal(std::nullopt), HISTORY_NONE) << "anything may have moved";
  EXPECT_EQ(refusal(nothing), HISTORY_KEPT);
  EXPECT_EQ(refusal(all), HISTORY_NONE);
  params.set("movement.map", std::string("none"));
  refusal(all);
  EXPECT_EQ(refusal(all), HISTORY_KEPT) << "nobody asked";
}

// A wall that turns about the middle of the picture, where its surface stays in place.
TEST_F(ShadowHistory, ASurfaceThatIsTurnedIsAnotherOne) {
  ParamSet params = renderer_->params();
  params.set("history.reuse", true);
  const auto refusal_after = [&](float turn) {
    unsigned found = 0;
    for (const float angle : {0.0f, glm::radians(turn)}) {
      const glm::vec3 along = 2.0f * glm::vec3(std::cos(angle), 0, std::sin(angle));
      TriangleScene scene;
      scene.add_quad(-0.5f * along - glm::vec3(0, 1, 0), along, {0, 2, 0});
      scene.to_light = glm::normalize(glm::vec3(0, 0.2f, 1));
      scene.view = glm::lookAt(glm::vec3(0, 0, 4), glm::vec3(0), glm::vec3(0, 1, 0));
      scene.projection = orthographic(0.5f, 0.5f, 0.1f, 8);
      scene.width = scene.height = 33;
      renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
        inputs.moved = shadow::Box{glm::vec3(1), glm::vec3(-1)};  // no caster
        inputs.view.last_view = inputs.view.view;
        inputs.view.last_projection = inputs.view.projection;
        inputs.view.cut = angle == 0 && found == 0;
      });
      const std::vector<unsigned> notes = gl::read_uints(*renderer_->mask().lights[0].notes, 1);
      found = glsl::notes_refusal(notes[notes.size() / 2]);
    }
    return found;
  };
  EXPECT_EQ(refusal_after(60), HISTORY_OTHER_SURFACE);
  EXPECT_EQ(refusal_after(1), HISTORY_KEPT);
}

// Maps that are fitted to what the view shows turn about the light with it: normals are kept in axes that do not.
TEST_F(ShadowHistory, ASurfaceIsTheSameWhenMapsTurn) {
  ParamSet params = renderer_->params();
  params.set("history.reuse", true);
  params.set("cascades.fit", std::string("visible"));
  params.set("cascades.size", 256);
  params.set("history.turn", 2.0f);  // degrees
  TriangleScene scene = box_on_ground(48);
  scene.triangles.resize(2);
  scene.to_light = sun_direction(30, 20);
  scene.receivers = scene.casters = shadow::Box{{-5, 0, -5}, {5, 1, 5}};
  std::optional<glm::mat4> last_view;
  double least = 10, most = -10;
  for (int frame = 0; frame < 6; ++frame) {
    const float yaw = 0.12f * static_cast<float>(frame);
    scene.view = glm::lookAt(glm::vec3(0, 3, 0), glm::vec3(std::sin(yaw), 2, -2 * std::cos(yaw)), glm::vec3(0, 1, 0));
    scene.projection = perspective(0.5f, 1, 0.1f);
    const Shadowed shadowed = renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.moved = shadow::Box{glm::vec3(1), glm::vec3(-1)};  // no caster
      inputs.view.last_view = last_view.value_or(inputs.view.view);
      inputs.view.last_projection = inputs.view.projection;
      inputs.view.cut = !last_view;
    });
    const double turn = renderer_->mask().lights[0].projection.cascades().turn;
    least = std::min(least, turn);
    most = std::max(most, turn);
    const std::vector<unsigned> notes = gl::read_uints(*renderer_->mask().lights[0].notes, 1);
    int other = 0, kept = 0;
    for (std::size_t i = 0; i < notes.size(); ++i) {
      if (shadowed.depth[i] == shadowed.sky_depth) continue;
      other += glsl::notes_refusal(notes[i]) == HISTORY_OTHER_SURFACE ? 1 : 0;
      kept += glsl::notes_refusal(notes[i]) == HISTORY_KEPT ? 1 : 0;
    }
    EXPECT_EQ(other, 0) << frame;
    if (last_view) {
      EXPECT_GT(kept, 500) << frame;
    }
    last_view = scene.view;
  }
  EXPECT_GT(most - least, glm::radians(3.0)) << "the maps did not turn";
}

TEST_F(ShadowHistory, ItsMemoryIsGivenBack) {
  ParamSet params = renderer_->params();
  const TriangleScene scene = wide_penumbra();
  const auto bytes = [&] {
    renderer_->render(scene, params);
    return renderer_->device().target_bytes();
  };
  const std::size_t without = bytes();
  params.set("history.reuse", true);
  params.set("filter.penumbra", std::string("median"));
  params.set("filter.visibility", std::string("bilateral_separable"));
  EXPECT_GT(bytes(), without);
  for (const char* name : {"history.reuse", "filter.penumbra", "filter.visibility"}) params.reset(name);
  EXPECT_EQ(bytes(), without);
}

}  // namespace
}  // namespace penumbra::test
