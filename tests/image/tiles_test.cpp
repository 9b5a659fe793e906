// mask.tiles spares work where no penumbra is, and misses no penumbra.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "image/scene_run.h"
#include "image/tiles_run.h"

namespace penumbra::test {
namespace {

// Those for which tiles are decided.
constexpr std::array techniques{"pcss", "slices"};

class Tiles : public TilesTest {};

TEST_F(Tiles, DecideMostPixelsAndMissNoPenumbra) {
  settings_ = {"cascades.size=1024"};
  for (const char* scene : {"posts", "foliage", "fence", "steps", "courtyard", "thesis"}) {
    SCOPED_TRACE(scene);
    load(scene, 320, 180);
    for (const float angle : {0.0f, 0.53f, 2.0f, 8.0f}) {
      for (const char* technique : techniques) expect_no_penumbra_is_missed(technique, angle);
    }
  }
  settings_ = {};
  load("posts", 640, 360);
  EXPECT_GT(expect_no_penumbra_is_missed("pcss", 0.53f), 0.6);
}

TEST_F(Tiles, AreTheSameInBothDrivers) {
  for (const auto& [width, height] : {std::pair(320, 180), {97, 61}}) {
    for (const char* scene : {"foliage", "posts", "courtyard"}) {
      SCOPED_TRACE(fmt::format("{} {} x {}", scene, width, height));
      load(scene, width, height);
      for (const char* technique : {"pcss", "slices_denoised"}) {
        settings_ = {"driver=fragment"};
        mask(renderer_, technique, 2.0f, true);
        const std::vector<std::vector<float>> fragment = read_all(aovs);
        settings_ = {"driver=compute"};
        mask(renderer_, technique, 2.0f, true);
        for (std::size_t i = 0; i < aovs.size(); ++i)
          EXPECT_EQ(fragment[i], renderer_.read_aov(aovs.at(i))) << technique << ", " << aovs.at(i);
      }
    }
  }
}

// Receivers are shifted by several texels before they are compared with the map.
TEST_F(Tiles, MissNoPenumbraWithANormalOffset) {
  settings_ = {"bias.normal_offset=4"};
  for (const char* scene : {"posts", "courtyard"}) {
    SCOPED_TRACE(scene);
    load(scene, 320, 180);
    for (const float angle : {0.0f, 0.53f}) {
      for (const char* technique : techniques) expect_no_penumbra_is_missed(technique, angle);
    }
  }
}

TEST_F(Tiles, MissNoPenumbraOfASquareSun) {
  settings_ = {"sun.shape=square"};
  for (const char* scene : {"posts", "courtyard"}) {
    SCOPED_TRACE(scene);
    load(scene, 320, 180);
    for (const float angle : {0.53f, 4.0f}) {
      for (const char* technique : techniques) expect_no_penumbra_is_missed(technique, angle);
    }
  }
}

// Cascades so coarse that two of them differ where a tile's receivers read both, at a wide seam.
TEST_F(Tiles, MissNoPenumbraAtSeams) {
  for (const char* seam : {"none", "fade", "dither"}) {
    for (const auto& [scene, size] : {std::pair("posts", 128), {"courtyard", 512}}) {
      settings_ = {fmt::format("cascades.seam={}", seam), "cascades.blend=0.5", fmt::format("cascades.size={}", size)};
      SCOPED_TRACE(fmt::format("{}, {}", scene, settings_[0]));
      load(scene, 320, 180);
      for (const char* technique : techniques) expect_no_penumbra_is_missed(technique, 2.0f);
    }
  }
}

// Sheets a few millimetres above what they shadow: finer layers show contacts that coarser ones do not.
TEST_F(Tiles, MissNoContactWhereReceiversReadAFinerLayer) {
  for (const char* settings : {"cascades.size=256", "bias.normal_offset=4"}) {
    SCOPED_TRACE(settings);
    settings_ = {settings};
    load("coincident", 160, 96);
    for (const char* technique : techniques) expect_no_penumbra_is_missed(technique, 2.0f);
  }
}

TEST_F(Tiles, OfEachLightAreItsOwn) {
  load("courtyard", 160, 90);
  settings_ = {"cascades.size=512"};
  const std::vector<render::FrameLight> suns{render::SunLight{.to_light = render::direction_to(2.0f, 0.9f)},
                                             render::SunLight{.to_light = render::direction_to(4.0f, 0.6f)}};
  for (const char* technique : {"pcss", "pcss_compute", "thesis_8x8", "thesis_8x8_compute"}) {
    SCOPED_TRACE(technique);
    std::vector<std::vector<float>> alone;
    for (const render::FrameLight& sun : suns) {
      lights_ = {sun};
      mask(renderer_, technique, 2.0f, true);
      alone.push_back(layers()[0]);
    }
    lights_ = suns;
    mask(renderer_, technique, 2.0f, true);
    EXPECT_EQ(layers(), alone);
    EXPECT_NE(alone[0], alone[1]);
  }
}

// A denoiser reads the blocker distances of decided pixels too.
TEST_F(Tiles, LeaveDenoisedMasksAsTheyAre) {
  for (const char* scene : {"courtyard", "foliage"}) {
    SCOPED_TRACE(scene);
    load(scene, 320, 180);
    for (const char* technique : {"thesis", "thesis_8x8", "thesis_compute", "slices_denoised"}) {
      SCOPED_TRACE(technique);
      const std::vector<float> with = mask(renderer_, technique, 2.0f, true);
      const std::vector<float> without = mask(renderer_, technique, 2.0f, false);
      double squares = 0;
      for (std::size_t i = 0; i < with.size(); ++i) squares += std::pow(with[i] - without[i], 2);
      EXPECT_LT(std::sqrt(squares / static_cast<double>(with.size())), 0.002);
    }
  }
}

// The share of pixels that differ by more than 1/255.
double share_apart(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) apart += std::abs(a[i] - b[i]) > 1.0f / 255 ? 1 : 0;
  return static_cast<double>(apart) / static_cast<double>(a.size());
}

// The history of decided pixels is kept, blended and refused like that of the others, while casters and camera move.
TEST_F(Tiles, KeepTheHistoryAsItIs) {
  SceneRun with("moving", 320, 180), without("moving", 320, 180);
  for (const char* technique : {"thesis", "thesis_8x8_compute"}) {
    with.choose(technique);
    without.choose(technique);
    without.params().set("mask.tiles", false);
    for (SceneRun* run : {&with, &without}) run->params().set("cascades.size", 1024);
    for (int frame = 0; frame < 6; ++frame) {
      SCOPED_TRACE(fmt::format("{}, frame {}", technique, frame));
      const Visibility a = with.draw(/*cut=*/frame == 0), b = without.draw(/*cut=*/frame == 0);
      EXPECT_LT(share_apart(a, b), 0.002);
      EXPECT_LT(share_apart(with.read_aov("history"), without.read_aov("history")), 0.02);
      for (SceneRun* run : {&with, &without}) {
        run->time() += 1 / 30.0;
        run->camera().view = glm::translate(run->camera().view, glm::vec3(0.01f, 0, 0));
      }
    }
  }
}

// Filters leave out tiles without a blocker near, except compute shaders that share what they read: these run for all
// pixels, as all filters do in pictures smaller than a tile.
TEST_F(Tiles, AreLeftOutByFiltersThatWouldNotChangeThem) {
  load("posts", 317, 179);
  for (const char* filter : {"none", "box", "gaussian", "bilateral_separable"}) {
    SCOPED_TRACE(filter);
    settings_ = {fmt::format("filter.visibility={}", filter), "cascades.size=512"};
    mask(renderer_, "thesis_8x8", 4.0f, true);
    const std::vector<std::vector<float>> fragment = layers();
    mask(renderer_, "thesis_8x8_compute", 4.0f, true);
    EXPECT_EQ(fragment, layers());
  }
  // Of a technique that knows no blocker distance, too.
  for (const char* technique : {"hard", "pcf_hardware", "pcss"}) {
    SCOPED_TRACE(technique);
    settings_ = {"filter.visibility=median_visibility", "cascades.size=256", "driver=fragment"};
    mask(renderer_, technique, 4.0f, true);
    const std::vector<std::vector<float>> fragment = layers();
    settings_.back() = "driver=compute";
    mask(renderer_, technique, 4.0f, true);
    EXPECT_EQ(fragment, layers());
    settings_.front() = "filter.visibility=none";
    mask(renderer_, technique, 4.0f, true);
    EXPECT_NE(fragment, layers());
  }
  for (const auto& [width, height] : {std::pair(3, 3), {2, 16}, {1, 1}}) {
    SCOPED_TRACE(fmt::format("{} x {}", width, height));
    load("thesis", width, height);
    settings_ = {"filter.visibility=gaussian"};
    mask(renderer_, "thesis_8x8", 8.0f, true);
    const std::vector<std::vector<float>> fragment = layers();
    mask(renderer_, "thesis_8x8_compute", 8.0f, true);
    EXPECT_EQ(fragment, layers());
  }
}

// A list of tiles that holds all of them.
constexpr const char* lists_all = R"(
#include "shared/shadow_block.h"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"
layout(std140, binding = 1) uniform ShadowData { ShadowBlock shadow; };
layout(local_size_x = 8, local_size_y = 8) in;
void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(tile * tile_size, ivec2(shadow.viewport.zw)))) list_tile(tile);
}
)";

