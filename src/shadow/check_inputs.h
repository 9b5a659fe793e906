#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "depth_precision.h"
#include "inputs.h"

namespace penumbra::shadow {

// Remembers which of the caller's textures passed the checks in a view's last frame. OpenGL is queried about a texture
// again only when its name, size or use changes.
class TextureChecks {
 public:
  struct Key {
    unsigned id = 0;
    int width = 0, height = 0;
    int channels = 0;                          // that it needs, of signed numbers; 0: it is a depth texture
    int layers = 0;                            // of shadow maps, that it needs at least; 0: it is of receivers
    int layer = 0;                             // of receivers
    bool atlas = false;                        // of shadow maps
    bool may_be_unsigned = false;              // the numbers, because a scale and an offset are given
    std::optional<OutputTexture> output = {};  // drawn to, not read

    bool operator==(const Key&) const = default;
  };

  // How a texture of receivers is read.
  struct Source {
    unsigned target = 0;
    int sample = 0;         // of those of a pixel
    glm::vec2 place{0.5f};  // of that sample in the pixel, 0 to 1

    bool is_plain() const;  // a GL_TEXTURE_2D
    bool has_samples() const;
  };

  void begin() { last_.swap(now_), now_.clear(); }
  bool knows(const Key& key) const { return std::ranges::find(last_, key, &Entry::key) != last_.end(); }
  void add(const Key& key) { now_.push_back({.key = key}); }

  // The same for a texture of receivers: null if it is not known.
  const Source* known_source(const Key& key) const;
  void add(const Key& key, const Source& source) { now_.push_back({.key = key, .source = source}); }
  // Of one of this frame.
  const Source& source_of(const TextureView& view) const;

  // The same for an output of this frame, with its description; `size`: of its level.
  bool takes_known_output(const OutputTexture& output, const glm::ivec2& size);
  void add_output(const OutputTexture& output, const glm::ivec2& size, const gl::TextureDesc& desc);
  const gl::TextureDesc& desc_of(const OutputTexture& output) const;

  DepthRounding depth;  // of the depth texture

 private:
  struct Entry {
    Key key;
    gl::TextureDesc desc = {};  // of an output
    Source source = {};         // of receivers
  };
  std::vector<Entry> last_, now_;
};

// Like check(Inputs), but skips the textures that `checks` knows from the last frame.
void check(const Inputs& inputs, TextureChecks& checks);

}  // namespace penumbra::shadow
