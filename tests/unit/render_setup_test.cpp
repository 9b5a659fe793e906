// The camera, sun and ground that are chosen where the user requests none.
#include "render/setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"

namespace penumbra::test {
namespace {

scene::Primitive box(const glm::vec3& low, const glm::vec3& high) {
  scene::Primitive box;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) {
      const auto first = static_cast<std::uint32_t>(box.positions.size());
      for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        glm::vec3 corner;
        corner[axis] = far ? 1.0f : 0.0f;
        corner[(axis + 1) % 3] = at.x;
        corner[(axis + 2) % 3] = at.y;
        box.positions.push_back(glm::mix(low, high, corner));
        glm::vec3 normal(0);
        normal[axis] = far ? 1.0f : -1.0f;
        box.normals.push_back(normal);
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) box.indices.push_back(first + i);
    }
  }
  return box;
}

scene::Scene scene_of(std::vector<scene::Primitive> primitives) {
  scene::Scene scene;
  scene.meshes.push_back({.name = "mesh", .primitives = std::move(primitives)});
  scene.nodes.push_back({.name = "node", .mesh = 0});
  scene.roots = {0};
  return scene;
}

render::Setup setup_of(const scene::Scene& scene, const render::SetupRequest& request = {}) {
  return render::choose_setup(scene, scene::rest_pose(scene), request);
}

TEST(Setup, FramesScenesOfEverySizeAndShape) {
  for (const float size : {0.07f, 1.0f, 2000.0f}) {
    for (const glm::vec3 shape : {glm::vec3(1, 1, 1), glm::vec3(1, 0.01f, 1), glm::vec3(0.1f, 3, 0.1f)}) {
      for (const float aspect : {16.0f / 9.0f, 0.5f}) {
        const glm::vec3 offset(3 * size, -size, 0);
        const scene::Scene scene = scene_of({box(offset - shape * size, offset + shape * size)});
        const render::Camera camera = setup_of(scene, {.aspect = aspect}).camera;
        const glm::mat4 to_clip = render::projection_of(camera, aspect) * camera.view;
        float widest = 0;
        glm::vec2 low(1), high(-1);
        for (const glm::vec3& corner : scene.meshes[0].primitives[0].positions) {
          const glm::vec4 clip = to_clip * glm::vec4(corner, 1);
          EXPECT_GT(clip.w, camera.near);
          const glm::vec2 at(clip.x / clip.w, clip.y / clip.w);
          widest = std::max({widest, std::abs(at.x), std::abs(at.y)});
          low = glm::min(low, at);
          high = glm::max(high, at);
        }
        EXPECT_NEAR(low.x, -high.x, 2e-2f) << "in the middle";
        EXPECT_NEAR(low.y, -high.y, 2e-2f);
        EXPECT_NEAR(widest, 0.9f, 2e-3f) << "5 % of the picture on each side";
      }
    }
  }
}

// Two columns, on an island and a sea whose sides are these times as long as the columns' bounds. A node each.
scene::Scene island(float land, float sea, float height = 0) {
  scene::Scene scene;
  for (const scene::Primitive& primitive : {box({-1, 0, -1}, {-0.5f, 2, -0.5f}), box({0.5f, 0, 0.5f}, {1, 2, 1}),
                                            box({-land, height - 0.1f, -land}, {land, height, land}),
                                            box({-sea, height - 0.2f, -sea}, {sea, height - 0.1f, sea})}) {
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back({.name = "node", .mesh = static_cast<int>(scene.meshes.size())});
    scene.meshes.push_back({.name = "mesh", .primitives = {primitive}});
  }
  return scene;
}

// The height of a column, as a share of the picture's.
float column_in(const render::Camera& camera) {
  const glm::mat4 to_clip = render::projection_of(camera, 1) * camera.view;
  const glm::vec4 low = to_clip * glm::vec4(1, 0, 1, 1), high = to_clip * glm::vec4(1, 2, 1, 1);
  return (high.y / high.w - low.y / low.w) * 0.5f;
}

