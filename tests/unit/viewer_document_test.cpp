// The command line that the viewer gives makes `penumbra render` draw what the viewer shows.
#include "viewer/document.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <random>

#include "app/render/options.h"
#include "cli/command_line.h"
#include "cli/usage.h"
#include "core/error.h"
#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra {
namespace {

using viewer::Document;
using Arguments = std::vector<std::string>;

ParamSet defaults() { return ParamSet(render::Renderer::params(session::all_techniques())); }

// A scene as the viewer opens it. The viewer's document is always a sequence, whose first frame it shows.
Document plain() {
  Document document{.options = {}, .params = defaults()};
  document.options.scene = "a.glb";
  document.options.frames = cli::FrameRange{};
  return document;
}

// The options that `render` parses from the arguments.
struct Rendered {
  app::RenderOptions options;
  ParamSet params;
};

Rendered rendered(const Arguments& arguments) {
  EXPECT_EQ(arguments.front(), "render");
  CLI::App app;
  Rendered result;
  app::add_render_options(app, result.options);
  EXPECT_TRUE(cli::parse(app, {arguments.begin() + 1, arguments.end()}));
  app::check_together(result.options);
  result.params = app::params_of(result.options);
  return result;
}

void expect_same(const Document& document, const Rendered& render) {
  const cli::SceneOptions &shown = document.options, &drawn = render.options;
  EXPECT_EQ(drawn.scene, shown.scene);
  EXPECT_EQ(drawn.size.width, shown.size.width);
  EXPECT_EQ(drawn.size.height, shown.size.height);
  EXPECT_EQ(drawn.camera, shown.camera);
  EXPECT_EQ(drawn.eye, shown.eye);
  EXPECT_EQ(drawn.target, shown.target);
  EXPECT_EQ(drawn.fov, shown.fov);
  ASSERT_EQ(drawn.sun.has_value(), shown.sun.has_value());
  if (shown.sun) {
    EXPECT_EQ(drawn.sun->azimuth, shown.sun->azimuth);
    EXPECT_EQ(drawn.sun->elevation, shown.sun->elevation);
  }
  EXPECT_EQ(drawn.ground, shown.ground);
  EXPECT_EQ(drawn.samples, shown.samples);
  EXPECT_EQ(drawn.own_shadows, viewer::refines(document));
  const cli::FrameRange frames = drawn.frames.value_or(cli::FrameRange{});
  EXPECT_EQ(frames.count(), 1);
  EXPECT_EQ(session::time_of(drawn, frames.first), document.seconds());
  for (const Param& row : document.params.rows())
    EXPECT_EQ(render.params.value(row.name), document.params.value(row.name)) << row.name;
}

class ViewerDocument : public testing::Test {
 protected:
  template <class T>
  T in(T low, T high) {
    return std::uniform_real_distribution<T>(low, high)(random_);
  }
  int count(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool sometimes() { return count(0, 2) == 0; }
  glm::vec3 point() {
    const float far = std::pow(10.0f, in(-3.0f, 8.5f));
    return {in(-far, far), in(-far, far), in(-far, far)};
  }

  ParamSet any_params() {
    while (true) {
      ParamSet params = defaults();
      for (const Param& row : params.rows()) {
        if (sometimes()) params.set(row.name, any_value(row));
      }
      const long long size = params.get_int("cascades.size");
      if (size * size * params.get_int("cascades.count") <= cli::largest_maps) return params;
    }
  }

  Document any_document() {
    Document document = plain();
    document.params = any_params();
    if (sometimes()) document.frame = count(1, 999'999);
    cli::SceneOptions& options = document.options;
    options.scene = sometimes() ? "a folder/it's \"one\".glb" : "scene.gltf";
    options.size = {count(1, 2000), count(1, 2000)};
    options.ground = static_cast<render::GroundChoice>(count(0, 2));
    if (sometimes()) options.samples = count(1, render::max_samples);
    if (sometimes()) options.time = in(0.0, 1e6);
    if (sometimes()) options.fps = in(0.001, 240.0);
    if (sometimes()) options.fov = in(1.0, 179.0);
    if (sometimes()) viewer::place_sun(document, render::direction_to(in(-9.0f, 9.0f), in(-1.57f, 1.57f)));
    if (sometimes()) {
      options.eye = point();
      options.target = point();
    } else if (sometimes()) {
      static constexpr const char* names[] = {"-1", "--eye", "Camera 1", "[a,b]", "a=b", "\"q\"", "caf\u00e9", "{}"};
      options.camera = names[count(0, 7)];
    }
    return document;
  }

 private:
  ParamValue any_value(const Param& row) {
    if (std::holds_alternative<bool>(row.default_value)) return sometimes();
    if (std::holds_alternative<int>(row.default_value))
      return count(static_cast<int>(row.min), static_cast<int>(row.max));
    if (std::holds_alternative<float>(row.default_value))
      return in(static_cast<float>(row.min), static_cast<float>(row.max));
    return row.choices[static_cast<std::size_t>(count(0, static_cast<int>(row.choices.size()) - 1))];
  }

  std::mt19937 random_{11};
};

TEST(ViewerDocumentFrame, StepsToWhatRenderTakes) {
  Document document;
  document.step(-1);
  EXPECT_EQ(document.frame, 0);
  document.step(viewer::last_frame);
  EXPECT_EQ(document.frame, viewer::last_frame);
  EXPECT_NO_THROW(cli::parse_frames("--frames", fmt::format("0:{}", document.frame)));
  EXPECT_THROW(cli::parse_frames("--frames", fmt::format("0:{}", document.frame + 1)), Error);
  document.step(3);
  EXPECT_EQ(document.frame, 2);
}

TEST_F(ViewerDocument, RenderDrawsWhatIsShown) {
  for (int i = 0; i < 300; ++i) {
    const Document document = any_document();
    const Arguments arguments = render_arguments(document, "out.png", 0, "");
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Rendered render = rendered(arguments);
    expect_same(document, render);
    EXPECT_EQ(render.options.output, "out.png");
    EXPECT_EQ(render.options.warmup, 0);
    EXPECT_EQ(render.options.glsl, "");
    if (HasFailure()) return;
  }
}

TEST_F(ViewerDocument, DefaultsAreNotSpelledOut) {
  Document document = plain();
  EXPECT_EQ(render_arguments(document, "out.png", 0, ""),
            (Arguments{"render", "a.glb", "--size=1280x720", "-o", "out.png", "--technique=pcss", "--sample-shadows"}));
  session::all_techniques().select(document.params, "thesis");
  document.params.set("filter.width", 0.2f);
  EXPECT_EQ(render_arguments(document, "out.png", 0, ""),
            (Arguments{"render", "a.glb", "--size=1280x720", "-o", "out.png", "--technique=thesis",
                       "--set=filter.width=0.2"}));
}

TEST_F(ViewerDocument, APictureAtRestIsOfOneMomentAndASequenceComesToItsFirst) {
  Document document = plain();
  document.frame = 7;
  EXPECT_TRUE(rendered(render_arguments(document, "out.png", 31, "")).options.warmup_still);
  EXPECT_FALSE(rendered(render_arguments(document, "out.png", 0, "")).options.warmup_still);
  EXPECT_FALSE(rendered(render_arguments(document, "out.png", 31, "", cli::FrameRange{7, 9})).options.warmup_still);
}

TEST_F(ViewerDocument, OnlyTheFilesOfASequenceAreNumbered) {
  Document document = plain();
  for (const int now : {0, 7}) {
    document.frame = now;
    EXPECT_FALSE(rendered(render_arguments(document, "out.png", 0, "")).options.is_sequence());
    EXPECT_TRUE(rendered(render_arguments(document, "out.png", 0, "", cli::FrameRange{0, 0})).options.is_sequence());
  }
}

TEST_F(ViewerDocument, OutputWarmUpAndShadersAreSaid) {
  Document document = plain();
  document.options.scene = "-a.glb";
  const std::string glsl = PENUMBRA_ROOT "/glsl";
  const Rendered render = rendered(render_arguments(document, "my pictures/a.exr", 31, glsl));
  EXPECT_EQ(render.options.scene, "./-a.glb");
  EXPECT_EQ(render.options.output, "my pictures/a.exr");
  EXPECT_EQ(render.options.warmup, 31);
  EXPECT_EQ(render.options.glsl, glsl);
}

TEST_F(ViewerDocument, ASequenceHasItsFramesAtTheViewersSpeed) {
  for (const int now : {0, 17}) {
    Document document = plain();
    document.frame = now;
    document.options.fps = 60;
    document.options.time = 1.5;
    const Rendered render = rendered(render_arguments(document, "out.png", 0, "", cli::FrameRange{0, 9}));
    ASSERT_TRUE(render.options.frames);
    EXPECT_EQ(render.options.frames->first, 0);
    EXPECT_EQ(render.options.frames->last, 9);
    EXPECT_EQ(session::time_of(render.options, 9), session::time_of(document.options, 9));
  }
}

TEST_F(ViewerDocument, EveryDirectionThatCanBeTypedIsGivenBack) {
  for (int i = 0; i < 3000; ++i) {
    const int decimals = count(0, 9);
    const double scale = std::pow(10.0, decimals);
    const std::string typed = fmt::format("{:.{}f},{:.{}f}", std::floor(in(-360.0, 360.0) * scale) / scale, decimals,
                                          std::floor(in(-90.0, 90.0) * scale) / scale, decimals);
    Document document = plain();
    document.options.sun = cli::parse_direction("--sun", typed);
    const Arguments arguments = render_arguments(document, "out.png", 0, "");
    ASSERT_EQ(arguments[3].substr(0, 6), "--sun=");
    const cli::Direction again = cli::parse_direction("--sun", arguments[3].substr(6));
    ASSERT_EQ(again.azimuth, document.options.sun->azimuth) << typed << " and " << arguments[3];
    ASSERT_EQ(again.elevation, document.options.sun->elevation) << typed << " and " << arguments[3];
  }
}

TEST_F(ViewerDocument, ASunThatWasPlacedStandsThereInShortDegrees) {
  Document document = plain();
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 to_light = render::direction_to(in(-3.1f, 3.1f), in(0.0f, 1.57f));
    viewer::place_sun(document, to_light);
    const glm::vec3 placed = render::direction_to(document.options.sun->azimuth, document.options.sun->elevation);
    EXPECT_NEAR(glm::distance(placed, to_light), 0, 3e-5f);
    const Arguments arguments = render_arguments(document, "out.png", 0, "");
    EXPECT_LE(arguments[3].size(), std::string("--sun=-123.456,12.345").size()) << arguments[3];
  }
}

TEST_F(ViewerDocument, AFreeCameraTakesThePlaceOfTheFiles) {
  Document document = plain();
  document.options.camera = "Camera";
  session::PreparedScene prepared;
  prepared.setup.sun.to_light = render::direction_to(1.0f, 0.5f);
  const viewer::CameraRig rig{.eye = {1, 2, 3}, .target = {4, 5, 6}, .fov_y = 0.7f};
  place(document, prepared, rig);
  EXPECT_FALSE(document.options.camera);
  EXPECT_EQ(document.options.eye, rig.eye);
  EXPECT_EQ(document.options.target, rig.target);
  EXPECT_NEAR(*document.options.fov, glm::degrees(0.7), 1e-4);
  ASSERT_TRUE(document.options.sun) << "the sun would follow another camera";
  EXPECT_NEAR(document.options.sun->azimuth, 1.0f, 1e-4f);
  EXPECT_NEAR(document.options.sun->elevation, 0.5f, 1e-4f);
}

TEST_F(ViewerDocument, TheFilesOwnSunAndOneThatWasSetStay) {
  const viewer::CameraRig rig;
  session::PreparedScene prepared;
  prepared.setup.sun_node = 3;
  Document document = plain();
  document.options.camera = "Camera";
  place(document, prepared, rig);
  EXPECT_FALSE(document.options.sun);
  prepared.setup.sun_node.reset();
  document.options.camera = "Camera";
  document.options.sun = cli::Direction{.azimuth = 0.25f, .elevation = 0.5f};
  place(document, prepared, rig);
  EXPECT_EQ(document.options.sun->azimuth, 0.25f);
}

TEST_F(ViewerDocument, CameraNumbersAreThoseOfRender) {
  cli::SceneOptions options;
  EXPECT_TRUE(viewer::camera_arguments(options).empty());
  options.camera = "2";
  EXPECT_EQ(viewer::camera_arguments(options), (Arguments{"--camera=2"}));
  options = {};
  options.eye = {1, -2.5f, 0.1f};
  options.target = {0, 0, 0};
  options.fov = 40;
  EXPECT_EQ(viewer::camera_arguments(options), (Arguments{"--eye=1,-2.5,0.1", "--target=0,0,0", "--fov=40"}));
}

TEST_F(ViewerDocument, OnlyTechniquesThatRememberAreWarmedUp) {
  Document document = plain();
  document.params.set("history.reuse", true);
  const double oldest = std::pow(1.0 - document.params.get_float("history.alpha"), viewer::warmup_of(document));
  EXPECT_LT(oldest, 0.05) << "what was there before weighs on the picture";
  document.params.set("history.reuse", false);
  EXPECT_EQ(viewer::warmup_of(document), 0);
  document.params.set("history.reuse", true);
  for (const char* not_denoised : {"truth", "shadow_volume"}) {
    document.params.set_text("technique", not_denoised);
    EXPECT_EQ(viewer::warmup_of(document), 0) << not_denoised;
  }
  document.params.set_text("technique", "pcss");
  EXPECT_GT(viewer::warmup_of(document), 0);
  document.params.set_text("denoiser", "none");
  EXPECT_EQ(viewer::warmup_of(document), 0);
}

}  // namespace
}  // namespace penumbra
