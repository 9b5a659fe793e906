// A technique that uses every part of the contract, and denoisers and a recipe beside it: see planar_technique.h.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "gpu/gl_calls.h"
#include "gpu/gpu_test.h"
#include "gpu/planar_technique.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr int side = 64;  // pixels

// The share of a disc that lies beyond a line at a given distance from its centre.
float disc_share(float distance) {
  const float t = std::clamp(distance / planar_blur_radius, -1.0f, 1.0f);
  return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / std::numbers::pi_v<float>;
}

class ShadowContract : public GpuTest {
 protected:
  ShadowContract() : renderer(with_planar()), params(renderer.params()), scene(half_plane_over_ground(side)) {
    put_planar_shaders(renderer.device().shaders.files());
    scene.projection = orthographic(1.5f, 1.5f, 0.05f, 5);
    params.set("denoiser", std::string("none"));
    params.set("sampling.noise", std::string("white"));
    params.set("cascades.size", 16);
  }

  // The mean of each column of the next frame.
  std::vector<float> columns() {
    const Shadowed shadowed = renderer.render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = scene.view;
      inputs.view.last_projection = scene.projection;
    });
    std::vector<float> means(side, 0);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) means[static_cast<size_t>(x)] += shadowed.visibility(x, y) / side;
    }
    return means;
  }

  // The largest error of a column's mean.
  static float error(const std::vector<float>& columns) {
    float most = 0;
    for (int x = 0; x < side; ++x) {
      const float expected = disc_share(static_cast<float>(x) - 0.5f * static_cast<float>(side) + 0.5f);
      most = std::max(most, std::abs(columns[static_cast<size_t>(x)] - expected));
    }
    return most;
  }

  TriangleRenderer renderer;
  ParamSet params;
  TriangleScene scene;
};

TEST_F(ShadowContract, EveryPartTakesPartInThePicture) {
  for (const char* pattern : {"vogel", "hammersley"}) {
    params.set("planar.points", 64);
    params.set("sampling.filter_pattern", std::string(pattern));
    const std::vector<float> means = columns();
    EXPECT_LT(error(means), 0.04f) << pattern;
    EXPECT_EQ(means.front(), 0.0f);
    EXPECT_EQ(means.back(), 1.0f);
  }
  params.set("blur_radius.pixels", 1);
  const std::vector<float> sharp = columns();
  EXPECT_LT(sharp[side / 2 - 2], 0.01f);
  EXPECT_GT(sharp[side / 2 + 1], 0.99f);
}

TEST_F(ShadowContract, TheDenoiserFollowsATechniqueWithPassesOfItsOwn) {
  params.set("planar.points", 1);
  params.set("sampling.filter_pattern", std::string("uniform"));
  params.set("sampling.filter_sequence", std::string("shift"));
  params.set("sampling.scramble", std::string("shift"));
  const float noisy = error(columns());
  params.set("denoiser", std::string("averaging"));
  EXPECT_EQ(error(columns()), noisy) << "the mean of one frame";
  std::vector<float> means;
  for (int i = 0; i < 31; ++i) means = columns();
  EXPECT_LT(error(means), 0.05f);
  EXPECT_GT(noisy, 2 * error(means));
}

TEST_F(ShadowContract, TheBuiltInDenoiserFollowsItToo) {
  params.set("planar.points", 1);
  params.set("denoiser", std::string("history_and_filters"));
  params.set("history.reuse", true);
  columns();
  const shadow::LightFrame frame = renderer.mask().lights[0];
  ASSERT_NE(frame.notes, nullptr);
  columns();
  for (const unsigned note : gl::read_uints(*renderer.mask().lights[0].notes, 1)) ASSERT_EQ(note >> 5, 0u);
}

TEST_F(ShadowContract, AProductIsMadeOnceForAllThatAskAndGivenBackWithTheLast) {
  params.set("denoiser", std::string("averaging"));
  columns();
  planar_record().builds = 0;
  columns();
  EXPECT_EQ(planar_record().builds, 1);
  const std::size_t bytes = renderer.device().target_bytes("shadow");
  params.set("technique", std::string("none"));
  planar_record().builds = 0;
  columns();
  EXPECT_EQ(planar_record().builds, 1) << "for the denoiser";
  params.set("denoiser", std::string("none"));
  columns();
  EXPECT_EQ(planar_record().builds, 1) << "nobody asks";
  for (const gl::Device::NamedTarget& target : renderer.device().targets()) {
    for (const char* owner : {"techniques/", "recipes/", "denoisers/"}) {
      EXPECT_EQ(target.name.find(owner), std::string_view::npos) << target.name;
    }
  }
  params.set("technique", std::string("planar"));
  params.set("denoiser", std::string("averaging"));
  columns();
  EXPECT_EQ(renderer.device().target_bytes("shadow"), bytes);
}

TEST_F(ShadowContract, TargetsOfAFilterThatIsNoLongerChosenAreReleased) {
  const auto holds = [&](std::string_view name) {
    return std::ranges::any_of(renderer.device().targets(), [&](const gl::Device::NamedTarget& target) {
      return target.name.find(name) != std::string_view::npos;
    });
  };
  params.set("technique", std::string("pcss"));
  params.set("denoiser", std::string("history_and_filters"));
  params.set("filter.visibility", std::string("bilateral_separable"));
  columns();
  EXPECT_TRUE(holds("denoisers/history_and_filters/filter 0 bilateral_separable"));
  EXPECT_TRUE(holds("light 0/shadow map"));
  params.set("filter.visibility", std::string("box"));
  columns();
  EXPECT_FALSE(holds("bilateral_separable"));
  EXPECT_TRUE(holds("denoisers/history_and_filters/texels"));
  params.set("technique", std::string("none"));
  columns();
  EXPECT_FALSE(holds("light 0/shadow map"));
}

