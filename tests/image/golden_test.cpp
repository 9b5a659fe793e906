// Golden pictures: what techniques, filters and AOVs draw is what they drew when somebody last looked at it.
// goldens.cpp lists them; this draws them, compares, and with PENUMBRA_GOLDENS=record (scripts/goldens.sh) records
// them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "gl/context.h"
#include "gpu/gpu_test.h"
#include "image/goldens.h"
#include "image/picture.h"
#include "image/read.h"
#include "image/write.h"
#include "metrics/heat_color.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "truth/technique.h"

namespace penumbra::test {

// For GoogleTest's messages, which looks for this name.
// NOLINTNEXTLINE(readability-identifier-naming)
static void PrintTo(const Golden& golden, std::ostream* stream) { *stream << golden.name; }

namespace {

namespace fs = std::filesystem;

constexpr int width = 160, height = 90, frames_a_second = 24;

fs::path folder() { return fs::path(PENUMBRA_ROOT) / "tests/image/golden"; }
fs::path results() { return PENUMBRA_GOLDEN_RESULTS; }
fs::path file_of(const Golden& golden) { return folder() / (std::string(golden.name) + ".png"); }
fs::path record_file() { return folder() / "recorded_with.txt"; }

bool recording() {
  const char* wish = std::getenv("PENUMBRA_GOLDENS");
  return wish != nullptr && std::string(wish) == "record";
}

// "llvmpipe (LLVM 15.0.6), Mesa 22.3.6": without the width of the processor's registers, which decides no pixel.
std::string renderer_version() {
  const gl::DeviceInfo info = gl::device_info();
  std::smatch mesa;
  const bool is_mesa = std::regex_search(info.version, mesa, std::regex("Mesa [0-9.]+"));
  return std::regex_replace(info.renderer, std::regex(", [0-9]+ bits"), "") + ", " +
         (is_mesa ? mesa.str() : info.version);
}

std::string recorded_version() {
  std::ifstream file(record_file());
  std::string line;
  std::getline(file, line);
  return line;
}

// The tolerance on this renderer; none if the goldens have none for it.
std::optional<Tolerance> tolerance_here(const Golden& golden) {
  if (renderer_version() == recorded_version()) return *golden.tolerance;
  if (!gl::device_info().software) return {};
  return Tolerance{16, 0.05, "another version than that which recorded them rasterises and rounds differently"};
}

struct Bytes {
  int channels = 1;
  std::vector<std::uint8_t> pixels;  // rows top to bottom
};

// What all goldens share. Scenes stay read, and programs compiled, from one to the next.
class GoldenRenderer {
 public:
  ParamSet params_of(const Golden& golden) const {
    ParamSet params(render::Renderer::params(registry_));
    registry_.select(params, golden.technique);
    for (const char* setting : golden.settings) params.assign(setting);
    return params;
  }

  Bytes draw(const Golden& golden) {
    Loaded& loaded = load(golden.scene);
    const ParamSet params = params_of(golden);
    for (int i = 0; i < golden.frames; ++i) {
      const double time = static_cast<double>(i) / frames_a_second;
      renderer_.draw(*loaded.gpu,
                     {.width = width,
                      .height = height,
                      .camera = loaded.setup.camera,
                      .last_camera = loaded.setup.camera,
                      .lights = {loaded.setup.sun},
                      .time = time,
                      .last_time = i == 0 ? time : time - 1.0 / frames_a_second,
                      .cut = i == 0},
                     params);
    }
    return to_bytes(golden, renderer_.read_aov(golden.aov));
  }

 private:
  struct Loaded {
    scene::Scene scene;
    render::Setup setup;
    std::optional<scene::GpuScene> gpu;
  };

  Loaded& load(const std::string& name) {
    const auto found = scenes_.find(name);
    if (found != scenes_.end()) return found->second;
    Loaded& loaded = scenes_[name];
    loaded.scene = scene::read_gltf(fs::path(PENUMBRA_ROOT) / "scenes" / (name + ".glb"), image::image_decoder());
    constexpr float aspect = static_cast<float>(width) / height;
    loaded.setup = render::choose_setup(loaded.scene, scene::pose_at(loaded.scene, 0), {.aspect = aspect});
    loaded.gpu.emplace(device_, loaded.scene);
    return loaded;
  }

