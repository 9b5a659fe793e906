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

// How to interpret the caller's depth buffer, matrices and normals. A projection that contradicts `reversed_z` is
// refused, and a perspective of reversed Z whose depths never reach -1 if they are said to. Other ranges can't be told
// from a projection with another near or far plane: a view's first frame warns if glClipControl contradicts them.
struct Conventions {
  bool reversed_z = true;          // the far plane has depth 0 (else 1); pixels with exactly that depth are sky and lit
  bool depth_zero_to_one = true;   // clip-space z in 0..1 (else -1..1)
  bool octahedral_normals = true;  // normals texture: RG, octahedral map; else RGB(A), xyz; both in -1..1
  // What the normals texture holds, times that scale and plus that offset, is in -1..1: 2 and -1 for normals that were
  // stored as 0.5 + 0.5 n. Finite, the scale not 0.
  float normals_scale = 1, normals_offset = 0;
  // The normals texture holds shading normals, interpolated between vertices, not those of the triangles. Geometric
  // ones are then made from depth, as without a texture (see Inputs::normals), and the given ones say which neighbours
  // of a pixel belong to its surface, and stand in where none does.
  bool shading_normals = false;
};

// A camera in this frame and in the last one. Projections are without jitter; `jitter` is the subpixel offset that was
// added to clip-space xy (in NDC).
struct View {
  // From world to view space, in metres; it turns and moves, and mirrors for a planar reflection. The camera looks
  // along -z.
  glm::mat4 view{1};
  // Perspective or orthographic, also beside the middle of the picture, with an oblique near plane, or scaled as a
  // whole. x of clip space may depend on x and z of view space, y on y and z, w on z: what turns the picture belongs
  // into `view`.
  glm::mat4 projection{1};
  // Used to reproject the history. They must equal the matrices of this view's last render(), else the history and the
  // kept maps are discarded (see PassContext and Inputs::moved). Where they are also those of this frame, the view
  // rests, and the parameter maps.jitter moves the maps.
  glm::mat4 last_view{1}, last_projection{1};
  glm::vec2 jitter{0};
  int id = 0;            // identifies the view: each has its own shadow maps, mask and history
  bool cut = false;      // discards the history and the kept maps: for a camera cut, another scene or a jump in time
  bool restart = false;  // discards the history alone: Inputs::moved still says what moved since the view's last frame
};

// A texture that the caller owns. Shadow maps are a GL_TEXTURE_2D_ARRAY or an atlas. Of receivers it is a GL_TEXTURE_2D
// or a layer of an array, such as that of one eye; or one of both with samples, of which the one nearest to the pixel's
// centre is read. What is not a GL_TEXTURE_2D is copied in each frame. Its filter, wrap and compare modes do not
// matter; its swizzle, base and maximum level and GL_DEPTH_STENCIL_TEXTURE_MODE must have OpenGL's initial values:
// a swizzle of channels that are read, another base level and another mode are refused.
struct TextureView {
  unsigned id = 0;
  int width = 0, height = 0;  // of level 0, texels
  int layer = 0;              // of an array of receivers; else 0
};

// A rectangle of texels; (x, y) is its lower left texel.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;

  bool operator==(const Rect&) const = default;
};

// Which casters the callback draws, and what their fragments write to colour output 0 (a float) besides depth. A caster
// has moved if its transform, skinning, morph weights or shape differ from the last frame. A caster that appeared is
// drawn at its present position only, one that disappeared at its last position only.
enum class CasterKind {
  depth,            // all casters in the cull volume; no colour output
  depth_and_moved,  // the same; output 0, cleared to 0, must end as 1 where a caster that moved since the last frame is
                    // nearest to the light. To save time draw the static casters first, without
                    // colour writes, then those that moved, writing 1
  moved_now,        // casters that moved, at their present positions; output 0 is 1
  moved_last,       // casters that moved, at their last positions; output 0 is 1
  second_depth,     // all casters; output 0, cleared to 1, must end as the least depth behind the nearest one: see
                    // CasterPass::gap
  geometry,         // triangles for the technique's own shaders: see CasterPass::program. Opaque casters, and
                    // alpha-tested ones as whole triangles; no blended surfaces. A triangle that casts no shadow,
                    // because only the surface's other face does, is left out or has all corners in one place
};

