// Shadow maps that an engine draws with matrices of its own give the shadows of the library's own maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <vector>

#include "capi/penumbra.h"
#include "core/error.h"
#include "gpu/capi_scene.h"
#include "gpu/triangle_scene.h"
#include "shadow/light_matrices.h"

namespace penumbra::test {
namespace {

constexpr int size = 1024;

// Slices of the view as engines fit them, neither of which holds the other, and a map that holds both; rolled about the
// sun's rays.
glm::mat4 slice(const glm::vec3& to_light, const glm::vec3& target, float half, float away) {
  return glm::orthoRH_ZO(-half, half, -half, half, 1.0f, 2 * away) *
         glm::lookAt(target + away * to_light, target, glm::vec3(0.4f, 1, 0.2f));
}

std::vector<glm::mat4> slices(const glm::vec3& to_light) {
  return {slice(to_light, {0, 0, 3}, 3, 30), slice(to_light, {0, 0, -1}, 3.5f, 30), slice(to_light, {0, 0, 0}, 9, 40)};
}

// One for each slice of the view, as engines have them: none holds another.
std::vector<glm::mat4> disjoint_slices(const glm::vec3& to_light) {
  const std::vector<glm::mat4> all = slices(to_light);
  return {all[0], all[1]};
}

class ShadowMatrices : public TriangleTest {
 protected:
  // The scene's shadow, from maps that are drawn with these matrices; `adjust` may change what is given of the maps.
  using AdjustMaps = std::function<void(shadow::FinishedMaps&)>;
  Shadowed draw_with(const std::vector<glm::mat4>& matrices, const std::string& technique,
                     const AdjustMaps& adjust = {}, GLenum format = GL_DEPTH_COMPONENT32F) {
    const gl::Texture maps = draw_maps(matrices, false, format);
    const shadow::LightProjection projection = shadow::sun_projection(
        {.world_to_clip = matrices, .to_light = scene_.to_light, .size = size, .camera = glm::vec3(2, 5, 6)});
    shadow::FinishedMaps finished{{maps.id(), size, size}, projection};
    if (adjust) adjust(finished);
    const shadow::Light light{.source = shadow::Sun{scene_.to_light}, .maps = finished};
    return render(technique, [&](shadow::Inputs& inputs) {
      inputs.lights = {&light, 1};
      inputs.draw = {};
    });
  }

  // `matrices`: with clip-space z in 0..1, 0 near the light unless they are reversed.
  gl::Texture draw_maps(const std::vector<glm::mat4>& matrices, bool reversed = false,
                        GLenum format = GL_DEPTH_COMPONENT32F) {
    gl::Texture maps("engine's maps", {.target = GL_TEXTURE_2D_ARRAY,
                                       .format = format,
                                       .width = size,
                                       .height = size,
                                       .layers = static_cast<int>(matrices.size())});
    const Geometry casters(scene_);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      gl::Pass pass(renderer_->device(), {.name = "engine's maps",
                                          .depth = gl::Attachment{.texture = &maps,
                                                                  .layer = static_cast<int>(i),
                                                                  .clear = glm::vec4(reversed ? 0 : 1)},
                                          .depth_test = reversed ? gl::DepthTest::greater : gl::DepthTest::less,
                                          .depth_write = true});
      casters.casters()({.kind = shadow::CasterKind::depth,
                         .layer = static_cast<int>(i),
                         .world_to_clip = matrices[i],
                         .cull = {},
                         .source = shadow::Sun{scene_.to_light}},
                        pass);
    }
    return maps;
  }

  // As engines pack them: maps of several sizes in one texture, here with a gap.
  struct Atlas {
    gl::Texture texture{"engine's atlas",
                        {.format = GL_DEPTH_COMPONENT32F, .width = 2 * size + 40, .height = 2 * size}};
    std::vector<glm::ivec2> corners{{size + 40, size}, {0, 0}, {size + 7, 0}};