  static Bytes to_bytes(const Golden& golden, const std::vector<float>& values) {
    const std::size_t channels = values.size() / (width * height);
    Bytes bytes{.channels = channels == 1 ? 1 : 3, .pixels = {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float share = (values[i] - golden.black) / (golden.white - golden.black);
      bytes.pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f))));
      if (channels == 2 && i % 2 == 1) bytes.pixels.push_back(0);  // PNG has no two channels without alpha
    }
    return bytes;
  }

  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  std::map<std::string, Loaded> scenes_;
  truth::TruthTechnique truth_{{.cache = {}}};
  shadow::Registry registry_ = truth_.registry();
  render::Renderer renderer_{device_, registry_};
};

Bytes read(const fs::path& path) {
  const image::Picture picture = image::read_picture(path);
  Bytes bytes{.channels = static_cast<int>(picture.channels.size()), .pixels = {}};
  for (const float value : picture.pixels) bytes.pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
  return bytes;
}

// Of each pixel: the greatest difference of a channel.
std::vector<int> differences(const Bytes& a, const Bytes& b) {
  std::vector<int> result(static_cast<std::size_t>(width) * height);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    int& greatest = result[i / static_cast<std::size_t>(a.channels)];
    greatest = std::max(greatest, std::abs(a.pixels[i] - b.pixels[i]));
  }
  return result;
}

// False colour: black for none, the brightest for 32 of 255 and more.
Bytes false_color(const std::vector<int>& differences) {
  Bytes picture{.channels = 3, .pixels = {}};
  for (const int difference : differences) {
    const std::array<std::uint8_t, 3> color = metrics::heat_color(static_cast<float>(difference) / 32);
    picture.pixels.insert(picture.pixels.end(), color.begin(), color.end());
  }
  return picture;
}

void write(const fs::path& path, const Bytes& bytes, int columns = width) {
  image::write_png(path, columns, height, bytes.channels, bytes.pixels);
}

Bytes side_by_side(const std::array<Bytes, 3>& pictures) {
  Bytes all{.channels = 3, .pixels = {}};
  for (std::size_t y = 0; y < height; ++y) {
    for (const Bytes& picture : pictures) {
      const auto channels = static_cast<std::size_t>(picture.channels);
      for (std::size_t i = y * width * 3; i < (y + 1) * width * 3; ++i)
        all.pixels.push_back(picture.pixels[i / 3 * channels + (channels == 3 ? i % 3 : 0)]);
    }
  }
  return all;
}

std::string command_of(const Golden& golden) {
  std::string command = fmt::format("build/release/penumbra render scenes/{}.glb --size {}x{} --technique {}",
                                    golden.scene, width, height, golden.technique);
  for (const char* setting : golden.settings) command += fmt::format(" --set {}", setting);
  if (golden.frames > 1) command += fmt::format(" --frames 0:{} --fps {}", golden.frames - 1, frames_a_second);
  return command + fmt::format(" --aov {} -o {}.exr", golden.aov, golden.name);
}

// Writes what is needed to judge a failed golden, and says how to see it.
std::string report(const Golden& golden, const Bytes& picture, const Bytes& reference,
                   const std::vector<int>& difference) {
  fs::create_directories(results());
  const std::string base = (results() / golden.name).string();
  const Bytes colored = false_color(difference);
  write(base + "_picture.png", picture);
  write(base + "_reference.png", reference);
  write(base + "_difference.png", colored);
  write(base + ".png", side_by_side({picture, reference, colored}), 3 * width);
  return fmt::format(
      "picture, reference and difference (brightest: 32 of 255) are {0}_picture.png, …_reference.png and "
      "…_difference.png\n  see them side by side: xdg-open {0}.png\n  draw it by:            {1}\n"
      "  if it is right:        scripts/goldens.sh {2}",
      base, command_of(golden), golden.name);
}

class GoldenPictures : public GpuTest, public testing::WithParamInterface<Golden> {
 protected:
  GoldenPictures() {
    if (renderer_) return;
    renderer_ = std::make_unique<GoldenRenderer>();
    if (recording()) {
      fs::create_directories(folder());
      std::ofstream(record_file()) << renderer_version() << "\n";
    }
    const bool same = renderer_version() == recorded_version();
    if (!same) fmt::print("the golden pictures are of {}; this is {}\n", recorded_version(), renderer_version());
  }
  static void TearDownTestSuite() { renderer_.reset(); }

  static inline std::unique_ptr<GoldenRenderer> renderer_;
};

