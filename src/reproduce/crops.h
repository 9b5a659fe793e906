#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "report/picture.h"
#include "reproduce/finding.h"
#include "reproduce/workbench.h"

namespace penumbra::reproduce {

// A part of a picture, pixels from its top left.
struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

// Of all crops of the report's size, the one with the greatest sum of `weights`, which has one value per pixel.
Crop best_crop(const Workbench& bench, std::span<const double> weights);
// The crop where a single tap is noisiest: the weights are V (1 − V), the variance of a tap that is lit with
// probability V.
Crop noisiest_crop(const Workbench& bench);

// Values from 0 to 1 as grey, enlarged without interpolation to about the width of a tile.
report::EncodedPicture enlarged(std::span<const float> pixels, int width, int height);
report::EncodedPicture enlarged(std::span<const float> pixels, int width, const Crop& crop);
// Values from 0 to 1 as grey, at their own size.
report::EncodedPicture grey_picture(std::span<const float> pixels, int width, int height);
report::EncodedPicture colour_picture(const std::vector<std::uint8_t>& rgb, int width, int height);

// A picture under a title.
report::Tile tile(const std::string& title, const std::string& note, const report::EncodedPicture& picture);

// A configuration and the name that a figure gives it.
struct NamedConfig {
  std::string name;
  ShadowConfig config;
};
// Crops side by side, each with its figures.
report::Html crop_tiles(Workbench& bench, const std::vector<NamedConfig>& configs, const Crop& crop);
// A table of each picture's figures, which are recorded in the finding too, with the number of values that are not
// finite, if there are any.
report::Html quality_table(Finding& finding, Workbench& bench, const std::vector<NamedConfig>& configs);

// How much better counts as "significantly" or "much" better: a fifth less squared error.
constexpr double clear_gain = 1;  // dB

// Figures of a picture as they are recorded: "PSNR of NAME".
Quantity psnr_of(const NamedConfig& named, const MeasuredPicture& drawing);
Quantity psnr_truth_of(const NamedConfig& named, const MeasuredPicture& drawing);
Quantity psnr_blurred_of(const NamedConfig& named, const MeasuredPicture& drawing);
Quantity flip_of(const NamedConfig& named, const MeasuredPicture& drawing);

}  // namespace penumbra::reproduce