// Whether the picture shows all of a box.
bool shows(const render::Camera& camera, const glm::vec3& low, const glm::vec3& high) {
  const glm::mat4 to_clip = render::projection_of(camera, 1) * camera.view;
  for (const glm::vec3& corner : box(low, high).positions) {
    const glm::vec4 clip = to_clip * glm::vec4(corner, 1);
    if (clip.w <= camera.near || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) return false;
  }
  return true;
}

TEST(Setup, FramesWhatStandsOnAMuchWiderGroundWithRoomForItsShadows) {
  const auto framed = [](const scene::Scene& scene) { return setup_of(scene, {.aspect = 1}).camera; };
  const render::Camera sea = framed(island(20, 500));
  EXPECT_TRUE(shows(sea, {-2, 0, -2}, {2, 2, 2})) << "half of the columns' height around them";
  EXPECT_GT(column_in(sea), 0.25f);
  EXPECT_FLOAT_EQ(column_in(framed(island(20, 30))), column_in(sea)) << "a sea that is hardly wider than the land";
  EXPECT_TRUE(shows(framed(island(3, 3.1f)), {-3.1f, -0.2f, -3.1f}, {3.1f, 2, 3.1f})) << "nothing is much wider";
  EXPECT_TRUE(shows(framed(island(20, 500, 3)), {-500, 0, -500}, {500, 3, 500})) << "a roof casts shadows";
}

TEST(Setup, WhatIsTinyOnAGroundIsNotFramedByItself) {
  for (const float size : {0.0f, 1e-3f}) {
    SCOPED_TRACE(size);
    scene::Scene scene = island(20, 30);
    scene.roots = {0, 3};
    for (glm::vec3& corner : scene.meshes[0].primitives[0].positions) corner *= size;
    EXPECT_TRUE(shows(setup_of(scene, {.aspect = 1}).camera, {-30, -0.2f, -30}, {30, 0, 30}));
  }
}

TEST(Setup, ASkyIsNoGroundAndStandsOnNone) {
  // A dome, and a flat shell under the sea such as that of clouds in a lake.
  for (const scene::Primitive& shell :
       {box({-600, -600, -600}, {600, 600, 600}), box({-600, -1, -600}, {600, -0.9f, 600})}) {
    scene::Scene scene = island(20, 500);
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back({.name = "sky", .mesh = static_cast<int>(scene.meshes.size()), .sky = true});
    scene.meshes.push_back({.name = "mesh", .primitives = {shell}});
    EXPECT_GT(column_in(setup_of(scene, {.aspect = 1}).camera), 0.25f) << "as without it";
  }
  scene::Scene scene = scene_of({box({-1, 0, -1}, {1, 2, 1})});
  scene.roots.push_back(1);
  scene.nodes.push_back({.name = "sky", .mesh = 1, .sky = true});
  scene.meshes.push_back({.name = "mesh", .primitives = {box({-9, -0.1f, -9}, {9, 0, 9})}});
  EXPECT_TRUE(shows(setup_of(scene, {.aspect = 1}).camera, {-9, -0.1f, -9}, {9, 2, 9})) << "a sky of any shape";
}

TEST(Setup, AWideGroundIsNotClipped) {
  const scene::Scene scene = island(20, 500);
  const render::Camera camera = setup_of(scene).camera;
  EXPECT_LT(camera.near, render::position_of(camera).y) << "the ground below the eye";
}

TEST(Setup, GroundComesUnderWhatStandsFree) {
  const scene::Primitive house = box({-1, 0, -1}, {1, 2, 1});
  EXPECT_TRUE(setup_of(scene_of({house})).ground);
  EXPECT_FALSE(setup_of(scene_of({house, box({-9, -0.1f, -9}, {9, 0, 9})})).ground);
  EXPECT_TRUE(setup_of(scene_of({house, box({-1.05f, -0.1f, -1.05f}, {1.05f, 0, 1.05f})})).ground);
  EXPECT_FALSE(setup_of(scene_of({house}), {.ground = render::GroundChoice::off}).ground);
  EXPECT_TRUE(setup_of(scene_of({box({-9, -0.1f, -9}, {9, 0, 9})}), {.ground = render::GroundChoice::on}).ground);
}