    explicit Atlas(const gl::Texture& maps) {
      corners.resize(static_cast<std::size_t>(maps.desc().layers));
      for (int i = 0; i < maps.desc().layers; ++i) {
        const glm::ivec2 corner = corners[static_cast<std::size_t>(i)];
        gl::glCopyImageSubData(maps.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, i, texture.id(), GL_TEXTURE_2D, 0, corner.x,
                               corner.y, 0, size, size, 1);
      }
    }
  };

  Shadowed render(const std::string& technique, const TriangleRenderer::Adjust& adjust = {}) {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    params.set("sun.angle", 6.0f);
    params.set("cascades.size", size);
    params.set("sun.shape", shape_);
    return renderer_->render(scene_, params, adjust);
  }

  // Of receivers that one of the maps holds.
  void expect_own_shadows(const std::vector<glm::mat4>& matrices) {
    const auto is_held = [&](const glm::vec3& at) {
      return std::ranges::any_of(matrices, [&](const glm::mat4& matrix) {
        const glm::vec4 clip = matrix * glm::vec4(at, 1);
        return std::max(std::abs(clip.x), std::abs(clip.y)) < 1;
      });
    };
    for (const char* technique : {"hard", "pcss", "slices", "pcf_hardware"}) {
      const Shadowed own = render(technique), given = draw_with(matrices, technique);
      int held = 0, different = 0, dark = 0, penumbra = 0;
      for (int y = 0; y < own.height; ++y) {
        for (int x = 0; x < own.width; ++x) {
          if (own.sky(x, y) || !is_held(own.point(x, y))) continue;
          ++held;
          const float a = own.visibility(x, y), b = given.visibility(x, y);
          different += std::abs(a - b) > 0.25f ? 1 : 0;
          dark += b < 0.01f ? 1 : 0;
          penumbra += b > 0.1f && b < 0.9f ? 1 : 0;
        }
      }
      EXPECT_GT(held, 10000) << technique;
      EXPECT_LE(different, 8) << technique;
      EXPECT_GT(dark, 500) << technique;
      const bool narrow = std::string_view(technique) == "hard" || std::string_view(technique) == "pcf_hardware";
      EXPECT_TRUE(narrow || penumbra > 200) << technique;
    }
  }

