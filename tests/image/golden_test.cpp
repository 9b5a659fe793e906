// Golden pictures: what techniques, filters and AOVs draw is what they drew when somebody last looked at it.
// goldens.cpp lists them; this draws them, compares, and with PENUMBRA_GOLDENS=record (scripts/goldens.sh) records
// them. It also shows that each of them would notice the loss of what it shows.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "gl/context.h"
#include "gpu/gpu_test.h"
#include "image/golden_picture.h"
#include "image/golden_renderer.h"
#include "image/goldens.h"
#include "lib/packed_texel.glsl"
#include "support/temp_folder.h"

namespace penumbra::test {

// For GoogleTest's messages, which looks for this name.
// NOLINTNEXTLINE(readability-identifier-naming)
static void PrintTo(const Golden& golden, std::ostream* stream) { *stream << golden.name; }

namespace {

namespace fs = std::filesystem;

fs::path folder() { return fs::path(PENUMBRA_ROOT) / "tests/image/golden"; }
fs::path file_of(const Golden& golden) { return folder() / (std::string(golden.name) + ".png"); }
fs::path versions_file() { return folder() / "recorded_with.txt"; }

bool recording() {
  const char* wish = std::getenv("PENUMBRA_GOLDENS");
  return wish != nullptr && std::string(wish) == "record";
}

// "llvmpipe (LLVM 15.0.6), Mesa 22.3.6": without the width of the processor's registers, which decides no pixel.
std::string version_here() {
  const gl::DeviceInfo info = gl::device_info();
  std::smatch mesa;
  const bool is_mesa = std::regex_search(info.version, mesa, std::regex("Mesa [0-9.]+"));
  return std::regex_replace(info.renderer, std::regex(", [0-9]+ bits"), "") + ", " +
         (is_mesa ? mesa.str() : info.version);
}

std::string command_of(const Golden& golden) {
  std::string command = fmt::format("build/release/penumbra render scenes/{}.glb --size {}x{} --technique {}",
                                    golden.scene, golden_width, golden_height, golden.technique);
  if (golden.view != nullptr) {
    command += fmt::format(" --eye={} --target={} --fov {}", fmt::join(golden.view->eye, ","),
                           fmt::join(golden.view->target, ","), golden.view->fov);
  }
  for (const char* setting : golden.settings) command += fmt::format(" --set {}", setting);
  if (golden.frames > 1) command += fmt::format(" --frames 0:{} --fps 24", golden.frames - 1);
  return command + fmt::format(" --aov {} -o {}.exr", golden.aov, golden.name);
}

void print_tolerances() {
  const GoldenVersions versions = read_versions(versions_file());
  const std::string here = version_here();
  const auto own = std::ranges::count_if(versions, [&](const auto& version) { return version.second == here; });
  fmt::print("golden pictures: {} recorded {} of {} and is held to their own tolerances; others are {}\n", here, own,
             versions.size(), gl::device_info().software ? "compared with the looser one" : "skipped");
}

class GoldenPictures : public GpuTest, public testing::WithParamInterface<Golden> {
 protected:
  GoldenPictures() {
    if (renderer_) return;
    renderer_ = std::make_unique<GoldenRenderer>();
    if (!recording()) print_tolerances();
  }
  static void TearDownTestSuite() { renderer_.reset(); }

  const Golden& golden() const { return GetParam(); }
  GoldenPicture draw(const std::vector<const char*>& more = {}) const {
    renderer_->draw(golden(), more);
    return renderer_->picture(golden());
  }
  std::string recorded_version() const {
    const GoldenVersions versions = read_versions(versions_file());
    const auto found = versions.find(golden().name);
    return found == versions.end() ? "an unknown renderer" : found->second;
  }
  // The tolerance on this renderer; none if the golden picture has none for it.
  std::optional<Tolerance> tolerance_here() const {
    if (version_here() == recorded_version()) return *golden().tolerance;
    if (!gl::device_info().software) return {};
    return tolerance_of_other_versions();
  }