TEST(Setup, GroundAroundASceneHasTheColourOfItsFloorWhateverStandsThere) {
  const glm::vec3 brown(0.3f, 0.2f, 0.1f);
  for (const float height : {0.05f, 3.0f}) {
    scene::Scene scene =
        scene_of({box({-9, -0.1f, -9}, {9, 0, 9}), box({4, 0, 4}, {5, 3, 5}), box({-1, 0, -1}, {1, height, 1})});
    scene.materials = {{.base_color = glm::vec4(brown, 1)}, {.base_color = {1, 0, 0, 1}}};
    for (const int i : {0, 1, 2}) scene.meshes[0].primitives[static_cast<std::size_t>(i)].material = std::min(i, 1);
    EXPECT_EQ(setup_of(scene).ground_color, brown) << height;
    scene.materials[0].base_color_texture.texture = 0;
    EXPECT_EQ(setup_of(scene).ground_color, glm::vec3(render::ground_albedo)) << "a texture's colour is not known";
  }
  EXPECT_EQ(setup_of(scene_of({box({-1, 0, -1}, {1, 2, 1})})).ground_color, glm::vec3(render::ground_albedo))
      << "that of the ground that is added";
}

TEST(Setup, AddedGroundLiesUnderTheScene) {
  scene::Scene scene = scene_of({box({-1, 0.5f, -1}, {1, 2, 1})});
  const scene::Bounds before = scene::bounds_of(scene, scene::rest_pose(scene));
  render::add_ground(scene, before);
  const scene::Bounds after = scene::bounds_of(scene, scene::rest_pose(scene));
  EXPECT_LT(after.min.y, before.min.y);
  EXPECT_NEAR(after.min.y, before.min.y, 1e-3f);
  EXPECT_GT(after.extent().x, 3 * before.extent().x);
}

TEST(Setup, TakesTheFilesSun) {
  scene::Scene scene = scene_of({box({-1, 0, -1}, {1, 2, 1})});
  scene.lights = {{.kind = scene::LightKind::point},
                  {.kind = scene::LightKind::directional, .color = {1, 0.5f, 0.25f}, .intensity = 8}};
  for (const int light : {0, 1}) {
    scene.nodes.push_back({.name = "light", .light = light});
    scene.nodes.back().matrix = glm::rotate(glm::mat4(1), -1.5707963f, glm::vec3(1, 0, 0));
    scene.roots.push_back(light + 1);
  }
  const render::SunLight sun = setup_of(scene).sun;
  EXPECT_NEAR(sun.to_light.y, 1, 1e-6f);
  EXPECT_FLOAT_EQ(sun.illuminance.r, 8);
  EXPECT_FLOAT_EQ(sun.illuminance.b, 2);
}

TEST(Setup, FindsCamerasByNameAndIndex) {
  scene::Scene scene = scene_of({box({-1, 0, -1}, {1, 2, 1})});
  scene.cameras = {{.name = "front", .fov_y = 0.5f}, {.name = "above", .fov_y = 0.9f}};
  for (const int camera : {0, 1}) {
    scene.nodes.push_back({.name = "camera", .camera = camera});
    scene.nodes.back().matrix = glm::scale(glm::translate(glm::mat4(1), glm::vec3(0, 0, 5)), glm::vec3(2));
    scene.roots.push_back(camera + 1);
  }
  EXPECT_FLOAT_EQ(setup_of(scene).camera.fov_y, 0.5f);
  EXPECT_FLOAT_EQ(setup_of(scene, {.camera = "above"}).camera.fov_y, 0.9f);
  EXPECT_FLOAT_EQ(setup_of(scene, {.camera = "1"}).camera.fov_y, 0.9f);
  // A node's scale does not affect the view matrix.
  EXPECT_NEAR(glm::determinant(glm::mat3(setup_of(scene).camera.view)), 1, 1e-5f);
  EXPECT_NEAR(render::position_of(setup_of(scene).camera).z, 5, 1e-5f);
  try {
    setup_of(scene, {.camera = "abvoe"});
    FAIL() << "no Error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("above"), std::string::npos) << error.what();
  }
}

