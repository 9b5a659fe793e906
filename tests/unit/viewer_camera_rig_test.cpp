// How the user moves the camera and the sun.
#include "viewer/camera_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "render/setup.h"

namespace penumbra {
namespace {

using viewer::CameraRig;

constexpr float pi = 3.14159265f;

render::Camera camera_of(const CameraRig& rig) { return render::look_at(rig.eye, rig.target, rig.fov_y, 0.01f); }

// Where the picture shows a point: picture heights from its middle, y up.
glm::vec2 seen_at(const CameraRig& rig, const glm::vec3& point, float aspect = 1) {
  const render::Camera camera = camera_of(rig);
  const glm::vec4 clip = render::projection_of(camera, aspect) * camera.view * glm::vec4(point, 1);
  return glm::vec2(clip.x / clip.w * aspect, clip.y / clip.w) * 0.5f;
}

// Rigs of all kinds: near and far, high and low.
class ViewerCameraRig : public testing::Test {
 protected:
  float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  glm::vec3 point(float far) { return {in(-far, far), in(-far, far), in(-far, far)}; }
  CameraRig any_rig() {
    CameraRig rig{.target = point(20), .fov_y = in(0.2f, 1.5f)};
    rig.eye = rig.target + in(0.1f, 50.0f) * render::direction_to(in(-pi, pi), in(-1.5f, 1.5f));
    return rig;
  }

