// What is saved beside a scene is read back as it was; a damaged file does no harm.
#include "viewer/view_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "cli/usage.h"
#include "core/error.h"
#include "io/output_file.h"
#include "support/temp_folder.h"
#include "viewer/document.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using viewer::SavedView;

class ViewerViewFile : public testing::Test {
 protected:
  std::optional<SavedView> read() const {
    std::string fault;
    std::optional<SavedView> view = viewer::read_view(scene_, fault);
    EXPECT_EQ(fault, "");
    return view;
  }
  // Expects that such a file is refused as a whole, with one line that names the file and contains `cause`.
  void expect_fault(const std::string& text, const std::string& cause) const {
    io::write_text(file_, text);
    std::string fault;
    EXPECT_FALSE(viewer::read_view(scene_, fault)) << text;
    EXPECT_NE(fault.find(file_.string()), std::string::npos) << fault;
    EXPECT_NE(fault.find(cause), std::string::npos) << fault << " lacks " << cause;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
    EXPECT_LT(fault.size(), 600u);
  }

  test::TempFolder folder_;
  std::string scene_ = folder_.path() / "hall.glb";
  fs::path file_ = folder_.path() / "hall.glb.view.json";
};

TEST_F(ViewerViewFile, ASceneThatWasNeverSavedHasNone) {
  EXPECT_FALSE(read());
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(ViewerViewFile, WhatWasWrittenIsReadBack) {
  cli::SceneOptions options;
  options.eye = {0.1f, -2, 3e-5f};
  options.target = {-1, 0, 1e6f};
  options.fov = 33.3333;
  options.sun = cli::parse_direction("--sun", "20.123,50");
  options.lights = {"0", "2"};
  options.lamp_radius = 0.25;
  options.lamps = {{.number = 0}, {.number = 1}};
  viewer::Bookmarks bookmarks;
  bookmarks[0] = {.eye = {0.1f, -2, 3e-5f}, .target = {1e6f, 0, 0}, .fov = 33.3333};
  bookmarks[8] = {.eye = {0, 0, 0}, .target = {0, 0, -1}, .fov = 179};
  viewer::write_view(scene_, {.options = options, .bookmarks = bookmarks});
  const std::optional<SavedView> again = read();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->bookmarks, bookmarks);
  EXPECT_EQ(viewer::view_arguments(again->options), viewer::view_arguments(options));
  EXPECT_EQ(again->options.eye, options.eye);
  EXPECT_EQ(again->options.lamps, options.lamps);
  options = {};
  options.no_sun = true;
  options.lights = std::vector<std::string>();
  options.camera = "Größe 影, 2";
  viewer::write_view(scene_, {.options = options});
  EXPECT_EQ(viewer::view_arguments(read()->options), viewer::view_arguments(options));
}

// Else the next start would ignore all of it, and nothing could be saved any more.
TEST_F(ViewerViewFile, WhatCouldNotBeReadBackIsNotWritten) {
  cli::SceneOptions good, far, large;
  good.eye = {1, 2, 3};
  good.target = {0, 0, 0};
  viewer::write_view(scene_, {.options = good});
  far = good;
  far.eye = {2e10f, 0, 0};
  large.lamps = {{.radius = 2423, .number = 0}};
  viewer::Bookmarks bookmarks;
  bookmarks[3] = {.eye = {0, 3e9f, 0}, .target = {0, 0, 0}, .fov = 40};
  for (const SavedView& view :
       {SavedView{.options = far}, SavedView{.options = large}, SavedView{.bookmarks = bookmarks}})
    EXPECT_THROW(viewer::write_view(scene_, view), Error);
  EXPECT_EQ(viewer::view_arguments(read()->options), viewer::view_arguments(good));
}