// A technique that draws a scene twice: as it does, and with filters that run for all tiles.
struct FilteredRuns {
  std::string name;
  SceneRun run, reference;

  FilteredRuns(const std::string& technique, const std::string& scene, const std::vector<std::string>& settings)
      : name(technique + ", " + scene), run(scene, 203, 117), reference(scene, 203, 117) {
    reference.device().shaders.files().put("shadow/drivers/filter_tiles.comp", lists_all);
    for (SceneRun* each : {&run, &reference}) {
      each->choose(technique);
      each->params().set("cascades.size", 512);
      for (const std::string& setting : settings) each->params().assign(setting);
    }
  }

  void expect_same(const std::string& what) { EXPECT_EQ(run.draw(), reference.draw()) << name << ", " << what; }
};

// The same for every kind of technique, history and scale.
TEST_F(Tiles, ThatFiltersLeaveOutKeepEveryBit) {
  struct Case {
    const char *technique, *scene;
    std::vector<std::string> settings;
  };
  for (const auto& [technique, scene, settings] :
       {Case{"hybrid_denoised", "posts", {}}, Case{"hybrid_denoised", "posts", {"driver=compute"}},
        Case{"hybrid", "posts", {"filter.penumbra=median", "filter.visibility=bilateral"}},
        Case{"slices_denoised", "moving", {"filter.penumbra=median", "history.reuse=true", "history.mean=true"}},
        Case{"slices_denoised", "foliage", {"filter.penumbra=median"}},
        Case{"slices_denoised", "moving", {"filter.penumbra=median", "history.reuse=true"}},
        Case{"slices_denoised", "foliage", {"mask.scale=3"}}, Case{"thesis", "moving", {}},
        Case{"ssss", "posts", {"filter.visibility=gaussian"}},
        Case{"vssm", "posts", {"filter.penumbra=median", "filter.visibility=box", "mask.tiles=false"}}}) {
    FilteredRuns runs(technique, scene, settings);
    for (const float angle : {4.0f, 0.53f}) {
      for (SceneRun* each : {&runs.run, &runs.reference}) each->params().set("sun.angle", angle);
      for (int frame = 0; frame < 3; ++frame) {
        runs.expect_same(fmt::format("{} degrees, frame {}", angle, frame));
        for (SceneRun* each : {&runs.run, &runs.reference}) each->time() += 1 / 30.0;
      }
    }
  }
}

