#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "depth_precision.h"
#include "inputs.h"

namespace penumbra::shadow {

// Remembers which of the caller's textures passed the checks in a view's last frames. OpenGL is queried about a texture
// again only when its name, size or use was in none of them.
class TextureChecks {
 public:
  static constexpr int remembered_frames = 3;  // of engines that take turns with two or three textures

  struct Key {
    unsigned id = 0;
    int width = 0, height = 0;
    int channels = 0;                          // that it needs, of signed numbers; 0: it is a depth texture
    int layers = 0;                            // of shadow maps, that it needs at least; 0: it is of receivers
    int layer = 0;                             // of receivers
    bool atlas = false, lamp = false;          // of shadow maps
    bool may_be_unsigned = false;              // the numbers, because a scale and an offset are given
    std::optional<OutputTexture> output = {};  // drawn to, not read

    bool operator==(const Key&) const = default;
  };

  // How a texture is read.
  struct Source {
    unsigned target = 0;
    int sample = 0;               // of receivers: of those of a pixel
    glm::vec2 place{0.5f};        // of that sample in the pixel, 0 to 1
    DepthRounding rounding = {};  // of receivers' depths
    bool can_compare = false;     // of shadow maps: they have a depth format, which samplers can compare

    bool is_plain() const;  // a GL_TEXTURE_2D
    bool has_samples() const;
  };

  void begin();

  // Null if it is not known.
  const Source* known_source(const Key& key) const;
  void add(const Key& key, const Source& source) { now_.push_back({.key = key, .source = source}); }
  // Of a texture of receivers of this frame.
  const Source& source_of(const TextureView& view) const;
  // Of shadow maps of this frame.
  const Source& source_of(const FinishedMaps& maps) const;

  // The same for an output of this frame, with its description; `size`: of its level.
  bool takes_known_output(const OutputTexture& output, const glm::ivec2& size);
  void add_output(const OutputTexture& output, const glm::ivec2& size, const gl::TextureDesc& desc);
  const gl::TextureDesc& desc_of(const OutputTexture& output) const;

  DepthRounding depth;  // of the depth texture

 private:
  struct Entry {
    Key key;
    gl::TextureDesc desc = {};  // of an output
    Source source = {};         // of any other
    int frames = 1;             // since it was used, and that one
  };
  std::vector<Entry> last_, now_;
};

// Like check(Inputs), but skips the textures that `checks` knows from the last frame.
void check(const Inputs& inputs, TextureChecks& checks);

// A line for the log if `zero_to_one`, to which the caller has set clip space by glClipControl, contradicts the
// conventions, and the projection does not show that these are right; else "".
std::string clip_control_warning(const glm::mat4& projection, const Conventions& conventions, bool zero_to_one);

}  // namespace penumbra::shadow
