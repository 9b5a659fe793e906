// The C interface in a context: the same masks as those of the C++ facade, byte for byte, and its own promises.
#include "capi/penumbra.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <new>
#include <set>
#include <utility>

#include "capi/device.h"
#include "gl/compatibility.h"
#include "gpu/capi_scene.h"
#include "shadow/registry.h"

namespace penumbra::test {
namespace {

class CapiTest : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    c_ = std::make_unique<CInterface>(test_context().get_proc_address());
  }
  void TearDown() override {
    c_.reset();
    TriangleTest::TearDown();
  }

  // Draws a scene by both; `adjust` changes the inputs before.
  void expect_same_mask(const TriangleScene& scene, const ParamSet& params,
                        const TriangleRenderer::Adjust& adjust = {}) {
    std::vector<float> of_c, of_facade;
    shadow::Inputs given;
    c_->set(params);
    const Geometry geometry(scene);
    renderer_->render(
        scene, params,
        [&](shadow::Inputs& inputs) {
          if (adjust) adjust(inputs);
          given = inputs;
        },
        [&] {
          const gl::Texture& mask = *renderer_->mask().texture;
          for (int layer = 0; layer < mask.desc().layers; ++layer) {
            const std::vector<float> values = gl::read_floats(mask, 4, 0, layer);
            of_facade.insert(of_facade.end(), values.begin(), values.end());
          }
          of_c = c_->render(c_->frame_of(given, geometry));
        });
    ASSERT_EQ(of_c.size(), of_facade.size());
    EXPECT_EQ(std::memcmp(of_c.data(), of_facade.data(), of_c.size() * sizeof(float)), 0);
  }

  // The same of three frames between which a box moves.
  void expect_same_masks_of_motion(const ParamSet& params) {
    TriangleScene scene = box_on_ground(48);
    for (int frame = 0; frame < 3; ++frame) {
      if (frame > 0) scene.move_from(2, glm::vec3(0.1f, 0, 0));
      expect_same_mask(scene, params, [&](shadow::Inputs& inputs) {
        inputs.view.id = 7;
        inputs.view.last_view = inputs.view.view;
        inputs.view.last_projection = inputs.view.projection;
        inputs.view.cut = frame == 0;
      });
    }
  }

  // A frame of `scene` whose textures are those of the facade's device.
  penumbra_frame frame_of(const TriangleScene& scene, const Geometry& geometry) {
    penumbra_frame frame{};
    ParamSet params = renderer_->params();
    params.set("cascades.size", 64);
    renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      light_ = inputs.lights[0];
      inputs.lights = {&light_, 1};
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      frame = c_->frame_of(inputs, geometry);
    });
    return frame;
  }

  penumbra_result result_of(const penumbra_frame& frame) {
    penumbra_mask mask{};
    mask.struct_size = sizeof(mask);
    return penumbra_render(c_->device, c_->settings, &frame, &mask);
  }

  std::unique_ptr<CInterface> c_;
  shadow::Light light_;
};

TEST_F(CapiTest, MasksOfEveryTechniqueAreThoseOfTheFacade) {
  for (const shadow::Technique& technique : renderer_->shadows().registry().techniques()) {
    SCOPED_TRACE(technique.name);
    ParamSet params = renderer_->params();
    params.set("technique", technique.name);
    params.set("sun.angle", 3.0f);
    params.set("cascades.size", 256);
    expect_same_mask(box_on_ground(48), params);
  }
  EXPECT_GT(c_->passes[PENUMBRA_PASS_GEOMETRY], 0);
}

TEST_F(CapiTest, MasksOfEveryPresetAreThoseOfTheFacadeWhileCastersMove) {
  for (const shadow::Preset& preset : renderer_->shadows().registry().presets()) {
    SCOPED_TRACE(preset.name);
    ParamSet params = renderer_->params();
    renderer_->shadows().registry().select(params, preset.name);
    params.set("cascades.size", 256);
    expect_same_masks_of_motion(params);
  }
  EXPECT_GT(c_->passes[PENUMBRA_PASS_MOVED_LAST], 0);
}

TEST_F(CapiTest, WhatMovedIsDrawnInTheShadowPassIfSoSet) {
  ParamSet params = renderer_->params();
  renderer_->shadows().registry().select(params, "thesis");
  params.set("movement.present", "shadow_pass");
  params.set("cascades.size", 256);
  expect_same_masks_of_motion(params);
  EXPECT_GT(c_->passes[PENUMBRA_PASS_DEPTH_AND_MOVED], 0);
}