// By the text that the viewer writes for each.
TEST(Setup, AnIndexIsFoundWhateverNamesThereAre) {
  const std::vector<std::string> names{"1", "2", "lamp", "3", "lamp"};
  for (const std::vector<std::string>& all : {names, {"#2", "2", "x"}, {"0", "1"}}) {
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_EQ(render::index_of_text(all, render::text_of_index(all, i)), i) << render::text_of_index(all, i);
  }
  EXPECT_EQ(render::text_of_index(names, 0), "0");
  EXPECT_EQ(render::text_of_index(names, 2), "#2");
  EXPECT_EQ(render::index_of_text(names, "2"), 1u) << "names go first";
  EXPECT_EQ(render::index_of_text(names, "lamp"), 2u) << "the first";
  for (const char* text : {"", "#", "#5", "5", "-1", "1x", "#1x"})
    EXPECT_FALSE(render::index_of_text(names, text)) << text;
}

// A camera of the file at `eye`, which looks away from `back`.
void add_camera(scene::Scene& scene, const glm::vec3& eye, const glm::vec3& back, scene::Camera camera) {
  scene.nodes.push_back({.name = "camera", .camera = static_cast<int>(scene.cameras.size())});
  scene.nodes.back().matrix = glm::inverse(glm::lookAt(eye, eye - back, glm::vec3(0, 1, 0)));
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
  scene.cameras.push_back(std::move(camera));
}

TEST(Setup, TakesTheFirstOfTheFilesCamerasThatSeesTheScene) {
  const scene::Scene house = scene_of({box({-1, 0, -1}, {1, 2, 1})});
  const scene::Camera lens{.name = "x", .fov_y = 0.5f, .near = 0.1f};
  const scene::Camera flat{
      .name = "x", .orthographic = true, .half_width = 2, .half_height = 2, .near = 0.1f, .far = 9};
  const scene::Camera peephole{
      .name = "x", .orthographic = true, .half_width = 0.2f, .half_height = 0.2f, .near = 0.1f, .far = 0.9f};
  struct Case {
    const char* what;
    glm::vec3 eye, back;
    scene::Camera camera;
    bool taken;
  };
  for (const Case& test : {
           Case{"before it", {0, 1, 6}, {0, 0, 1}, lens, true},
           Case{"with its back to it", {0, 1, 6}, {0, 0, -1}, lens, false},
           Case{"past it", {0, 1, 6}, {-1, 0, 0}, lens, false},
           Case{"a corner of it", {2, 1, 6}, {0.1f, 0, 1}, lens, true},
           Case{"within it", {0, 1, 0.9f}, {0, 0, -1}, lens, true},
           Case{"close to its wall", {0, 1, 1.2f}, {0, 0, 1}, lens, true},
           Case{"a speck", {0, 1, 90}, {0, 0, 1}, lens, false},
           Case{"orthographic, before it", {0, 1, 6}, {0, 0, 1}, flat, true},
           Case{"orthographic, beside it", {5, 1, 6}, {0, 0, 1}, flat, false},
           Case{"orthographic, with its back to it", {0, 1, 6}, {0, 0, -1}, flat, false},
           Case{"orthographic, beyond its far plane", {0, 1, 11}, {0, 0, 1}, flat, false},
           Case{"orthographic, all of what it sees within it", {0, 1, 0.4f}, {0, 0, 1}, peephole, true},
       }) {
    scene::Scene scene = house;
    add_camera(scene, test.eye, test.back, test.camera);
    const render::Setup setup = setup_of(scene);
    EXPECT_EQ(setup.camera_node.has_value(), test.taken) << test.what;
    EXPECT_TRUE(setup_of(scene, {.camera = "x"}).camera_node.has_value()) << test.what << ": asked for";
  }
  scene::Scene scene = house;
  add_camera(scene, {0, 1, 6}, {0, 0, -1}, lens);
  add_camera(scene, {0, 1, 7}, {0, 0, 1}, lens);
  EXPECT_NEAR(render::position_of(setup_of(scene).camera).z, 7, 1e-5f);
}

