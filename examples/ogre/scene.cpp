#include "scene.h"

#include <OgreEntity.h>
#include <OgreManualObject.h>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "materials.h"

namespace {

// A surface of revolution around the y axis, smooth if it has many sides. The profile has radii and heights, from the
// top downwards.
Ogre::MeshPtr make_lathe(Ogre::SceneManager& manager, const std::string& name,
                         const std::vector<Ogre::Vector2>& profile, int sides) {
  const float step = 2 * std::numbers::pi_v<float> / static_cast<float>(sides);
  Ogre::ManualObject& object = *manager.createManualObject();
  object.begin("white");
  unsigned corner = 0;
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    const Ogre::Vector2 down = profile[ring + 1] - profile[ring];
    for (int side = 0; side < sides; ++side) {
      for (const auto& point : {profile[ring], profile[ring + 1]}) {
        for (const int end : {side, (side + 1) % sides}) {
          const float angle = step * (static_cast<float>(end) + 0.5f);
          const float facing = sides > 8 ? angle : step * static_cast<float>(side + 1);
          object.position(point.x * std::sin(angle), point.y, point.x * std::cos(angle));
          object.normal(Ogre::Vector3(-down.y * std::sin(facing), down.x, -down.y * std::cos(facing)).normalisedCopy());
        }
      }
      object.quad(corner, corner + 2, corner + 3, corner + 1);
      corner += 4;
    }
  }
  object.end();
  return object.convertToMesh(name);
}

class Builder {
 public:
  explicit Builder(Ogre::SceneManager& manager) : manager_(manager) {
    make_surface("stone", Ogre::ColourValue(0.62f, 0.58f, 0.52f));
    make_surface("white", Ogre::ColourValue(0.8f, 0.78f, 0.74f));
    make_surface("wood", Ogre::ColourValue(0.34f, 0.2f, 0.11f));
    make_surface("red", Ogre::ColourValue(0.6f, 0.15f, 0.09f));
    make_surface("canvas", Ogre::ColourValue(0.78f, 0.7f, 0.52f));
    make_surface("leaves", Ogre::ColourValue(0.13f, 0.34f, 0.16f));
    make_surface("grass", Ogre::ColourValue(0.35f, 0.42f, 0.18f));
    make_surface("straw", Ogre::ColourValue(0.75f, 0.56f, 0.2f));
    make_lathe(manager, "disc", {{0, 0}, {1, 0}, {1, -1}}, 96);
    make_lathe(manager, "cylinder", {{0, 0.5f}, {1, 0.5f}, {1, -0.5f}, {0, -0.5f}}, 32);
    make_lathe(manager, "cone", {{0, 1}, {1, 0}, {0, 0}}, 32);
    make_lathe(manager, "roof", {{0, 1}, {std::numbers::sqrt2_v<float> / 2, 0}, {0, 0}}, 4);
    make_lathe(manager, "tower", {{1.25f, 5}, {1.55f, 2.2f}, {2.1f, 2.2f}, {2.1f, 2}, {1.6f, 2}, {1.9f, 0}}, 32);
  }

  Ogre::SceneNode& node(Ogre::SceneNode& parent, const Ogre::Vector3& place, float turn = 0) {
    return *parent.createChildSceneNode(place, Ogre::Quaternion(Ogre::Radian(turn), Ogre::Vector3::UNIT_Y));
  }

  Ogre::SceneNode& add(Ogre::SceneNode& parent, const char* mesh, const char* material, const Ogre::Vector3& place,
                       const Ogre::Vector3& size) {
    return add(parent, *manager_.createEntity(mesh), material, place, size);
  }

  Ogre::SceneNode& box(Ogre::SceneNode& parent, const char* material, const Ogre::Vector3& place,
                       const Ogre::Vector3& size) {
    return add(parent, *manager_.createEntity(Ogre::SceneManager::PT_CUBE), material, place, size / 100);
  }

  Ogre::SceneNode& ball(Ogre::SceneNode& parent, const char* material, const Ogre::Vector3& place, float radius) {
    return add(parent, *manager_.createEntity(Ogre::SceneManager::PT_SPHERE), material, place,
               Ogre::Vector3(radius / 50));
  }

 private:
  static Ogre::SceneNode& add(Ogre::SceneNode& parent, Ogre::Entity& entity, const char* material,
                              const Ogre::Vector3& place, const Ogre::Vector3& size) {
    entity.setMaterialName(material);
    Ogre::SceneNode& node = *parent.createChildSceneNode(place);
    node.setScale(size);
    node.attachObject(&entity);
    return node;
  }

  Ogre::SceneManager& manager_;
};

