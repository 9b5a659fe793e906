#pragma once

#include <algorithm>
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
    int channels = 0;              // that it needs, of signed numbers; 0: it is a depth texture
    int layers = 0;                // of an array, that it needs at least; 0: it is no array
    bool may_be_unsigned = false;  // the numbers, because a scale and an offset are given

    bool operator==(const Key&) const = default;
  };

  void begin() { last_.swap(now_), now_.clear(); }
  bool knows(const Key& key) const { return std::ranges::find(last_, key) != last_.end(); }
  void add(const Key& key) { now_.push_back(key); }

  DepthRounding depth;  // of the depth texture

 private:
  std::vector<Key> last_, now_;
};

// Like check(Inputs), but skips the textures that `checks` knows from the last frame.
void check(const Inputs& inputs, TextureChecks& checks);

}  // namespace penumbra::shadow
