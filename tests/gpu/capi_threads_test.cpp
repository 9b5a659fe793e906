// The C interface on several threads: a device for each context, and the errors of those who mix them.
#include <array>
#include <latch>
#include <thread>

#include "capi/device.h"
#include "capi/penumbra.h"
#include "gl/compatibility.h"
#include "gl/debug.h"
#include "gpu/capi_scene.h"

namespace penumbra::test {
namespace {

struct ContextKind {
  const char* backend;
  bool compatibility;
};

// Frames of several techniques in which a caster moves, drawn by a context and a device of the calling thread's own.
// `begin`: called once all is made, before the first frame.
template <class Begin>
std::vector<std::vector<float>> masks(const ContextKind& kind, const Begin& begin) {
  const auto context = gl::make_context(kind.backend, {.debug = true, .compatibility = kind.compatibility});
  TriangleRenderer renderer;
  CInterface c(context->get_proc_address());
  std::vector<std::vector<float>> all;
  begin();
  for (const char* technique : {"slices", "thesis", "vssm", "shadow_volume"}) {
    ParamSet params = renderer.params();
    renderer.shadows().registry().select(params, technique);
    params.set("cascades.size", 256);
    c.set(params);
    TriangleScene scene = box_on_ground(48);
    for (int frame = 0; frame < 3; ++frame) {
      if (frame > 0) scene.move_from(2, glm::vec3(0.1f, 0, 0));
      const Geometry geometry(scene);
      shadow::Inputs given;
      renderer.render(
          scene, params,
          [&](shadow::Inputs& inputs) {
            inputs.view.last_view = inputs.view.view;
            inputs.view.last_projection = inputs.view.projection;
            inputs.view.cut = frame == 0;
            given = inputs;
          },
          [&] {
            gl::Api* const of_thread = std::exchange(gl::current_api, nullptr);  // an engine has none
            penumbra_frame drawn = c.frame_of(given, geometry);
            penumbra_mask mask{};
            mask.struct_size = sizeof mask;
            EXPECT_EQ(penumbra_render(c.device, c.settings, &drawn, &mask), PENUMBRA_OK) << penumbra_last_error();
            EXPECT_EQ(gl::current_api, nullptr);
            gl::current_api = of_thread;
            all.push_back(gl::read_floats(gl::Texture::wrap(mask.texture, gl::describe("mask", mask.texture)), 4));
          });
    }
  }
  EXPECT_NO_THROW(gl::check_errors("frames"));
  return all;
}

TEST(CapiThreads, DevicesOfTwoContextsDrawAtTheSameTimeWhatTheyDrawAlone) {
  using Pair = std::array<ContextKind, 2>;
  for (const Pair& kinds : {Pair{{{"egl", false}, {"egl", true}}}, Pair{{{"egl", false}, {"osmesa", false}}}}) {
    SCOPED_TRACE(fmt::format("{} and {}", kinds[0].backend, kinds[1].backend));
    std::array<std::vector<std::vector<float>>, 2> alone, together;
    for (std::size_t i = 0; i < 2; ++i) alone[i] = masks(kinds[i], [] {});
    {
      std::latch begin(2);
      std::array<std::jthread, 2> threads;
      for (std::size_t i = 0; i < 2; ++i) {
        threads[i] = std::jthread([&, i] { together[i] = masks(kinds[i], [&] { begin.arrive_and_wait(); }); });
      }
    }
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_EQ(alone[i].size(), 12u);
      EXPECT_EQ(alone[i], together[i]) << i;
    }
  }
}

struct Made {
  Made() {
    EXPECT_EQ(penumbra_frame_init(&frame, sizeof frame), PENUMBRA_OK);
    EXPECT_EQ(penumbra_light_init(&light, sizeof light), PENUMBRA_OK);
    frame.lights = &light;
    frame.light_count = 1;
  }

