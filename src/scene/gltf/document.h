#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf.h"
#include "scene/gltf/budget.h"

namespace penumbra::scene::gltf {

using Bytes = std::span<const std::byte>;

struct ImageSource {
  std::string name;  // for messages
  std::string uri;   // or
  int view = -1;
};

// A glTF with its data at hand. All indices of the model are in range, types and ranges are checked; what the numbers
// mean together (accessors, hierarchy, animations) is checked where it is read.
struct Document {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  // those that the glTF names, whether anything uses them or not
  tinygltf::Model model;                     // buffers and images are kept here instead:
  std::vector<Bytes> views;                  // of each bufferView, decompressed; empty where its buffer has no data
  std::vector<ImageSource> images;
  ReadLimits limits;
  Budget budget;
  std::vector<std::vector<std::byte>> storage;  // what the views point into
};

Document read_document(const std::filesystem::path& path, const ReadLimits& limits);

// An extension's object, or null when `owner` has none.
template <class Owner>
const tinygltf::Value* find_extension(const Owner& owner, const char* name) {
  const auto found = owner.extensions.find(name);
  return found == owner.extensions.end() ? nullptr : &found->second;
}

// Members of an extension's object, which the schema has checked.
double number_or(const tinygltf::Value& object, const char* key, double otherwise);
int index_or(const tinygltf::Value& object, const char* key, int otherwise);
std::string text_or(const tinygltf::Value& object, const char* key, const char* otherwise);
std::vector<double> numbers_or(const tinygltf::Value& object, const char* key, std::vector<double> otherwise);

}  // namespace penumbra::scene::gltf