// One call to the caller's code: draw these casters with these matrices. The framebuffer, viewport, scissor, depth
// test and blending are set; culling and polygon offset are off, front faces counter-clockwise and back faces those
// that would be culled, and no matrix mirrors; the callback binds its own programs and vertex arrays. Both sides of
// every triangle cast shadows unless the caller decides otherwise. A caster that is drawn in several of these passes
// must get bit-identical depths in each, so compute positions by the same expressions
// (`invariant gl_Position`). The kinds from depth_and_moved to moved_last are requested only when the denoiser keeps a
// history.
struct CasterPass {
  CasterKind kind = CasterKind::depth;
  // Of the light's shadow map; 0 for kind `geometry`. With cascades.fit=penumbrae also of smaller maps that are drawn
  // first, so that a layer may come twice, with another matrix.
  int layer = 0;
  // Of this frame, also for moved_last. Clip space has z in 0..1, 0 near the light; under lamps whose maps the library
  // draws, but for kind `geometry`, it is 1 there, and the pass's depth range, which must stay, stores it as 0.
  glm::mat4 world_to_clip{1};
  // The same for positions less an anchor in the layer: gl_Position = anchored.to_clip * vec4(position -
  // anchored.anchor, 1). Far from the world's origin world_to_clip has too few digits: under lamps from about 50 m,
  // under suns from 2 km on, surfaces would shadow themselves. Use one of both in all passes of a light. For kind
  // `geometry` the anchor is 0.
  AnchoredMatrix anchored;
  CullVolume cull;
  LightSource source;  // of the light: where only one face of a surface casts shadows, which one faces the light
  // For the kind `second_depth`: the fragment shader writes gl_FragCoord.z + gap to output 0, and discards only what an
  // alpha test discards. The pass tests against the depths of the shadow map itself, which it must not write, lets what
  // is behind them pass, and blends so that the least stays (Everitt 2001, "Interactive order-independent
  // transparency": depth peeling); its own matrices bring surfaces nearer to the light by the gap (maps.gap). Of
  // surfaces whose back faces are never seen, such as those of closed objects, only faces towards the light should be
  // drawn: else the second layer of an object is its own underside, and what lies below it is lost.
  float gap = 0;
  // For kind `geometry`: the technique's geometry and fragment shaders and their defines, without a vertex shader. The
  // callback adds its own vertex shader, which writes gl_Position = world_to_clip * world position (the matrix may be
  // the identity) and no other output that later stages read, and draws each triangle once, as GL_TRIANGLES. It must
  // not change any binding of textures, samplers and uniform buffers, nor those of storage buffers from 4 on. Empty for
  // the other kinds.
  gl::ProgramDesc program = {};
};
using DrawCasters = std::function<void(const CasterPass&, gl::Pass&)>;

// A shadow map that the caller has already drawn: a depth texture array, or R32F (which is refused with the techniques
// pcf_hardware and pcf_poisson, whose samplers compare, and where a second layer is drawn behind it), with
// LightProjection::given_layers() layers; 0 is near, 1 far. Or an atlas, a GL_TEXTURE_2D whose parts are copied to an
// array in each frame. Copied as well are maps of which none holds all others: a further one that does is made from
// them.
struct FinishedMaps {
  TextureView depth;
  LightProjection projection;
  std::vector<glm::ivec2> atlas = {};  // where each layer begins, texels: its lower left corner; empty: an array
  bool reversed = false;               // 1 is near, 0 far; copied in each frame, too

  bool is_copied() const { return reversed || !atlas.empty() || projection.given_layers() < projection.layers(); }
};

// A channel of a texture of the caller's, to which a light's visibility is written beside the mask: 1 is lit, 0 is in
// shadow, rounded to the nearest value of the format. The texture is a GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY, immutable
// or not, in R8, RG8, RGBA8, R16F, RG16F or RGBA16F; the level is as large as Inputs::depth. Other channels, layers and
// levels stay as they are, and so do texels outside of the viewport.
struct OutputTexture {
  unsigned id = 0;
  int level = 0;
  int layer = 0;    // of an array; else 0
  int channel = 0;  // 0 to 3: red, green, blue, alpha

  bool operator==(const OutputTexture&) const = default;
};

// A light that casts shadows. Its colour and intensity are left to the caller: the mask is the same for all.
struct Light {
  int id = 0;  // unique among the lights of a frame; identifies the light's maps and history from frame to frame
  LightSource source;
  std::vector<std::string> overrides;  // "name=value": parameter values for this light only
  std::optional<FinishedMaps> maps;    // absent: drawn by Inputs::draw
  std::optional<OutputTexture> output = {};
};