// A long wall that runs diagonally past the picture's corner: its ends are out of sight on sides that together would
// span the picture.
TEST(Setup, ACameraDoesNotSeeWhatPassesItsPictureDiagonally) {
  const scene::Camera flat{
      .name = "x", .orthographic = true, .half_width = 2, .half_height = 2, .near = 0.1f, .far = 90};
  const scene::Scene wall = scene_of({box({-20, -0.1f, -0.1f}, {20, 0.1f, 0.1f})});
  for (const bool seen : {true, false}) {
    scene::Scene scene = wall;
    const glm::vec3 back(0, 0, 1);
    add_camera(scene, {}, back, flat);
    const glm::mat4 turned = glm::rotate(glm::mat4(1), 0.7853982f, back);
    scene.nodes.back().matrix = glm::translate(turned, seen ? glm::vec3(0, 0, 40) : glm::vec3(2.5f, 2.5f, 40));
    EXPECT_EQ(setup_of(scene, {.aspect = 1}).camera_node.has_value(), seen);
  }
}

TEST(Setup, CameraAndSunFollowTheirNodes) {
  scene::Scene scene = scene_of({box({-1, 0, -1}, {1, 2, 1})});
  add_camera(scene, {0, 1, 6}, {0, 0, 1}, {.name = "x", .fov_y = 0.5f});
  scene.lights = {{.kind = scene::LightKind::directional, .intensity = 8}};
  scene.nodes.push_back({.name = "light", .light = 0});
  scene.roots.push_back(2);
  render::Setup setup = setup_of(scene);
  scene::Pose later = scene::rest_pose(scene);
  later.world[1] = glm::translate(glm::mat4(1), glm::vec3(3, 1, 6));
  later.world[2] = glm::rotate(glm::mat4(1), -1.5707963f, glm::vec3(1, 0, 0));
  render::follow(setup, later);
  EXPECT_NEAR(render::position_of(setup.camera).x, 3, 1e-6f);
  EXPECT_FLOAT_EQ(setup.camera.fov_y, 0.5f);
  EXPECT_NEAR(setup.sun.to_light.y, 1, 1e-6f);
  later.world[2] = glm::mat4(0);  // a singular matrix gives no direction: the last one is kept
  render::follow(setup, later);
  EXPECT_NEAR(setup.sun.to_light.y, 1, 1e-6f);
}

TEST(Setup, ACameraFarFromTheOriginLooksWhereItDoesNearIt) {
  scene::Scene scene = scene_of({box({-1, 0, -1}, {1, 2, 1})});
  add_camera(scene, {0, 1, 6}, {0, 0, 1}, {.name = "x", .fov_y = 0.5f});
  render::Setup setup = setup_of(scene);
  const glm::mat4 turn = glm::rotate(glm::mat4(1), 1.1f, glm::normalize(glm::vec3(0.3f, 1, -0.2f)));
  const auto seen_from = [&](const glm::vec3& place) {
    scene::Pose pose = scene::rest_pose(scene);
    pose.world[1] = glm::translate(glm::mat4(1), place) * turn;
    render::follow(setup, pose);
    return glm::mat3(setup.camera.view);
  };
  const glm::mat3 near = seen_from(glm::vec3(0));
  for (const float metres : {6e3f, 6e4f, 7.8e6f, 7.8e7f})
    EXPECT_EQ(seen_from(metres * glm::vec3(1, 0.67f, 1.3f)), near) << metres << " m";
}

