#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "texture.h"

namespace penumbra::gl {

// A texture that a pass draws to, and what becomes of its contents when the pass begins: cleared with `clear`,
// undefined with `dont_care`, else kept.
struct Attachment {
  static constexpr int all_layers = -1;

  const Texture* texture = nullptr;  // Penumbra's own, or the caller's by Texture::wrap()
  int level = 0;
  int layer = 0;  // of an array; all_layers: a geometry shader chooses with gl_Layer, and a clear clears all
  // For depth, .x is the depth. For integer colours it is converted to integers.
  std::optional<glm::vec4> clear;
  // Contents become undefined (glInvalidateNamedFramebufferData): for passes that write every texel, so that a GPU need
  // not load the old ones.
  bool dont_care = false;
};

// `less` passes where the new depth < the stored one, and so on.
enum class DepthTest { off, less, less_equal, equal, greater_equal, greater };
enum class Blend { off, premultiplied_over, min, max, add };

// `less` passes where (reference & read mask) < (stored value & read mask), and so on.
enum class StencilTest { always, never, less, less_equal, equal, not_equal, greater_equal, greater };
enum class StencilOp { keep, zero, replace, increment, increment_wrap, decrement, decrement_wrap, invert };

// Stencil test and operations for front- or back-facing triangles.
struct StencilFace {
  StencilTest test = StencilTest::always;
  StencilOp fail = StencilOp::keep;        // the stencil test failed
  StencilOp depth_fail = StencilOp::keep;  // it passed, the depth test failed
  StencilOp pass = StencilOp::keep;        // both passed
};

struct Stencil {
  StencilFace front, back;  // counter-clockwise is front; culling is off unless the pass asks for it
  unsigned reference = 0;
  unsigned read_mask = 0xff, write_mask = 0xff;
  // When the pass begins: cleared to a value (whatever the write mask), undefined with `dont_care`, else kept.
  std::optional<unsigned> clear;
  bool dont_care = false;
};

// (x, y) is the lower left texel.
struct TexelRect {
  int x = 0, y = 0, width = 0, height = 0;
};

// What a raster pass draws to, and all of its state: nothing is inherited from earlier passes, so they can be
// reordered.
struct PassDesc {
  std::string_view name;  // debug group, timer row and bench row
  std::vector<Attachment> colors;
  std::optional<Attachment> depth;
  DepthTest depth_test = DepthTest::off;
  bool depth_write = false;
  // Needs a depth attachment of a format that has stencil (GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8). Without it the
  // stencil test is off and stored stencil values stay.
  std::optional<Stencil> stencil;
  Blend blend = Blend::off;
  unsigned channels = 0xf;  // of colours that draws write: bit 0 red to bit 3 alpha; clears write all
  bool cull_back = false;   // counter-clockwise is front
  bool depth_clamp = false;
  bool depth_reversed = false;       // clip-space depths of 0 to 1 are tested and stored as 1 to 0
  std::optional<TexelRect> scissor;  // draws change only these texels; clears are not limited
};

}  // namespace penumbra::gl
