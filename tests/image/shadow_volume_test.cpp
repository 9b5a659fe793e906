// The technique shadow_volume is the shadow of the sun's centre: the same as by rays, in every scene, ours and third
// parties', as `penumbra render` shows it without options. Third parties' scenes are those below
// $PENUMBRA_ASSETS/scenes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "gpu/gpu_test.h"
#include "image/read.h"
#include "image/sun_rays.h"
#include "render/receivers.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/pose.h"
#include "scene/scene_info.h"

namespace penumbra::test {
namespace {

namespace fs = std::filesystem;

constexpr int width = 320, height = 180;

// Receivers of a picture that differ from rays.
struct Differences {
  int receivers = 0, darker = 0, brighter = 0;
  // Of these, pixels more than a pixel from any edge.
  int off_edges = 0;
  // Pixels that are bright only because what shadows them lies within the technique's tolerance (docs/techniques.md,
  // shadow volumes, step 4). They are none of the above.
  int coincident = 0;

  double share() const { return static_cast<double>(darker + brighter) / std::max(receivers, 1); }
  Differences& operator+=(const Differences& other) {
    receivers += other.receivers;
    darker += other.darker;
    brighter += other.brighter;
    off_edges += other.off_edges;
    coincident += other.coincident;
    return *this;
  }
};

void print(const std::string& name, const Differences& d) {
  std::printf("%-52s %9d %6d %8d %9d %10d %9.4f %%\n", name.c_str(), d.receivers, d.darker, d.brighter, d.off_edges,
              d.coincident, 100 * d.share());
}

// All scenes of a folder together.
struct Summary {
  int scenes = 0, without_receivers = 0, refused = 0;
  Differences sum;
};

// Third parties' scenes with more triangles need not be right at every pixel that is not an edge.
constexpr std::size_t most_triangles = 100'000;
// glsl/shadow/techniques/shadow_volume_receivers.frag
const double tolerance = std::ldexp(1.0, -21);

class ShadowVolumeImage : public GpuTest {
 protected:
  struct Shown {
    Differences whole;  // masked casters counted as whole triangles, and blended ones not at all
    int brighter = 0;   // receivers that are brighter than by rays that see alpha
    bool masked = false, blended = false;
    std::size_t triangles = 0;
  };

  Shown show(const fs::path& path, double time = 0);
  void expect_rays(const fs::path& path, const std::string& name, Summary& summary, double time = 0);
  void expect_rays_below(const fs::path& folder);

 private:
  Differences compare(const std::vector<float>& picture, const std::vector<std::uint8_t>& receivers) const;

  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  SunRays rays_;
  render::Renderer renderer_{device_, rays_.registry()};
  ParamSet params_{render::Renderer::params(renderer_.registry())};
};

Differences ShadowVolumeImage::compare(const std::vector<float>& picture,
                                       const std::vector<std::uint8_t>& receivers) const {
  const std::vector<bool> lit = rays_.lit();
  Differences result;
  std::vector<glm::ivec2> different;
  std::vector<bool> too_dark;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      if (receivers[i] == 0) continue;
      ++result.receivers;
      if ((picture[i] > 0.5f) == lit[i]) continue;
      different.emplace_back(x, y);
      too_dark.push_back(lit[i]);
    }
  }
  const std::vector<bool> edges = rays_.edges(different);
  const std::vector<bool> lit_off_surface = rays_.lit_off_surface(different, tolerance);
  for (std::size_t i = 0; i < different.size(); ++i) {
    if (lit_off_surface[i] && !too_dark[i]) {
      ++result.coincident;
      continue;
    }
    ++(too_dark[i] ? result.darker : result.brighter);
    result.off_edges += edges[i] ? 0 : 1;
  }
  return result;
}