TEST_F(CapiTest, NormalsMayBeThoseOfShading) {
  ParamSet params = renderer_->params();
  params.set("sun.angle", 3.0f);
  params.set("cascades.size", 256);
  std::vector<float> masks[2];
  for (const bool shading : {false, true}) {
    const auto adjust = [&](shadow::Inputs& inputs) { inputs.conventions.shading_normals = shading; };
    expect_same_mask(box_on_ground(48), params, adjust);
    masks[shading ? 1 : 0] = renderer_->render(box_on_ground(48), params, adjust).mask;
  }
  EXPECT_NE(masks[0], masks[1]);
}

TEST_F(CapiTest, PassesSayWhereTheLightIsAndWhatNeedNotBeDrawn) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  // Its maps are drawn whole, so that what is in clip space is what has to be drawn.
  penumbra_settings_set(c_->settings, "technique", "vsm");
  penumbra_frame frame = frame_of(scene, geometry);
  penumbra_light lights[] = {frame.lights[0], frame.lights[0]};
  lights[1].id = 1;
  lights[1].kind = PENUMBRA_LAMP;
  const glm::vec3 lamp(3, 6, 2), axis = glm::normalize(-lamp);
  std::copy_n(glm::value_ptr(lamp), 3, lights[1].position);
  std::copy_n(glm::value_ptr(axis), 3, lights[1].axis);
  lights[1].cone = 0.5f;
  lights[1].radius = 0.1f;
  const glm::vec4 places[] = {{scene.to_light, 0}, {lamp, 1}};
  for (const int i : {0, 1}) {
    SCOPED_TRACE(i == 0 ? "sun" : "lamp");
    frame.lights = &lights[i];
    c_->drawn.clear();
    ASSERT_EQ(result_of(frame), PENUMBRA_OK) << penumbra_last_error();
    ASSERT_FALSE(c_->drawn.empty());
    int inside = 0, left_out = 0;
    for (const penumbra_caster_pass& pass : c_->drawn) {
      EXPECT_LT(glm::length(glm::make_vec4(pass.light_place) - places[i]), 1e-5f);
      const auto depth_at = [&](const glm::vec3& place) {
        const glm::vec4 clip = glm::make_mat4(pass.world_to_clip) * glm::vec4(place, 1);
        return clip.z / clip.w;
      };
      // Nearer to the light depths are less, but of lamps greater: reversed.
      EXPECT_EQ(depth_at(0.2f * lamp) < depth_at(-0.2f * lamp), i == 0);
      for (int at = 0; at < 4096; ++at) {
        const glm::dvec3 point(2 * (at & 15) - 15, 2 * (at >> 4 & 15) - 15, 2 * (at >> 8) - 15);
        const glm::dvec4 clip = glm::dmat4(glm::make_mat4(pass.world_to_clip)) * glm::dvec4(point, 1);
        const bool behind = std::ranges::any_of(pass.cull_planes, [&](const double(&plane)[4]) {
          return glm::dot(glm::make_vec3(plane), point) + plane[3] < 0;
        });
        const double beside = std::max(std::abs(clip.x), std::abs(clip.y)) / clip.w;
        const bool is_inside = clip.w > 0 && beside < 0.99 && clip.z > 0.01 * clip.w && clip.z < 0.99 * clip.w;
        EXPECT_FALSE(is_inside && behind);
        EXPECT_TRUE(behind || clip.w <= 0 || beside < 1.01);
        inside += is_inside ? 1 : 0;
        left_out += behind ? 1 : 0;
      }
    }
    EXPECT_GT(inside, 50);
    EXPECT_GT(left_out, 50);
  }
}