  static inline std::unique_ptr<GoldenRenderer> renderer_;
};

TEST_P(GoldenPictures, IsAsRecorded) {
  if (recording()) {
    write_golden(file_of(golden()), draw());
    note_version(versions_file(), golden().name, version_here());
    return;
  }
  const std::optional<Tolerance> tolerance = tolerance_here();
  if (!tolerance) GTEST_SKIP() << "skipped: golden pictures are of a software renderer, this is " << version_here();
  ASSERT_TRUE(fs::exists(file_of(golden())))
      << file_of(golden()) << " is missing; scripts/goldens.sh " << GetParam().name;
  const GoldenPicture picture = draw();
  const GoldenPicture reference = read_golden(file_of(golden()));
  ASSERT_EQ(picture.channels, reference.channels);
  ASSERT_EQ(picture.pixels.size(), reference.pixels.size());
  const GoldenComparison comparison = compare(picture, reference, *tolerance);
  if (comparison.alike()) return;
  const fs::path results = PENUMBRA_GOLDEN_RESULTS;
  write_comparison(results, golden().name, picture, reference, comparison.differences);
  ADD_FAILURE() << fmt::format(
      "{} pixels differ by more than {} of 255, at most {} may; the greatest difference is {} ({})\n"
      "  recorded with {}; this is {}\n"
      "  picture, reference and difference (brightest: 32 of 255) are {}_picture.png, …_reference.png and "
      "…_difference.png\n  see them side by side: xdg-open {}.png\n  draw it by:            {}\n"
      "  if it is right:        scripts/goldens.sh {}",
      comparison.off, tolerance->steps, comparison.allowed, *std::ranges::max_element(comparison.differences),
      tolerance->reason, recorded_version(), version_here(), (results / golden().name).string(),
      (results / golden().name).string(), command_of(golden()), golden().name);
}

// The picture with the background's colour in these pixels.
GoldenPicture without(GoldenPicture picture, std::span<const std::size_t> pixels) {
  const GoldenColor background = background_of(picture);
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (const std::size_t pixel : pixels) std::copy_n(background.begin(), channels, &picture.pixels[pixel * channels]);
  return picture;
}

TEST_P(GoldenPictures, NoticesTheLossOfAThirdOfWhatItShows) {
  if (recording()) return;
  const GoldenPicture reference = read_golden(file_of(golden()));
  for (const Tolerance& tolerance : {*golden().tolerance, tolerance_of_other_versions()}) {
    EXPECT_TRUE(compare(reference, reference, tolerance).alike());
    const std::vector<std::size_t> shown = shown_in(reference, tolerance.steps);
    EXPECT_GE(shown.size(), 200u) << "it shows too little: choose another scene, camera or scale";
    const std::size_t third = shown.size() / 3;
    for (std::size_t first = 0; first + third <= shown.size(); first += third) {
      const GoldenPicture lost = without(reference, std::span(shown).subspan(first, third));
      EXPECT_FALSE(compare(lost, reference, tolerance).alike()) << first / third << ", " << tolerance.reason;
    }
  }
}

TEST_P(GoldenPictures, NoticesTheLossOfWhatItIsFor) {
  if (recording()) return;
  const GoldenPicture reference = read_golden(file_of(golden()));
  for (const char* setting : golden().without) {
    const GoldenPicture lost = draw({setting});
    ASSERT_EQ(lost.pixels.size(), reference.pixels.size());
    const GoldenComparison here = compare(lost, reference, *golden().tolerance);
    EXPECT_GT(here.off, 2 * here.allowed) << "with " << setting << " it passes as the golden picture, or nearly so";
    const GoldenComparison other = compare(lost, reference, tolerance_of_other_versions());
    const bool first = setting == golden().without.front();
    EXPECT_TRUE(!first || !other.alike())
        << "with " << setting << " it passes on other versions of the renderer: " << other.off << " of "
        << other.allowed;
  }
}

TEST_P(GoldenPictures, ShowsTheHistoryThatItIsFor) {
  if (recording() || !shows_history(golden(), truth::TruthTechnique({.cache = {}}).registry())) return;
  renderer_->draw(golden());
  const std::vector<float> visibility = renderer_->aov("shadow"), history = renderer_->aov("history");
  int blended = 0;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const bool in_penumbra = visibility[i] > 0 && visibility[i] < 1;
    if (in_penumbra && history[i] == static_cast<float>(HISTORY_KEPT)) ++blended;
  }
  EXPECT_GE(blended, 500) << "few pixels in a penumbra are blended with the last frames";
}

INSTANTIATE_TEST_SUITE_P(All, GoldenPictures, testing::ValuesIn(goldens().begin(), goldens().end()),
                         [](const auto& golden) { return std::string(golden.param.name); });

TEST(GoldenVersions, RecordingOnePictureKeepsTheVersionsOfTheOthers) {
  const TempFolder temp;
  const fs::path file = temp.path() / "recorded_with.txt";
  note_version(file, "b", "llvmpipe, Mesa 22");
  note_version(file, "a", "llvmpipe, Mesa 22");
  note_version(file, "b", "llvmpipe, Mesa 23: new");
  EXPECT_EQ(read_versions(file), (GoldenVersions{{"a", "llvmpipe, Mesa 22"}, {"b", "llvmpipe, Mesa 23: new"}}));
}

}  // namespace
}  // namespace penumbra::test
