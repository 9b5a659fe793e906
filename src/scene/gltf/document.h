#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf.h"
#include "scene/gltf/budget.h"
#include "scene/gltf/left_out.h"

namespace penumbra::scene::gltf {

using Bytes = std::span<const std::byte>;

struct ImageSource {
  std::string name;  // for messages
  std::string uri;   // or
  int view = -1;
};

// A glTF document with its data loaded. All indices of the model are in range, and types and ranges are checked. What
// depends on several values (accessors, hierarchy, animations) is checked where it is read. Elements that were left out
// because of a fault are placeholders.
struct Document {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  // that the glTF names and may read, used or not
  tinygltf::Model model;                     // without buffers and images, which the members below hold
  std::vector<Bytes> views;                  // bytes of each bufferView, decompressed; empty if its buffer has no data
  std::vector<ImageSource> images;
  ReadOptions options;
  Budget budget;
  LeftOut left_out;
  std::vector<std::vector<std::byte>> storage;  // memory that `views` refer to

  // Reports progress to the caller, at most a hundred times for each part.
  void report(const ReadProgress& progress) const {
    const auto percent = [&](std::size_t done) { return done * 100 / progress.count; };
    const bool news = progress.done == 0 || percent(progress.done) != percent(progress.done - 1);
    if (options.progress && news) options.progress(progress);
  }
};

Document read_document(const std::filesystem::path& path, const ReadOptions& options);

// An extension's object, or null if `owner` has none.
template <class Owner>
const tinygltf::Value* find_extension(const Owner& owner, const char* name) {
  const auto found = owner.extensions.find(name);
  return found == owner.extensions.end() ? nullptr : &found->second;
}

// How the extras of a node or a material set its shadow casting: {"penumbra_casts": true, false, "both", "front" or
// "back"}. Any other value causes a warning that names `place`.
CastSetting casting_of_extras(const tinygltf::Value& extras, const std::string& place);

// Members of an extension's object, which the schema has checked.
double number_or(const tinygltf::Value& object, const char* key, double otherwise);
int index_or(const tinygltf::Value& object, const char* key, int otherwise);
std::vector<double> numbers_or(const tinygltf::Value& object, const char* key, std::vector<double> otherwise);

}  // namespace penumbra::scene::gltf
