#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/gltf/document.h"

namespace penumbra::scene::gltf {

// The elements of an accessor: where they are and how to read them. Elements 0 to count - 1 are already checked to be
// inside `bytes`.
struct AccessorView {
  std::string name;  // for messages
  int component_type = 0;
  int components = 1;
  bool normalized = false;
  std::size_t count = 0, stride = 0;
  Bytes bytes;                   // empty: all elements are zero
  std::vector<uint32_t> sparse;  // in increasing order: the elements that `sparse_bytes` replaces
  Bytes sparse_bytes;            // tightly packed

  std::size_t element_size() const;
  // Null if the element is all zeros.
  const std::byte* element(std::size_t index) const;
  // A component as a number; integers are normalized if the accessor says so.
  float number(const std::byte* element, int component) const;
  uint32_t integer(const std::byte* element, int component) const;
};

AccessorView view_accessor(Document& document, int accessor);

// Which elements of its accessors a primitive uses: all, or a list.
struct Selection {
  std::size_t count = 0;
  std::vector<uint32_t> elements;  // empty: all
  std::size_t operator[](std::size_t i) const { return elements.empty() ? i : elements[i]; }
};

std::size_t component_size(int component_type);

// Throws unless the accessor has that many components.
void expect_components(const AccessorView& view, int components);
[[noreturn]] void fail_not_finite(const AccessorView& view, std::size_t element);

// Float vectors; throws Error on a number that is not finite.
template <int N>
std::vector<glm::vec<N, float>> read_vectors(const AccessorView& view, const Selection& selection) {
  expect_components(view, N);
  std::vector<glm::vec<N, float>> vectors(selection.count, glm::vec<N, float>(0));
  for (std::size_t i = 0; i < selection.count; ++i) {
    const std::byte* element = view.element(selection[i]);
    if (element == nullptr) continue;
    for (int c = 0; c < N; ++c) {
      const float number = view.number(element, c);
      if (!std::isfinite(number)) fail_not_finite(view, selection[i]);
      vectors[i][c] = number;
    }
  }
  return vectors;
}

// The same, but vectors that are not finite become zero, and their number is added to `wrong`.
template <int N>
std::vector<glm::vec<N, float>> read_finite_vectors(const AccessorView& view, const Selection& selection,
                                                    std::size_t& wrong) {
  expect_components(view, N);
  std::vector<glm::vec<N, float>> vectors(selection.count, glm::vec<N, float>(0));
  for (std::size_t i = 0; i < selection.count; ++i) {
    const std::byte* element = view.element(selection[i]);
    if (element == nullptr) continue;
    glm::vec<N, float> vector;
    for (int c = 0; c < N; ++c) vector[c] = view.number(element, c);
    if (glm::any(glm::isnan(vector)) || glm::any(glm::isinf(vector)))
      ++wrong;
    else
      vectors[i] = vector;
  }
  return vectors;
}

template <int N>
std::vector<glm::vec<N, float>> read_vectors(const AccessorView& view) {
  return read_vectors<N>(view, Selection{.count = view.count});
}

// All components of all elements, one after the other; throws Error on a number that is not finite.
std::vector<float> read_numbers(const AccessorView& view);

// A scalar accessor of unsigned integers.
std::vector<uint32_t> read_integers(const AccessorView& view);

}  // namespace penumbra::scene::gltf
