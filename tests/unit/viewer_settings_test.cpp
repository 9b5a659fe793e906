// The settings that the viewer keeps between runs; a damaged settings file does no harm.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "io/output_file.h"
#include "session/techniques.h"
#include "support/temp_folder.h"
#include "viewer/settings.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using viewer::Settings;

class ViewerSettings : public testing::Test {
 protected:
  ViewerSettings() {
    setenv("XDG_CONFIG_HOME", (root_ / "config").c_str(), 1);
    setenv("HOME", (root_ / "home").c_str(), 1);
  }
  ~ViewerSettings() override {
    unsetenv("XDG_CONFIG_HOME");
    setenv("HOME", home_.c_str(), 1);
  }

  static Settings read() {
    std::string fault;
    Settings settings = viewer::read_settings(fault);
    EXPECT_EQ(fault, "");
    return settings;
  }
  fs::path file() const { return root_ / "config/penumbra/viewer.json"; }
  void put(const std::string& text) const { io::write_text(file(), text); }

  // Expects that such a file is refused as a whole, with one line that names the file and contains `cause`.
  void expect_fault(const std::string& text, const std::string& cause) const {
    put(text);
    expect_fault(cause);
  }
  void expect_fault(const std::string& cause) const {
    std::string fault;
    const Settings settings = viewer::read_settings(fault);
    EXPECT_NE(fault.find(file().string()), std::string::npos) << fault;
    EXPECT_NE(fault.find(cause), std::string::npos) << fault << " lacks " << cause;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
    EXPECT_LT(fault.size(), 600u);
    EXPECT_TRUE(settings.panel);
    EXPECT_TRUE(settings.recent.empty());
    EXPECT_FALSE(settings.window);
    EXPECT_EQ(session::technique_label(settings.params), session::usual_technique);
  }

  test::TempFolder folder_;
  fs::path root_ = folder_.path();
  std::string home_ = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
};

