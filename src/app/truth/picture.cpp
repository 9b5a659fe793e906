#include "app/truth/picture.h"

#include <cmath>
#include <cstdint>
#include <vector>

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

}  // namespace

cli::EncodedFile encoded_picture(const cli::OutputNames& names, int frame, const cli::Size& size,
                                 const truth::TruthTechnique::Last& last, const image::Metadata& metadata) {
  const truth::Traced& traced = last.traced;
  const std::filesystem::path path = names.picture(frame);
  const std::vector<float> shadow = from_top(traced.visibility, size.width);
  if (!names.is_exr()) {
    std::vector<std::uint8_t> bytes;
    for (const float v : shadow) bytes.push_back(static_cast<std::uint8_t>(std::lround(v * 255.0f)));
    return {path, image::encode_png(size.width, size.height, 1, bytes, metadata)};
  }
  const std::vector<image::Layer> layers{{"shadow", {"V"}, shadow},
                                         {"standard_error", {"V"}, from_top(traced.standard_error, size.width)},
                                         {"hard", {"V"}, from_top(traced.hard, size.width)},
                                         {"receiver", {"V"}, from_top(last.receiver, size.width)}};
  return {path, image::encode_exr(size.width, size.height, layers, metadata)};
}

}  // namespace penumbra::app
