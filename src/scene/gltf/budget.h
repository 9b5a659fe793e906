#pragma once

#include <cstddef>

#include "core/error.h"
#include "scene/gltf.h"

namespace penumbra::scene::gltf {

// Counts what a scene makes the reader allocate, before it is allocated.
class Budget {
 public:
  explicit Budget(const ReadLimits& limits) : limits_(limits) {}

  void add_file(std::size_t bytes) { file_bytes_ += bytes; }

  void spend_vertices(std::size_t count) {
    if (count > limits_.vertices - vertices_) fail("more than the limit of {} vertices", limits_.vertices);
    vertices_ += count;
  }

  // `count` things of `size` bytes each.
  void spend(std::size_t count, std::size_t size) {
    const std::size_t limit = limits_.decoded_bytes + limits_.decoded_ratio * file_bytes_;
    if (count > (limit - spent_) / size)
      fail("expands to more than {} bytes, the limit for its {} bytes", limit, file_bytes_);
    spent_ += count * size;
  }

 private:
  ReadLimits limits_;
  std::size_t file_bytes_ = 0, vertices_ = 0, spent_ = 0;
};

}  // namespace penumbra::scene::gltf
