// The list of golden pictures is complete: every technique, preset, filter, denoiser and AOV has its own.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "image/golden_picture.h"
#include "image/golden_renderer.h"
#include "image/goldens.h"
#include "render/renderer.h"
#include "truth/technique.h"

namespace penumbra::test {
namespace {

namespace fs = std::filesystem;

fs::path folder() { return fs::path(PENUMBRA_ROOT) / "tests/image/golden"; }

shadow::Registry registry() { return truth::TruthTechnique({.cache = {}}).registry(); }

// The scenes on which a golden of this technique or preset shows the AOV "shadow".
std::size_t scenes_of_technique(const std::string& name) {
  std::set<std::string> scenes;
  for (const Golden& golden : goldens()) {
    if (golden.technique == name && golden.aov == std::string("shadow")) scenes.insert(golden.scene);
  }
  return scenes.size();
}

// The scenes on which a golden shows that denoiser and, if the denoiser keeps anything from frame to frame, what it
// keeps.
std::size_t scenes_of_denoiser(const shadow::Denoiser& denoiser, const shadow::Registry& registry) {
  std::set<std::string> scenes;
  for (const Golden& golden : goldens()) {
    const bool applied = denoiser_of(golden, registry) == &denoiser;
    if (applied && (!denoiser.remembers || shows_history(golden, registry))) scenes.insert(golden.scene);
  }
  return scenes.size();
}

TEST(Goldens, EachTechniqueAndPresetHasTwoScenes) {
  for (const std::string& name : registry().names())
    EXPECT_GE(scenes_of_technique(name), 2U) << name << " lacks golden pictures: add lines to tests/image/goldens.cpp";
}

TEST(Goldens, EachFilterHasOne) {
  const shadow::Registry all = registry();
  for (const shadow::Filter& filter : all.filters()) {
    const char* param = filter.of == shadow::Filter::Of::penumbra ? "filter.penumbra" : "filter.visibility";
    EXPECT_TRUE(std::ranges::any_of(goldens(),
                                    [&](const Golden& golden) {
                                      return denoiser_of(golden, all) != nullptr &&
                                             params_of(golden, all).get_word(param) == filter.name;
                                    }))
        << filter.name << " lacks a golden picture";
  }
}

TEST(Goldens, EachDenoiserHasTwoScenes) {
  const shadow::Registry all = registry();
  for (const shadow::Denoiser& denoiser : all.denoisers()) {
    EXPECT_GE(scenes_of_denoiser(denoiser, all), 2U)
        << denoiser.name << " lacks golden pictures: add lines to tests/image/goldens.cpp";
  }
}

TEST(Goldens, EachAovHasOne) {
  for (const render::Aov& aov : render::aovs()) {
    EXPECT_TRUE(std::ranges::any_of(goldens(), [&](const Golden& golden) { return golden.aov == aov.name; }))
        << aov.name << " lacks a golden picture: add a line to tests/image/goldens.cpp";
  }
}

TEST(Goldens, EachLineHasAFileAndEachFileALine) {
  std::set<std::string> names, recorded, files;
  for (const Golden& golden : goldens()) EXPECT_TRUE(names.insert(golden.name).second) << golden.name << " twice";
  for (const auto& [name, version] : read_versions(folder() / "recorded_with.txt")) recorded.insert(name);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() == ".png") files.insert(entry.path().stem());
  }
  EXPECT_EQ(files, names) << "scripts/goldens.sh records what is missing; delete what no line names";
  EXPECT_EQ(recorded, names) << "of recorded_with.txt";
}

// Without these, a picture of that technique would not be held to anything but its background.
TEST(Goldens, EachTechniqueSaysWhatItsPictureIsFor) {
  for (const Golden& golden : goldens()) {
    const bool shadows = golden.aov == std::string("shadow") && golden.technique != std::string("none");
    EXPECT_TRUE(!shadows || !golden.without.empty()) << golden.name;
  }
}

}  // namespace
}  // namespace penumbra::test
