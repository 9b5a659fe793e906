#include "image/golden_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "image/picture.h"
#include "image/write.h"
#include "metrics/heat_color.h"

namespace penumbra::test {

namespace {

constexpr std::size_t columns = golden_width, rows = golden_height;

GoldenColor color_of(const GoldenPicture& picture, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  GoldenColor color{};
  for (std::size_t c = 0; c < channels; ++c) color[c] = picture.pixels[pixel * channels + c];
  return color;
}

// One row of pictures, each with three channels in the result.
GoldenPicture side_by_side(const std::array<const GoldenPicture*, 3>& pictures) {
  GoldenPicture all{.channels = 3, .pixels = {}};
  for (std::size_t y = 0; y < rows; ++y) {
    for (const GoldenPicture* picture : pictures) {
      const auto channels = static_cast<std::size_t>(picture->channels);
      for (std::size_t i = y * columns * 3; i < (y + 1) * columns * 3; ++i)
        all.pixels.push_back(picture->pixels[i / 3 * channels + (channels == 3 ? i % 3 : 0)]);
    }
  }
  return all;
}

GoldenPicture false_color(const std::vector<int>& differences) {
  GoldenPicture picture{.channels = 3, .pixels = {}};
  for (const int difference : differences) {
    const std::array<std::uint8_t, 3> color = metrics::heat_color(static_cast<float>(difference) / 32);
    picture.pixels.insert(picture.pixels.end(), color.begin(), color.end());
  }
  return picture;
}

}  // namespace

GoldenPicture read_golden(const std::filesystem::path& path) {
  const image::Picture file = image::read_picture(path);
  GoldenPicture picture{.channels = static_cast<int>(file.channels.size()), .pixels = {}};
  for (const float value : file.pixels) picture.pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
  return picture;
}

void write_golden(const std::filesystem::path& path, const GoldenPicture& picture) {
  image::write_png(path, golden_width, golden_height, picture.channels, picture.pixels);
}

GoldenColor background_of(const GoldenPicture& picture) {
  std::map<GoldenColor, int> counts;
  for (std::size_t pixel = 0; pixel < columns * rows; ++pixel) ++counts[color_of(picture, pixel)];
  return std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
}

std::vector<std::size_t> shown_in(const GoldenPicture& picture, int steps) {
  const GoldenColor background = background_of(picture);
  std::vector<std::size_t> shown;
  for (std::size_t x = 0; x < columns; ++x) {
    for (std::size_t y = 0; y < rows; ++y) {
      const GoldenColor color = color_of(picture, y * columns + x);
      int greatest = 0;
      for (std::size_t c = 0; c < color.size(); ++c) greatest = std::max(greatest, std::abs(color[c] - background[c]));
      if (greatest > steps) shown.push_back(y * columns + x);
    }
  }
  return shown;
}

GoldenComparison compare(const GoldenPicture& picture, const GoldenPicture& reference, const Tolerance& tolerance) {
  GoldenComparison result{.differences = std::vector<int>(columns * rows)};
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    int& greatest = result.differences[i / static_cast<std::size_t>(picture.channels)];
    greatest = std::max(greatest, std::abs(picture.pixels[i] - reference.pixels[i]));
  }
  result.off = static_cast<std::size_t>(
      std::ranges::count_if(result.differences, [&](int difference) { return difference > tolerance.steps; }));
  const auto shown = static_cast<double>(shown_in(reference, tolerance.steps).size());
  result.allowed = static_cast<std::size_t>(tolerance.share * shown);
  return result;
}

void write_comparison(const std::filesystem::path& folder, const std::string& name, const GoldenPicture& picture,
                      const GoldenPicture& reference, const std::vector<int>& differences) {
  std::filesystem::create_directories(folder);
  const GoldenPicture colored = false_color(differences);
  write_golden(folder / (name + "_picture.png"), picture);
  write_golden(folder / (name + "_reference.png"), reference);
  write_golden(folder / (name + "_difference.png"), colored);
  image::write_png(folder / (name + ".png"), 3 * golden_width, golden_height, 3,
                   side_by_side({&picture, &reference, &colored}).pixels);
}

GoldenVersions read_versions(const std::filesystem::path& file) {
  GoldenVersions versions;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) versions[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return versions;
}

void note_version(const std::filesystem::path& file, const std::string& name, const std::string& version) {
  GoldenVersions versions = read_versions(file);
  versions[name] = version;
  std::ofstream stream(file);
  for (const auto& [picture, renderer] : versions) stream << picture << ": " << renderer << "\n";
}

}  // namespace penumbra::test
