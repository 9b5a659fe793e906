// Shadows of lamps against closed forms, and against themselves where they must not depend on how the maps are made.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/exact_penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr float lamp_height = 2.5f;  // metres above the ground

// A half-plane x < edge at a height above the ground, below a lamp over the origin. `z`: of the receivers.
struct Edge {
  float height, radius;  // of the half-plane; of the lamp
  float x = 0, z = 0;

  // Where the lamp's centre casts the shadow of the edge.
  float shadow_x() const { return x * lamp_height / (lamp_height - height); }
  float penumbra_radius() const { return radius * height / (lamp_height - height); }

  // Of the penumbra radius, how far a point of the ground is from the edge of the umbra's middle: where the plane
  // through the point and the edge cuts the disc that faces the point.
  double place(const glm::dvec3& point) const {
    const glm::dvec2 along(x - point.x, height);
    const glm::dvec2 normal = glm::dvec2(along.y, -along.x) / glm::length(along);
    const glm::dvec3 to_lamp = glm::dvec3(0, lamp_height, 0) - point;
    const double sine = -glm::dot(normal, glm::dvec2(to_lamp)) / glm::length(to_lamp);
    return -glm::length(to_lamp) * sine / std::sqrt(1 - sine * sine) / radius;
  }
};

TriangleScene scene_of(const Edge& edge, int width) {
  // Off the lamp's axis penumbrae are wider.
  const float reach =
      1.25f * edge.penumbra_radius() * (1 + edge.shadow_x() * edge.shadow_x() / (lamp_height * lamp_height));
  const glm::vec3 middle(edge.shadow_x(), 0, edge.z);
  TriangleScene scene;
  scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  scene.add_quad({-4, edge.height, -4}, {0, 0, 8}, {4 + edge.x, 0, 0});
  scene.width = width;
  scene.height = 2;
  scene.view = glm::lookAt(middle + glm::vec3(0, edge.height / 2, 0), middle, glm::vec3(0, 0, -1));
  scene.projection = orthographic(reach, reach * 2 / static_cast<float>(width), 0.01f, edge.height);
  return scene;
}

shadow::Lamp point_lamp(float radius) { return {.position = {0, lamp_height, 0}, .radius = radius}; }

shadow::Lamp spot(float radius, float cone_degrees) {
  shadow::Lamp lamp = point_lamp(radius);
  lamp.axis = {0, -1, 0};
  lamp.cone = glm::radians(cone_degrees);
  return lamp;
}

class Lamps : public TriangleTest {
 protected:
  Shadowed render(const TriangleScene& scene, const shadow::Lamp& lamp, const ParamSet& params) {
    const std::vector<shadow::Light> lights{{.source = lamp}};
    return renderer_->render(scene, params, [&](shadow::Inputs& inputs) { inputs.lights = lights; });
  }

  // The mean over seeds, so that only the bias is left.
  std::vector<double> mean_visibility(const TriangleScene& scene, const shadow::Lamp& lamp, ParamSet params,
                                      int seeds) {
    std::vector<double> mean;
    for (int seed = 0; seed < seeds; ++seed) {
      params.set("sampling.seed", seed);
      const std::vector<float> one = render(scene, lamp, params).visibilities();
      mean.resize(one.size());
      for (size_t i = 0; i < one.size(); ++i) mean[i] += one[i] / seeds;
    }
    return mean;
  }

  // The largest error of a profile.
  double deviation(const Edge& edge, const shadow::Lamp& lamp, const ParamSet& params, int seeds) {
    const TriangleScene scene = scene_of(edge, 64);
    const std::vector<double> mean = mean_visibility(scene, lamp, params, seeds);
    const Shadowed places = render(scene, lamp, params);
    double worst = 0;
    for (size_t i = 0; i < mean.size(); ++i)
      worst = std::max(worst, std::abs(mean[i] - exact_disc(edge.place(glm::dvec3(places.points[i])))));
    return worst;
  }

  // A map of which that many texels cover the penumbra's radius.
  static ParamSet with_texels(ParamSet params, const Edge& edge, double map_tangent, double texels) {
    const double size = 2 * map_tangent * lamp_height * texels / edge.penumbra_radius();
    params.set("lamps.size", static_cast<int>(std::bit_ceil(static_cast<unsigned>(size))));
    return params;
  }
};