TEST_P(GoldenPictures, IsAsRecorded) {
  const Golden& golden = GetParam();
  const std::optional<Tolerance> tolerance = tolerance_here(golden);
  if (!tolerance) GTEST_SKIP() << "skipped: golden pictures are of a software renderer, this is " << renderer_version();
  const Bytes picture = renderer_->draw(golden);
  if (recording()) {
    write(file_of(golden), picture);
    return;
  }
  ASSERT_TRUE(fs::exists(file_of(golden))) << file_of(golden) << " is missing; scripts/goldens.sh " << golden.name;
  const Bytes reference = read(file_of(golden));
  ASSERT_EQ(picture.channels, reference.channels);
  ASSERT_EQ(picture.pixels.size(), reference.pixels.size());
  const std::vector<int> difference = differences(picture, reference);
  const auto off = std::ranges::count_if(difference, [&](int steps) { return steps > tolerance->steps; });
  EXPECT_LE(static_cast<double>(off), tolerance->share * width * height)
      << off << " pixels differ by more than " << tolerance->steps << " of 255, at most "
      << *std::ranges::max_element(difference) << " (" << tolerance->reason << ")\n"
      << report(golden, picture, reference, difference);
}

INSTANTIATE_TEST_SUITE_P(All, GoldenPictures, testing::ValuesIn(goldens().begin(), goldens().end()),
                         [](const auto& golden) { return std::string(golden.param.name); });

// The scenes on which a golden of this technique or preset shows the AOV "shadow".
std::size_t scenes_of_technique(const std::string& name) {
  std::set<std::string> scenes;
  for (const Golden& golden : goldens()) {
    if (golden.technique == name && golden.aov == std::string("shadow")) scenes.insert(golden.scene);
  }
  return scenes.size();
}

// The scenes on which a golden is denoised with this setting, by itself or by its preset.
std::size_t scenes_with(const shadow::Registry& registry, const std::string& param, const std::string& word) {
  std::set<std::string> scenes;
  for (const Golden& golden : goldens()) {
    ParamSet params(render::Renderer::params(registry));
    registry.select(params, golden.technique);
    for (const char* setting : golden.settings) params.assign(setting);
    const shadow::Denoiser* denoiser = registry.find_denoiser(params.get_word("denoiser"));
    const bool denoised = denoiser != nullptr && (!denoiser->applies || denoiser->applies(params));
    if (denoised && params.get_word(param) == word) scenes.insert(golden.scene);
  }
  return scenes.size();
}

TEST(Goldens, EachTechniqueAndPresetHasTwoScenes) {
  const truth::TruthTechnique truth{{.cache = {}}};
  for (const std::string& name : truth.registry().names())
    EXPECT_GE(scenes_of_technique(name), 2U) << name << " lacks golden pictures: add lines to tests/image/goldens.cpp";
}

TEST(Goldens, EachFilterHasOne) {
  const truth::TruthTechnique truth{{.cache = {}}};
  const shadow::Registry registry = truth.registry();
  for (const shadow::Filter& filter : registry.filters()) {
    const char* param = filter.of == shadow::Filter::Of::penumbra ? "filter.penumbra" : "filter.visibility";
    EXPECT_GE(scenes_with(registry, param, filter.name), 1U) << filter.name << " lacks a golden picture";
  }
}

TEST(Goldens, EachDenoiserHasTwoScenes) {
  const truth::TruthTechnique truth{{.cache = {}}};
  const shadow::Registry registry = truth.registry();
  for (const shadow::Denoiser& denoiser : registry.denoisers()) {
    EXPECT_GE(scenes_with(registry, "denoiser", denoiser.name), 2U)
        << denoiser.name << " lacks golden pictures: add lines to tests/image/goldens.cpp";
  }
}

TEST(Goldens, EachAovHasOne) {
  for (const render::Aov& aov : render::aovs()) {
    EXPECT_TRUE(std::ranges::any_of(goldens(), [&](const Golden& golden) { return golden.aov == aov.name; }))
        << aov.name << " lacks a golden picture: add a line to tests/image/goldens.cpp";
  }
}

TEST(Goldens, EachFileHasALineAndShowsSomething) {
  std::set<std::string> names;
  for (const Golden& golden : goldens()) EXPECT_TRUE(names.insert(golden.name).second) << golden.name << " twice";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() != ".png") continue;
    const std::string name = entry.path().stem();
    EXPECT_TRUE(names.contains(name)) << entry.path() << " is of no line in tests/image/goldens.cpp: delete it";
    const Bytes bytes = read(entry.path());
    const auto [least, most] = std::ranges::minmax_element(bytes.pixels);
    EXPECT_TRUE(*least < *most || name.starts_with("none_")) << name << " is of one grey";
  }
}

}  // namespace
}  // namespace penumbra::test
