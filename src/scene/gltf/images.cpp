#include "scene/gltf/images.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.h"
#include "scene/gltf/resources.h"
#include "scene/limits.h"

namespace penumbra::scene::gltf {

ImageReader::ImageReader(Document& document, const ImageDecoder& decode, Scene& scene)
    : document_(document),
      decode_(decode),
      scene_(scene),
      needed_(document.images.size()),
      numbers_(document.images.size(), -1) {}

void ImageReader::need(int number) {
  if (number < 0) return;
  const auto image = static_cast<std::size_t>(number);
  needed_[image] = !document_.left_out.holds("images", image);
}

// Loads the data of a URI; bytes of a bufferView are in memory already.
std::vector<std::byte> ImageReader::load(const ImageSource& source) const {
  if (source.view >= 0) return {};
  return load_uri(document_.folder, source.uri, document_.options);
}

ReadAt ImageReader::open(const ImageSource& source) const {
  if (source.view >= 0) return reader_of(document_.views[static_cast<std::size_t>(source.view)]);
  return open_uri(document_.folder, source.uri, document_.options);
}

// From the image's header: files that are too large are not read.
std::size_t ImageReader::decoded_size(std::size_t image) {
  const ReadAt file = open(document_.images[image]);
  std::byte first{};
  if (file(0, {&first, 1}) == 0) fail("has no data");
  const ImageHeader header = decode_.probe()(file);
  const ReadLimits& limits = document_.options.limits;
  if (static_cast<std::size_t>(header.height) > limits.image_pixels / static_cast<std::size_t>(header.width))
    fail_over_limit(fmt::format("{} x {} pixels", header.width, header.height), limits, &ReadLimits::image_pixels);
  return header.decoded_bytes;
}

void ImageReader::check_sizes() {
  const ReadLimits& limits = document_.options.limits;
  std::size_t total = 0, count = 0;
  for (const bool of_used : {true, false})  // images of drawn parts first
    for (std::size_t i = 0; i < needed_.size(); ++i) {
      if (!needed_[i] || used(i) != of_used) continue;
      try {
        const std::size_t size = decoded_size(i);
        if (!of_used && total + size > limits.image_bytes)
          fail_over_limit(fmt::format("with it, the images take {}", bytes_text(total + size)), limits,
                          &ReadLimits::image_bytes);
        total += size;
        ++count;
      } catch (const Error& e) {
        document_.left_out.add_part(document_.images[i].name, of_used, e.what());
        needed_[i] = false;
      }
    }
  if (total > limits.image_bytes)
    fail_over_limit(fmt::format("{} images take {} when decoded", count, bytes_text(total)), limits,
                    &ReadLimits::image_bytes);
}

void ImageReader::decode(std::size_t image) {
  const ImageSource& source = document_.images[image];
  try {
    const std::vector<std::byte> file = load(source);
    if (source.view < 0)
      document_.budget.add_file(file_of_uri(document_.folder, source.uri, document_.options), file.size());
    const Bytes bytes = source.view >= 0 ? document_.views[static_cast<std::size_t>(source.view)] : Bytes(file);
    if (bytes.empty()) fail("has no data");
    Image decoded = decode_(bytes, source.name);
    document_.budget.spend_image(decoded.rgba.size());
    scene_.images.push_back(std::move(decoded));
    numbers_[image] = static_cast<int>(scene_.images.size()) - 1;
  } catch (const Error& e) {
    document_.left_out.add_part(source.name, used(image), e.what());
  }
}

void ImageReader::read() {
  if (decode_.probe()) check_sizes();
  const auto count = static_cast<std::size_t>(std::ranges::count(needed_, true));
  std::size_t done = 0;
  for (std::size_t i = 0; i < needed_.size(); ++i) {
    if (!needed_[i]) continue;
    document_.report({.part = "image", .done = done++, .count = count});
    decode(i);
  }
}

}  // namespace penumbra::scene::gltf