  penumbra_frame frame;
  penumbra_light light;
};

// Runs on a thread of its own, and waits for it.
template <class Body>
void elsewhere(const Body& body) {
  std::jthread thread(body);
}

constexpr const char* not_current = "penumbra_warm_up(): the device's OpenGL context is not current on this thread";

TEST(CapiThreads, ADeviceWithoutItsContextIsOneClearError) {
  const auto context = gl::make_context(backend_name(), {});
  const CInterface c(context->get_proc_address());
  const Made made;
  ASSERT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
  elsewhere([&] {
    EXPECT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_ERROR_CONTEXT);
    EXPECT_STREQ(penumbra_last_error(), not_current);
  });
  // Another context in which objects have the same names.
  elsewhere([&] {
    const auto another = gl::make_context(backend_name(), {});
    const CInterface own(another->get_proc_address());
    EXPECT_EQ(penumbra_warm_up(own.device, own.settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
    EXPECT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_ERROR_CONTEXT);
    EXPECT_STREQ(penumbra_last_error(), not_current);
    EXPECT_EQ(gl::glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_EQ(penumbra_warm_up(own.device, own.settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
  });
  EXPECT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
}

TEST(CapiThreads, ADeviceThatHasDrawnNothingKnowsItsContext) {
  const auto context = gl::make_context(backend_name(), {});
  const CInterface c(context->get_proc_address());
  const Made made;
  elsewhere([&] {
    const auto another = gl::make_context(backend_name(), {});
    EXPECT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_ERROR_CONTEXT);
    EXPECT_STREQ(penumbra_last_error(), not_current);
  });
  EXPECT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
}

TEST(CapiThreads, ADeviceFollowsItsContextToAnotherThread) {
  auto context = gl::make_context(backend_name(), {});
  auto c = std::make_unique<CInterface>(context->get_proc_address());
  const Made made;
  ASSERT_EQ(penumbra_warm_up(c->device, c->settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
  gl::make_context(backend_name(), {});  // made and destroyed: none is current now
  elsewhere([&] {
    context->make_current();
    EXPECT_EQ(penumbra_warm_up(c->device, c->settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
    EXPECT_EQ(gl::glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    c.reset();
    context.reset();
  });
}

// Threads that follow each other often have the same std::thread::id.
TEST(CapiThreads, ALaterThreadIsNotTakenForOneThatEnded) {
  const auto context = gl::make_context(backend_name(), {});
  const CInterface c(context->get_proc_address());
  const Made made;
  ASSERT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
  gl::make_context(backend_name(), {});  // made and destroyed: none is current now
  elsewhere([&] {
    context->make_current();
    EXPECT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
    gl::make_context(backend_name(), {});
  });
  elsewhere([&] {
    EXPECT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_ERROR_CONTEXT);
    EXPECT_STREQ(penumbra_last_error(), not_current);
  });
  context->make_current();
}

TEST(CapiThreads, WithoutItsContextADeviceForgetsNoView) {
  const auto context = gl::make_context(backend_name(), {});
  const CInterface c(context->get_proc_address());
  const Made made;
  ASSERT_EQ(penumbra_warm_up(c.device, c.settings, &made.frame), PENUMBRA_OK) << penumbra_last_error();
  gl::make_context(backend_name(), {});  // made and destroyed: none is current now
  EXPECT_EQ(penumbra_forget_view(c.device, 0), PENUMBRA_ERROR_CONTEXT);
  context->make_current();
  EXPECT_EQ(penumbra_forget_view(c.device, 0), PENUMBRA_OK) << penumbra_last_error();
}

TEST(CapiThreads, ADeviceThatIsInUseOnAnotherThreadIsOneClearError) {
  const auto context = gl::make_context(backend_name(), {});
  CInterface c(context->get_proc_address());
  TriangleRenderer renderer;
  const TriangleScene scene = box_on_ground(16);
  const Geometry geometry(scene);
  struct Within {
    const CInterface* c;
    penumbra_result result = PENUMBRA_OK;
    std::string message;
  } within{.c = &c, .message = {}};
  renderer.render(scene, renderer.params(), [&](shadow::Inputs& inputs) {
    penumbra_frame frame = c.frame_of(inputs, geometry);
    frame.draw_user = &within;
    frame.draw = [](void* user, const penumbra_caster_pass*) -> int32_t {
      auto& self = *static_cast<Within*>(user);
      elsewhere([&] {
        self.result = penumbra_forget_view(self.c->device, 0);
        self.message = penumbra_last_error();
      });
      return 0;
    };
    penumbra_mask mask{};
    mask.struct_size = sizeof mask;
    EXPECT_EQ(penumbra_render(c.device, c.settings, &frame, &mask), PENUMBRA_OK) << penumbra_last_error();
  });
  EXPECT_EQ(within.result, PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(within.message, "penumbra_forget_view(): another thread is in a call with the device");
}

// The facade of C++, whose device remembers the entry points that were loaded on the thread which made it.
TEST(CapiThreads, TheFacadeNeedsItsContextAndNoEntryPointsOfTheThread) {
  const auto context = gl::make_context(backend_name(), {});
  TriangleRenderer renderer;
  const TriangleScene scene = box_on_ground(16);
  std::string message;
  std::vector<float> expected;
  renderer.render(scene, renderer.params(), {}, [&] { expected = gl::read_floats(*renderer.mask().texture, 4); });
  renderer.render(scene, renderer.params(), [&](const shadow::Inputs& given) {
    shadow::Inputs inputs = given;
    elsewhere([&] { message = message_of([&] { renderer.shadows().render(inputs, renderer.params()); }); });
    gl::Api* const of_thread = std::exchange(gl::current_api, nullptr);
    inputs.draw = [&](const shadow::CasterPass& casters, gl::Pass& pass) {
      EXPECT_EQ(gl::current_api, of_thread);
      given.draw(casters, pass);
    };
    const shadow::Mask mask = renderer.shadows().render(inputs, renderer.params());
    gl::current_api = of_thread;
    EXPECT_EQ(gl::read_floats(*mask.texture, 4), expected);
  });
  EXPECT_EQ(message, "soft shadows: the device's OpenGL context is not current on this thread");
}

}  // namespace
}  // namespace penumbra::test