const std::vector<Edge>& edges() {
  static const std::vector<Edge> all{{0.5f, 0.05f}, {1, 0.05f},   {1.5f, 0.05f}, {0.5f, 0.1f}, {1, 0.1f},
                                     {1.5f, 0.1f},  {0.5f, 0.2f}, {1, 0.2f},     {1.5f, 0.2f}};
  return all;
}

TEST_F(Lamps, BruteForceMatchesTheExactFunctionUnderASpot) {
  for (const Edge& edge : edges()) {
    ParamSet params = with_texels(renderer_->params(), edge, 0.32, 24);
    params.set("technique", std::string("brute_force"));
    params.set("brute_force.every_texel", true);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 1), 0.02)
        << "lamp of " << edge.radius << " m, caster at " << edge.height << " m";
  }
}

TEST_F(Lamps, PcssAndSlicesMatchTheExactFunctionUnderASpot) {
  for (const Edge& edge : edges()) {
    ParamSet params = with_texels(renderer_->params(), edge, 0.32, 24);
    params.set("pcss.blocker_taps", 64);
    params.set("pcss.filter_taps", 64);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 32), 0.03)
        << "pcss, lamp of " << edge.radius << " m, caster at " << edge.height << " m";
    params.set("technique", std::string("slices"));
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 8), 0.02)
        << "slices, lamp of " << edge.radius << " m, caster at " << edge.height << " m";
  }
}

// A disc that faces the receiver looks longer to the map than it is: in the direction in which the receiver lies from
// the axis, and not across it.
TEST_F(Lamps, PenumbraeAwayFromTheAxisMatchTheExactFunction) {
  for (const Edge& edge :
       {Edge{1, 0.2f, 0.9f, 0}, Edge{1, 0.2f, 0, 1.8f}, Edge{1, 0.2f, 0.7f, 1.2f}, Edge{1, 0.2f, 1.4f, 0.8f}}) {
    ParamSet params = renderer_->params();
    params.set("lamps.size", 1600);
    params.set("technique", std::string("brute_force"));
    params.set("brute_force.every_texel", true);
    EXPECT_LE(deviation(edge, point_lamp(edge.radius), params, 1), 0.02) << "edge at " << edge.x << ", z " << edge.z;
    params.set("technique", std::string("slices"));
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    EXPECT_LE(deviation(edge, point_lamp(edge.radius), params, 8), 0.02) << "edge at " << edge.x << ", z " << edge.z;
  }
}

// A half-plane across a direction, 1 m from a lamp at the origin, whose edge passes through that direction.
struct Screen {
  glm::vec3 towards, edge;  // unit, perpendicular

  glm::vec3 covered() const { return glm::cross(towards, edge); }

  double place(const glm::dvec3& point, double radius) const {
    const glm::dvec3 through(towards);
    glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(edge), point - through));
    if (glm::dot(normal, glm::dvec3(covered())) > 0) normal = -normal;
    const double sine = glm::dot(normal, -point) / glm::length(point);
    return glm::length(point) * sine / std::sqrt(1 - sine * sine) / radius;
  }
};

// A wall 3 m from a lamp at the origin, as seen from between it and the screen.
TriangleScene scene_of(const Screen& screen, int side) {
  TriangleScene scene;
  const glm::vec3 across = screen.covered();
  scene.add_quad(3.0f * screen.towards - 4.0f * (screen.edge + across), 8.0f * screen.edge, 8.0f * across);
  scene.add_quad(screen.towards - 4.0f * screen.edge, 8.0f * screen.edge, 4.0f * across);
  scene.width = scene.height = side;
  scene.view = glm::lookAt(1.2f * screen.towards, 3.0f * screen.towards, screen.edge);
  scene.projection = perspective(0.7f, 1, 0.01f);
  return scene;
}

// Across edges and a corner of the cube, along them and oblique to them.
const std::vector<Screen>& screens() {
  static const float s = std::sqrt(0.5f), c = std::sqrt(1 / 3.0f);
  static const std::vector<Screen> all{{{s, 0, s}, {0, 1, 0}},
                                       {{s, 0, s}, {s, 0, -s}},
                                       {{0, s, -s}, {1, 0, 0}},
                                       {{c, c, c}, {s, -s, 0}},
                                       {{-c, c, -c}, glm::normalize(glm::vec3(1, 0.2f, -0.8f))}};
  return all;
}

int face_of(const glm::vec3& p) {
  const glm::vec3 a = glm::abs(p);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
  return 2 * axis + (p[axis] < 0 ? 1 : 0);
}

