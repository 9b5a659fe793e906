#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>

#include "core/error.h"
#include "scene/gltf.h"
#include "scene/limits.h"

namespace penumbra::scene::gltf {

// Counts the memory that a scene makes the reader allocate, before it is allocated.
class Budget {
 public:
  explicit Budget(const ReadLimits& limits) : limits_(limits) {}

  // Counts what a file holds, each file once. `file` is empty for data that no other part of the scene can share.
  void add_file(const std::filesystem::path& file, std::size_t bytes) {
    if (file.empty() || files_.insert(file).second) file_bytes_ += bytes;
  }

  void spend_vertices(std::size_t count) {
    if (count > limits_.vertices - vertices_)
      fail_over_limit(fmt::format("at least {} vertices", vertices_ + count), limits_, &ReadLimits::vertices);
    vertices_ += count;
  }

  // Counts `count` elements of `size` bytes each.
  void spend(std::size_t count, std::size_t size) {
    ReadLimits allowed = limits_;
    allowed.decoded_bytes = std::min(limits_.decoded_bytes + limits_.decoded_ratio * file_bytes_, limits_.decoded_most);
    if (count > (allowed.decoded_bytes - std::min(spent_, allowed.decoded_bytes)) / size)
      fail_over_limit(fmt::format("{} bytes of files expand to more", file_bytes_), allowed,
                      &ReadLimits::decoded_bytes);
    spent_ += count * size;
  }

  // Counts an image's decoded pixels.
  void spend_image(std::size_t bytes) {
    if (bytes > limits_.image_bytes - std::min(image_bytes_, limits_.image_bytes))
      fail_over_limit("the images decode to more", limits_, &ReadLimits::image_bytes);
    image_bytes_ += bytes;
  }

 private:
  ReadLimits limits_;
  std::set<std::filesystem::path> files_;
  std::size_t file_bytes_ = 0, vertices_ = 0, spent_ = 0, image_bytes_ = 0;
};

}  // namespace penumbra::scene::gltf