// Kernels about as wide as the narrowest that does anything, under every filter, seen by every kind of camera.
TEST_F(Tiles, ThatFiltersLeaveOutHaveNoKernel) {
  struct Case {
    const char *filter, *driver;
  };
  for (const auto& [filter, driver] :
       {Case{"box", "fragment"}, Case{"gaussian", "fragment"}, Case{"bilateral", "fragment"},
        Case{"bilateral_separable", "fragment"}, Case{"isophote", "fragment"}, Case{"bilateral", "compute"},
        Case{"isophote", "compute"}}) {
    for (const char* scene : {"courtyard", "fence"}) {
      FilteredRuns runs("slices_denoised", scene,
                        {fmt::format("filter.visibility={}", filter), fmt::format("driver={}", driver)});
      for (const int camera : {0, 1, 2}) {
        for (SceneRun* each : {&runs.run, &runs.reference}) {
          each->camera().fov_y = camera == 0 ? 0.8f : 2.2f;
          each->camera().orthographic = camera == 2;
          each->camera().half_height = 4;
        }
        for (const float angle : {0.2f, 0.53f, 1.0f, 2.0f}) {
          for (SceneRun* each : {&runs.run, &runs.reference}) each->params().set("sun.angle", angle);
          runs.expect_same(fmt::format("{}, camera {}, {} degrees", filter, camera, angle));
        }
      }
    }
  }
}