TEST_F(CapiTest, ALightsVisibilityIsWrittenToATextureOfTheEngines) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  penumbra_frame frame = frame_of(scene, geometry);
  const gl::Texture texture(
      "output",
      {.target = GL_TEXTURE_2D_ARRAY, .format = GL_RGBA8, .width = 96, .height = 96, .layers = 3, .levels = 2});
  gl::glClearTexImage(texture.id(), 1, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  penumbra_light light = *frame.lights;
  light.output_texture = texture.id();
  light.output_level = 1;
  light.output_layer = 2;
  light.output_channel = 1;
  frame.lights = &light;
  const std::vector<float> mask = c_->render(frame);
  const std::vector<float> written = gl::read_floats(texture, 4, 1, 2);
  ASSERT_EQ(mask.size(), written.size());
  for (std::size_t i = 0; i < mask.size(); i += 4) {
    ASSERT_NEAR(written[i + 1], std::floor(mask[i] * 255 + 0.5f) / 255, 1e-6f) << i;
    ASSERT_EQ(written[i] + written[i + 2] + written[i + 3], 0.0f) << i;
  }
  light.output_channel = 4;
  penumbra_mask refused{};
  refused.struct_size = sizeof refused;
  EXPECT_EQ(penumbra_render(c_->device, c_->settings, &frame, &refused), PENUMBRA_ERROR_REFUSED);
  EXPECT_NE(std::string(penumbra_last_error()).find("has no channel 4"), std::string::npos) << penumbra_last_error();
}

// As in stereo: the other layers hold nothing that would give this mask.
TEST_F(CapiTest, LayersOfArraysAreRead) {
  const gl::TextureDesc array{
      .target = GL_TEXTURE_2D_ARRAY, .format = GL_DEPTH_COMPONENT32F, .width = 48, .height = 48, .layers = 2};
  gl::TextureDesc array_of_normals = array;
  array_of_normals.format = GL_RG32F;
  array_of_normals.layers = 3;
  const gl::Texture depth("depth", array), normals("normals", array_of_normals);
  const auto to_layer = [](shadow::TextureView& view, const gl::Texture& texture, int layer) {
    gl::glCopyImageSubData(view.id, GL_TEXTURE_2D, 0, 0, 0, 0, texture.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, 48,
                           48, 1);
    view.id = texture.id();
    view.layer = layer;
  };
  ParamSet params = renderer_->params();
  params.set("cascades.size", 256);
  const std::vector<float> plain = renderer_->render(box_on_ground(48), params).mask;
  expect_same_mask(box_on_ground(48), params, [&](shadow::Inputs& inputs) {
    to_layer(inputs.depth, depth, 1);
    to_layer(inputs.normals, normals, 2);
  });
  EXPECT_EQ(gl::read_floats(*renderer_->mask().texture, 4), plain);
}

TEST_F(CapiTest, SecondLayersAreDrawn) {
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("maps.layers", 2);
  expect_same_mask(box_on_ground(48), params);
  EXPECT_GT(c_->passes[PENUMBRA_PASS_SECOND_DEPTH], 0);
}

TEST_F(CapiTest, SecondLayersThatAreOfNoUseAreLeftOutWhereNoSurfaceIsDrawnForward) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  penumbra_frame frame = frame_of(scene, geometry);
  ASSERT_EQ(penumbra_settings_select(c_->settings, "slices"), PENUMBRA_OK);
  for (const auto& [name, value] : std::map<const char*, double>{{"maps.layers", 2}, {"maps.overlap", 0.5}})
    ASSERT_EQ(penumbra_settings_set_number(c_->settings, name, value), PENUMBRA_OK) << penumbra_last_error();
  const std::vector<float> two = c_->render(frame);
  EXPECT_GT(c_->passes[PENUMBRA_PASS_SECOND_DEPTH], 0);
  EXPECT_EQ(penumbra_bind_forward(c_->device, frame.view_id, 0), PENUMBRA_OK) << penumbra_last_error();
  c_->passes.clear();
  frame.no_forward_surfaces = 1;
  c_->render(frame);
  EXPECT_EQ(c_->passes[PENUMBRA_PASS_SECOND_DEPTH], 0);
  EXPECT_EQ(penumbra_bind_forward(c_->device, frame.view_id, 0), PENUMBRA_ERROR_REFUSED);
  EXPECT_NE(std::string(penumbra_last_error()).find("no_forward_surfaces"), std::string::npos);
}