// Returns the sails, which turn around their z axis.
Ogre::SceneNode& add_mill(Builder& builder, Ogre::SceneNode& parent) {
  builder.add(parent, "tower", "white", {0, 0, 0}, Ogre::Vector3(1));
  builder.add(parent, "cone", "red", {0, 5, 0}, {1.5f, 1.7f, 1.5f});
  builder.box(parent, "wood", {0, 0.9f, 1.75f}, {0.9f, 1.8f, 0.3f});
  Ogre::SceneNode& sails = builder.node(parent, {0, 5.2f, 2});
  builder.add(sails, "cylinder", "wood", {0, 0, -0.6f}, {0.18f, 1.6f, 0.18f}).pitch(Ogre::Degree(90));
  for (int i = 0; i < 4; ++i) {
    Ogre::SceneNode& sail = builder.node(sails, {0, 0, 0});
    sail.roll(Ogre::Degree(90.0f * static_cast<float>(i)));
    builder.box(sail, "wood", {0, 1.9f, 0}, {0.12f, 3.8f, 0.12f});
    builder.box(sail, "wood", {0.9f, 2.3f, 0}, {0.06f, 2.9f, 0.06f});
    for (int bar = 0; bar < 7; ++bar) {
      builder.box(sail, "wood", {0.45f, 0.9f + 0.46f * static_cast<float>(bar), 0}, {0.9f, 0.07f, 0.06f});
    }
    builder.box(sail, "canvas", {0.45f, 3, 0.04f}, {0.86f, 1.36f, 0.02f});
  }
  return sails;
}

void add_house(Builder& builder, Ogre::SceneNode& parent) {
  builder.box(parent, "canvas", {0, 1, 0}, {3, 2, 2.4f});
  builder.add(parent, "roof", "red", {0, 2, 0}, {3.5f, 1.5f, 3});
  builder.box(parent, "stone", {0.9f, 2.8f, 0.3f}, {0.4f, 1.4f, 0.4f});
  builder.box(parent, "wood", {-0.6f, 0.75f, 1.2f}, {0.7f, 1.5f, 0.1f});
  builder.box(parent, "white", {0.7f, 1.1f, 1.2f}, {0.7f, 0.6f, 0.1f});
}

void add_tree(Builder& builder, Ogre::SceneNode& parent, float size) {
  builder.add(parent, "cylinder", "wood", {0, 0.4f * size, 0}, {0.12f * size, 0.8f * size, 0.12f * size});
  for (int i = 0; i < 3; ++i) {
    const float width = (0.85f - 0.2f * static_cast<float>(i)) * size;
    builder.add(parent, "cone", "leaves", {0, (0.6f + 0.55f * static_cast<float>(i)) * size, 0},
                {width, 1.1f * size, width});
  }
}

void add_fence(Builder& builder, Ogre::SceneNode& parent, int posts) {
  constexpr float gap = 1;
  for (int i = 0; i < posts; ++i) {
    builder.box(parent, "white", {gap * static_cast<float>(i), 0.45f, 0}, {0.12f, 0.9f, 0.12f});
  }
  const float length = gap * static_cast<float>(posts - 1);
  for (const float height : {0.35f, 0.7f}) {
    builder.box(parent, "white", {length / 2, height, 0.07f}, {length + 0.3f, 0.1f, 0.04f});
  }
}

}  // namespace

Scene make_scene(Ogre::Root& root) {
  Scene scene{};
  scene.manager = root.createSceneManager();
  Ogre::SceneNode& world = *scene.manager->getRootSceneNode();

  scene.camera = scene.manager->createCamera("view");
  scene.camera->setFOVy(Ogre::Degree(32));
  scene.camera->setNearClipDistance(1);
  scene.camera->setFarClipDistance(100);
  Ogre::SceneNode& eye = *world.createChildSceneNode(Ogre::Vector3(-5, 6.2f, 20.5f));
  eye.attachObject(scene.camera);
  eye.lookAt({0.6f, 3.4f, 0}, Ogre::Node::TS_WORLD);

  scene.sun = scene.manager->createLight("sun");
  scene.sun->setType(Ogre::Light::LT_DIRECTIONAL);
  Ogre::SceneNode& sky = *world.createChildSceneNode();
  sky.attachObject(scene.sun);
  sky.setDirection({0.75f, -0.6f, -0.3f}, Ogre::Node::TS_WORLD);

  Builder builder(*scene.manager);
  scene.things = world.createChildSceneNode();
  Ogre::SceneNode& things = *scene.things;
  builder.add(things, "disc", "grass", {0, 0, 0}, {12, 0.5f, 12});
  scene.sails = &add_mill(builder, builder.node(things, {-2.5f, 0, 0}, -0.6f));
  add_house(builder, builder.node(things, {5.4f, 0, -3.2f}, -0.35f));
  add_tree(builder, builder.node(things, {-7.8f, 0, -2.5f}), 1.6f);
  add_tree(builder, builder.node(things, {1.8f, 0, -6.6f}), 1.9f);
  add_tree(builder, builder.node(things, {8.6f, 0, 0.6f}), 1.3f);
  add_fence(builder, builder.node(things, {-5.2f, 0, 5.6f}, 0.12f), 8);
  builder.add(things, "cylinder", "straw", {4.6f, 0.6f, 2.4f}, {0.6f, 1.2f, 0.6f}).pitch(Ogre::Degree(90));
  builder.add(things, "cylinder", "straw", {6.0f, 0.6f, 2.9f}, {0.6f, 1.2f, 0.6f}).pitch(Ogre::Degree(90));
  builder.ball(things, "red", {0.9f, 0.45f, 4}, 0.45f);
  return scene;
}

void animate(Scene& scene, double time) {
  scene.sails->setOrientation(
      Ogre::Quaternion(Ogre::Radian(static_cast<float>(0.45 - 0.8 * time)), Ogre::Vector3::UNIT_Z));
}
