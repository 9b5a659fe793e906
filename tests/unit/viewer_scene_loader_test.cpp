// Scenes are read in the background: the last requested one is returned, whatever was requested before.
#include "viewer/scene_loader.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "core/error.h"

namespace penumbra {
namespace {

using viewer::SceneLoader;

cli::SceneOptions options_of(const std::string& scene) {
  cli::SceneOptions options;
  options.scene = PENUMBRA_ROOT "/scenes/" + scene;
  return options;
}

SceneLoader::Loaded wait(SceneLoader& loader) {
  while (true) {
    if (std::optional<SceneLoader::Loaded> loaded = loader.finished()) return std::move(*loaded);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

TEST(ViewerSceneLoader, TheLastSceneThatWasAskedForComesOnce) {
  SceneLoader loader;
  for (const char* name : {"foliage.glb", "no such file", "moving.glb", "posts.glb"}) loader.start(options_of(name));
  EXPECT_EQ(loader.file(), options_of("posts.glb").scene);
  const SceneLoader::Loaded loaded = wait(loader);
  EXPECT_EQ(loaded.options.scene, options_of("posts.glb").scene);
  EXPECT_TRUE(loaded.prepared.scene.animations.empty());
  EXPECT_EQ(loader.file(), "");
  EXPECT_FALSE(loader.finished());
}

TEST(ViewerSceneLoader, AFaultIsThrownOnceAndNamesTheFile) {
  SceneLoader loader;
  loader.start(options_of("no such file"));
  try {
    wait(loader);
    FAIL() << "no fault";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no such file"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(loader.finished());
  loader.start(options_of("posts.glb"));
  EXPECT_EQ(wait(loader).options.scene, options_of("posts.glb").scene);
}

TEST(ViewerSceneLoader, EndsWhileItReads) {
  SceneLoader loader;
  for (const char* name : {"foliage.glb", "courtyard.glb"}) loader.start(options_of(name));
}

}  // namespace
}  // namespace penumbra