 private:
  std::mt19937 random_{7};
};

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance) {
  EXPECT_LE(glm::distance(a, b), tolerance)
      << a.x << "," << a.y << "," << a.z << " and " << b.x << "," << b.y << "," << b.z;
}

TEST_F(ViewerCameraRig, OrbitKeepsTheTargetAndTheDistance) {
  for (int i = 0; i < 500; ++i) {
    CameraRig rig = any_rig();
    const CameraRig before = rig;
    for (int step = 0; step < 20; ++step) rig.orbit(in(-1, 1), in(-1, 1));
    EXPECT_EQ(rig.target, before.target);
    EXPECT_NEAR(rig.distance() / before.distance(), 1, 1e-3f);
  }
}

TEST_F(ViewerCameraRig, OrbitTurnsByWhatItIsTold) {
  CameraRig rig{.eye = {0, 0, 5}, .target = glm::vec3(0)};
  rig.orbit(pi / 2, 0);
  expect_near(rig.eye, {5, 0, 0}, 1e-5f);
  rig.orbit(0, pi / 6);
  expect_near(rig.eye, {5 * std::cos(pi / 6), 2.5f, 0}, 1e-5f);
}

TEST_F(ViewerCameraRig, OrbitNeverFlipsOverThePoles) {
  for (const float sign : {1.0f, -1.0f}) {
    CameraRig rig{.eye = {1, 1, 3}, .target = glm::vec3(0)};
    const float azimuth = std::atan2(rig.eye.x, rig.eye.z);
    for (int step = 0; step < 100; ++step) {
      rig.orbit(0, sign * 0.37f);
      EXPECT_NEAR(std::atan2(rig.eye.x, rig.eye.z), azimuth, 1e-3f) << "on the other side";
      EXPECT_GT(camera_of(rig).view[1][1], 0) << "upside down";
    }
    EXPECT_GT(sign * rig.eye.y, 0.99f * rig.distance());
    rig.orbit(0, -sign * 0.5f);
    EXPECT_LT(sign * rig.eye.y, 0.99f * rig.distance()) << "stuck at the pole";
  }
}

TEST_F(ViewerCameraRig, LookTurnsTheHeadAndNotTheFeet) {
  for (int i = 0; i < 200; ++i) {
    CameraRig rig = any_rig();
    const CameraRig before = rig;
    rig.look(in(-2, 2), in(-2, 2));
    EXPECT_EQ(rig.eye, before.eye);
    EXPECT_NEAR(rig.distance() / before.distance(), 1, 1e-3f);
    EXPECT_NE(rig.target, before.target);
    EXPECT_GT(camera_of(rig).view[1][1], 0);
  }
}

TEST_F(ViewerCameraRig, PanMovesWhatIsAtTheTargetsDistanceByTheDrag) {
  for (int i = 0; i < 200; ++i) {
    CameraRig rig = any_rig();
    const glm::vec3 back = rig.eye - rig.target;
    const glm::vec2 drag(in(-0.4f, 0.4f), in(-0.4f, 0.4f));
    const glm::vec3 grabbed = rig.target;
    rig.pan(drag);
    const glm::vec2 seen = seen_at(rig, grabbed);
    EXPECT_NEAR(seen.x, -drag.x, 2e-3f);
    EXPECT_NEAR(seen.y, -drag.y, 2e-3f);
    expect_near(rig.eye - rig.target, back, 1e-4f * (1 + glm::length(back)));
  }
}

TEST_F(ViewerCameraRig, DollyNeverReachesTheTargetNorPassesIt) {
  for (const glm::vec3& target : {glm::vec3(0), glm::vec3(1000, -20, 300)}) {
    CameraRig rig{.eye = target + glm::vec3(1, 2, 3), .target = target};
    const glm::vec3 back = glm::normalize(rig.eye - rig.target);
    rig.dolly(0.5f);
    EXPECT_NEAR(rig.distance(), std::sqrt(14.0f) / 2, 1e-3f);
    for (const float factor : {0.88f, 0.0f, -1.0f, 0.5f}) {
      for (int notch = 0; notch < 300; ++notch) rig.dolly(factor);
      ASSERT_NE(rig.eye, rig.target) << "at " << target.x << " by " << factor;
      EXPECT_GT(glm::dot(glm::normalize(rig.eye - rig.target), back), 0.5f) << factor;
    }
    rig.orbit(0.1f, 0.1f);
    rig.pan({0.1f, 0.1f});
    EXPECT_TRUE(std::isfinite(glm::length(rig.eye))) << target.x;
    const float near = rig.distance();
    for (int notch = 0; notch < 20; ++notch) rig.dolly(2.0f);
    EXPECT_GT(rig.distance(), 2 * near) << "can't leave";
    for (int notch = 0; notch < 3000; ++notch) rig.dolly(1.14f);
    EXPECT_LT(glm::length(rig.eye), 1e9f) << "as far as --eye takes it";
    const float far = rig.distance();
    for (int notch = 0; notch < 20; ++notch) rig.dolly(0.5f);
    EXPECT_LT(rig.distance(), far / 2) << "can't come back";
  }
}

TEST_F(ViewerCameraRig, FlyGoesRightUpAndBack) {
  CameraRig rig{.eye = {0, 0, 5}, .target = glm::vec3(0)};
  rig.fly({1, 2, 3});
  expect_near(rig.eye, {1, 2, 8}, 1e-6f);
  expect_near(rig.target, {1, 2, 3}, 1e-6f);
}

TEST_F(ViewerCameraRig, FrameShowsAllOfABoxAndNotMuchElse) {
  for (int i = 0; i < 300; ++i) {
    CameraRig rig = any_rig();
    const glm::vec3 direction = glm::normalize(rig.target - rig.eye), low = point(30);
    const glm::vec3 high = low + glm::vec3(in(0, 10), in(0, 10), in(0.1f, 10));
    scene::Bounds bounds;
    bounds.add(low);
    bounds.add(high);
    const float aspect = in(0.4f, 2.5f);
    rig.frame(bounds, aspect);
    float widest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 at((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                         (corner & 4) != 0 ? high.z : low.z);
      EXPECT_GT(glm::dot(at - rig.eye, direction), 0);
      const glm::vec2 seen = glm::abs(seen_at(rig, at, aspect));
      EXPECT_LE(seen.x, 0.5f * aspect + 1e-3f);
      EXPECT_LE(seen.y, 0.5f + 1e-3f);
      widest = std::max({widest, seen.x / aspect, seen.y});
    }
    EXPECT_GT(widest, 0.05f) << "too far away";
    expect_near(rig.target, bounds.center(), 1e-4f);
    expect_near(glm::normalize(rig.target - rig.eye), direction, 1e-3f);
  }
}

TEST_F(ViewerCameraRig, AnEmptyBoxFramesToSomethingFinite) {
  CameraRig rig;
  rig.frame({}, 1.5f);
  EXPECT_TRUE(std::isfinite(glm::length(rig.eye)));
  EXPECT_GT(rig.distance(), 0);
}

TEST_F(ViewerCameraRig, TheRigOfACameraShowsWhatItShows) {
  for (int i = 0; i < 300; ++i) {
    const CameraRig rig = any_rig();
    scene::Bounds about;
    about.add(rig.target - 0.5f);
    about.add(rig.target + 0.5f);
    const CameraRig same = viewer::rig_of(camera_of(rig), about);
    const float tolerance = 1e-4f * (20 + rig.distance());
    expect_near(same.eye, rig.eye, tolerance);
    expect_near(same.target, rig.target, tolerance);
    EXPECT_EQ(same.fov_y, rig.fov_y);
    // For every box, the line of sight is the camera's, and the target is in front of the eye.
    scene::Bounds elsewhere;
    elsewhere.add(point(100));
    elsewhere.add(point(100));
    const CameraRig other = viewer::rig_of(camera_of(rig), elsewhere);
    expect_near(other.eye, rig.eye, 1e-4f * (20 + other.distance()));
    expect_near(glm::normalize(other.target - other.eye), glm::normalize(rig.target - rig.eye), 1e-3f);
  }
}

TEST_F(ViewerCameraRig, ACameraThatLooksDownGivesARigThatCanBeTurned) {
  scene::Bounds about;
  about.add(glm::vec3(-1));
  about.add(glm::vec3(1));
  CameraRig rig = viewer::rig_of(render::look_at({0, 5, 0}, {0, 0, 0}, 0.7f, 0.01f), about);
  expect_near(rig.eye, {0, 5, 0}, 0.06f);
  rig.pan({0.1f, 0});
  rig.orbit(0.1f, -0.1f);
  EXPECT_TRUE(std::isfinite(glm::length(rig.eye)));
}

TEST_F(ViewerCameraRig, AnOrthographicCameraKeepsItsHeightAtTheTarget) {
  render::Camera camera = render::look_at({0, 2, 10}, {0, 2, 0}, 0.7f, 0.01f);
  camera.orthographic = true;
  camera.half_height = 3;
  scene::Bounds about;
  about.add(glm::vec3(-1));
  about.add(glm::vec3(1));
  const CameraRig rig = viewer::rig_of(camera, about);
  EXPECT_NEAR(rig.distance() * std::tan(rig.fov_y / 2), 3, 1e-4f);
}

TEST_F(ViewerCameraRig, AHandTurnsTheSunByItsAnglesAndKeepsItOverTheHorizon) {
  for (int i = 0; i < 500; ++i) {
    const float azimuth = in(-3, 3), elevation = in(0.1f, 1.4f), yaw = in(-0.1f, 0.1f), pitch = in(-0.09f, 0.09f);
    const glm::vec3 from = render::direction_to(azimuth, elevation);
    expect_near(viewer::turned_light(from, yaw, pitch), render::direction_to(azimuth + yaw, elevation + pitch), 1e-3f);
    const glm::vec3 far = viewer::turned_light(from, in(-9, 9), in(-9, 9));
    EXPECT_GE(far.y, 0);
    EXPECT_NEAR(glm::length(far), 1, 1e-5f);
  }
}

TEST_F(ViewerCameraRig, ASunThatWasPushedToTheZenithComesBackOnItsOwnSide) {
  const glm::vec3 from = render::direction_to(0.8f, 1.2f);
  glm::vec3 sun = from;
  for (int step = 0; step < 10; ++step) sun = viewer::turned_light(sun, 0, 0.1f);
  EXPECT_GT(sun.y, 0.999f);
  sun = viewer::turned_light(sun, 0, -0.4f);
  EXPECT_GT(glm::dot(glm::vec2(sun.x, sun.z), glm::vec2(from.x, from.z)), 0);
}

}  // namespace
}  // namespace penumbra