// Steps of a picture's error between neighbours that the same face of the cube sees, and between those of two faces.
struct Steps {
  double within = 0, across = 0, worst_error = 0;
  int pairs = 0;  // across
};

Steps steps_of(const Shadowed& shadowed, const Screen& screen, float radius) {
  std::vector<double> error;
  for (size_t i = 0; i < shadowed.points.size(); ++i)
    error.push_back(shadowed.mask[4 * i] - exact_disc(screen.place(glm::dvec3(shadowed.points[i]), radius)));
  Steps steps;
  const auto compare = [&](size_t i, size_t k) {
    const bool same = face_of(shadowed.points[i]) == face_of(shadowed.points[k]);
    double& step = same ? steps.within : steps.across;
    step = std::max(step, std::abs(error[i] - error[k]));
    steps.pairs += same ? 0 : 1;
    steps.worst_error = std::max(steps.worst_error, std::abs(error[i]));
  };
  const auto width = static_cast<size_t>(shadowed.width);
  for (size_t i = 0; i + width < error.size(); ++i) {
    if ((i + 1) % width != 0) compare(i, i + 1);
    compare(i, i + width);
  }
  return steps;
}

TEST_F(Lamps, NoSeamShowsWhereCubeFacesMeet) {
  constexpr float radius = 0.1f;
  for (const char* technique : {"slices", "brute_force"}) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string(technique));
    params.set("brute_force.every_texel", true);
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    params.set("lamps.size", 512);
    for (const char* seam : {"fade", "dither"}) {
      params.set("cascades.seam", std::string(seam));
      int pairs = 0;
      for (const Screen& screen : screens()) {
        const Steps steps = steps_of(render(scene_of(screen, 96), {.radius = radius}, params), screen, radius);
        EXPECT_LE(steps.across, steps.within + 1.0 / 255)
            << technique << ", " << seam << ", screen towards " << screen.towards.x << " " << screen.towards.y << " "
            << screen.towards.z;
        EXPECT_LE(steps.worst_error, 0.03) << technique << ", " << seam;
        pairs += steps.pairs;
      }
      EXPECT_GT(pairs, 300);
    }
  }
}

// In a wide transition two faces see a receiver at depths that differ by up to a fifth: each is read by its own. Below
// the lamp is the first face.
TEST_F(Lamps, EachFaceOfATransitionIsReadAtItsOwnDepth) {
  constexpr float radius = 0.1f;
  ParamSet params = renderer_->params();
  params.set("technique", std::string("brute_force"));
  params.set("brute_force.every_texel", true);
  params.set("lamps.size", 512);
  params.set("cascades.blend", 0.2f);
  const float s = std::sqrt(0.5f);
  const std::vector<Screen> below{{{0, -s, s}, {1, 0, 0}}, {{0, -s, s}, {0, s, s}}, {{s, -s, 0}, {0, 0, 1}}};
  for (const char* seam : {"fade", "dither"}) {
    params.set("cascades.seam", std::string(seam));
    for (const Screen& screen : below) {
      const Steps steps = steps_of(render(scene_of(screen, 96), {.radius = radius}, params), screen, radius);
      EXPECT_LE(steps.worst_error, 0.03) << seam << ", screen towards " << screen.towards.x << " " << screen.towards.y
                                         << " " << screen.towards.z;
    }
  }
}

// A lamp in a closed box lights nothing outside of it, however little its maps reach beyond the cube's edges.
TEST_F(Lamps, NoLightLeaksWhereCubeFacesMeet) {
  for (const float radius : {0.0f, 0.002f, 0.1f}) {
    for (const Screen& screen : screens()) {
      TriangleScene scene = scene_of(screen, 64);
      scene.triangles.resize(2);  // the wall alone
      scene.add_box(glm::vec3(-0.5f), glm::vec3(0.5f));
      for (const char* technique : {"hard", "pcss", "slices"}) {
        ParamSet params = renderer_->params();
        params.set("technique", std::string(technique));
        for (const char* seam : {"fade", "dither"}) {
          params.set("cascades.seam", std::string(seam));
          for (const float visibility : render(scene, {.radius = radius}, params).visibilities())
            ASSERT_LT(visibility, 1e-3f) << technique << ", " << seam << ", lamp of " << radius << " m";
        }
      }
    }
  }
}