// Where the node's matrix gives no direction upwards, it is the world's, or for a camera that looks down its +Z.
TEST(Setup, ACameraIsUprightWhereItsNodeIsFlat) {
  scene::Scene scene = scene_of({box({-1, 0, -1}, {1, 2, 1})});
  scene.cameras = {{.name = "x"}};
  scene.nodes.push_back({.name = "camera", .camera = 0});
  scene.roots.push_back(1);
  for (const auto& [back, expected] : {std::pair(glm::vec3(0, 0, 1), glm::vec3(0, 1, 0)),
                                       {glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)},
                                       {glm::vec3(0.6f, 0.8f, 0), glm::vec3(-0.8f, 0.6f, 0)}}) {
    const glm::vec4 none(0);
    scene.nodes[1].matrix = glm::mat4(none, none, glm::vec4(2.0f * back, 0), glm::vec4(6.0f * back, 1));
    const glm::mat4 turn = glm::transpose(setup_of(scene, {.camera = "x"}).camera.view);
    EXPECT_LT(glm::distance(glm::vec3(turn[1]), expected), 1e-6f) << back.x << ' ' << back.y;
    EXPECT_LT(glm::distance(glm::vec3(turn[2]), back), 1e-6f) << back.x << ' ' << back.y;
  }
}

TEST(Setup, TheNearPlaneIsHalfwayToTheScene) {
  scene::Bounds bounds;
  bounds.add({-1, 0, -1});
  bounds.add({1, 2, 1});
  EXPECT_FLOAT_EQ(render::near_plane_for(bounds, {0, 9, 4}), 0.5f * std::sqrt(49.0f + 9.0f));
  EXPECT_FLOAT_EQ(render::near_plane_for(bounds, {0, 0.5f, 4}), 0.25f) << "there may be a ground plane below the eye";
  EXPECT_FLOAT_EQ(render::near_plane_for(bounds, {0, 1, 0}), 1e-3f * std::sqrt(3.0f)) << "within it";
}

TEST(Setup, EmptyScenesHaveACameraToo) {
  const render::Setup setup = setup_of(scene::Scene{});
  EXPECT_TRUE(std::isfinite(render::position_of(setup.camera).x));
  EXPECT_NEAR(glm::length(setup.sun.to_light), 1, 1e-5f);
}

TEST(Setup, DirectionsAreCompassBearings) {
  const glm::vec3 east = render::direction_to(1.5707963f, 0);
  EXPECT_NEAR(east.x, 1, 1e-6f);
  EXPECT_NEAR(render::direction_to(0, 0).z, 1, 1e-6f);
  EXPECT_NEAR(render::direction_to(0, 1.5707963f).y, 1, 1e-6f);
}

// A scene with one of each kind of light, on nodes that are turned and moved.
scene::Scene scene_with_lights() {
  scene::Scene scene = scene_of({box({-9, -0.1f, -9}, {9, 0, 9})});
  scene.lights = {{.name = "lamp", .kind = scene::LightKind::point, .intensity = 20, .range = 7},
                  {.name = "spot",
                   .kind = scene::LightKind::spot,
                   .intensity = 30,
                   .inner_cone = 0.2f,
                   .outer_cone = 0.6f,
                   .radius = 0.1f},
                  {.name = "sun", .kind = scene::LightKind::directional, .intensity = 5},
                  {.name = "dark", .kind = scene::LightKind::point, .intensity = 0}};
  for (int i = 0; i < 4; ++i) {
    scene::Node node{.name = "node"};
    // -Z of the node points down.
    node.matrix =
        glm::rotate(glm::translate(glm::mat4(1), glm::vec3(i, 2, 0)), glm::radians(-90.0f), glm::vec3(1, 0, 0));
    node.light = i;
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back(node);
  }
  return scene;
}

