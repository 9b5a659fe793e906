#pragma once

#include <cstddef>
#include <cstring>

#include "call.h"

namespace penumbra::capi {

// The name of a struct of the C interface and its defaults, in its present version, and its size in the first version.
template <class T>
struct StructTraits;

template <>
struct StructTraits<penumbra_device_desc> {
  static constexpr const char* name = "penumbra_device_desc";
  static constexpr std::size_t first_size = 40;
  static penumbra_device_desc defaults();
};
template <>
struct StructTraits<penumbra_light> {
  static constexpr const char* name = "penumbra_light";
  static constexpr std::size_t first_size = 80;
  static penumbra_light defaults();
};
template <>
struct StructTraits<penumbra_frame> {
  static constexpr const char* name = "penumbra_frame";
  static constexpr std::size_t first_size = 488;
  static penumbra_frame defaults();
};
template <>
struct StructTraits<penumbra_mask> {
  static constexpr const char* name = "penumbra_mask";
  static constexpr std::size_t first_size = 32;
};
template <>
struct StructTraits<penumbra_param> {
  static constexpr const char* name = "penumbra_param";
  static constexpr std::size_t first_size = 72;
};
template <>
struct StructTraits<penumbra_technique> {
  static constexpr const char* name = "penumbra_technique";
  static constexpr std::size_t first_size = 32;
};

// The sizes recorded above are those of pointers of 8 bytes.
template <class T>
constexpr std::size_t first_size = sizeof(void*) == 8 ? StructTraits<T>::first_size : sizeof(T);

// No version of a struct will be as large: such a size was never set.
constexpr std::size_t too_large = 65536;

// Refuses sizes below that of the first version, and those that no version can have: of part of a field, or too large.
template <class T>
void check_size(std::size_t size) {
  static_assert(first_size<T> <= sizeof(T) && sizeof(T) < too_large);
  if (size >= first_size<T> && size < too_large && size % alignof(T) == 0) return;
  fail_with(PENUMBRA_ERROR_ARGUMENT, "{}.struct_size is {}; set it to sizeof({}), which is {}", StructTraits<T>::name,
            size, StructTraits<T>::name, sizeof(T));
}

// A struct of the caller's, as this library declares it, with the defaults of fields that the caller does not know.
template <class T>
T read_struct(const T* given) {
  const std::size_t size = given->struct_size;
  check_size<T>(size);
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  for (std::size_t i = sizeof(T); i < size; ++i) {
    if (bytes[i] == 0) continue;
    fail_with(PENUMBRA_ERROR_ARGUMENT,
              "{}.struct_size is {}: the library, which is older than the program, knows {} bytes, and the bytes after "
              "them are not all 0",
              StructTraits<T>::name, size, sizeof(T));
  }
  T known = StructTraits<T>::defaults();
  std::memcpy(&known, given, size < sizeof(T) ? size : sizeof(T));
  known.struct_size = sizeof(T);
  return known;
}

// Writes to a struct of the caller's the fields that both know; its struct_size stays.
template <class T>
void write_struct(T* given, T values) {
  const std::size_t size = given->struct_size;
  check_size<T>(size);
  values.struct_size = size;
  std::memcpy(given, &values, size < sizeof(T) ? size : sizeof(T));
}

// For the functions penumbra_..._init(): all bytes beyond the fields that this library knows become 0.
template <class T>
void init_struct(T* given, std::size_t size) {
  check_size<T>(size);
  T values = StructTraits<T>::defaults();
  values.struct_size = size;
  std::memset(static_cast<void*>(given), 0, size);
  std::memcpy(given, &values, size < sizeof(T) ? size : sizeof(T));
}

}  // namespace penumbra::capi