// A lamp among casters that lights a wide ground, too: a box that is far from the lamp casts its shadow.
TEST_F(Lamps, CastersFarFromALampCastShadows) {
  TriangleScene scene;
  scene.add_quad({-700, 0, -700}, {0, 0, 1400}, {1400, 0, 0});
  scene.add_quad({-10, 3, -10}, {0, 0, 20}, {20, 0, 0});
  scene.add_quad({10, 610, 10}, {0, 0, 20}, {20, 0, 0});
  scene.width = scene.height = 16;
  scene.view = glm::lookAt(glm::vec3(0, 2, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(8, 8, 0.01f, 4);
  const shadow::Lamp lamp{.position = {0, 600, 0}, .radius = 0.1f};
  for (const char* technique : {"hard", "pcss", "slices"}) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string(technique));
    for (const float visibility : render(scene, lamp, params).visibilities()) ASSERT_EQ(visibility, 0) << technique;
  }
}

// bias.normal_offset moves a receiver along its normal, wherever a face sees it: on the ground, the point that is
// looked up lies higher, so that its ray from the lamp ends further out.
TEST_F(Lamps, TheNormalOffsetIsThatOfTheWorldAwayFromTheAxis) {
  constexpr float offset = 8;
  const Edge edge{1, 0, 1.4f, 0.8f};
  const TriangleScene scene = scene_of(Edge{1, 0.4f, 1.4f, 0.8f}, 64);
  ParamSet params = renderer_->params();
  params.set("technique", std::string("hard"));
  params.set("lamps.size", 256);
  params.set("bias.normal_offset", offset);
  const float texel = 2 * lamp_height / 256 / (1 - 16.0f / 256);
  const Shadowed shadowed = render(scene, point_lamp(0), params);
  int lit = 0, dark = 0;
  for (size_t i = 0; i < shadowed.points.size(); ++i) {
    const glm::vec3& point = shadowed.points[i];
    const float across = glm::length(glm::vec2(point.x, point.z));
    const float raised = offset * texel * across / std::hypot(across, lamp_height);
    const float from_edge = point.x * lamp_height / (lamp_height - raised) - edge.shadow_x();
    if (std::abs(from_edge) < 1.5f * texel) continue;
    ASSERT_EQ(shadowed.mask[4 * i], from_edge > 0 ? 1.0f : 0.0f) << from_edge << " m from the edge";
    ++(from_edge > 0 ? lit : dark);
  }
  EXPECT_GT(lit, 20);
  EXPECT_GT(dark, 20);
}

TEST_F(Lamps, ShadowVolumesAreThoseOfTheCentre) {
  ParamSet params = renderer_->params();
  params.set("technique", std::string("shadow_volume"));
  for (const Screen& screen : screens()) {
    const Shadowed shadowed = render(scene_of(screen, 64), {.radius = 0.1f}, params);
    int lit = 0;
    for (size_t i = 0; i < shadowed.points.size(); ++i) {
      const double place = screen.place(glm::dvec3(shadowed.points[i]), 1.0);
      if (std::abs(place) < 1e-5) continue;
      ASSERT_EQ(shadowed.mask[4 * i], place > 0 ? 1.0f : 0.0f) << "at " << place;
      lit += place > 0 ? 1 : 0;
    }
    EXPECT_GT(lit, 1000);
    EXPECT_LT(lit, 3000);
  }
}

// Every technique that shadows lamps finds the same middle of the penumbra, and both drivers compute the same.
TEST_F(Lamps, TechniquesAndDriversAgree) {
  const Edge edge{1, 0.05f, 0.5f, 0.4f};
  const TriangleScene scene = scene_of(edge, 64);
  for (const shadow::Technique& technique : renderer_->shadows().registry().techniques()) {
    if (technique.suns_only || technique.name == "none") continue;
    for (const shadow::Lamp& lamp : {point_lamp(edge.radius), spot(edge.radius, 40)}) {
      ParamSet params = renderer_->params();
      params.set("technique", technique.name);
      params.set("lamps.size", 512);
      const Shadowed fragment = render(scene, lamp, params);
      params.set("driver", std::string("compute"));
      const Shadowed compute = render(scene, lamp, params);
      for (size_t i = 0; i < fragment.points.size(); ++i) {
        ASSERT_NEAR(fragment.mask[4 * i], compute.mask[4 * i], 2e-3) << technique.name;
        const double place = edge.place(glm::dvec3(fragment.points[i]));
        const float visibility = fragment.mask[4 * i];
        const bool expected = place < -1.0 ? visibility <= 0.6f : place < 1.0 || visibility >= 0.4f;
        ASSERT_TRUE(expected) << technique.name << ": " << visibility << " at " << place;
      }
    }
  }
}

