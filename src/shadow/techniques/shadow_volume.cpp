// Shadow volumes: what lies behind each of the casters' triangles is counted in a stencil, by depth-fail.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "../pass_context.h"
#include "../technique.h"

namespace penumbra::shadow {

namespace {

// What shadow_volume.geom reads.
struct Volumes {
  glm::mat4 world_to_clip;
  glm::vec4 apex;   // clip space: the point at infinity where a sun's rays meet; of a lamp: minus its centre
  glm::vec4 light;  // world, homogeneous: see place_of()
  float short_of = 0, nearest = 0, unused[2] = {};
};
constexpr GLuint volumes_binding = block_samples;  // the technique has no sample points

// The stencil of receivers in no volume. Where faces of a volume meet within the rasteriser's fraction of a pixel, one
// that is entered behind a receiver can be left before it, which counts -1. This leaves room for it below.
constexpr unsigned in_no_volume = 4;

// From world space to the clip space whose depths, 0..1, are those of the receivers' texture.
glm::mat4 world_to_depth(const Inputs& inputs) {
  glm::dmat4 projection(inputs.view.projection);
  for (glm::length_t column = 0; column < 4; ++column) {
    const double w = projection[column].w;
    projection[column].x += w * static_cast<double>(inputs.view.jitter.x);
    projection[column].y += w * static_cast<double>(inputs.view.jitter.y);
    if (!inputs.conventions.depth_zero_to_one) projection[column].z = 0.5 * (projection[column].z + w);
  }
  return glm::mat4(projection) * inputs.view.view;
}

// Between two depths that a texture can hold; 0: it holds floats.
float spacing_of(GLenum format) {
  switch (format) {
    case GL_DEPTH_COMPONENT16:
      return std::ldexp(1.0f, -16);
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH24_STENCIL8:
      return std::ldexp(1.0f, -24);
    default:
      return 0;
  }
}

// Where the camera's rays are parallel, nothing at infinity is on the picture, and a rasteriser leaves out triangles
// that are much larger than it. Volumes then end this share of the way short of infinity, beyond all receivers: the
// corner of a caster at that distance from the lamp reaches twice as far as they do.
float short_of_infinity(const Inputs& inputs, const glm::vec3& lamp, float nearest) {
  const bool perspective = inputs.view.projection[2][3] != 0;
  if (perspective) return 0;
  constexpr float usual = 1e-3f;
  const Box& box = inputs.receivers;
  const float reach = glm::length(glm::max(glm::abs(box.min - lamp), glm::abs(box.max - lamp)));
  return glm::all(glm::lessThanEqual(box.min, box.max)) ? 0.5f * nearest / std::max(reach, nearest) : usual;
}

void copy_receivers(const PassContext& context, const gl::Texture& depth_stencil) {
  const Inputs& inputs = context.inputs();
  const Rect& viewport = context.frame().viewport;
  gl::Pass pass(context.device(), {.name = "receivers",
                                   .colors = {{.texture = &context.mask(), .layer = context.frame().layer}},
                                   .depth = gl::Attachment{.texture = &depth_stencil},
                                   .depth_write = true});
  const gl::Program& program = context.use(pass, "receivers");
  program.set("stored_spacing", spacing_of(context.receiver_depth().desc().format));
  program.set("camera_distance",
              static_cast<float>(glm::length(glm::dvec3(glm::inverse(glm::dmat4(inputs.view.view))[3]))));
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  pass.draw_full_screen();
}

// Everitt and Kilgard 2002: of the faces behind a receiver, those that the camera sees from outside are subtracted from
// those that it sees from inside. The difference is the number of volumes that hold the receiver, wherever the camera
// is.
void count_volumes(const PassContext& context, const gl::Texture& depth_stencil) {
  const Inputs& inputs = context.inputs();
  const Rect& viewport = context.frame().viewport;
  const glm::mat4 world_to_clip = world_to_depth(inputs);
  const glm::vec4 light = place_of(context.light().source);
  const gl::Buffer& volumes = context.scratch("volumes", sizeof(Volumes));
  const float nearest = context.params().get_float("lamps.near");
  gl::write_value(volumes, Volumes{.world_to_clip = world_to_clip,
                                   .apex = world_to_clip * -light,
                                   .light = light,
                                   .short_of = short_of_infinity(inputs, glm::vec3(light), nearest),
                                   .nearest = nearest});
  const bool reversed = inputs.conventions.reversed_z;
  gl::Pass pass(context.device(), {.name = "shadow volumes",
                                   .depth = gl::Attachment{.texture = &depth_stencil},
                                   .depth_test = reversed ? gl::DepthTest::greater : gl::DepthTest::less,
                                   .stencil = gl::Stencil{.front = {.depth_fail = gl::StencilOp::decrement_wrap},
                                                          .back = {.depth_fail = gl::StencilOp::increment_wrap},
                                                          .clear = in_no_volume},
                                   .depth_clamp = true});
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  volumes.bind_uniform(volumes_binding);
  context.draw_caster_geometry(pass, "volumes", glm::mat4(1));
}

void darken(const PassContext& context, const gl::Texture& depth_stencil) {
  const gl::StencilFace inside{.test = gl::StencilTest::less};  // the reference is less than what is stored
  const Rect& viewport = context.frame().viewport;
  gl::Pass pass(context.device(), {.name = "shadowed receivers",
                                   .colors = {{.texture = &context.mask(), .layer = context.frame().layer}},
                                   .depth = gl::Attachment{.texture = &depth_stencil},
                                   .stencil = gl::Stencil{.front = inside, .back = inside, .reference = in_no_volume}});
  context.use(pass, "shadowed");
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  pass.draw_full_screen();
}

void resolve(const PassContext& context) {
  // Not the caller's texture, even if it has a stencil: that is the caller's.
  const gl::Texture& depth_stencil = context.target(
      "depth and stencil",
      {.format = GL_DEPTH32F_STENCIL8, .width = context.mask().width(), .height = context.mask().height()});
  copy_receivers(context, depth_stencil);
  count_volumes(context, depth_stencil);
  darken(context, depth_stencil);
}

}  // namespace

Technique shadow_volume() {
  return {
      .name = "shadow_volume",
      .summary =
          "The shadow of the light's centre without a map: the volumes behind the casters' triangles, of which those "
          "with an alpha mask count as whole.",
      .source =
          "Crow 1977, Shadow algorithms for computer graphics; Everitt and Kilgard 2002, Practical and robust "
          "stenciled shadow volumes for hardware-accelerated rendering",
      .glsl = {},
      .needs = {},
      .resolve = resolve,
      .resolve_reads_motion = false,
      .programs =
          [](const ParamSet&) {
            const std::string folder = "shadow/techniques/shadow_volume";
            return std::vector<gl::ProgramDesc>{
                {.name = "receivers", .vertex = "shared/full_screen.vert", .fragment = folder + "_receivers.frag"},
                {.name = "volumes", .geometry = folder + ".geom"},
                {.name = "shadowed", .vertex = "shared/full_screen.vert", .fragment = folder + "_shadowed.frag"}};
          },
      .denoisable = false,
      .soft = false,
      .stand_in = "hard"};
}

}  // namespace penumbra::shadow
