#include "reproduce/crops.h"

#include <algorithm>
#include <cmath>

#include "image/write.h"
#include "report/number.h"
#include "report/table.h"

namespace penumbra::reproduce {

namespace {

constexpr int tile_width = 384;           // about what a tile of a page shows
constexpr double share_of_width = 0.2;    // of the picture, that a crop shows
constexpr double share_of_height = 0.24;  // of 16 : 9 pictures that is 3 : 2

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

Crop crop_size(const Workbench& bench) {
  const auto part = [](int side, double share) { return std::clamp(static_cast<int>(side * share), 1, side); };
  return {.width = part(bench.width(), share_of_width), .height = part(bench.height(), share_of_height)};
}

}  // namespace

Crop best_crop(const Workbench& bench, std::span<const double> weights) {
  const Crop size = crop_size(bench);
  const int stride = bench.width() + 1;
  // Summed-area table: sum(x, y) is the sum over all pixels above y and to the left of x.
  std::vector<double> sums(static_cast<std::size_t>(stride * (bench.height() + 1)), 0.0);
  const auto sum = [&](int x, int y) -> double& { return sums[static_cast<std::size_t>(y * stride + x)]; };
  for (int y = 0; y < bench.height(); ++y) {
    for (int x = 0; x < bench.width(); ++x) {
      const double own = weights[static_cast<std::size_t>(y * bench.width() + x)];
      sum(x + 1, y + 1) = own + sum(x, y + 1) + sum(x + 1, y) - sum(x, y);
    }
  }
  Crop best = size;
  double most = -1;
  for (int y = 0; y + size.height <= bench.height(); ++y) {
    for (int x = 0; x + size.width <= bench.width(); ++x) {
      const int right = x + size.width, bottom = y + size.height;
      const double all = sum(right, bottom) - sum(x, bottom) - sum(right, y) + sum(x, y);
      if (all <= most) continue;
      most = all;
      best.x = x;
      best.y = y;
    }
  }
  return best;
}

Crop noisiest_crop(const Workbench& bench) {
  std::vector<double> weights(bench.truth().size(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double seen = bench.truth()[i];
    if (bench.receivers()[i] != 0) weights[i] = seen * (1 - seen);
  }
  return best_crop(bench, weights);
}

report::EncodedPicture grey_picture(std::span<const float> pixels, int width, int height) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(pixels.size());
  for (const float value : pixels) bytes.push_back(byte_of(value));
  return report::make_picture(image::encode_png(width, height, 1, bytes), width, height);
}

report::EncodedPicture colour_picture(const std::vector<std::uint8_t>& rgb, int width, int height) {
  return report::make_picture(image::encode_png(width, height, 3, rgb), width, height);
}

report::EncodedPicture enlarged(std::span<const float> pixels, int width, const Crop& crop) {
  const int factor = std::max(1, static_cast<int>(std::lround(static_cast<double>(tile_width) / crop.width)));
  std::vector<float> large;
  large.reserve(static_cast<std::size_t>(crop.width * crop.height * factor * factor));
  for (int y = 0; y < crop.height * factor; ++y) {
    for (int x = 0; x < crop.width * factor; ++x)
      large.push_back(pixels[static_cast<std::size_t>((crop.y + y / factor) * width + crop.x + x / factor)]);
  }
  return grey_picture(large, crop.width * factor, crop.height * factor);
}

report::EncodedPicture enlarged(std::span<const float> pixels, int width, int height) {
  return enlarged(pixels, width, {.width = width, .height = height});
}

report::Tile tile(const std::string& title, const std::string& note, const report::EncodedPicture& picture) {
  return {.title = title,
          .note = note,
          .body = report::picture({.label = {}, .alt = title + (note.empty() ? "" : ", " + note), .picture = picture})};
}

Quantity psnr_of(const NamedConfig& named, const MeasuredPicture& drawing) {
  return {"the PSNR in the penumbra of " + named.name, drawing.psnr_pcss, "dB"};
}

Quantity psnr_truth_of(const NamedConfig& named, const MeasuredPicture& drawing) {
  return {"the PSNR in the penumbra against truth of " + named.name, drawing.psnr_truth, "dB"};
}

Quantity psnr_blurred_of(const NamedConfig& named, const MeasuredPicture& drawing) {
  return {"the PSNR in the penumbra after a blur of " + named.name, drawing.psnr_blurred, "dB"};
}

Quantity flip_of(const NamedConfig& named, const MeasuredPicture& drawing) {
  return {"the FLIP of " + named.name, drawing.flip, "", 4};
}

report::Html crop_tiles(Workbench& bench, const std::vector<NamedConfig>& configs, const Crop& crop) {
  std::vector<report::Tile> tiles;
  for (const NamedConfig& named : configs) {
    const MeasuredPicture& drawing = bench.draw(named.config);
    const std::string note = "PSNR penumbra " + report::fixed(drawing.psnr_pcss, 2) + " dB, after a blur " +
                             report::fixed(drawing.psnr_blurred, 2) + " dB";
    tiles.push_back(tile(named.name, note, enlarged(drawing.visibility, bench.width(), crop)));
  }
  return report::tiles(tiles);
}

report::Html quality_table(Finding& finding, Workbench& bench, const std::vector<NamedConfig>& configs) {
  using report::Best;
  report::Table table{
      .caption = "In the penumbra, against converged PCSS unless it says otherwise.",
      .columns = {{"Picture"},
                  {"PSNR penumbra", "dB", "Over receivers whose reference is between 0.02 and 0.98.", Best::highest},
                  {"PSNR penumbra after a blur", "dB", "Errors first go through a Gaussian of 1.5 pixels.",
                   Best::highest},
                  {"FLIP", "", "How different the two look to a viewer who flips between them, 0 to 1.", Best::lowest},
                  {"PSNR penumbra against truth", "dB", "The same against the ray-traced picture.", Best::highest}},
      .rows = {}};
  for (const NamedConfig& named : configs) {
    const MeasuredPicture& drawing = bench.draw(named.config);
    finding.record(psnr_of(named, drawing));
    finding.record(psnr_blurred_of(named, drawing));
    finding.record(flip_of(named, drawing));
    finding.record(psnr_truth_of(named, drawing));
    if (const std::size_t count = drawing.to_pcss.not_finite; count > 0)
      finding.record({"the number of values that are not finite of " + named.name, static_cast<double>(count), "", 0});
    table.rows.push_back({{named.name},
                          report::cell_of(drawing.psnr_pcss, 2),
                          report::cell_of(drawing.psnr_blurred, 2),
                          report::cell_of(drawing.flip, 4),
                          report::cell_of(drawing.psnr_truth, 2)});
  }
  return report::to_html(table);
}

}  // namespace penumbra::reproduce