TEST_F(ViewerSettings, AFirstRunHasTheDefaultsAndNoFault) {
  const Settings settings = read();
  EXPECT_TRUE(settings.panel);
  EXPECT_TRUE(settings.vsync);
  EXPECT_FALSE(settings.window);
  EXPECT_EQ(session::technique_label(settings.params), session::usual_technique);
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(ViewerSettings, WhatWasWrittenIsReadBack) {
  Settings settings = read();
  settings.recent = {"/a/two words.glb", "/b/\"quoted\"\n\t\\.gltf", "/c/Größe 影.glb"};
  settings.window = {1234, 567};
  settings.panel = settings.vsync = false;
  settings.tab = "Cost";
  settings.panel_width = 512.5f;
  settings.panel_share = 0.25f;
  settings.scale = 1.75f;
  for (const Param& row : settings.params.rows()) {
    if (const bool* flag = std::get_if<bool>(&row.default_value)) settings.params.set(row.name, !*flag);
    if (const float* quantity = std::get_if<float>(&row.default_value))
      settings.params.set(row.name, *quantity + static_cast<float>(row.max - *quantity) / 3.0f);
    if (!row.choices.empty()) settings.params.set(row.name, row.choices.back());
  }
  settings.params.set_text("cascades.count", "2");
  viewer::write_settings(settings);
  const Settings again = read();
  EXPECT_EQ(again.recent, settings.recent);
  EXPECT_EQ(again.window->width, 1234);
  EXPECT_EQ(again.window->height, 567);
  EXPECT_FALSE(again.panel);
  EXPECT_FALSE(again.vsync);
  EXPECT_EQ(again.tab, "Cost");
  EXPECT_EQ(again.panel_width, 512.5f);
  EXPECT_EQ(again.panel_share, 0.25f);
  EXPECT_EQ(again.scale, 1.75f);
  for (const Param& row : settings.params.rows())
    EXPECT_EQ(again.params.value(row.name), settings.params.value(row.name)) << row.name;
}

TEST_F(ViewerSettings, OnlyChangedValuesAreKeptSoThatNewDefaultsReachTheUser) {
  Settings settings = read();
  settings.params.set_text("sun.angle", "2");
  viewer::write_settings(settings);
  std::ifstream stream(file());
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  EXPECT_NE(text.find("\"sun.angle\": 2"), std::string::npos) << text;
  EXPECT_EQ(text.find("technique"), std::string::npos) << text;
}

TEST_F(ViewerSettings, PartsMayBeMissingAndUnknownKeysAreIgnored) {
  put(R"({"panel": false, "theme": {"accent": [1, 2, {"deep": null}]}, "window": {"width": 10, "height": 20, "x": -5}})");
  const Settings settings = read();
  EXPECT_FALSE(settings.panel);
  EXPECT_TRUE(settings.vsync);
  EXPECT_EQ(settings.window->height, 20);
}

TEST_F(ViewerSettings, ABrokenFileIsIgnoredAndNamed) {
  for (const char* text : {"", "{", "{\"panel\": false,}", "{\"panel\": false} {}", "\xff\xfe{}", "{\"tab\": \"\xff\"}",
                           "{'panel': true}", "{\"window\": 1e999}"})
    expect_fault(text, "not JSON");
  for (const char* text : {"[]", "null", "3", "\"text\""}) expect_fault(text, "not settings");
}

TEST_F(ViewerSettings, AWrongPartSpoilsTheWhole) {
  const std::string good = R"({"panel": false, "recent": ["/a.glb"], "params": {"sun.angle": 2}, )";
  for (const char* part : {R"("vsync": 1)", R"("vsync": "true")", R"("vsync": null)"}) {
    expect_fault(good + part + "}", "'vsync' takes true or false");
  }
  for (const char* part : {R"("window": [1, 2])", R"("window": {"width": 0, "height": 9})", R"("window": {"width": 9})",
                           R"("window": {"width": 1e9, "height": 9})", R"("window": {"width": 9, "height": -9})",
                           R"("window": {"width": 18446744073709551617, "height": 9})",
                           R"("window": {"width": 1000000000, "height": 9})"}) {
    expect_fault(good + part + "}", "'window");
  }
  for (const char* value : {"0.5", "4", "-1", "\"1\"", "null", "[1]", "1e300"}) {
    expect_fault(good + "\"scale\": " + value + "}", "'scale' takes a number from 0.75 to 3");
    expect_fault(good + "\"panel_width\": " + value + "}", "'panel_width' takes a number from 240 to 1600");
  }
  for (const char* value : {"0.1", "1", "-1", "\"1\"", "null"})
    expect_fault(good + "\"panel_share\": " + value + "}", "'panel_share' takes a number from 0.2 to 0.8");
  expect_fault(good + R"("tab": 3})", "'tab'");
  expect_fault(good + R"("tab": ")" + std::string(1000, 'x') + "\"}", "'tab'");
  for (const char* part : {R"(["a.glb"])", R"([""])", R"([3])", R"({"0": "/a.glb"})", R"("/a.glb")"})
    expect_fault(R"({"recent": )" + std::string(part) + "}", "'recent'");
  std::string eleven = R"({"recent": ["/0")";
  for (int i = 1; i < 11; ++i) eleven += ", \"/a\"";
  expect_fault(eleven + "]}", "at most 10");
}

TEST_F(ViewerSettings, WrongParametersSpoilTheWhole) {
  const auto with = [](const std::string& params) { return R"({"panel": false, "params": )" + params + "}"; };
  expect_fault(with("[]"), "'params'");
  expect_fault(with(R"({"sun.angel": 2})"), "unknown parameter 'sun.angel'");
  expect_fault(with(R"({"sun.angle=2": 2})"), "unknown parameter");
  expect_fault(with("{\"" + std::string(5000, 'x') + "\\n\": 2}"), "unknown parameter 'xxx");
  expect_fault(with(R"({"sun.angle": 1e30})"), "sun.angle");
  expect_fault(with(R"({"sun.angle": "2"})"), "sun.angle");
  expect_fault(with(R"({"sun.angle": null})"), "sun.angle");
  expect_fault(with(R"({"sun.angle": [2]})"), "sun.angle");
  expect_fault(with(R"({"cascades.count": 2.5})"), "cascades.count");
  expect_fault(with(R"({"cascades.count": true})"), "cascades.count");
  expect_fault(with(R"({"cascades.count": 99999999999})"), "cascades.count");
  expect_fault(with(R"({"cascades.count": 8, "cascades.size": 8192})"), "limit");
  expect_fault(with(R"({"technique": "pcsss"})"), "pcsss");
}

