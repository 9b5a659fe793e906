#include "truth/hybrid.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "truth/frame_rays.h"
#include "truth/picture_request.h"

namespace penumbra::truth {

namespace {

// As in glsl/shadow/decide.glsl.
constexpr unsigned verdict_lit = 1, verdict_undecided = 3;

constexpr const char* program_name = "verdicts";

// What the map decides of each pixel, rows bottom to top.
std::vector<unsigned> read_verdicts(const shadow::PassContext& frame) {
  const gl::Texture& verdicts =
      frame.target(program_name, {.format = GL_R8UI, .width = frame.mask().width(), .height = frame.mask().height()});
  gl::Pass pass(frame.device(), {.name = program_name});
  frame.use(pass, program_name);
  verdicts.bind_image(0, GL_WRITE_ONLY);
  pass.dispatch(frame.frame().viewport.width, frame.frame().viewport.height);
  return gl::read_uints(verdicts, 1);
}

// The visibility of some pixels.
std::vector<float> traced(const shadow::PassContext& frame, PictureTracer& tracer,
                          const std::vector<std::uint32_t>& pixels, int threads) {
  const render::FrameScene& user = frame_scene(frame, "hybrid");
  const std::vector<glm::uvec2> drawn = drawn_surfaces(frame.device(), user);
  const gl::Pass pass(frame.device(), {.name = "rays"});
  PictureRequest request{
      .scene = &user.scene.scene(),
      .geometry = user.scene.posed_geometry(),
      .width = static_cast<int>(pixels.size()),
      .light = traced_light(frame),
      .options = {
          .samples = frame.params().get_int("hybrid.rays"), .scramblings = Scramblings::one, .threads = threads}};
  request.receivers = receivers_of(request.geometry, eye_rays(user), drawn, pixels);
  request.casters = key_of(*request.scene, request.geometry);
  return tracer.trace(request).traced.visibility;
}

void resolve(const shadow::PassContext& frame, PictureTracer& tracer, int threads) {
  const std::vector<unsigned> verdicts = read_verdicts(frame);
  std::vector<float> visibility(verdicts.size());
  std::vector<std::uint32_t> undecided;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    visibility[i] = verdicts[i] == verdict_lit ? 1.0f : 0.0f;
    if (verdicts[i] == verdict_undecided) undecided.push_back(static_cast<std::uint32_t>(i));
  }
  if (!undecided.empty()) {
    const std::vector<float> of_rays = traced(frame, tracer, undecided, threads);
    for (std::size_t i = 0; i < undecided.size(); ++i) visibility[undecided[i]] = of_rays[i];
  }
  fill_mask(frame, visibility);
}

}  // namespace

shadow::Technique hybrid(int threads) {
  using enum ParamBinding;
  const auto tracer = std::make_shared<PictureTracer>();
  return {.name = "hybrid",
          .summary =
              "The shadow map decides the pixels that no penumbra reaches; rays to the light decide the others. "
              "For renderers without a GPU.",
          .source = "edges of the map as in ADR 18; Owen-scrambled Sobol points, Embree",
          .needs = {"shadow_map", "least_depth_pyramid"},
          .params = {{"hybrid.rays", 16, 8, 4096, "rays",
                      "Rays of each pixel that the map does not decide, rounded up to a multiple of eight.", host}},
          .resolve = [=](const shadow::PassContext& frame) { resolve(frame, *tracer, threads); },
          .resolve_reads_motion = false,
          .programs =
              [](const ParamSet&) {
                return std::vector<gl::ProgramDesc>{{.name = program_name, .compute = "shadow/techniques/hybrid.comp"}};
              },
          .denoisable = false,
          .stand_in = "pcss",
          .reads_light_discs = true};
}

}  // namespace penumbra::truth