TEST_F(Lamps, SoftnessDependsOnNeitherMapSizeNorNearPlane) {
  const Edge edge{1, 0.1f, 0.4f, 0.3f};
  TriangleScene scene = scene_of(edge, 96);
  // A caster at the lamp's height, so that only lamps.near says where the near plane is.
  scene.add_quad({3, lamp_height - 0.5f, -4}, {0, 1, 0}, {1, 0, 0});
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("slices.azimuths", 32);
  params.set("slices.samples", 32);
  const auto width = [&] {
    const std::vector<double> mean = mean_visibility(scene, point_lamp(edge.radius), params, 4);
    return width_10_90(std::vector<double>(mean.begin(), mean.begin() + scene.width), 1.0);
  };
  params.set("lamps.size", 4096);
  const double fine = width();
  for (const int size : {1024, 2048}) {
    params.set("lamps.size", size);
    EXPECT_NEAR(width(), fine, 0.03 * fine) << size << " texels";
  }
  for (const float near : {0.001f, 0.1f, 0.5f}) {
    params.set("lamps.near", near);
    EXPECT_NEAR(width(), fine, 0.03 * fine) << "near plane at " << near << " m";
  }
}

// Nothing is between the lamp and the ground but a plate so near to the lamp that it counts as a part of it, or not.
TEST_F(Lamps, CastersAreThoseBeyondTheNearPlane) {
  TriangleScene scene;
  scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  scene.width = scene.height = 16;
  scene.view = glm::lookAt(glm::vec3(0, 1, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(1, 1, 0.01f, 2);
  for (const float below : {0.01f, 0.05f}) {
    TriangleScene plated = scene;
    plated.add_quad({-0.2f, lamp_height - below, -0.2f}, {0, 0, 0.4f}, {0.4f, 0, 0});
    for (const char* technique : {"hard", "pcss", "slices"}) {
      ParamSet params = renderer_->params();
      params.set("technique", std::string(technique));
      const Shadowed shadowed = render(plated, point_lamp(0.01f), params);
      for (const float visibility : shadowed.visibilities())
        ASSERT_EQ(visibility, below < 0.02f ? 1.0f : 0.0f) << technique << ", plate " << below << " m below the lamp";
    }
  }
}

// 12 m of ground around the lamp, from above.
TriangleScene wide_ground() {
  TriangleScene scene;
  scene.add_quad({-8, 0, -8}, {0, 0, 16}, {16, 0, 0});
  scene.width = scene.height = 64;
  scene.view = glm::lookAt(glm::vec3(0, 5, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(6, 6, 0.01f, 6);
  return scene;
}

TEST_F(Lamps, ASpotShinesWithinItsConeAlone) {
  const TriangleScene scene = wide_ground();
  for (const float degrees : {5.0f, 30.0f, 60.0f, 65.0f}) {
    const Shadowed shadowed = render(scene, spot(0.05f, degrees), renderer_->params());
    int lit = 0;
    for (size_t i = 0; i < shadowed.points.size(); ++i) {
      const glm::vec3& p = shadowed.points[i];
      const float tangent = glm::length(glm::vec2(p.x, p.z)) / lamp_height / std::tan(glm::radians(degrees));
      if (std::abs(tangent - 1) < 1e-3f) continue;
      ASSERT_EQ(shadowed.mask[4 * i], tangent < 1 ? 1.0f : 0.0f) << degrees;
      lit += tangent < 1 ? 1 : 0;
    }
    EXPECT_GT(lit, 3) << degrees;
  }
}

TEST_F(Lamps, ALampShinesWithinItsRangeAlone) {
  const TriangleScene scene = wide_ground();
  for (const float cone : {0.0f, 60.0f}) {
    shadow::Lamp lamp = cone > 0 ? spot(0.05f, cone) : point_lamp(0.05f);
    lamp.range = 4;
    const Shadowed shadowed = render(scene, lamp, renderer_->params());
    int lit = 0, dark = 0;
    for (size_t i = 0; i < shadowed.points.size(); ++i) {
      const float away = glm::distance(shadowed.points[i], lamp.position);
      if (std::abs(away - lamp.range) < 1e-3f) continue;
      ASSERT_EQ(shadowed.mask[4 * i], away < lamp.range ? 1.0f : 0.0f) << away << " m";
      lit += away < lamp.range ? 1 : 0;
      dark += away > lamp.range ? 1 : 0;
    }
    EXPECT_GT(lit, 100);
    EXPECT_GT(dark, 100);
  }
}

TEST_F(Lamps, AMovedLampDropsItsOwnHistoryAloneAndOneAtRestIsNotDrawnAgain) {
  const Edge edge{1, 0.1f};
  const TriangleScene scene = scene_of(edge, 32);
  ParamSet params = renderer_->params();
  params.set("history.reuse", true);
  std::vector<shadow::Light> lights{{.id = 0, .source = point_lamp(0.1f)}, {.id = 1, .source = spot(0.1f, 30)}};
  int drawn = 0;
  const auto frame = [&] {
    drawn = 0;
    renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.lights = lights;
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      inputs.moved = shadow::Box{glm::vec3(1), glm::vec3(-1)};
      inputs.draw = [&drawn, draw = inputs.draw](const shadow::CasterPass& casters, gl::Pass& pass) {
        ++drawn;
        draw(casters, pass);
      };
    });
  };
  const auto has_history = [&](size_t light) { return renderer_->mask().lights[light].history; };
  frame();
  EXPECT_EQ(drawn, 7);
  frame();
  EXPECT_EQ(drawn, 0);
  EXPECT_TRUE(has_history(0) && has_history(1));
  std::get<shadow::Lamp>(lights[1].source).position.x += 0.1f;
  frame();
  EXPECT_EQ(drawn, 1);
  EXPECT_TRUE(has_history(0));
  EXPECT_FALSE(has_history(1));
  frame();
  EXPECT_EQ(drawn, 0);
  EXPECT_TRUE(has_history(0) && has_history(1));
}

TEST_F(Lamps, BadLampsAndTechniquesForSunsAreRefused) {
  const TriangleScene scene = scene_of({1, 0.1f}, 16);
  const ParamSet params = renderer_->params();
  const auto fault = [&](const shadow::Lamp& lamp) { return message_of([&] { render(scene, lamp, params); }); };
  const float nan = std::nanf("");
  EXPECT_EQ(fault({.position = {nan, 0, 0}}), "soft shadows: light 0 has no position");
  EXPECT_EQ(fault({.position = {1e7f, 0, 0}}), "soft shadows: light 0 is too far from the origin");
  EXPECT_EQ(fault({.radius = -1}), "soft shadows: light 0 has no radius");
  EXPECT_EQ(fault({.radius = nan}), "soft shadows: light 0 has no radius");
  EXPECT_EQ(fault({.range = nan}), "soft shadows: light 0 has a range that is not 0 or more");
  EXPECT_EQ(fault({.axis = {0, 2, 0}, .cone = 0.5f}), "soft shadows: light 0 has an axis that is not of length 1");
  EXPECT_EQ(fault({.axis = {0, 1, 0}}), "soft shadows: light 0 has a cone that is not between 0 and π/2");
  ParamSet for_suns = params;
  for_suns.set("technique", std::string("ssss"));
  EXPECT_EQ(message_of([&] { render(scene, point_lamp(0.1f), for_suns); }),
            "soft shadows: light 0 is a lamp, and technique 'ssss' is for suns alone");
}

// Lamps within a caster, on a receiver, of no size or of a large one: no value but 0 to 1.
TEST_F(Lamps, ExtremeLampsGiveFiniteMasks) {
  const TriangleScene scene = scene_of({1, 0.1f}, 32);
  for (const char* technique : {"pcss", "slices", "brute_force", "vsm", "msm", "hard", "pcf"}) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string(technique));
    params.set("lamps.size", 128);
    for (const shadow::Lamp& lamp :
         {shadow::Lamp{.position = {0, 1, 0}}, shadow::Lamp{.position = {0, 0, 0}},
          shadow::Lamp{.position = {0, 1e-6f, 0}, .radius = 10}, shadow::Lamp{.position = {0, 2, 0}, .radius = 0},
          shadow::Lamp{.position = {9e5f, 9e5f, 0}, .radius = 1e5f},
          shadow::Lamp{.position = {0, 2, 0}, .range = 1e-6f},
          shadow::Lamp{.position = {0, 2, 0}, .axis = {0, -1, 0}, .cone = 1e-4f}}) {
      for (const float visibility : render(scene, lamp, params).visibilities())
        ASSERT_TRUE(visibility >= 0 && visibility <= 1) << technique << ": " << visibility;
    }
  }
}

}  // namespace
}  // namespace penumbra::test