TEST_F(ViewerSettings, AHostileFileIsRefusedAtOnce) {
  expect_fault(std::string(1 << 19, '['), "nested deeper");
  std::string nested;
  for (int i = 0; i < 100'000; ++i) nested += "{\"a\":";
  expect_fault(nested, "nested deeper");
  std::string keys = "{";
  for (int i = 0; i < 80'000; ++i) keys += "\"" + std::to_string(i) + "\":1,";
  expect_fault(keys + "\"last\":1}", "keys");
  expect_fault("{}" + std::string(1 << 20, ' '), "over the limit");
}

TEST_F(ViewerSettings, WhatIsNoFileOfTheirOwnIsNotWaitedFor) {
  fs::create_directories(file());
  expect_fault("not a regular file");
  fs::remove(file());
  ASSERT_EQ(mkfifo(file().c_str(), 0600), 0);
  expect_fault("not a regular file");
  fs::remove(file());
  fs::create_symlink(file(), file());
  expect_fault("symbolic link");
}

TEST_F(ViewerSettings, FoldersThatAreNotAbsoluteCountForNothing) {
  const fs::path home = root_ / "home/.config/penumbra/viewer.json";
  for (const char* relative : {"", "config", "./config", "../config"}) {
    setenv("XDG_CONFIG_HOME", relative, 1);
    EXPECT_EQ(viewer::settings_file(), home) << relative;
  }
  unsetenv("XDG_CONFIG_HOME");
  EXPECT_EQ(viewer::settings_file(), home);
  viewer::write_settings(read());
  EXPECT_TRUE(fs::exists(home));
  setenv("HOME", "home", 1);
  EXPECT_EQ(viewer::settings_file(), "");
  read();
  EXPECT_THROW(viewer::write_settings({}), Error);
  unsetenv("HOME");
  EXPECT_EQ(viewer::settings_file(), "");
}

TEST_F(ViewerSettings, AFolderThatCannotBeWrittenIsOneErrorAndHarmsNothing) {
  io::write_text(root_ / "config", "a file where the folder should be");
  const Settings settings = read();
  try {
    viewer::write_settings(settings);
    ADD_FAILURE() << "written into a file";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(file().string()), std::string::npos) << error.what();
  }
  EXPECT_TRUE(fs::is_regular_file(root_ / "config"));
}

TEST_F(ViewerSettings, NewFoldersAreTheUsersAloneAndLinksStayLinks) {
  Settings settings = read();
  viewer::write_settings(settings);
  EXPECT_EQ(fs::status(file().parent_path()).permissions(), fs::perms::owner_all);
  const fs::path elsewhere = root_ / "dotfiles.json";
  fs::rename(file(), elsewhere);
  fs::create_symlink(elsewhere, file());
  settings.panel = false;
  viewer::write_settings(settings);
  EXPECT_TRUE(fs::is_symlink(file()));
  EXPECT_FALSE(read().panel);
}

TEST_F(ViewerSettings, WhatIsWrittenCanAlwaysBeRead) {
  Settings settings = read();
  settings.recent = {"relative.glb", "/no\xffutf8.glb", "/" + std::string(9000, 'x'), "/good.glb"};
  for (int i = 0; i < 20; ++i) settings.recent.emplace_back("/more.glb");
  settings.window = {0, 1'000'000'000};
  settings.tab = std::string(100, 't');
  settings.panel_width = -5;
  settings.scale = 1e9f;
  settings.params.set_text("cascades.count", "8");
  settings.params.set_text("cascades.size", "8192");
  viewer::write_settings(settings);
  const Settings again = read();
  ASSERT_EQ(again.recent.size(), viewer::most_recent);
  EXPECT_EQ(again.recent.front(), "/good.glb");
  EXPECT_FALSE(again.window);
  EXPECT_EQ(again.panel_width, viewer::least_panel_width);
  EXPECT_EQ(again.scale, viewer::most_scale);
  EXPECT_TRUE(again.params.is_default("cascades.size")) << "more memory than --set would grant";
}

TEST_F(ViewerSettings, RecentScenesAreTenWithTheNewestInFront) {
  std::vector<std::string> recent;
  for (int i = 0; i < 12; ++i) viewer::add_recent(recent, "/scenes/" + std::to_string(i) + ".glb");
  ASSERT_EQ(recent.size(), 10u);
  EXPECT_EQ(recent.front(), "/scenes/11.glb");
  EXPECT_EQ(recent.back(), "/scenes/2.glb");
  viewer::add_recent(recent, "/scenes/./lights/../5.glb");
  EXPECT_EQ(recent.size(), 10u);
  EXPECT_EQ(recent[0], "/scenes/5.glb");
  EXPECT_EQ(recent[1], "/scenes/11.glb");
  viewer::add_recent(recent, "here.glb");
  EXPECT_EQ(recent.front(), (fs::current_path() / "here.glb").string());
}

}  // namespace
}  // namespace penumbra