TEST_F(CapiTest, SeveralLightsWithOverridesAndOtherConventions) {
  TriangleScene scene = box_on_ground(48);
  scene.conventions.reversed_z = false;
  scene.conventions.depth_zero_to_one = false;
  scene.projection = standard_perspective(0.8f, 1, 0.5f, 100);
  const std::array lights{
      shadow::Light{.id = 4, .source = shadow::Sun{scene.to_light}, .overrides = {"sun.angle=8"}, .maps = {}},
      shadow::Light{.id = 2,
                    .source = shadow::Lamp{.position = {1, 4, 2}, .radius = 0.2f, .range = 20},
                    .overrides = {"technique=slices", "lamps.size=256"},
                    .maps = {}},
      shadow::Light{.id = 3,
                    .source = shadow::Lamp{.position = {-3, 5, 0}, .axis = {0.6f, -0.8f, 0}, .cone = 0.7f},
                    .overrides = {},
                    .maps = {}}};
  expect_same_mask(scene, renderer_->params(), [&](shadow::Inputs& inputs) {
    inputs.lights = lights;
    inputs.viewport = {.x = 3, .y = 5, .width = 40, .height = 32};
    inputs.view.jitter = {0.01f, -0.005f};
    inputs.mask_details = false;
  });
}

TEST_F(CapiTest, ProgramsOfTheSameTextsHaveTheSameId) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  const penumbra_frame frame = frame_of(scene, geometry);
  ASSERT_EQ(penumbra_settings_select(c_->settings, "shadow_volume"), PENUMBRA_OK);
  const auto text = [](const char* given) { return std::string(given == nullptr ? "" : given); };
  std::map<std::string, std::uint64_t> ids;
  std::set<std::uint64_t> known;
  for (const char* shape : {"disc", "square"}) {
    ASSERT_EQ(penumbra_settings_set(c_->settings, "sun.shape", shape), PENUMBRA_OK);
    c_->render(frame);
    for (const penumbra_caster_pass& pass : c_->drawn) {
      if (pass.kind != PENUMBRA_PASS_GEOMETRY) continue;
      const std::string texts = text(pass.geometry_shader) + "\f" + text(pass.fragment_shader);
      EXPECT_EQ(ids.emplace(texts, pass.program_id).first->second, pass.program_id) << shape;
      known.insert(pass.program_id);
    }
  }
  EXPECT_GT(ids.size(), 0u);
  EXPECT_EQ(known.size(), ids.size());
}

TEST_F(CapiTest, MapsAreDrawnAgainOnlyWhereSomethingMayHaveMoved) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  penumbra_frame frame = frame_of(scene, geometry);
  ASSERT_EQ(frame.moved_is_known, 1u);
  const auto drawn = [&] {
    c_->passes.clear();
    c_->render(frame);
    return c_->passes[PENUMBRA_PASS_DEPTH];
  };
  const int all = drawn();
  EXPECT_GT(all, 0);
  EXPECT_EQ(drawn(), 0);
  frame.moved = {{-1, 0, -1}, {1, 2, 1}};
  EXPECT_GT(drawn(), 0);
  frame.moved = {{1, 1, 1}, {-1, -1, -1}};
  EXPECT_EQ(drawn(), 0);
  frame.moved_is_known = 0;
  EXPECT_EQ(drawn(), all);
  frame.moved_is_known = 1;
  frame.cut = 1;
  EXPECT_EQ(drawn(), all);
  frame.cut = 0;
  frame.restart = 1;
  EXPECT_EQ(drawn(), 0);
}

// What moved in a frame that was refused is not said again.
TEST_F(CapiTest, AfterARefusedFrameMapsAreDrawnAnew) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  penumbra_frame frame = frame_of(scene, geometry);
  frame.moved = {{1, 1, 1}, {-1, -1, -1}};
  const auto drawn = [&] {
    c_->passes.clear();
    c_->render(frame);
    return c_->passes[PENUMBRA_PASS_DEPTH];
  };
  const int all = drawn();
  EXPECT_EQ(drawn(), 0);
  penumbra_frame refused = frame;
  penumbra_light with_maps = *frame.lights;
  with_maps.maps = frame.depth;  // by a matrix of zeros
  with_maps.maps_size = 48;
  with_maps.maps_count = 1;
  const std::array<float, 16> zeros{};
  with_maps.maps_world_to_clip = zeros.data();
  refused.lights = &with_maps;
  EXPECT_EQ(result_of(refused), PENUMBRA_ERROR_REFUSED) << penumbra_last_error();
  EXPECT_EQ(drawn(), all);
  EXPECT_EQ(drawn(), 0);
  penumbra_frame wrong = frame;
  wrong.reserved = 1;
  EXPECT_EQ(result_of(wrong), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(drawn(), all);
  EXPECT_EQ(drawn(), 0);
}

