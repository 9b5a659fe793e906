#include <gtest/gtest.h>

#include "compare/scene_names.h"

namespace penumbra {
namespace {

using std::filesystem::path;
using Names = std::vector<std::string>;

TEST(CompareNames, AreShortWhereThatTellsScenesApart) {
  EXPECT_EQ(compare::scene_names({"scenes/a.glb", "/other/b.gltf"}, &path::stem), (Names{"a", "b"}));
  EXPECT_EQ(compare::scene_names({"a.glb", "a.gltf"}, &path::filename), (Names{"a.glb", "a.gltf"}));
}

TEST(CompareNames, HaveFoldersWhereScenesShareAName) {
  EXPECT_EQ(compare::scene_names({"x/a.glb", "b.glb", "/y/z/a.glb", "a.glb"}, &path::stem),
            (Names{"x/a", "b", "z/a", "a"}));
  EXPECT_EQ(compare::scene_names({"x/a.glb", "y/a.glb"}, &path::filename), (Names{"x/a.glb", "y/a.glb"}));
}

TEST(CompareNames, AreWholePathsWhereScenesShareTheFolderToo) {
  EXPECT_EQ(compare::scene_names({"1/x/a.glb", "2/x/a.glb", "x/a.gltf", "y/a.glb"}, &path::stem),
            (Names{"1/x/a.glb", "2/x/a.glb", "x/a.gltf", "y/a"}));
  EXPECT_EQ(compare::scene_names({"a.glb", "a.gltf"}, &path::stem), (Names{"a.glb", "a.gltf"}));
}

}  // namespace
}  // namespace penumbra