ShadowVolumeImage::Shown ShadowVolumeImage::show(const fs::path& path, double time) {
  scene::Scene scene = scene::read_gltf(path, image::image_decoder());
  const scene::Pose pose = scene::pose_at(scene, time);
  const render::Setup setup = render::choose_setup(scene, pose);
  if (setup.ground) render::add_ground(scene, scene::bounds_of(scene, pose));
  scene::GpuScene gpu_scene(device_, scene);
  params_.set("cascades.size", 16);  // blended surfaces get maps
  const auto draw = [&](const char* technique) {
    params_.set("technique", std::string(technique));
    renderer_.draw(gpu_scene,
                   {.width = width,
                    .height = height,
                    .camera = setup.camera,
                    .last_camera = setup.camera,
                    .lights = {setup.sun},
                    .time = time,
                    .last_time = time,
                    .cut = true},
                   params_);
  };
  draw("shadow_volume");
  const std::vector<float> picture = renderer_.read_aov("shadow");
  rays_.set_alpha(SunRays::Alpha::as_volumes);
  draw("sun_rays");
  ParamSet point = params_;
  point.set("sun.angle", 0.0f);
  const std::vector<std::uint8_t> receivers = render::receivers_of(renderer_, setup.sun, point);
  Shown shown{.whole = compare(picture, receivers),
              .masked = rays_.masked_casters(),
              .blended = rays_.blended_casters(),
              .triangles = scene::describe(scene).triangles};
  if (shown.masked) {
    rays_.set_alpha(SunRays::Alpha::part);
    draw("sun_rays");
    shown.brighter = compare(picture, receivers).brighter;
  }
  return shown;
}

void ShadowVolumeImage::expect_rays(const fs::path& path, const std::string& name, Summary& summary, double time) {
  SCOPED_TRACE(name);
  const Shown shown = show(path, time);
  print(name + (shown.masked ? " (mask)" : "") + (shown.blended ? " (blend)" : ""), shown.whole);
  ++summary.scenes;
  summary.without_receivers += shown.whole.receivers == 0 ? 1 : 0;
  // Where the rasteriser rounds vertices, receivers lie beside their surfaces, and the technique's bias is as wide. On
  // an NVIDIA H200 the most of 13 scenes was 0.139 % of the receivers, in `fence`, and one receiver off edges, in
  // `courtyard`, was the only one.
  const bool exact = device_.vertex_rounding() == 0;
  EXPECT_LE(shown.whole.share(), exact ? 0.001 : 0.002);
  if (!shown.blended) {
    EXPECT_LE(shown.brighter, 0.001 * shown.whole.receivers) << "brighter than what alpha leaves";
  }
  if (shown.triangles >= most_triangles) {
    std::printf("  of %zu triangles: not counted below\n", shown.triangles);
    return;
  }
  EXPECT_LE(shown.whole.off_edges, exact ? 0 : std::max(1 - summary.sum.off_edges, 0))
      << "with 1 in all scenes together";
  summary.sum += shown.whole;
}

void ShadowVolumeImage::expect_rays_below(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".glb" || extension == ".gltf") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  ASSERT_FALSE(paths.empty()) << folder;
  std::printf("%-52s %9s %6s %8s %9s %10s\n", "scene", "receivers", "darker", "brighter", "off edges", "coincident");
  Summary summary;
  for (const fs::path& path : paths) {
    try {
      expect_rays(path, fs::relative(path, folder).replace_extension().string(), summary);
    } catch (const Error& error) {
      std::printf("refused: %s\n", error.what());
      ++summary.refused;
    }
  }
  print(fmt::format("{} scenes", summary.scenes), summary.sum);
  std::printf("%d without receivers, %d files refused\n", summary.without_receivers, summary.refused);
  EXPECT_LE(summary.refused, 1) << "one public file asks for a glTF version that is not there yet";
}

TEST_F(ShadowVolumeImage, IsTheSameAsByRaysInAllOurScenes) { expect_rays_below(PENUMBRA_ROOT "/scenes"); }

TEST_F(ShadowVolumeImage, IsTheSameAsByRaysInAllThirdPartiesScenes) {
  const char* assets = std::getenv("PENUMBRA_ASSETS");
  const fs::path folder = fs::path(assets == nullptr ? "" : assets) / "scenes";
  if (assets == nullptr || !fs::is_directory(folder)) {
    GTEST_SKIP() << "skipped: PENUMBRA_ASSETS names no folder with scenes";
  }
  expect_rays_below(folder);
}

TEST_F(ShadowVolumeImage, FollowsSkinsAndMorphTargets) {
  Summary summary;
  for (const double time : {0.4, 1.1, 2.3})
    expect_rays(PENUMBRA_ROOT "/scenes/moving.glb", fmt::format("moving at {} s", time), summary, time);
}

}  // namespace
}  // namespace penumbra::test