  TriangleScene scene_ = box_on_ground(192);
  std::string shape_ = "disc";
};

TEST_F(ShadowMatrices, OfTheEnginesOwnGiveTheSameShadows) { expect_own_shadows(slices(scene_.to_light)); }

// Where the search of a receiver between two slices leaves both, it reads the map that is made from them. What lies
// beyond all slices is lit.
TEST_F(ShadowMatrices, SlicesOfTheViewNeedNoMapThatHoldsAll) { expect_own_shadows(disjoint_slices(scene_.to_light)); }

// Across the first one's border, where shadow lies, receivers blend with the third: the second is elsewhere.
TEST_F(ShadowMatrices, BlendWithTheNextThatHoldsTheReceiver) {
  const glm::vec3& sun = scene_.to_light;
  expect_own_shadows(
      {slice(sun, {0, 0, 0}, 2, 30), slice(sun, {7, 0, 7}, 2.5f, 30), slice(sun, {-2, 0, -2}, 4.5f, 30)});
}

// 16 bits over 600 m are steps of 9 mm, larger than the maps' texels.
TEST_F(ShadowMatrices, DepthsOf16BitsLeaveLitSurfacesLit) {
  const std::vector<glm::mat4> matrices = {slice(scene_.to_light, {0, 0, 1}, 4, 300),
                                           slice(scene_.to_light, {0, 0, 0}, 9, 300)};
  for (const char* technique : {"hard", "pcss", "slices"}) {
    const Shadowed fine = draw_with(matrices, technique);
    const Shadowed coarse = draw_with(matrices, technique, {}, GL_DEPTH_COMPONENT16);
    // Filtered texels of slices reach a little beyond a shadow's rim, in one map farther than in the other.
    const int beside = technique == std::string("slices") ? 1 : 0;
    const auto is_lit = [&](int x, int y) {
      bool all = true;
      for (int row = std::max(y - beside, 0); row <= std::min(y + beside, fine.height - 1); ++row) {
        for (int column = std::max(x - beside, 0); column <= std::min(x + beside, fine.width - 1); ++column)
          all = all && (fine.sky(column, row) || fine.visibility(column, row) == 1);
      }
      return all;
    };
    int lit = 0, darker = 0, dark = 0, still_dark = 0;
    for (int y = 0; y < fine.height; ++y) {
      for (int x = 0; x < fine.width; ++x) {
        if (fine.sky(x, y)) continue;
        lit += is_lit(x, y) ? 1 : 0;
        darker += is_lit(x, y) && coarse.visibility(x, y) < 1 ? 1 : 0;
        dark += fine.visibility(x, y) == 0 ? 1 : 0;
        still_dark += fine.visibility(x, y) == 0 && coarse.visibility(x, y) == 0 ? 1 : 0;
      }
    }
    EXPECT_GT(lit, 8000) << technique;
    EXPECT_EQ(darker, 0) << technique;
    EXPECT_GT(dark, 500) << technique;
    EXPECT_GT(still_dark, dark * 0.95) << technique;
  }
}

TEST_F(ShadowMatrices, AnAtlasGivesTheShadowsOfAnArray) {
  const std::vector<glm::mat4> disjoint = disjoint_slices(scene_.to_light);
  const Atlas of_disjoint(draw_maps(disjoint));
  for (const char* technique : {"pcss", "slices"}) {
    const auto from_atlas = [&](shadow::FinishedMaps& maps) {
      maps.depth = {of_disjoint.texture.id(), of_disjoint.texture.width(), of_disjoint.texture.height()};
      maps.atlas = of_disjoint.corners;
    };
    EXPECT_EQ(draw_with(disjoint, technique, from_atlas).mask, draw_with(disjoint, technique).mask) << technique;
  }
  const std::vector<glm::mat4> matrices = slices(scene_.to_light);
  const Atlas atlas(draw_maps(matrices));
  const auto from_atlas = [&](shadow::FinishedMaps& maps) {
    maps.depth = {atlas.texture.id(), atlas.texture.width(), atlas.texture.height()};
    maps.atlas = atlas.corners;
  };
  for (const char* technique : {"pcss", "slices", "pcf_hardware"}) {
    EXPECT_EQ(draw_with(matrices, technique, from_atlas).mask, draw_with(matrices, technique).mask) << technique;
  }
  const auto refusal = [&](const AdjustMaps& change) {
    return message_of([&] {
      draw_with(matrices, "pcss", [&](shadow::FinishedMaps& maps) {
        from_atlas(maps);
        change(maps);
      });
    });
  };
  EXPECT_NE(refusal([](auto& maps) { maps.atlas.pop_back(); }).find("an atlas of 2 maps for 3 layers"),
            std::string::npos);
  for (const glm::ivec2 corner : {glm::ivec2(-1, 0), {0, size + 1}, {size + 41, 0}, {2147483647, 0}}) {
    EXPECT_NE(refusal([&](auto& maps) { maps.atlas[1] = corner; }).find("is not a part of its atlas of 2088×2048"),
              std::string::npos);
  }
  EXPECT_NE(refusal([](auto& maps) { maps.atlas.clear(); }).find("is not a GL_TEXTURE_2D_ARRAY"), std::string::npos);
}

TEST_F(ShadowMatrices, DepthsOfAColourFormatAreRefusedWhereSamplersCompare) {
  const std::vector<glm::mat4> matrices = slices(scene_.to_light);
  gl::Texture colour("engine's maps", {.target = GL_TEXTURE_2D_ARRAY,
                                       .format = GL_R32F,
                                       .width = size,
                                       .height = size,
                                       .layers = static_cast<int>(matrices.size())});
  const gl::Texture maps = draw_maps(matrices);
  for (int i = 0; i < maps.desc().layers; ++i) {
    const std::vector<float> depths = gl::read_floats(maps, 1, 0, i);
    gl::glTextureSubImage3D(colour.id(), 0, 0, 0, i, size, size, 1, GL_RED, GL_FLOAT, depths.data());
  }
  const auto of_colour = [&](shadow::FinishedMaps& given) { given.depth.id = colour.id(); };
  EXPECT_EQ(draw_with(matrices, "pcss", of_colour).mask, draw_with(matrices, "pcss").mask);
  for (const std::string technique : {"pcf_hardware", "pcf_poisson"}) {
    for (int frame = 0; frame < 2; ++frame) {
      EXPECT_EQ(message_of([&] { draw_with(matrices, technique, of_colour); }),
                "soft shadows: the maps of light 0 are R32F, whose depths technique '" + technique +
                    "' can't compare: use a depth format");
    }
    EXPECT_NO_THROW(draw_with(matrices, technique));
  }
}

// By the C interface, from an array and from an atlas, without a callback that draws casters.
TEST_F(ShadowMatrices, AreTakenByTheCInterface) {
  const std::vector<glm::mat4> matrices = slices(scene_.to_light);
  const std::vector<float> expected = draw_with(matrices, "pcss").mask;
  const gl::Texture maps = draw_maps(matrices);
  const Atlas atlas(maps);
  CInterface c(test_context().get_proc_address());
  const Geometry geometry(scene_);
  ParamSet params = renderer_->params();
  params.set("sun.angle", 6.0f);
  c.set(params);
  std::vector<std::vector<float>> of_c;
  std::string refused;
  render("pcss", [&](shadow::Inputs& inputs) {
    penumbra_frame frame = c.frame_of(inputs, geometry);
    penumbra_light light = frame.lights[0];
    frame.lights = &light;
    frame.draw = nullptr;
    light.maps = {maps.id(), size, size};
    light.maps_size = size;
    light.maps_count = static_cast<int>(matrices.size());
    light.maps_world_to_clip = glm::value_ptr(matrices[0]);
    of_c.push_back(c.render(frame));
    // OpenGL's own clip space, whose z is stored as 0.5 z + 0.5.
    const glm::mat4 widen(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, -1, 1);
    std::vector<glm::mat4> from_minus_one;
    for (const glm::mat4& matrix : matrices) from_minus_one.push_back(widen * matrix);
    light.maps_world_to_clip = glm::value_ptr(from_minus_one[0]);
    light.maps_depth_zero_to_one = 0;
    of_c.push_back(c.render(frame));
    light.maps_world_to_clip = glm::value_ptr(matrices[0]);
    light.maps_depth_zero_to_one = 1;
    std::vector<std::array<int32_t, 2>> corners;
    for (const glm::ivec2& corner : atlas.corners) corners.push_back({corner.x, corner.y});
    light.maps = {atlas.texture.id(), atlas.texture.width(), atlas.texture.height()};
    light.maps_atlas = corners[0].data();
    of_c.push_back(c.render(frame));
    penumbra_mask mask{};
    mask.struct_size = sizeof mask;
    EXPECT_EQ(penumbra_settings_set(c.settings, "technique", "shadow_volume"), PENUMBRA_OK);
    EXPECT_EQ(penumbra_render(c.device, c.settings, &frame, &mask), PENUMBRA_ERROR_REFUSED);
    EXPECT_STREQ(penumbra_last_error(),
                 "soft shadows: light 0: technique 'shadow_volume' draws casters, and there is no caster callback");
    EXPECT_EQ(penumbra_settings_set(c.settings, "technique", "pcss"), PENUMBRA_OK);
    std::vector<glm::mat4> backwards = matrices;
    std::swap(backwards[0], backwards[2]);
    light.maps_world_to_clip = glm::value_ptr(backwards[0]);
    EXPECT_EQ(penumbra_render(c.device, c.settings, &frame, &mask), PENUMBRA_ERROR_REFUSED);
    refused = penumbra_last_error();
    light.maps_world_to_clip = glm::value_ptr(matrices[0]);
    light.maps_count = 9;
    EXPECT_EQ(penumbra_render(c.device, c.settings, &frame, &mask), PENUMBRA_ERROR_ARGUMENT);
    light.kind = PENUMBRA_LAMP;
    light.maps_count = 2;
    EXPECT_EQ(penumbra_render(c.device, c.settings, &frame, &mask), PENUMBRA_ERROR_ARGUMENT);
    light.maps_count = 1;
    EXPECT_EQ(penumbra_render(c.device, c.settings, &frame, &mask), PENUMBRA_ERROR_REFUSED);
    EXPECT_STREQ(penumbra_last_error(),
                 "shadow maps by the caller's matrices: the lamp shines all round; maps can be given for suns and "
                 "spots alone");
    EXPECT_EQ(c.passes[PENUMBRA_PASS_DEPTH], 0);
  });
  EXPECT_NE(refused.find("layer"), std::string::npos) << refused;
  for (const std::vector<float>& mask : of_c) {
    ASSERT_EQ(mask.size(), expected.size());
    double most = 0;  // the camera is another: it comes from the view's matrix
    for (std::size_t i = 0; i < mask.size(); i += 4) most = std::max<double>(most, std::abs(mask[i] - expected[i]));
    EXPECT_LE(most, 0.02);
  }
}

// A spot's map in the conventions of engines, in which x y z w of clip space are those of `projection` and z is stored
// as it is, or as 0.5 z + 0.5.
struct SpotConvention {
  const char* name;
  glm::mat4 projection;
  bool depth_zero_to_one, reversed, atlas;
};

TEST_F(ShadowMatrices, ASpotsMapGivesTheShadowsOfTheLibrarysOwn) {
  const glm::vec3 at(3, 6, 2);
  const shadow::Lamp lamp{.position = at, .radius = 0.25f, .axis = glm::normalize(-at), .cone = 0.5f};
  const glm::mat4 to_zero_to_one(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 1);
  const SpotConvention conventions[] = {
      {"0..1", glm::perspectiveRH_ZO(1.2f, 1.0f, 0.5f, 20.0f), true, false, false},
      {"-1..1", glm::perspectiveRH_NO(1.2f, 1.0f, 0.5f, 20.0f), false, false, false},
      {"-1..1, atlas", glm::perspectiveRH_NO(1.2f, 1.0f, 0.5f, 20.0f), false, false, true},
      {"reversed", glm::perspectiveRH_ZO(1.2f, 1.0f, 20.0f, 0.5f), true, true, false},
      {"reversed, -1..1, atlas", glm::perspectiveRH_NO(1.2f, 1.0f, 20.0f, 0.5f), false, true, true}};
  const auto under = [&](const shadow::Light& light) {
    return [&light](shadow::Inputs& inputs) {
      inputs.lights = {&light, 1};
      if (light.maps) inputs.draw = {};
    };
  };
  for (const SpotConvention& convention : conventions) {
    const glm::mat4 matrix = convention.projection * glm::lookAt(at, glm::vec3(0), glm::vec3(0.3f, 1, 0));
    const glm::mat4 drawn = convention.depth_zero_to_one ? matrix : to_zero_to_one * matrix;
    const gl::Texture maps = draw_maps({drawn}, convention.reversed);
    const gl::Texture atlas("atlas", {.format = GL_DEPTH_COMPONENT32F, .width = size + 40, .height = size + 7});
    gl::glCopyImageSubData(maps.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, atlas.id(), GL_TEXTURE_2D, 0, 40, 7, 0, size,
                           size, 1);
    const shadow::LightProjection projection =
        shadow::spot_projection({.world_to_clip = matrix,
                                 .depth_zero_to_one = convention.depth_zero_to_one,
                                 .reversed = convention.reversed,
                                 .lamp = lamp,
                                 .size = size});
    shadow::FinishedMaps finished{{maps.id(), size, size}, projection, {}, convention.reversed};
    if (convention.atlas) {
      finished.depth = {atlas.id(), atlas.width(), atlas.height()};
      finished.atlas = {{40, 7}};
    }
    const shadow::Light own_light{.source = lamp}, given_light{.source = lamp, .maps = finished};
    for (const char* technique : {"pcss", "slices", "pcf_hardware", "evsm"}) {
      const std::vector<float> own = render(technique, under(own_light)).visibilities();
      const std::vector<float> given = render(technique, under(given_light)).visibilities();
      double sum = 0;
      int different = 0;
      for (std::size_t i = 0; i < own.size(); ++i) {
        sum += std::pow(static_cast<double>(own[i]) - given[i], 2);
        different += std::abs(own[i] - given[i]) > 0.25f ? 1 : 0;
      }
      const auto lit_in_part = [](float value) { return value > 0.1f && value < 0.9f; };
      EXPECT_LT(std::sqrt(sum / static_cast<double>(own.size())), 0.02) << technique << " " << convention.name;
      EXPECT_LE(different, 20) << technique << " " << convention.name;
      EXPECT_GT(std::ranges::count_if(given, lit_in_part), 20) << technique << " " << convention.name;
      EXPECT_GT(std::ranges::count(given, 0.0f), 500) << technique << " " << convention.name;
    }
  }
}

TEST_F(ShadowMatrices, ASpotsMapNeedsDepthsOf24Bits) {
  const glm::vec3 at(3, 6, 2);
  const shadow::Lamp lamp{.position = at, .radius = 0.25f, .axis = glm::normalize(-at), .cone = 0.5f};
  const glm::mat4 matrix =
      glm::perspectiveRH_ZO(1.2f, 1.0f, 0.5f, 20.0f) * glm::lookAt(at, glm::vec3(0), glm::vec3(0.3f, 1, 0));
  const auto draw_with_maps = [&](GLenum format) {
    const gl::Texture maps(
        "maps", {.target = GL_TEXTURE_2D_ARRAY, .format = format, .width = size, .height = size, .layers = 1});
    const shadow::Light light{
        .source = lamp,
        .maps = shadow::FinishedMaps{{maps.id(), size, size},
                                     shadow::spot_projection({.world_to_clip = matrix, .lamp = lamp, .size = size})}};
    render("pcss", [&](shadow::Inputs& inputs) { inputs.lights = {&light, 1}; });
  };
  const std::string refused = message_of([&] { draw_with_maps(GL_DEPTH_COMPONENT16); });
  EXPECT_NE(refused.find("has depths of 16 bits; a lamp's needs at least 24"), std::string::npos) << refused;
  const std::string half = message_of([&] { draw_with_maps(GL_R16F); });
  EXPECT_NE(half.find("hold half floats, which are too coarse"), std::string::npos) << half;
  for (const GLenum format : {GL_DEPTH_COMPONENT24, GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT32F, GL_R32F})
    EXPECT_NO_THROW(draw_with_maps(format)) << format;
}

// Checks of a texture are remembered, but not for another kind of light.
TEST_F(ShadowMatrices, AMapThatServedASunIsCheckedForASpot) {
  const gl::Texture maps(
      "maps",
      {.target = GL_TEXTURE_2D_ARRAY, .format = GL_DEPTH_COMPONENT16, .width = size, .height = size, .layers = 1});
  const glm::vec3 at(3, 6, 2);
  const shadow::Lamp lamp{.position = at, .radius = 0.25f, .axis = glm::normalize(-at), .cone = 0.5f};
  const glm::mat4 of_spot =
      glm::perspectiveRH_ZO(1.2f, 1.0f, 0.5f, 20.0f) * glm::lookAt(at, glm::vec3(0), glm::vec3(0.3f, 1, 0));
  const shadow::Light spot{
      .source = lamp,
      .maps = shadow::FinishedMaps{{maps.id(), size, size},
                                   shadow::spot_projection({.world_to_clip = of_spot, .lamp = lamp, .size = size})}};
  const std::vector<glm::mat4> of_sun = {slices(scene_.to_light)[2]};
  const shadow::LightProjection projection = shadow::sun_projection(
      {.world_to_clip = of_sun, .to_light = scene_.to_light, .size = size, .camera = glm::vec3(2, 5, 6)});
  const shadow::Light sun{.source = shadow::Sun{scene_.to_light},
                          .maps = shadow::FinishedMaps{{maps.id(), size, size}, projection}};
  render("pcss", [&](shadow::Inputs& inputs) { inputs.lights = {&sun, 1}; });
  const std::string refused = message_of([&] {
    render("pcss", [&](shadow::Inputs& inputs) { inputs.lights = {&spot, 1}; });
  });
  EXPECT_NE(refused.find("has depths of 16 bits"), std::string::npos) << refused;
}

TEST_F(ShadowMatrices, ASpotsMapIsTakenByTheCInterface) {
  const glm::vec3 at(3, 6, 2);
  const shadow::Lamp lamp{.position = at, .radius = 0.25f, .axis = glm::normalize(-at), .cone = 0.5f};
  const glm::mat4 matrix =
      glm::perspectiveRH_ZO(1.2f, 1.0f, 20.0f, 0.5f) * glm::lookAt(at, glm::vec3(0), glm::vec3(0.3f, 1, 0));
  const gl::Texture maps = draw_maps({matrix}, true);
  const shadow::FinishedMaps finished{
      {maps.id(), size, size},
      shadow::spot_projection({.world_to_clip = matrix, .reversed = true, .lamp = lamp, .size = size}),
      {},
      true};
  const shadow::Light light{.source = lamp, .maps = finished};
  CInterface c(test_context().get_proc_address());
  const Geometry geometry(scene_);
  ParamSet params = renderer_->params();
  params.set("sun.angle", 6.0f);
  c.set(params);
  std::vector<float> of_c;
  const std::vector<float> expected =
      render("pcss", [&](shadow::Inputs& inputs) {
        inputs.lights = {&light, 1};
        penumbra_frame frame = c.frame_of(inputs, geometry);
        inputs.draw = {};
        penumbra_light of_engine = frame.lights[0];
        frame.lights = &of_engine;
        frame.draw = nullptr;
        of_engine.maps = {maps.id(), size, size};
        of_engine.maps_size = size;
        of_engine.maps_count = 1;
        of_engine.maps_world_to_clip = glm::value_ptr(matrix);
        of_engine.maps_reversed = 1;
        of_c = c.render(frame);
        of_engine.reserved = 1;
        penumbra_mask mask{};
        mask.struct_size = sizeof mask;
        EXPECT_EQ(penumbra_render(c.device, c.settings, &frame, &mask), PENUMBRA_ERROR_ARGUMENT);
      }).mask;
  EXPECT_EQ(of_c, expected);
}

TEST_F(ShadowMatrices, MapsOfAnotherKindOfLightAreRefused) {
  const std::vector<glm::mat4> matrices = slices(scene_.to_light);
  EXPECT_EQ(message_of([&] {
              const gl::Texture maps = draw_maps(matrices);
              const shadow::Light light{
                  .source = shadow::Lamp{.position = {0, 5, 0}},
                  .maps = shadow::FinishedMaps{
                      {maps.id(), size, size},
                      shadow::sun_projection({.world_to_clip = matrices, .to_light = scene_.to_light, .size = size})}};
              render("pcss", [&](shadow::Inputs& inputs) { inputs.lights = {&light, 1}; });
            }),
            "soft shadows: light 0 is a lamp and its maps are those of a sun");
}

TEST_F(ShadowMatrices, TurnedOnesDoNotServeASquareSun) {
  shape_ = "square";
  try {
    draw_with(slices(scene_.to_light), "pcss");
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "soft shadows: the maps of light 0 are turned about its rays, which a square sun does not allow");
  }
}

}  // namespace
}  // namespace penumbra::test
