#include "app/truth/picture.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "app/light_layers.h"

namespace penumbra::app {

namespace {

// Reverses the order of rows that are stored from bottom to top.
std::vector<float> from_top(const std::vector<float>& rows, int width) {
  std::vector<float> flipped;
  flipped.reserve(rows.size());
  for (auto row = rows.end(); row != rows.begin();) {
    row -= width;
    flipped.insert(flipped.end(), row, row + width);
  }
  return flipped;
}

std::vector<std::byte> shadow_png(const cli::Size& size, const truth::Traced& traced, const image::Metadata& metadata) {
  std::vector<std::uint8_t> bytes;
  for (const float v : from_top(traced.visibility, size.width))
    bytes.push_back(static_cast<std::uint8_t>(std::lround(v * 255.0f)));
  return image::encode_png(size.width, size.height, 1, bytes, metadata);
}

}  // namespace

std::vector<std::filesystem::path> picture_files(const cli::OutputNames& names, int frame, std::size_t lights) {
  std::vector<std::filesystem::path> files{names.picture(frame)};
  if (names.is_exr()) return files;
  for (std::size_t light = 1; light < lights; ++light) files.push_back(names.aov(frame, layer_name("shadow", light)));
  return files;
}

std::vector<cli::EncodedFile> encoded_pictures(const cli::OutputNames& names, int frame, const cli::Size& size,
                                               const truth::TruthTechnique& truth, std::size_t lights,
                                               const image::Metadata& metadata) {
  const std::vector<std::filesystem::path> paths = picture_files(names, frame, lights);
  std::vector<cli::EncodedFile> files;
  std::vector<image::Layer> layers;
  for (std::size_t light = 0; light < lights; ++light) {
    const truth::TruthTechnique::Last& last = truth.last(static_cast<int>(light));
    const truth::Traced& traced = last.traced;
    if (!names.is_exr()) {
      files.push_back({paths[light], shadow_png(size, traced, metadata)});
      continue;
    }
    const auto add = [&](const char* name, const std::vector<float>& values) {
      layers.push_back({layer_name(name, light), {"V"}, from_top(values, size.width)});
    };
    add("shadow", traced.visibility);
    add("standard_error", traced.standard_error);
    add("hard", traced.hard);
    add("receiver", last.receiver);
  }
  if (names.is_exr()) files.push_back({paths.front(), image::encode_exr(size.width, size.height, layers, metadata)});
  return files;
}

}  // namespace penumbra::app
