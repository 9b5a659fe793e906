// Shadow volumes: each receiver is tested against the casters' triangles whose volumes may hold it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "../pass_context.h"
#include "../technique.h"

namespace penumbra::shadow {

namespace {

// What shadow_volume.glsl declares. Positions are metres along the world's axes from the camera.
struct Volumes {
  glm::mat4 to_clip;
  glm::vec4 camera, eye, light, receivers_min, receivers_max;
  float margin = 0, nearest = 0, unused[2] = {};
};
static_assert(offsetof(Volumes, camera) == 64 && offsetof(Volumes, margin) == 144 && sizeof(Volumes) == 160);
constexpr GLuint volumes_binding = block_samples;  // the technique has no sample points

// To the clip space whose depths, 0..1, are those of the receivers' texture; from positions relative to the camera.
glm::mat4 to_depth(const Inputs& inputs) {
  glm::dmat4 projection(inputs.view.projection);
  for (glm::length_t column = 0; column < 4; ++column) {
    const double w = projection[column].w;
    projection[column].x += w * static_cast<double>(inputs.view.jitter.x);
    projection[column].y += w * static_cast<double>(inputs.view.jitter.y);
    if (!inputs.conventions.depth_zero_to_one) projection[column].z = 0.5 * (projection[column].z + w);
  }
  return glm::mat4(projection * glm::dmat4(glm::dmat3(inputs.view.view)));
}

// Where the camera is, homogeneous and relative to itself: the origin, or the direction towards it if its rays are
// parallel.
glm::vec4 eye_of(const Inputs& inputs) {
  const glm::mat4& projection = inputs.view.projection;
  if (projection[2][3] != 0) return {0, 0, 0, 1};
  const bool depth_grows_with_z = (projection[2][2] > 0) != inputs.conventions.reversed_z;
  const glm::dvec3 z = glm::inverse(glm::dmat3(inputs.view.view))[2];
  return {glm::vec3(depth_grows_with_z ? -z : z), 0};
}

// See shadow_volume_receivers.frag.
glm::vec2 over_floats(const DepthRounding& stored) {
  const float of_floats = std::ldexp(1.0f, -24);
  return {stored.absolute, std::max(stored.relative - of_floats, 0.0f)};
}

// The caller's box. It may be empty where every light brings its maps: then what is within 100 km of the camera.
Box receivers_of(const Inputs& inputs, const glm::vec3& camera) {
  constexpr float far = 1e5f;  // metres
  const Box& box = inputs.receivers;
  return glm::all(glm::lessThanEqual(box.min, box.max)) ? box : Box{camera - far, camera + far};
}

Volumes volumes_of(const PassContext& context) {
  const Inputs& inputs = context.inputs();
  const Rect& viewport = context.frame().viewport;
  const glm::mat4& projection = inputs.view.projection;
  const glm::dvec3 camera(glm::inverse(glm::dmat4(inputs.view.view))[3]);
  const glm::dvec4 light(place_of(context.light().source));
  const Box receivers = receivers_of(inputs, glm::vec3(camera));
  const float pixel = 2 / std::min(std::abs(projection[0][0]) * static_cast<float>(viewport.width),
                                   std::abs(projection[1][1]) * static_cast<float>(viewport.height));
  return {.to_clip = to_depth(inputs),
          .camera = glm::vec4(camera, 1),
          .eye = eye_of(inputs),
          .light = glm::vec4(glm::dvec3(light) - light.w * camera, light.w),
          .receivers_min = glm::vec4(glm::dvec3(receivers.min) - camera, 1),
          .receivers_max = glm::vec4(glm::dvec3(receivers.max) - camera, 1),
          .margin = pixel / 64,
          .nearest = context.params().get_float("lamps.near")};
}

// Of each pixel: where its receiver is, and the depth behind which the faces of volumes that may hold it lie.
struct Receivers {
  const gl::Texture& places;
  const gl::Texture& depth;
};

void write_receivers(const PassContext& context, const Receivers& receivers) {
  const Inputs& inputs = context.inputs();
  const Rect& viewport = context.frame().viewport;
  gl::Pass pass(context.device(), {.name = "receivers",
                                   .colors = {{.texture = &context.mask(), .layer = context.frame().layer},
                                              {.texture = &receivers.places, .dont_care = true}},
                                   .depth = gl::Attachment{.texture = &receivers.depth, .dont_care = true},
                                   .depth_write = true});
  const glm::dmat4 view_to_world = glm::inverse(glm::dmat4(inputs.view.view));
  const gl::Program& program = context.use(pass, "receivers");
  program.set("view_to_world", glm::mat4(view_to_world));
  program.set("stored_rounding", over_floats(context.depth_rounding()));
  program.set("camera_distance", static_cast<float>(glm::length(glm::dvec3(view_to_world[3]))));
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  pass.draw_full_screen();
}

void darken(const PassContext& context, const Receivers& receivers) {
  const Rect& viewport = context.frame().viewport;
  const gl::Buffer& volumes = context.scratch("volumes", sizeof(Volumes));
  gl::write_value(volumes, volumes_of(context));
  const bool reversed = context.inputs().conventions.reversed_z;
  gl::Pass pass(context.device(), {.name = "shadow volumes",
                                   .colors = {{.texture = &context.mask(), .layer = context.frame().layer}},
                                   .depth = gl::Attachment{.texture = &receivers.depth},
                                   .depth_test = reversed ? gl::DepthTest::less : gl::DepthTest::greater,
                                   .depth_clamp = true});
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  volumes.bind_uniform(volumes_binding);
  receivers.places.bind(first_pass_unit);
  context.draw_caster_geometry(pass, "volumes", glm::mat4(1));
}

void resolve(const PassContext& context) {
  const auto target = [&](std::string_view name, GLenum format) -> const gl::Texture& {
    return context.target(name, {.format = format, .width = context.mask().width(), .height = context.mask().height()});
  };
  const Receivers receivers{.places = target("places", GL_RGBA32F), .depth = target("depth", GL_DEPTH_COMPONENT32F)};
  write_receivers(context, receivers);
  darken(context, receivers);
}

}  // namespace

Technique shadow_volume() {
  return {.name = "shadow_volume",
          .summary =
              "The shadow of the light's centre without a map: the "
              "volumes behind the casters' triangles, of which those "
              "with an alpha mask count as whole.",
          .source =
              "Crow 1977, Shadow algorithms for computer graphics; "
              "Sintorn, Olsson and Assarsson 2011, An efficient "
              "alias-free shadow algorithm for opaque and transparent "
              "objects using per-triangle shadow volumes",
          .glsl = {},
          .needs = {},
          .resolve = resolve,
          .resolve_reads_motion = false,
          .programs =
              [](const ParamSet&) {
                const std::string folder = "shadow/techniques/shadow_volume";
                return std::vector<gl::ProgramDesc>{
                    {.name = "receivers", .vertex = "shared/full_screen.vert", .fragment = folder + "_receivers.frag"},
                    {.name = "volumes", .geometry = folder + ".geom", .fragment = folder + ".frag"}};
              },
          .denoisable = false,
          .soft = false,
          .stand_in = "hard"};
}

}  // namespace penumbra::shadow