TEST(Setup, AFileIsLitByItsOwnLights) {
  const render::Setup setup = setup_of(scene_with_lights());
  EXPECT_TRUE(setup.sun_shines);
  EXPECT_NEAR(setup.sun.to_light.y, 1, 1e-6f);
  EXPECT_EQ(setup.sun.illuminance, glm::vec3(5));
  ASSERT_EQ(setup.lights.size(), 2u) << "the dark one is left out";
  const auto& lamp = std::get<render::LampLight>(setup.lights[0].light);
  EXPECT_EQ(lamp.position, glm::vec3(0, 2, 0));
  EXPECT_EQ(lamp.axis, glm::vec3(0));
  EXPECT_EQ(lamp.range, 7);
  EXPECT_FLOAT_EQ(lamp.radius, 0.03f);
  const auto& spot = std::get<render::LampLight>(setup.lights[1].light);
  EXPECT_NEAR(spot.axis.y, -1, 1e-6f);
  EXPECT_FLOAT_EQ(spot.radius, 0.1f);
  EXPECT_FLOAT_EQ(spot.inner_cone, 0.2f);
  EXPECT_FLOAT_EQ(spot.outer_cone, 0.6f);
  EXPECT_EQ(render::frame_lights(setup).size(), 3u);
}

TEST(Setup, ASpotShinesIntoAHalfSpaceAtMost) {
  scene::Scene scene = scene_with_lights();
  scene.lights[1].outer_cone = 2;
  EXPECT_FLOAT_EQ(std::get<render::LampLight>(setup_of(scene).lights[1].light).outer_cone, 1.5707963f);
}

TEST(Setup, TheUserChoosesLights) {
  const scene::Scene scene = scene_with_lights();
  const auto lights_of = [&](const render::SetupRequest& request) {
    std::vector<std::string> names;
    const render::Setup setup = setup_of(scene, request);
    if (setup.sun_shines) names.emplace_back("the sun");
    for (const render::PlacedLight& light : setup.lights) names.push_back(light.name);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(lights_of({.no_sun = true}), (Names{"lamp", "spot"}));
  EXPECT_EQ(lights_of({.lights = Names{"spot"}}), (Names{"spot"}));
  EXPECT_EQ(lights_of({.lights = Names{"1", "sun"}}), (Names{"the sun", "spot"}));
  EXPECT_EQ(lights_of({.lights = Names{"lamp"}, .own_sun = true}), (Names{"the sun", "lamp"}));
  const render::Setup wide = setup_of(scene, {.lamp_radius = 0.5f});
  EXPECT_EQ(std::get<render::LampLight>(wide.lights[1].light).radius, 0.5f);
  EXPECT_THROW(lights_of({.lights = Names{"lmap"}}), Error);
  EXPECT_THROW(lights_of({.lights = Names{"dark"}}), Error);
  EXPECT_THROW(setup_of(scene_of({box({-1, 0, -1}, {1, 1, 1})}), {.no_sun = true}), Error);
}

TEST(Setup, ALightKeepsItsIdWhateverOtherLightsShine) {
  const scene::Scene scene = scene_with_lights();
  const auto ids = [&](const render::SetupRequest& request) { return render::light_ids(setup_of(scene, request)); };
  using Names = std::vector<std::string>;
  const std::vector<int> all = ids({.lamps = {{.number = 0}, {.number = 1}}});
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(std::set<int>(all.begin(), all.end()).size(), 5u);
  EXPECT_EQ(ids({.lights = Names{"spot", "sun"}}), (std::vector{all[0], all[2]}));
  EXPECT_EQ(ids({.no_sun = true, .lamps = {{.number = 1}}}), (std::vector{all[1], all[2], all[4]}));
  EXPECT_EQ(ids({.lights = Names{"lamp"}, .own_sun = true}).size(), 2u);
}

TEST(Setup, ThereAreNoMoreLightsThanAFrameHas) {
  scene::Scene scene = scene_with_lights();
  for (int i = 0; i < 10000; ++i) {
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back({.name = "more", .light = 0});
  }
  EXPECT_EQ(render::frame_lights(setup_of(scene)).size(), static_cast<std::size_t>(render::max_lights));
}

}  // namespace
}  // namespace penumbra::test
