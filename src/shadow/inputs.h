#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "../gl/pass.h"
#include "light_projection.h"

namespace penumbra::shadow {

// How the caller's depth buffer and matrices are meant.
struct Conventions {
  bool reversed_z = true;          // the far plane is at depth 0 (else 1); pixels exactly there are sky and lit
  bool depth_zero_to_one = true;   // clip-space z in 0..1 (else -1..1)
  bool octahedral_normals = true;  // normals texture: RG, octahedral map; else RGB(A), xyz; both in -1..1
};

// A camera now and in the last frame. Projections without jitter; `jitter` is what was added to clip-space xy (in NDC).
struct View {
  glm::mat4 view{1}, projection{1};
  // Optional: techniques with memory reproject with them. They are those of the last render() of this view, else its
  // history is dropped (see PassContext).
  glm::mat4 last_view{1}, last_projection{1};
  glm::vec2 jitter{0};
  int id = 0;        // tells several views apart: each has maps, a mask and a history of its own
  bool cut = false;  // nothing of the last frame belongs to this one: another scene, a jump of time
};

// A texture of the caller's: GL_TEXTURE_2D, one sample a texel (shadow maps: GL_TEXTURE_2D_ARRAY). How it filters,
// wraps and compares does not matter; its swizzle, base and maximum level and GL_DEPTH_STENCIL_TEXTURE_MODE are
// OpenGL's initial values.
struct TextureView {
  unsigned id = 0;
  int width = 0, height = 0;  // of level 0, texels
};

// A rectangle of texels; (x, y) is the lowest.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;

  bool operator==(const Rect&) const = default;
};

// Which casters are drawn, and what their fragments write to output 0, a float, besides depth. What moved has another
// transform, skin, morph or shape than in the last frame. What is new has no last position, and what is gone no present
// one.
enum class CasterKind {
  depth,            // all casters that the volume holds; no output
  depth_and_moved,  // the same; output 0, clear at first, ends as 1 where one that moved since the last frame is
                    // nearest, else 0. Cheap: what stands still first, colour writes off; then what moved, writing 1
  moved_now,        // those that moved, where they are; output 0 is 1
  moved_last,       // those that moved, where they were; output 0 is 1
  geometry,  // triangles for the technique's own shaders: see CasterPass::program. Opaque casters, and those that
             // alpha cuts out whole; blended surfaces are left out
};

// One call to the caller's code: draw these casters with these matrices. The framebuffer, viewport, depth test and
// culling state are set; the callback binds its own programs and vertex arrays, both sides of every triangle cast, and
// polygon offset stays off. Casters that are drawn in several of these passes must get the same depth in each: the same
// positions and matrices through the same sums. The kinds from depth_and_moved to moved_last are asked for only where
// something keeps history.
struct CasterPass {
  CasterKind kind = CasterKind::depth;
  int layer = 0;               // of the light's shadow map; 0 for kind `geometry`
  glm::mat4 world_to_clip{1};  // of the present frame, for moved_last too
  CullVolume cull;
  // Of kind `geometry`: the technique's geometry and fragment shaders and their defines, without a vertex shader. The
  // callback adds its own, which writes gl_Position = world_to_clip * world position (the identity asks for the world
  // position itself) and nothing that the stages after it read, and draws each triangle once, as GL_TRIANGLES. It
  // leaves textures, samplers, uniform buffers and storage buffers from binding 4 on as they are bound. Empty for the
  // other kinds.
  gl::ProgramDesc program = {};
};
using DrawCasters = std::function<void(const CasterPass&, gl::Pass&)>;

// Maps that the caller has drawn already: a depth texture array (or R32F) with the layers of a projection, near 0,
// far 1.
struct FinishedMaps {
  TextureView depth;
  LightProjection projection;
};

struct Light {
  int id = 0;  // each light of a frame has its own; maps and history go by it
  LightSource source;
  std::vector<std::string> overrides;  // "name=value": parameters that are this light's own
  std::optional<FinishedMaps> maps;    // absent: drawn by Inputs::draw
};

struct Inputs {
  View view;
  Conventions conventions;
  TextureView depth;    // any depth texture, or R32F
  TextureView normals;  // geometric normals, world space, signed (float or SNORM); the size of `depth`
  TextureView motion;  // optional (id 0), read by techniques with memory alone: RG, where the surface is minus where it
                       // was, in NDC; the size of `depth`
  Rect viewport;       // the part of the textures that the view was drawn to; without a size, all of it
  std::span<const Light> lights;
  // World bounds; unused when every light brings its maps. A point is a box, what was never set is none.
  Box casters{glm::vec3(1), glm::vec3(-1)}, receivers{glm::vec3(1), glm::vec3(-1)};
  // World bounds of the casters that moved since the last frame, where they are and where they were, together. Absent:
  // not known, so any may have. A box that holds nothing (min > max): none moved, and no movement map is drawn.
  // Where all lights bring their maps and there is no `draw`, no map can show what moved: with a movement.map, history
  // is then only kept in frames of which this says that none did.
  std::optional<Box> moved;
  DrawCasters draw;            // optional when every light brings its maps
  const void* user = nullptr;  // for techniques of the caller's own: handed on, never read
};

// Throws Error, in one line that names the input and the fault: textures that are none, of another size or of a format
// that can't be read as what they are given for; matrices that are not finite or can't be inverted; boxes that hold
// nothing or are not finite (`moved` may hold nothing); lights without direction, without maps, or with the id of
// another.
void check(const Inputs& inputs);

// Inputs::viewport, or all of the depth texture.
Rect viewport_of(const Inputs& inputs);

}  // namespace penumbra::shadow