TEST_F(CapiTest, ADirectionOfAnyLengthIsTaken) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  penumbra_frame frame = frame_of(scene, geometry);
  const std::vector<float> unit = c_->render(frame);
  penumbra_light light = *frame.lights;
  for (float& value : light.to_light) value *= 8;  // exact
  frame.lights = &light;
  frame.view_id = 1;
  double difference = 0;
  const std::vector<float> longer = c_->render(frame);
  ASSERT_EQ(longer.size(), unit.size());
  for (std::size_t i = 0; i < unit.size(); i += 4) difference += std::abs(static_cast<double>(unit[i] - longer[i]));
  EXPECT_LT(4 * difference / static_cast<double>(unit.size()), 1e-3);
}

// The settings that the interface's users see: every technique and preset, for suns and lamps.
TEST_F(CapiTest, AfterAWarmUpNoFrameCompilesAProgram) {
  const gl::ShaderLibrary& programs = c_->device->objects->device.shaders;
  for (std::size_t index = 0; index < penumbra_technique_count(); ++index) {
    penumbra_technique technique{};
    technique.struct_size = sizeof technique;
    ASSERT_EQ(penumbra_technique_info(index, &technique), PENUMBRA_OK);
    SCOPED_TRACE(technique.name);
    ASSERT_EQ(penumbra_settings_reset(c_->settings, nullptr), PENUMBRA_OK);
    ASSERT_EQ(penumbra_settings_select(c_->settings, technique.name), PENUMBRA_OK);
    for (const char* size : {"cascades.size", "lamps.size"})
      ASSERT_EQ(penumbra_settings_set_number(c_->settings, size, 128), PENUMBRA_OK);
    TriangleScene scene = box_on_ground(48);
    const auto draw = [&](const penumbra_light& light, bool warm, bool normals = true) {
      const Geometry geometry(scene);
      penumbra_frame frame = frame_of(scene, geometry);
      if (!normals) frame.normals = {};
      frame.lights = &light;
      frame.view_id = light.kind;
      if (warm) {
        EXPECT_EQ(penumbra_warm_up(c_->device, c_->settings, &frame), PENUMBRA_OK) << penumbra_last_error();
      } else {
        c_->render(frame);
      }
    };
    std::vector<penumbra_light> lights(technique.suns_only == 0 ? 2 : 1);
    for (penumbra_light& light : lights) {
      ASSERT_EQ(penumbra_light_init(&light, sizeof light), PENUMBRA_OK);
      light.kind = static_cast<int32_t>(&light - lights.data());
      light.position[1] = 5;
    }
    for (const penumbra_light& light : lights) draw(light, true);
    const std::size_t warm = programs.size();
    for (const penumbra_light& light : lights) {
      for (int i = 0; i < 4; ++i) {
        if (i == 2) scene.move_from(2, glm::vec3(0.1f, 0, 0));
        draw(light, false);
      }
      draw(light, false, /* normals= */ false);
      EXPECT_EQ(penumbra_forget_view(c_->device, light.kind), PENUMBRA_OK);
    }
    EXPECT_EQ(programs.size(), warm);
  }
  EXPECT_GT(programs.size(), 20u);
}

TEST_F(CapiTest, AfterAWarmUpNoFrameWithAMaskOfFewerPixelsCompilesAProgram) {
  const gl::ShaderLibrary& programs = c_->device->objects->device.shaders;
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  const penumbra_frame frame = frame_of(scene, geometry);
  for (const char* name : {"pcss", "slices_denoised", "thesis"}) {
    SCOPED_TRACE(name);
    ASSERT_EQ(penumbra_settings_select(c_->settings, name), PENUMBRA_OK);
    ASSERT_EQ(penumbra_settings_set_number(c_->settings, "mask.scale", 2), PENUMBRA_OK) << penumbra_last_error();
    EXPECT_EQ(penumbra_warm_up(c_->device, c_->settings, &frame), PENUMBRA_OK) << penumbra_last_error();
    const std::size_t warm = programs.size();
    for (int i = 0; i < 3; ++i) c_->render(frame);
    EXPECT_EQ(programs.size(), warm);
  }
}

TEST_F(CapiTest, AWarmUpLeavesNoTextureOfItsOwn) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  const penumbra_frame frame = frame_of(scene, geometry);
  EXPECT_EQ(penumbra_warm_up(c_->device, c_->settings, &frame), PENUMBRA_OK) << penumbra_last_error();
  for (const gl::Device::NamedTarget& target : c_->device->objects->device.targets())
    EXPECT_EQ(target.name.find("warm up"), std::string::npos) << target.name;
}