TEST_F(ShadowContract, CallbacksGetTheLightsSourceInEveryPass) {
  params.set("technique", std::string("pcss"));
  params.set("denoiser", std::string("history_and_filters"));
  params.set("history.reuse", true);
  std::set<shadow::CasterKind> kinds;
  const auto frame = [&](const char* technique) {
    params.set("technique", std::string(technique));
    renderer.render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = scene.view;
      inputs.view.last_projection = scene.projection;
      inputs.moved.reset();  // so that any caster may have moved
      const shadow::LightSource source = inputs.lights.front().source;
      inputs.draw = [&kinds, source, draw = inputs.draw](const shadow::CasterPass& casters, gl::Pass& pass) {
        kinds.insert(casters.kind);
        EXPECT_EQ(casters.source, source) << static_cast<int>(casters.kind);
        draw(casters, pass);
      };
    });
  };
  for (const char* present : {"own_pass", "shadow_pass"}) {
    params.set("movement.present", std::string(present));
    for (int i = 0; i < 2; ++i) frame("pcss");
  }
  frame("planar");
  EXPECT_EQ(kinds.size(), 5u);
}

TEST_F(ShadowContract, AFrameThatIsRefusedEndsTheHistory) {
  params.set("denoiser", std::string("averaging"));
  const auto frame = [&](bool refused) {
    renderer.render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = scene.view;
      inputs.view.last_projection = scene.projection;
      if (refused) inputs.normals.width = 1;
    });
  };
  frame(false);
  frame(false);
  EXPECT_TRUE(renderer.mask().lights[0].history);
  EXPECT_THROW(frame(true), Error);
  frame(false);
  EXPECT_FALSE(renderer.mask().lights[0].history);
}

TEST_F(ShadowContract, FiltersCanFollowEachOther) {
  params.set("technique", std::string("pcss"));
  params.set("denoiser", std::string("filters_twice"));
  columns();
  const std::set<const gl::Texture*> different(planar_record().filtered.begin(), planar_record().filtered.end());
  EXPECT_EQ(different.size(), 3u) << "no pass reads what it writes";
}

TEST_F(ShadowContract, TheCallersDepthIsDescribedOnce) {
  columns();
  const auto frame = [&] { renderer.render(scene, params, [&](shadow::Inputs& inputs) { inputs.view.cut = true; }); };
  frame();
  const GlCalls queries(GlCalls::Kind::queries);
  frame();
  const std::map<std::string, int> calls = queries.counts();
  for (const auto& [name, count] : calls) EXPECT_EQ(name.find("TextureLevelParameter"), std::string::npos) << name;
}

TEST_F(ShadowContract, HistoriesOfTechniquesThatReadCastersWithoutAShadowMapGetAMovementMap) {
  params.set("technique", std::string("planar_read"));
  params.set("denoiser", std::string("history_and_filters"));
  params.set("history.reuse", true);
  columns();
  EXPECT_NE(renderer.mask().lights[0].movement, nullptr);
}

TEST_F(ShadowContract, ParametersOfOthersDoNotEndADenoisersHistoryWhateverTheirNames) {
  params.set("denoiser", std::string("averaging"));
  params.set("planar.points", 1);
  const auto frames_seen = [&] {
    columns();
    float last_seen = 0;
    for (const gl::Device::NamedTarget& target : renderer.device().targets()) {
      if (target.name.find("history mean/") == std::string_view::npos) continue;
      last_seen = std::max(last_seen, gl::read_floats(*target.texture, 2)[1]);
    }
    return last_seen;
  };
  frames_seen();
  EXPECT_EQ(frames_seen(), 2);
  params.set("pcss.blocker_taps", 3);
  EXPECT_EQ(frames_seen(), 3) << "another technique's";
  params.set("history.alpha", 0.5f);
  EXPECT_EQ(frames_seen(), 4) << "another denoiser's";
  params.set("mean.most_frames", 500);
  frames_seen();
  EXPECT_EQ(frames_seen(), 2) << "its own";
  params.set("mean.most_frames", 2);
  for (int i = 0; i < 3; ++i) frames_seen();
  EXPECT_EQ(frames_seen(), 2) << "its own, as a constant of its program";
}

TEST_F(ShadowContract, EveryProgramIsListedForTheChecks) {
  const auto names_of = [](const std::vector<gl::ProgramDesc>& programs) {
    std::set<std::string> names;
    for (const gl::ProgramDesc& program : programs) names.insert(program.name);
    return names;
  };
  const std::vector<gl::ProgramDesc> programs = renderer.shadows().all_programs(params);
  const std::set<std::string> listed = names_of(programs);
  TriangleRenderer built_in;
  const std::set<std::string> known = names_of(built_in.shadows().all_programs(built_in.params()));
  int own = 0;
  for (gl::ProgramDesc program : programs) {
    if (known.contains(program.name)) continue;
    ++own;
    if (program.vertex.empty() && program.compute.empty()) program.vertex = "shared/full_screen.vert";
    EXPECT_NO_THROW(gl::Program(program, renderer.device().shaders.files())) << program.name;
  }
  EXPECT_GE(own, 6);
  for (const char* name : {"planar: ground", "planar: one", "planar: command", "planar: blur", "blur_radius: fill",
                           "averaging: mean", "least_depth_pyramid: base", "history_and_filters: blend"}) {
    EXPECT_TRUE(listed.contains(name)) << name;
  }
}

}  // namespace
}  // namespace penumbra::test
