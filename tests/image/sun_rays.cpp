#include "image/sun_rays.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "render/passes.h"
#include "scene/posed_geometry.h"
#include "shadow/pass_context.h"
#include "truth/frame_rays.h"
#include "truth/receiver.h"
#include "truth/tracer.h"

namespace penumbra::test {

namespace {

// Points of the grid are this share of a pixel apart; odd, so that one of them is the pixel's centre.
constexpr int steps = 9;
constexpr int reach = steps - 1, side = 2 * reach + 1, points = side * side;

bool is_blended(const scene::Scene& scene, const scene::PosedSurface& surface) {
  const int material = surface.primitive->material;
  return material >= 0 && scene.materials[static_cast<std::size_t>(material)].alpha_mode == scene::AlphaMode::blend;
}

}  // namespace

struct SunRays::Frame {
  Alpha alpha = Alpha::part;
  bool masked = false, blended = false;
  scene::PosedGeometry geometry;
  truth::EyeRays rays;
  std::vector<glm::uvec2> drawn;  // rows bottom to top
  truth::TracedSun sun;
  std::optional<truth::Tracer> tracer;

  void take(const shadow::PassContext& context);
  void take_alpha(const scene::Scene& scene);
  truth::DrawnPixel drawn_at(const glm::ivec2& pixel) const;
  std::vector<bool> trace(std::span<const truth::Receiver> receivers, int width) const;
};

void SunRays::Frame::take_alpha(const scene::Scene& scene) {
  masked = blended = false;
  for (scene::PosedSurface& surface : geometry.surfaces) {
    if (surface.casts != scene::CastMode::by_alpha) continue;
    const bool blends = is_blended(scene, surface);
    (blends ? blended : masked) = true;
    if (alpha == Alpha::as_volumes) surface.casts = blends ? scene::CastMode::never : scene::CastMode::always;
  }
}

void SunRays::Frame::take(const shadow::PassContext& context) {
  const render::FrameScene& frame = truth::frame_scene(context, "sun_rays");
  geometry = frame.scene.posed_geometry();
  take_alpha(frame.scene.scene());
  rays = truth::eye_rays(frame);
  drawn = truth::drawn_surfaces(context.device(), frame);
  sun = std::get<truth::TracedSun>(truth::traced_light(context));
  tracer.emplace(frame.scene.scene(), geometry);
  truth::fill_mask(context, std::vector<float>(drawn.size(), 1.0f));
}

truth::DrawnPixel SunRays::Frame::drawn_at(const glm::ivec2& pixel) const {
  const glm::ivec2 from_below(pixel.x, rays.height - 1 - pixel.y);
  return {from_below, drawn[static_cast<std::size_t>(from_below.y * rays.width + from_below.x)]};
}

std::vector<bool> SunRays::Frame::trace(std::span<const truth::Receiver> receivers, int width) const {
  if (receivers.empty()) return {};
  truth::TracedSun center = sun;
  center.angle = 0;
  const truth::Traced traced = tracer->trace(receivers, width, center, {.samples = 8, .progress = {}});
  std::vector<bool> lit;
  for (const float visibility : traced.hard) lit.push_back(visibility > 0.5f);
  return lit;
}

SunRays::SunRays() : frame_(std::make_shared<Frame>()) {}

void SunRays::set_alpha(Alpha alpha) { frame_->alpha = alpha; }

shadow::Registry SunRays::registry() const {
  shadow::Registry::Contents contents = shadow::built_in_registry().contents();
  contents.techniques.push_back(
      {.name = "sun_rays",
       .summary = "Keeps what rays to the sun's centre need.",
       .source = "a test",
       .glsl = {},
       .needs = {},
       .resolve = [frame = frame_](const shadow::PassContext& context) { frame->take(context); },
       .resolve_reads_motion = false,
       .denoisable = false,
       .stand_in = "none"});
  return shadow::Registry(std::move(contents));
}

std::vector<bool> SunRays::lit() const {
  const truth::EyeRays& rays = frame_->rays;
  const std::vector<bool> traced =
      frame_->trace(truth::receivers_of(frame_->geometry, rays, frame_->drawn), rays.width);
  std::vector<bool> lit;
  for (auto end = traced.end(); end != traced.begin(); end -= rays.width) lit.insert(lit.end(), end - rays.width, end);
  return lit;
}

std::vector<bool> SunRays::lit_off_surface(const std::vector<glm::ivec2>& pixels, double share) const {
  std::vector<truth::DrawnPixel> shown;
  for (const glm::ivec2& pixel : pixels) shown.push_back(frame_->drawn_at(pixel));
  std::vector<truth::Receiver> receivers = truth::receivers_of(frame_->geometry, frame_->rays, shown);
  const glm::dvec4& axis = frame_->rays.clip_to_world[2];
  const glm::dvec3 eye = glm::dvec3(axis) / axis.w;
  for (truth::Receiver& receiver : receivers) {
    const double distances = glm::length(eye) + glm::length(receiver.position - eye);
    receiver.position += share * distances * receiver.normal;
  }
  return frame_->trace(receivers, static_cast<int>(receivers.size()));
}

std::vector<bool> SunRays::edges(const std::vector<glm::ivec2>& pixels) const {
  const truth::EyeRays& rays = frame_->rays;
  const truth::EyeRays fine{rays.clip_to_world, rays.width * steps, rays.height * steps};
  std::vector<truth::DrawnPixel> shown;
  for (const glm::ivec2& pixel : pixels) {
    const truth::DrawnPixel center = frame_->drawn_at(pixel);
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x)
        shown.push_back({center.pixel * steps + steps / 2 + glm::ivec2(x, y), center.drawn});
    }
  }
  const std::vector<bool> lit = frame_->trace(truth::receivers_of(frame_->geometry, fine, shown), points);
  std::vector<bool> edges;
  for (auto first = lit.begin(); first != lit.end(); first += points) {
    const auto number = std::count(first, first + points, true);
    edges.push_back(number != 0 && number != points);
  }
  return edges;
}

std::vector<float> SunRays::visibility(const glm::ivec2& first, const glm::ivec2& size, int samples) const {
  std::vector<truth::DrawnPixel> shown;
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) shown.push_back(frame_->drawn_at(first + glm::ivec2(x, y)));
  }
  const std::vector<truth::Receiver> receivers = truth::receivers_of(frame_->geometry, frame_->rays, shown);
  return frame_->tracer->trace(receivers, size.x, frame_->sun, {.samples = samples, .progress = {}}).visibility;
}

bool SunRays::masked_casters() const { return frame_->masked; }
bool SunRays::blended_casters() const { return frame_->blended; }

}  // namespace penumbra::test