struct Inputs {
  View view;
  Conventions conventions;
  // Any depth texture, or R32F. The bias covers what the texture's format and the projection round
  // away, so it grows where positions are imprecise, and casters nearer than that to what they shadow cast no shadow. A
  // near plane of 0.1 m and 24 bits cost nothing visible; reversed Z in 32-bit floats is precise with any near plane. A
  // warning (core/log.h) says once for a view if positions are off by more than 1/200 of their distance from the
  // camera.
  TextureView depth;
  // Geometric normals, world space; the size of `depth`. Float or SNORM formats, and with a scale and an offset (see
  // Conventions) UNORM ones too, such as RGBA8, RGB10_A2 and RG16. RG8 is too coarse for octahedral normals, and
  // R11F_G11F_B10F, whose floats have no sign and 6 bits, is refused.
  // Optional (id 0: none): normals are then made from the depths of each pixel and its neighbours. Pixels at outlines
  // and on surfaces of less than 3 pixels may get a wrong normal, and casters nearer to what they shadow than its
  // rounded depths can tell cast no shadow, which shows in coarse depth formats. Half floats are refused as such
  // depths.
  TextureView normals;
  TextureView motion;  // optional (id 0: none), read only where a history is kept: RG, the surface's position in NDC
                       // minus that in the last frame, both without jitter; the size of `depth`
  Rect viewport;       // the part of the textures that the view was drawn to; all of it if the size is 0
  std::span<const Light> lights;
  // World bounds; unused when every light brings its maps. A single point (min = max) is valid; the default (min > max)
  // is an unset box, which check() rejects. `receivers` must hold all surfaces whose shadows are computed, those drawn
  // forward too, and `casters` all that casts: casters are drawn only to texels of the maps that lie in the casters'
  // box as the light sees it, and that what the view sees of the receivers' box can read (see
  // Technique::reads_light_discs). For techniques that read so, what casts on nothing, such as a ground below
  // everything, is best left out of both the box and the callback: tighter boxes cost less. Those that average depths
  // need it.
  Box casters{glm::vec3(1), glm::vec3(-1)}, receivers{glm::vec3(1), glm::vec3(-1)};
  // Whether `casters` and `receivers` are no larger than what they hold. If not, boxes of more than 10 km, such as
  // those of a sky's dome, limit what a sun's maps hold, so that near shadows stay right. Receivers more than 1 km from
  // the camera are then lit, unless the parameter cascades.distance says how far shadows reach or cascades.fit=visible
  // or penumbrae measures it; and casters more than 10 km before the receivers, along the light, cast no shadow. A
  // warning (core/log.h) says so once for a view.
  bool exact_bounds = false;
  // World bounds of those receivers that `depth` does not hold, such as blended surfaces that are drawn forward; empty
  // (min > max in every axis): there are none. Where maps are fitted to what `depth` shows (cascades.fit) they hold
  // these, too: elsewhere in the view no map holds anything, and receivers are lit. Where there are some, maps.jitter
  // does not move maps from frame to frame, since these receivers have no history.
  Box forward_receivers{glm::vec3(1), glm::vec3(-1)};
  // Whether SoftShadows::bind_forward() may follow this frame. If not, a technique that fills the mask by itself needs
  // no maps for its stand-in (Technique::stand_in), maps.overlap may leave out second layers, and bind_forward()
  // throws Error for lights that lack what forward surfaces read.
  bool binds_forward = true;
  // World bounds of the casters that moved since the view's last frame, enclosing their present and their last
  // positions. Absent: unknown, so any caster may have moved. An empty box (min > max in every axis): none moved, and
  // no movement map is drawn.
  // A layer of a shadow map that these bounds do not reach, and whose projection is the same, is not drawn again
  // (parameter maps.keep): `draw` is not called for it. So the bounds must also enclose casters that appeared,
  // disappeared, or changed what they cast in another way: the opacity of a texture, the face that casts, a level of
  // detail. Bounds that are too small can't be detected: the shadow of what they leave out stays as it was. Where the
  // caller does not know, they must be absent, or View::cut set.
  // Where all lights bring their maps and there is no `draw`, no movement map can be drawn: if the parameter
  // movement.map is on, the history is then used only in frames whose box is empty.
  std::optional<Box> moved;
  // Whether Mask::texture has a penumbra radius, a blocker distance and a layer of the shadow map beside visibility: 8
  // bytes a pixel and light instead of 2. Visibility is the same.
  bool mask_details = false;
  // Optional when every light brings its maps, unless a technique or recipe draws casters itself.
  DrawCasters draw;
  const void* user = nullptr;  // passed on to the caller's own techniques; the library never reads it

  // Whether geometric normals are made from depth.
  bool makes_normals() const { return normals.id == 0 || conventions.shading_normals; }
};

// Throws Error, in one line that names the input and the fault, for: textures that don't exist, have the wrong size or
// a format that does not suit their use; matrices that are not finite or not invertible, a view with a scale or for a
// camera that looks along +z; boxes that are empty or not finite (`moved` and `forward_receivers` may be empty); lights
// without direction, without maps, or with the same id as another; outputs that two lights share, that are read as
// another input, or whose level, layer, channel or format does not exist or suit.
void check(const Inputs& inputs);

// Inputs::viewport, or the whole depth texture if that has no size.
Rect viewport_of(const Inputs& inputs);

}  // namespace penumbra::shadow