TEST_F(CapiTest, WhatACallbackReturnsEndsTheFrame) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  penumbra_frame frame = frame_of(scene, geometry);
  const std::vector<float> expected = c_->render(frame);
  const auto draw = frame.draw;
  frame.view_id = 1;
  frame.draw = [](void*, const penumbra_caster_pass*) -> int32_t { return 42; };
  penumbra_mask mask{};
  mask.struct_size = sizeof mask;
  EXPECT_EQ(penumbra_render(c_->device, c_->settings, &frame, &mask), PENUMBRA_ERROR_CALLBACK);
  EXPECT_STREQ(penumbra_last_error(), "penumbra_render(): the caster callback returned 42");
  EXPECT_EQ(mask.texture, 0u);
  EXPECT_EQ(penumbra_bind_forward(c_->device, 1, 0), PENUMBRA_ERROR_ARGUMENT);
  frame.draw = draw;
  EXPECT_EQ(c_->render(frame), expected);
}

TEST_F(CapiTest, ACallbackWithoutMemoryEndsTheFrame) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  penumbra_frame frame = frame_of(scene, geometry);
  const auto draw =
      std::exchange(frame.draw, [](void*, const penumbra_caster_pass*) -> int32_t { throw std::bad_alloc(); });
  EXPECT_EQ(result_of(frame), PENUMBRA_ERROR_MEMORY);
  EXPECT_STREQ(penumbra_last_error(), "no memory is left");
  frame.draw = draw;
  EXPECT_EQ(result_of(frame), PENUMBRA_OK) << penumbra_last_error();
}

struct Within {
  CInterface* c;
  std::vector<penumbra_result> results;
};

TEST_F(CapiTest, CallsFromWithinACallbackAreRefused) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  penumbra_frame frame = frame_of(scene, geometry);
  Within within{.c = c_.get(), .results = {}};
  frame.draw_user = &within;
  frame.draw = [](void* user, const penumbra_caster_pass*) -> int32_t {
    auto& self = *static_cast<Within*>(user);
    penumbra_frame inner;
    penumbra_frame_init(&inner, sizeof inner);
    penumbra_mask mask{};
    mask.struct_size = sizeof mask;
    penumbra_device* device = self.c->device;
    self.results = {penumbra_render(device, self.c->settings, &inner, &mask),
                    penumbra_warm_up(device, self.c->settings, &inner),
                    penumbra_forget_view(device, 0),
                    penumbra_bind_forward(device, 0, 0),
                    penumbra_unbind_forward(device),
                    penumbra_device_abandon(device),
                    penumbra_device_destroy(device)};
    // Another device would load its own driver's entry points in the middle of the call.
    penumbra_device_desc desc;
    penumbra_device_desc_init(&desc, sizeof desc);
    desc.get_proc = [](void*, const char*) -> penumbra_proc { return nullptr; };
    penumbra_device* another = nullptr;
    self.results.push_back(penumbra_device_create(&desc, &another));
    return 0;
  };
  penumbra_mask mask{};
  mask.struct_size = sizeof mask;
  EXPECT_EQ(penumbra_render(c_->device, c_->settings, &frame, &mask), PENUMBRA_OK) << penumbra_last_error();
  EXPECT_EQ(within.results, std::vector<penumbra_result>(8, PENUMBRA_ERROR_ARGUMENT));
}

TEST_F(CapiTest, WarningsGoToTheDevicesLog) {
  TriangleScene scene = box_on_ground(48);
  scene.depth_format = GL_DEPTH_COMPONENT16;
  scene.conventions.reversed_z = false;
  scene.conventions.depth_zero_to_one = false;
  scene.projection = standard_perspective(0.8f, 1, 0.001f, 100);
  const Geometry geometry(scene);
  c_->render(frame_of(scene, geometry));
  ASSERT_EQ(c_->messages.size(), 1u);
  EXPECT_TRUE(c_->messages[0].starts_with("2 soft shadows: the depth texture tells positions")) << c_->messages[0];
}

