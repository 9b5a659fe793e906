#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "image/goldens.h"

namespace penumbra::test {

constexpr int golden_width = 160, golden_height = 90;

// A picture of golden_width × golden_height pixels.
struct GoldenPicture {
  int channels = 1;                  // 1 or 3
  std::vector<std::uint8_t> pixels;  // rows top to bottom, channels interleaved
};

GoldenPicture read_golden(const std::filesystem::path& path);
void write_golden(const std::filesystem::path& path, const GoldenPicture& picture);

// The most frequent colour. In a picture of one channel the others are 0.
using GoldenColor = std::array<std::uint8_t, 3>;
GoldenColor background_of(const GoldenPicture& picture);
// The indices of the pixels that differ from the background by more than `steps`, column by column.
std::vector<std::size_t> shown_in(const GoldenPicture& picture, int steps);

struct GoldenComparison {
  std::vector<int> differences;  // of each pixel: the greatest of a channel
  std::size_t off = 0;           // pixels that differ by more than the tolerance's steps
  std::size_t allowed = 0;

  bool alike() const { return off <= allowed; }
};

// Both have the same number of channels.
GoldenComparison compare(const GoldenPicture& picture, const GoldenPicture& reference, const Tolerance& tolerance);

// Writes NAME_picture.png, NAME_reference.png, NAME_difference.png (false colour, brightest at 32 of 255 and more), and
// NAME.png, the three side by side.
void write_comparison(const std::filesystem::path& folder, const std::string& name, const GoldenPicture& picture,
                      const GoldenPicture& reference, const std::vector<int>& differences);

// The renderer, with its versions, that recorded each golden picture, by its name. The file has one line a picture,
// "name: renderer", sorted by name; a missing file has none.
using GoldenVersions = std::map<std::string, std::string>;
GoldenVersions read_versions(const std::filesystem::path& file);
// Notes who recorded one picture, and leaves the other lines as they are.
void note_version(const std::filesystem::path& file, const std::string& name, const std::string& version);

}  // namespace penumbra::test
