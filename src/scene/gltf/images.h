#pragma once

#include <cstddef>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace penumbra::scene::gltf {

// Reads a document's images into a scene, each once. Their sizes are checked by their headers before the first one is
// decoded. Images that nothing drawn uses are left out if they have a fault or exceed the limit.
class ImageReader {
 public:
  ImageReader(Document& document, const ImageDecoder& decode, Scene& scene);

  // Requests the file's image of that index; -1 is ignored.
  void need(int number);
  // Reads all requested images. Throws Error that names the image or the limit.
  void read();
  // The scene's index of the file's image; -1 if it was left out.
  int number(int image) const { return numbers_[static_cast<std::size_t>(image)]; }

 private:
  std::vector<std::byte> load(const ImageSource& source) const;
  bool used(std::size_t image) const { return document_.left_out.used().holds("images", image); }
  ReadAt open(const ImageSource& source) const;
  std::size_t decoded_size(std::size_t image);
  void check_sizes();
  void decode(std::size_t image);

  Document& document_;
  const ImageDecoder& decode_;
  Scene& scene_;
  std::vector<bool> needed_;
  std::vector<int> numbers_;
};

}  // namespace penumbra::scene::gltf