TEST_F(CapiTest, TheForwardSourceCompilesAndReadsTheLight) {
  const TriangleScene scene = box_on_ground(48);
  const Geometry geometry(scene);
  c_->render(frame_of(scene, geometry));
  std::size_t length = 0;
  ASSERT_EQ(penumbra_forward_source(c_->device, c_->settings, nullptr, nullptr, 0, &length), PENUMBRA_OK);
  std::string text(length, '?');
  ASSERT_EQ(penumbra_forward_source(c_->device, c_->settings, nullptr, text.data(), length - 1, nullptr),
            PENUMBRA_ERROR_BUFFER);
  EXPECT_EQ(text[0], '\0');
  ASSERT_EQ(penumbra_forward_source(c_->device, c_->settings, nullptr, text.data(), length, nullptr), PENUMBRA_OK);
  EXPECT_EQ(std::strlen(text.c_str()), length - 1);
  text.pop_back();
  text = "#version 450\n" + text +
         "layout(location = 0) out float lit; in vec3 at;\n"
         "void main() { lit = penumbra_shadow_visibility(at, vec3(0, 1, 0), gl_FragCoord.xy); }";
  const GLuint shader = gl::glCreateShader(GL_FRAGMENT_SHADER);
  const char* start = text.c_str();
  gl::glShaderSource(shader, 1, &start, nullptr);
  gl::glCompileShader(shader);
  GLint compiled = 0;
  gl::glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  EXPECT_EQ(compiled, GL_TRUE);
  gl::glDeleteShader(shader);
  EXPECT_EQ(penumbra_bind_forward(c_->device, 0, 0), PENUMBRA_OK);
  GLint bound = 0;
  gl::glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 1, &bound);
  EXPECT_NE(bound, 0);
  EXPECT_EQ(penumbra_bind_forward(c_->device, 0, 1), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_STREQ(penumbra_last_error(), "penumbra_bind_forward(): 'light_index' is 1 and the mask has 1 lights");
  EXPECT_EQ(penumbra_unbind_forward(c_->device), PENUMBRA_OK);
}

TEST_F(CapiTest, MotionVectorsAreReadOnlyWithAHistory) {
  uint32_t reads = 7;
  EXPECT_EQ(penumbra_reads_motion(c_->device, c_->settings, nullptr, 0, &reads), PENUMBRA_OK);
  EXPECT_EQ(reads, 0u);
  penumbra_light light;
  ASSERT_EQ(penumbra_light_init(&light, sizeof light), PENUMBRA_OK);
  for (const auto& [preset, expected] : {std::pair{"pcss", 0u}, {"thesis", 1u}}) {
    ASSERT_EQ(penumbra_settings_select(c_->settings, preset), PENUMBRA_OK);
    EXPECT_EQ(penumbra_reads_motion(c_->device, c_->settings, &light, 1, &reads), PENUMBRA_OK);
    EXPECT_EQ(reads, expected) << preset;
  }
}

// A context of its own, which a test can end.
TEST(CapiContext, AnAbandonedDeviceLeavesTheObjectsOfTheNextContext) {
  auto context = gl::make_context(backend_name(), {});
  auto c = std::make_unique<CInterface>(context->get_proc_address());
  penumbra_frame frame;
  ASSERT_EQ(penumbra_frame_init(&frame, sizeof frame), PENUMBRA_OK);
  penumbra_light light;
  ASSERT_EQ(penumbra_light_init(&light, sizeof light), PENUMBRA_OK);
  frame.lights = &light;
  frame.light_count = 1;
  ASSERT_EQ(penumbra_warm_up(c->device, c->settings, &frame), PENUMBRA_OK) << penumbra_last_error();
  context.reset();
  context = gl::make_context(backend_name(), {});
  // Names begin anew in the new context: as many as the lost device had, and more.
  std::array<GLuint, 256> textures{}, buffers{};
  gl::glCreateTextures(GL_TEXTURE_2D, static_cast<GLsizei>(textures.size()), textures.data());
  gl::glCreateBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  const GLuint program = gl::glCreateProgram();
  EXPECT_EQ(penumbra_device_abandon(c->device), PENUMBRA_OK);
  EXPECT_EQ(penumbra_forget_view(c->device, 0), PENUMBRA_ERROR_CONTEXT);
  EXPECT_STREQ(penumbra_last_error(), "penumbra_forget_view(): the device was abandoned");
  EXPECT_EQ(penumbra_device_abandon(c->device), PENUMBRA_OK);
  EXPECT_EQ(penumbra_device_destroy(c->device), PENUMBRA_OK);
  c->device = nullptr;
  for (const GLuint id : textures) EXPECT_EQ(gl::glIsTexture(id), GL_TRUE) << id;
  for (const GLuint id : buffers) EXPECT_EQ(gl::glIsBuffer(id), GL_TRUE) << id;
  EXPECT_EQ(gl::glIsProgram(program), GL_TRUE);
}

