// The files of a folder that the viewer lists.
#include "support/temp_folder.h"
#include "viewer/file_list.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using viewer::FileList;

class ViewerFileList : public testing::Test {
 protected:
  void put(const std::string& name) const { std::ofstream(root_ / name) << "text"; }
  // The names of the entries; those of folders end in a slash.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const FileList::Entry& entry : viewer::list_folder(root_).entries)
      names.push_back(entry.name + (entry.is_folder ? "/" : ""));
    return names;
  }

  test::TempFolder folder_;
  fs::path root_ = folder_.path();
};

TEST_F(ViewerFileList, HasWhatCanBeOpenedFoldersFirst) {
  for (const char* name : {"b.glb", "a.GLTF", "p.toml", "a.bin", "glb", "picture.png", ".hidden.glb"}) put(name);
  for (const char* name : {"z", "a.glb", ".git"}) fs::create_directory(root_ / name);
  fs::create_symlink("nowhere.glb", root_ / "broken.glb");
  fs::create_directory_symlink("z", root_ / "link");
  EXPECT_EQ(names(), (std::vector<std::string>{"a.glb/", "link/", "z/", "a.GLTF", "b.glb", "p.toml"}));
  EXPECT_EQ(viewer::list_folder(root_).note, "");
}

TEST_F(ViewerFileList, KnowsAPresetInLettersOfEitherCase) {
  EXPECT_TRUE(viewer::is_preset("a/b.toml"));
  EXPECT_TRUE(viewer::is_preset("b.Toml"));
  EXPECT_FALSE(viewer::is_preset("b.glb"));
  EXPECT_FALSE(viewer::is_preset("toml"));
}

TEST_F(ViewerFileList, HasTheFolderAboveHoweverItsNameIsWritten) {
  fs::create_directory(root_ / "in");
  for (const char* name : {"in", "in/", "in/.", "./in/../in//"}) {
    EXPECT_EQ(viewer::list_folder(root_ / name).folder, root_ / "in") << name;
    EXPECT_EQ(viewer::list_folder(root_ / name).folder.parent_path(), root_) << name;
  }
  EXPECT_EQ(viewer::list_folder("/").folder, "/");
}

TEST_F(ViewerFileList, SaysWhatItCannotList) {
  EXPECT_NE(viewer::list_folder(root_ / "none").note, "");
  EXPECT_TRUE(viewer::list_folder(root_ / "none").entries.empty());
  for (std::size_t i = 0; i <= viewer::most_listed; ++i) put(std::to_string(i) + ".glb");
  const FileList list = viewer::list_folder(root_);
  EXPECT_EQ(list.entries.size(), viewer::most_listed);
  EXPECT_NE(list.note, "");
}

TEST_F(ViewerFileList, BeginsWhereTheSceneLies) {
  put("a.glb");
  EXPECT_EQ(viewer::folder_of((root_ / "a.glb").string()), root_);
  EXPECT_EQ(viewer::folder_of((root_ / "gone/b.glb").string()), root_);
  EXPECT_EQ(viewer::folder_of(root_.string()), root_);
  EXPECT_EQ(viewer::folder_of((root_ / "./a.glb").string()), root_);
  EXPECT_EQ(viewer::folder_of("./b.glb"), fs::current_path());
  EXPECT_TRUE(fs::equivalent(viewer::folder_of(""), fs::current_path()));
  EXPECT_TRUE(fs::equivalent(viewer::folder_of("b.glb"), fs::current_path()));
}

}  // namespace
}  // namespace penumbra
