#pragma once

#include <algorithm>
#include <vector>

#include "inputs.h"

namespace penumbra::shadow {

// The caller's textures that were found good in a view's last frame. OpenGL is asked about a texture again only when
// its name, its size or what it is used for is another.
class TextureChecks {
 public:
  struct Key {
    unsigned id = 0;
    int width = 0, height = 0;
    int channels = 0;  // signed numbers; 0: depth
    int layers = 1;    // at least

    bool operator==(const Key&) const = default;
  };

  void begin() { last_.swap(now_), now_.clear(); }
  bool knows(const Key& key) const { return std::ranges::find(last_, key) != last_.end(); }
  void add(const Key& key) { now_.push_back(key); }

 private:
  std::vector<Key> last_, now_;
};

// As check(Inputs), with what is known of the last frame.
void check(const Inputs& inputs, TextureChecks& checks);

}  // namespace penumbra::shadow