TEST_F(ViewerViewFile, ABrokenFileIsIgnoredAndNamed) {
  expect_fault("{", "not JSON");
  expect_fault("[]", "not a view");
  expect_fault(R"({"view": {}})", "'view' takes a list");
  expect_fault(R"({"view": ["--fov=40", 3]})", "'view' takes a list");
  expect_fault(R"({"view": ["--eye=NaN,0,0", "--target=1,0,0"]})", "--eye can't be 'NaN,0,0'");
  expect_fault(R"({"view": ["--eye=1e39,0,0", "--target=1,0,0"]})", "--eye can't be");
  expect_fault(R"({"view": ["--eye=0,0,0"]})", "--eye and --target go together");
  expect_fault(R"({"view": ["--eye=0,0,0", "--target=0,0,0"]})", "same point");
  expect_fault(R"({"view": ["--fov=0"]})", "--fov can't be '0'");
  expect_fault(R"({"view": ["--lamp=here"]})", "--lamp");
  expect_fault(R"({"view": ["--no-sun=maybe"]})", "no-sun");
  expect_fault(R"({"view": ["--sun=0,40", "--no-sun"]})", "exclude each other");
  expect_fault(R"({"view": ["--fov=40", "--fov=50"]})", "--fov");
  for (const char* other : {"--help", "-h", "--log-level=quiet", "--ground=on", "--max-memory=1", "hall.glb", "", "--"})
    expect_fault(std::string(R"({"view": [")") + other + R"("]})", "is no option of a view");
}

TEST_F(ViewerViewFile, ABrokenBookmarkIsNamed) {
  const auto with = [](const std::string& bookmarks) { return R"({"view": [], "bookmarks": )" + bookmarks + "}"; };
  const auto third = [&](const std::string& options) { return with("{\"3\": [" + options + "]}"); };
  expect_fault(with("[]"), "'bookmarks' takes cameras by number");
  for (const char* name : {"0", "10", "", "one", "-1", "\u00e9"})
    expect_fault(with("{\"" + std::string(name) + "\": []}"), "1 to 9");
  expect_fault(with(R"({"3": null})"), "bookmark 3: 'bookmarks.3' takes a list");
  expect_fault(third(R"("--eye=nan,0,0", "--target=0,0,1", "--fov=40")"), "bookmark 3: --eye can't be 'nan,0,0'");
  expect_fault(third(R"("--eye=0,0,0", "--target=0,inf,1", "--fov=40")"), "bookmark 3: --target can't be");
  expect_fault(third(R"("--eye=0,0,0", "--target=0,0,1", "--fov=nan")"), "bookmark 3: --fov can't be 'nan'");
  expect_fault(third(R"("--eye=0,0,0", "--target=0,0,1", "--fov=180")"), "bookmark 3: --fov can't be");
  expect_fault(third(R"("--eye=0,0,0", "--target=0,0,0", "--fov=40")"), "bookmark 3: --eye and --target are the same");
  expect_fault(third(R"("--eye=0,0,0", "--target=0,0,1")"), "bookmark 3: --eye, --target and --fov are needed");
  expect_fault(third(R"("--eye=0,0,0", "--target=0,0,1", "--fov=40", "--no-sun")"), "bookmark 3: '--no-sun'");
  expect_fault(third(""), "bookmark 3: --eye, --target and --fov are needed");
}

TEST_F(ViewerViewFile, UnknownKeysAreIgnored) {
  io::write_text(file_, R"({"view": ["--fov=40"], "theme": {"dark": [true]}})");
  EXPECT_EQ(read()->options.fov, 40);
  io::write_text(file_, "{}");
  EXPECT_TRUE(viewer::view_arguments(read()->options).empty());
}

TEST_F(ViewerViewFile, WhatTheCommandLineChoosesStays) {
  cli::SceneOptions saved;
  saved.eye = {1, 2, 3};
  saved.target = {0, 0, 0};
  saved.sun = cli::Direction{.azimuth = 1, .elevation = 1};
  saved.lamp_radius = 0.5;

  cli::SceneOptions options;
  viewer::use_view(saved, options);
  EXPECT_EQ(viewer::view_arguments(options), viewer::view_arguments(saved));

  options = {};
  options.camera = "0";
  options.no_sun = true;
  options.lights = {"1"};
  const auto own = viewer::view_arguments(options);
  viewer::use_view(saved, options);
  EXPECT_EQ(viewer::view_arguments(options), own);
}

}  // namespace
}  // namespace penumbra
