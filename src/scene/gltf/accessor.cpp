#include "scene/gltf/accessor.h"

#include <algorithm>
#include <cmath>

namespace penumbra::scene::gltf {
namespace {

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

int component_count(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_MAT2:
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT3:
      return 9;
    default:
      return 16;
  }
}

// Throws unless `count` elements of `size` bytes, `stride` apart, from `offset` on lie inside the bufferView.
Bytes checked_range(const Document& document, int view, std::size_t offset, std::size_t count, std::size_t stride,
                    std::size_t size) {
  const Bytes bytes = document.views[static_cast<std::size_t>(view)];
  if (bytes.empty()) return {};  // its buffer has no data, so all elements are zero
  // count is below 2^31 and stride below 2^8: no overflow.
  if (offset > bytes.size() || stride * (count - 1) + size > bytes.size() - offset)
    fail("{} elements of {} bytes from byte {} don't fit the {} bytes of bufferView {}", count, size, offset,
         bytes.size(), view);
  return bytes.subspan(offset);
}

void add_sparse(Document& document, const tinygltf::Accessor& accessor, AccessorView& view) {
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<std::size_t>(sparse.count);
  if (count > view.count) fail("{} sparse elements of {}", count, view.count);
  const std::size_t index_size = component_size(sparse.indices.componentType);
  const Bytes indices =
      checked_range(document, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                    index_size, index_size);
  view.sparse_bytes =
      checked_range(document, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                    view.element_size(), view.element_size());
  document.budget.spend(count, sizeof(uint32_t));
  if (indices.empty() || view.sparse_bytes.empty()) fail("its sparse elements have no data");
  const AccessorView index_view{.component_type = sparse.indices.componentType};
  for (std::size_t i = 0; i < count; ++i) {
    const uint32_t index = index_view.integer(indices.data() + i * index_size, 0);
    if (index >= view.count) fail("sparse element {} of {}", index, view.count);
    if (i > 0 && index <= view.sparse.back()) fail("sparse elements are not in increasing order");
    view.sparse.push_back(index);
  }
}

}  // namespace

std::size_t component_size(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    default:
      return 4;
  }
}

std::size_t AccessorView::element_size() const {
  return component_size(component_type) * static_cast<std::size_t>(components);
}

const std::byte* AccessorView::element(std::size_t index) const {
  if (!sparse.empty()) {
    const auto found = std::lower_bound(sparse.begin(), sparse.end(), index);
    if (found != sparse.end() && *found == index)
      return sparse_bytes.data() + static_cast<std::size_t>(found - sparse.begin()) * element_size();
  }
  return bytes.empty() ? nullptr : bytes.data() + index * stride;
}

float AccessorView::number(const std::byte* element, int component) const {
  const std::byte* at = element + component_size(component_type) * static_cast<std::size_t>(component);
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return load<float>(at);
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const float value = load<int8_t>(at);
      return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const float value = load<int16_t>(at);
      return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(at) / (normalized ? 255.0f : 1.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<uint16_t>(at) / (normalized ? 65535.0f : 1.0f);
    default:
      return static_cast<float>(load<uint32_t>(at)) / (normalized ? 4294967295.0f : 1.0f);
  }
}

uint32_t AccessorView::integer(const std::byte* element, int component) const {
  const std::byte* at = element + component_size(component_type) * static_cast<std::size_t>(component);
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<uint16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<uint32_t>(at);
    default:
      fail("{} must hold unsigned integers", name);
  }
}

AccessorView view_accessor(Document& document, int index) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  AccessorView view{.name = fmt::format("accessors[{}]", index),
                    .component_type = accessor.componentType,
                    .components = component_count(accessor.type),
                    .normalized = accessor.normalized,
                    .count = accessor.count};
  try {
    view.stride = view.element_size();
    if (accessor.bufferView >= 0) {
      const std::size_t stride = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
      if (stride != 0 && stride < view.stride) fail("byteStride {} is less than its {} bytes", stride, view.stride);
      if (stride != 0) view.stride = stride;
      view.bytes = checked_range(document, accessor.bufferView, accessor.byteOffset, view.count, view.stride,
                                 view.element_size());
    }
    if (accessor.sparse.isSparse) add_sparse(document, accessor, view);
  } catch (const Error& e) {
    fail("{}: {}", view.name, e.what());
  }
  return view;
}

void expect_components(const AccessorView& view, int components) {
  if (view.components != components) fail("{} has {} components, not {}", view.name, view.components, components);
}

void fail_not_finite(const AccessorView& view, std::size_t element) {
  fail("{}: element {} is not finite", view.name, element);
}

std::vector<float> read_numbers(const AccessorView& view) {
  const auto components = static_cast<std::size_t>(view.components);
  std::vector<float> numbers(view.count * components, 0.0f);
  for (std::size_t i = 0; i < view.count; ++i) {
    const std::byte* element = view.element(i);
    if (element == nullptr) continue;
    for (std::size_t c = 0; c < components; ++c) {
      const float number = view.number(element, static_cast<int>(c));
      if (!std::isfinite(number)) fail_not_finite(view, i);
      numbers[i * components + c] = number;
    }
  }
  return numbers;
}

std::vector<uint32_t> read_integers(const AccessorView& view) {
  expect_components(view, 1);
  std::vector<uint32_t> integers(view.count, 0);
  for (std::size_t i = 0; i < view.count; ++i)
    if (const std::byte* element = view.element(i)) integers[i] = view.integer(element, 0);
  return integers;
}

}  // namespace penumbra::scene::gltf
