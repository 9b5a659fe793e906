// Figures 2.14 and 4.1: filters on a picture of the scene, and the scene itself.
#include <algorithm>
#include <array>

#include "core/random.h"
#include "report/number.h"
#include "reproduce/crops.h"
#include "reproduce/figures.h"

namespace penumbra::reproduce {

namespace {

using Window = std::array<float, 9>;

// Filters each pixel with its 3 × 3 neighbourhood; beyond the border the nearest pixel is used.
template <class Reduce>
std::vector<float> filtered(const std::vector<float>& pixels, int width, int height, Reduce reduce) {
  std::vector<float> result(pixels.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Window window{};
      for (int i = 0; i < 9; ++i) {
        const int column = std::clamp(x + i % 3 - 1, 0, width - 1), row = std::clamp(y + i / 3 - 1, 0, height - 1);
        window[static_cast<std::size_t>(i)] = pixels[static_cast<std::size_t>(row * width + column)];
      }
      result[static_cast<std::size_t>(y * width + x)] = reduce(window);
    }
  }
  return result;
}

float mean_of(const Window& window) {
  float sum = 0;
  for (const float value : window) sum += value;
  return sum / static_cast<float>(window.size());
}

float median_of(Window window) {
  std::ranges::nth_element(window, window.begin() + 4);
  return window[4];
}

// Sets one pixel in twenty to black or white.
std::vector<float> with_salt_and_pepper(std::vector<float> pixels) {
  Random random(1);
  for (float& value : pixels) {
    if (random.below(20) == 0) value = random.below(2) == 0 ? 0.0f : 1.0f;
  }
  return pixels;
}

Quantity psnr(const std::string& name, const Workbench& bench, const std::vector<float>& pixels) {
  const metrics::ImageView test{.width = bench.width(), .height = bench.height(), .pixels = pixels};
  const metrics::ImageView truth{.width = bench.width(), .height = bench.height(), .pixels = bench.truth()};
  return {"the PSNR of " + name, metrics::error_figures(test, truth).psnr, "dB"};
}

NamedConfig thesis_with_median(const char* median) {
  const bool on = std::string_view(median) == "median";
  return {on ? "8/8 taps with a median of blocker distances" : "the same without",
          {"thesis_8x8", {std::string("filter.penumbra=") + median}}};
}

}  // namespace

Finding figure_2_14(Workbench& bench) {
  const std::vector<float> noisy = with_salt_and_pepper(bench.truth());
  const std::vector<float> box = filtered(noisy, bench.width(), bench.height(), mean_of);
  const std::vector<float> median = filtered(noisy, bench.width(), bench.height(), median_of);
  const Quantity of_noisy = psnr("the noisy picture", bench, noisy), of_box = psnr("the box filter", bench, box);
  const Quantity of_median = psnr("the median filter", bench, median);
  Finding finding;
  finding.id = "2.14";
  finding.title = "Box and median filter";
  finding.claim =
      "A median of 3 × 3 erases salt-and-pepper noise, a box filter takes the mean (section 2.7.1). A median reduces "
      "such noise in the penumbra (section 3.4), and to denoise the penumbra before it tells the kernel's size is a "
      "decent workaround (chapter 5).";
  finding.test =
      "The reference scene's visibility with one pixel in twenty set to black or white, through both filters, against "
      "the clean picture: the median must be nearer. Then our renderer with 8/8 taps and a bilateral filter, with and "
      "without a median of the blocker distances, against converged PCSS.";
  const Crop crop = noisiest_crop(bench);
  const auto shown = [&](const char* title, const Quantity& quantity, const std::vector<float>& pixels) {
    return tile(title, "PSNR " + quantity.text(), enlarged(pixels, bench.width(), crop));
  };
  const std::vector<NamedConfig> configs{thesis_with_median("median"), thesis_with_median("none")};
  finding.record(of_noisy);
  finding.body = report::tiles({shown("Salt and pepper", of_noisy, noisy), shown("Box, 3 × 3", of_box, box),
                                shown("Median, 3 × 3", of_median, median)});
  finding.body.add(quality_table(finding, bench, configs));
  finding.expect_above(of_median, of_box);
  finding.expect_above(psnr_of(configs[0], bench.draw(configs[0].config)),
                       psnr_of(configs[1], bench.draw(configs[1].config)));
  return finding;
}

Finding figure_4_1(Workbench& bench) {
  std::size_t receivers = 0, penumbra = 0;
  for (std::size_t i = 0; i < bench.truth().size(); ++i) {
    if (bench.receivers()[i] == 0) continue;
    ++receivers;
    const float seen = bench.truth()[i];
    if (seen >= metrics::penumbra_low && seen <= metrics::penumbra_high) ++penumbra;
  }
  const NamedConfig hard{"hard shadows", {"hard", {}}};
  const NamedConfig pcss{"converged PCSS", Workbench::pcss_config()};
  const auto figure = [&](const char* label, const ShadowConfig& config) {
    return report::Figure{.label = label,
                          .alt = std::string("The reference scene, ") + label,
                          .picture = colour_picture(bench.display(config), bench.width(), bench.height())};
  };
  const auto visibility = [&](const char* label, const std::vector<float>& pixels) {
    return report::Figure{.label = label,
                          .alt = std::string("The visible share of the sun, ") + label,
                          .picture = grey_picture(pixels, bench.width(), bench.height())};
  };
  Finding finding;
  finding.id = "4.1";
  finding.title = "Reference scene";
  finding.claim =
      "The penumbra of a distant caster covers most of the picture, which makes it an expensive case (chapter 4).";
  finding.test =
      "The share of receivers with a visibility from 0.02 to 0.98, ray traced: the claim holds from a half on. "
      "The error that PCSS has with any number of taps is given below: no figure of the thesis shows it.";
  finding.body = report::tiles(
      {{.title = "The scene",
        .note = "hard shadows against the ray-traced truth",
        .body = report::picture_slider(figure("hard", hard.config), figure("truth", bench.truth_config()))},
       {.title = "Visibility of the sun",
        .note = "converged PCSS against the ray-traced truth",
        .body = report::picture_slider(visibility("PCSS", bench.pcss()), visibility("truth", bench.truth()))}});
  const metrics::ErrorFigures off = bench.draw(pcss.config).to_truth;
  finding.record({"the PSNR in the penumbra against truth of converged PCSS", off.psnr_penumbra, "dB"});
  finding.record({"the bias against truth of converged PCSS", off.bias, "", 5});
  finding.record({"the PSNR in the penumbra against truth of hard shadows", bench.draw(hard.config).psnr_truth, "dB"});
  finding.body.add(report::Html("<p>Against the truth, in the penumbra, converged PCSS has a PSNR of ")
                       .text(report::fixed(off.psnr_penumbra, 2))
                       .add(" dB and hard shadows one of ")
                       .text(report::fixed(bench.draw(hard.config).psnr_truth, 2))
                       .add(" dB.</p>\n"));
  finding.expect_at_least({"the share of receivers in the penumbra",
                           100 * static_cast<double>(penumbra) / static_cast<double>(receivers), "%", 1},
                          50);
  return finding;
}

}  // namespace penumbra::reproduce