// On the thread on which the device was used, where OpenGL isn't asked in each call.
TEST(CapiContext, ADeviceThatIsDestroyedInAnotherContextLeavesItsObjects) {
  const auto context = gl::make_context(backend_name(), {});
  CInterface c(context->get_proc_address());
  penumbra_frame frame;
  ASSERT_EQ(penumbra_frame_init(&frame, sizeof frame), PENUMBRA_OK);
  ASSERT_EQ(penumbra_warm_up(c.device, c.settings, &frame), PENUMBRA_OK) << penumbra_last_error();
  const auto another = gl::make_context(backend_name(), {});
  std::array<GLuint, 256> textures{}, buffers{};
  gl::glCreateTextures(GL_TEXTURE_2D, static_cast<GLsizei>(textures.size()), textures.data());
  gl::glCreateBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  EXPECT_EQ(penumbra_device_destroy(c.device), PENUMBRA_ERROR_CONTEXT);
  EXPECT_EQ(c.messages, std::vector<std::string>{"2 a device is destroyed, but not what it has made in OpenGL: the "
                                                 "device's OpenGL context is not current on this thread"});
  c.device = nullptr;
  for (const GLuint id : textures) EXPECT_EQ(gl::glIsTexture(id), GL_TRUE) << id;
  for (const GLuint id : buffers) EXPECT_EQ(gl::glIsBuffer(id), GL_TRUE) << id;
}

TEST(CapiContext, ADeviceThatIsDestroyedWithoutAContextSaysSo) {
  auto context = gl::make_context(backend_name(), {});
  CInterface c(context->get_proc_address());
  context.reset();
  EXPECT_EQ(penumbra_device_destroy(c.device), PENUMBRA_ERROR_CONTEXT);
  EXPECT_STREQ(penumbra_last_error(), "penumbra_device_destroy(): no OpenGL context is current");
  EXPECT_EQ(c.messages.size(), 1u);
  c.device = nullptr;
  penumbra_device_desc desc;
  ASSERT_EQ(penumbra_device_desc_init(&desc, sizeof desc), PENUMBRA_OK);
  desc.get_proc = [](void*, const char*) -> penumbra_proc { return nullptr; };
  EXPECT_EQ(penumbra_device_create(&desc, &c.device), PENUMBRA_ERROR_CONTEXT);
  EXPECT_EQ(c.device, nullptr);
}

// Devices of two contexts, used in turn, in each of which names of objects begin anew.
TEST(CapiContext, SeveralDevicesAreUsedInTurn) {
  std::vector<std::unique_ptr<gl::Context>> contexts;
  std::vector<std::unique_ptr<CInterface>> devices;
  for (const bool compatibility : {false, true}) {
    contexts.push_back(gl::make_context(backend_name(), {.compatibility = compatibility}));
    devices.push_back(std::make_unique<CInterface>(contexts.back()->get_proc_address()));
  }
  penumbra_frame frame;
  ASSERT_EQ(penumbra_frame_init(&frame, sizeof frame), PENUMBRA_OK);
  penumbra_light light;
  ASSERT_EQ(penumbra_light_init(&light, sizeof light), PENUMBRA_OK);
  frame.lights = &light;
  frame.light_count = 1;
  for (int i = 0; i < 4; ++i) {
    const auto index = static_cast<std::size_t>(i % 2);
    contexts[index]->make_current();
    gl::current_api = nullptr;  // an engine's context does not load entry points when it is made current
    EXPECT_EQ(penumbra_warm_up(devices[index]->device, devices[index]->settings, &frame), PENUMBRA_OK)
        << penumbra_last_error();
    EXPECT_EQ(gl::current_api, nullptr);
    const gl::DeviceScope scope(devices[index]->device->objects->device);
    EXPECT_EQ(gl::has_legacy_state(), index == 1);
    EXPECT_EQ(gl::glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
  for (const std::size_t index : {1u, 0u}) {
    contexts[index]->make_current();
    devices[index].reset();
    contexts[index].reset();
  }
}

}  // namespace
}  // namespace penumbra::test
