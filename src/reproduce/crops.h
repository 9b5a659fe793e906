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

// Of all crops of the report's size, the one with the greatest sum of `weights`, a value a pixel.
Crop best_crop(const Workbench& bench, std::span<const double> weights);
// Where one tap is noisiest: V (1 − V) is the variance of a share V that is seen or not.
Crop noisiest_crop(const Workbench& bench);

// Values from 0 to 1 as grey, enlarged without interpolation to about the width of a tile.
report::Picture enlarged(std::span<const float> pixels, int width, int height);
report::Picture enlarged(std::span<const float> pixels, int width, const Crop& crop);
// As it is.
report::Picture grey_picture(std::span<const float> pixels, int width, int height);
report::Picture colour_picture(const std::vector<std::uint8_t>& rgb, int width, int height);

// A picture under a title.
report::Tile tile(const std::string& title, const std::string& note, const report::Picture& picture);

// A look by the name that it goes by in a figure.
struct Named {
  std::string name;
  Look look;
};
// Crops side by side, each with its figures.
report::Html crop_tiles(Workbench& bench, const std::vector<Named>& looks, const Crop& crop);
// What all drawings are measured by, recorded in the finding: a row each.
report::Html quality_table(Finding& finding, Workbench& bench, const std::vector<Named>& looks);

// What it takes to be "significantly" or "much" better: a fifth less of squared error.
constexpr double clear_gain = 1;  // dB

// Figures of a drawing, as recorded: "PSNR of NAME".
Quantity psnr_of(const Named& named, const Drawing& drawing);
Quantity psnr_truth_of(const Named& named, const Drawing& drawing);
Quantity psnr_blurred_of(const Named& named, const Drawing& drawing);
Quantity flip_of(const Named& named, const Drawing& drawing);

}  // namespace penumbra::reproduce