TEST_F(Tiles, ThatFiltersLeaveOutHaveNoKernelUnderLamps) {
  for (const char* scene : {"posts", "fence"}) {
    FilteredRuns runs("slices_denoised", scene, {});
    for (const float radius : {0.002f, 0.01f, 0.05f}) {
      for (SceneRun* each : {&runs.run, &runs.reference})
        each->shine(render::LampLight{.position = {0.3f, 2.0f, 0.6f}, .radius = radius});
      runs.expect_same(fmt::format("lamp of {} m", radius));
    }
  }
}

// Under the real sun most penumbrae of a scene are narrower than a pixel's kernel.
TEST_F(Tiles, AreFilteredOnlyWhereTheyCanChange) {
  SceneRun run("posts", 640, 360);
  run.device().shaders.files().put("shadow/filters/isophote.glsl",
                                   "#include \"shadow/drivers/filter.glsl\"\n"
                                   "uint filtered(ivec2 pixel) { return with_visibility(texel_at(pixel), 0.5); }\n");
  const auto share_filtered = [&](float angle, int filter_radius) {
    run.choose("slices_denoised");
    run.params().set("sun.angle", angle);
    run.params().set("slices.filter_radius", filter_radius);
    const Visibility picture = run.draw();
    const auto near_half = [](float visibility) { return std::abs(visibility - 0.5f) < 1e-3f; };
    return static_cast<double>(std::ranges::count_if(picture, near_half)) / static_cast<double>(picture.size());
  };
  const double real_sun = share_filtered(0.53f, 0), wide_sun = share_filtered(8.0f, 0);
  EXPECT_GT(real_sun, 0.01);
  EXPECT_LT(real_sun, 0.1);
  EXPECT_GT(wide_sun, 2 * real_sun);
  // Filtered texels have no noise.
  const double of_few_texels = share_filtered(0.53f, 8);
  EXPECT_GT(of_few_texels, 0);
  EXPECT_LT(of_few_texels, 0.7 * real_sun);
}

// Masks of visibility alone fill decided tiles in a shorter way.
TEST_F(Tiles, AreFilteredAlikeWhetherTheMaskHasDetails) {
  for (const char* technique : {"slices_denoised", "slices_sparse", "thesis_8x8", "thesis", "thesis_8x8_compute"}) {
    for (const char* scene : {"posts", "foliage"}) {
      SceneRun run(scene, 203, 117);
      run.choose(technique);
      for (const float angle : {0.53f, 4.0f}) {
        run.params().set("sun.angle", angle);
        run.set_details(true);
        const Visibility with = run.draw(/*cut=*/true);
        run.set_details(false);
        EXPECT_EQ(with, run.draw(/*cut=*/true)) << technique << ", " << scene << ", " << angle << " degrees";
      }
    }
  }
}

// Sizes at which the last tiles are cut off, and pictures smaller than a tile.
TEST_F(Tiles, CoverPicturesOfAnySize) {
  for (const auto& [width, height] : {std::pair(97, 61), {8, 8}, {9, 3}, {1, 1}}) {
    SCOPED_TRACE(fmt::format("{} x {}", width, height));
    load("posts", width, height);
    for (const char* technique : {"pcss", "pcss_compute"}) expect_no_penumbra_is_missed(technique, 2.0f);
  }
}

}  // namespace
}  // namespace penumbra::test
