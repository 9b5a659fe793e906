// Figures 4.8 to 4.11: how filters reduce the noise.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "report/number.h"
#include "reproduce/configs.h"
#include "reproduce/figures.h"

namespace penumbra::reproduce {

namespace {

constexpr const char* filter_name = "bilateral_separable";
std::string test_of(const Workbench& bench) {
  return fmt::format(
      "PSNR in the penumbra against converged PCSS, before and after a separable bilateral filter whose σ is {} pixels "
      "wherever the penumbra is wide, at 16×8 taps.",
      report::fixed(fixed_sigma(bench), 1));
}

Quantity psnr(Workbench& bench, const NamedConfig& named) { return psnr_of(named, bench.draw(named.config)); }

std::vector<NamedConfig> filtered(const Workbench& bench, const std::vector<NamedConfig>& noisy) {
  std::vector<NamedConfig> configs;
  for (const NamedConfig& named : noisy) configs.push_back(denoised(bench, named, filter_name));
  return configs;
}

// Crops of all configs before the filter, and under them the same after it.
Finding finding_of(Workbench& bench, const char* id, const char* title, const std::vector<NamedConfig>& before,
                   const std::vector<NamedConfig>& after) {
  Finding finding;
  finding.id = id;
  finding.title = title;
  finding.test = test_of(bench);
  const Crop crop = noisiest_crop(bench);
  std::vector<NamedConfig> all = before;
  all.insert(all.end(), after.begin(), after.end());
  finding.body = crop_tiles(bench, before, crop);
  finding.body.add(crop_tiles(bench, after, crop)).add(quality_table(finding, bench, all));
  return finding;
}

// Receivers whose visibility differs by an amount that is visible with 8 bits.
std::vector<std::uint8_t> differing(const MeasuredPicture& a, const MeasuredPicture& b) {
  std::vector<std::uint8_t> mask(a.visibility.size());
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = std::abs(a.visibility[i] - b.visibility[i]) > 1.0f / 255 ? 1 : 0;
  return mask;
}

}  // namespace

Finding figure_4_8(Workbench& bench) {
  const std::vector<NamedConfig> before{sampled("white", "hammersley", few_taps),
                                        sampled("white", "poisson", few_taps)};
  const std::vector<NamedConfig> after = filtered(bench, before);
  Finding finding = finding_of(bench, "4.8", "White noise denoised: Hammersley and Poisson disk", before, after);
  finding.claim =
      "Two penumbrae with white noise side by side; a low-discrepancy sequence is effective in creating a well "
      "distributed penumbra (chapter 6).";
  finding.test +=
      " The thesis does not say which of the two is better; we expect Hammersley points, before the filter and after "
      "it.";
  finding.expect_above(psnr(bench, before[0]), psnr(bench, before[1]));
  finding.expect_above(psnr(bench, after[0]), psnr(bench, after[1]));
  return finding;
}

Finding figure_4_9(Workbench& bench) {
  std::vector<NamedConfig> before;
  for (const Taps& taps : {few_taps, some_taps, many_taps}) before.push_back(sampled("white", "hammersley", taps));
  const std::vector<NamedConfig> after = filtered(bench, before);
  Finding finding = finding_of(bench, "4.9", "White noise and Hammersley points, denoised", before, after);
  finding.claim = "A bilateral filter improves the overall quality (chapter 5).";
  finding.test += " And at 32×32 and 64×64.";
  for (std::size_t i = 0; i < before.size(); ++i) finding.expect_above(psnr(bench, after[i]), psnr(bench, before[i]));
  return finding;
}

Finding figure_4_10(Workbench& bench) {
  std::vector<NamedConfig> before;
  for (const char* pattern : {"poisson", "hammersley"}) {
    for (const char* noise : {"white", "blue"}) before.push_back(sampled(noise, pattern, few_taps));
  }
  const std::vector<NamedConfig> after = filtered(bench, before);
  Finding finding = finding_of(bench, "4.10", "Denoising overview", before, after);
  finding.claim = "Blue noise, with its weak low frequencies, is much easier to denoise (section 2.6.2).";
  finding.test += " After the filter blue noise must be at least 1 dB above white, for both patterns.";
  finding.expect_above_by(clear_gain, psnr(bench, after[1]), psnr(bench, after[0]));
  finding.expect_above_by(clear_gain, psnr(bench, after[3]), psnr(bench, after[2]));
  return finding;
}

Finding figure_4_11(Workbench& bench) {
  const NamedConfig noisy = sampled("blue", "hammersley", few_taps);
  const NamedConfig bilateral = denoised(bench, noisy, filter_name), gaussian = denoised(bench, noisy, "gaussian");
  const MeasuredPicture& by_bilateral = bench.draw(bilateral.config);
  const MeasuredPicture& by_gaussian = bench.draw(gaussian.config);
  const std::vector<std::uint8_t> where = differing(by_bilateral, by_gaussian);
  Finding finding;
  finding.id = "4.11";
  finding.title = "Bilateral filter against Gaussian";
  finding.claim = "Without the bilateral weight the filter blurs too much (chapter 4), across edges (section 2.7.2).";
  finding.test = fmt::format(
      "RMSE against converged PCSS over the receivers where the two filters differ by more than 1/255, which is about "
      "edges; both have a σ of {} pixels. The crop shows where they differ most.",
      report::fixed(fixed_sigma(bench), 1));
  std::vector<double> weights(where.size());
  for (std::size_t i = 0; i < where.size(); ++i)
    weights[i] =
        std::abs(static_cast<double>(by_bilateral.visibility[i]) - static_cast<double>(by_gaussian.visibility[i]));
  const Crop crop = best_crop(bench, weights);
  const std::vector<NamedConfig> configs{noisy, gaussian, bilateral};
  finding.body = crop_tiles(bench, configs, crop);
  finding.body.add(report::tiles({tile("converged PCSS", "", enlarged(bench.pcss(), bench.width(), crop)),
                                  tile("truth", "ray traced", enlarged(bench.truth(), bench.width(), crop))}));
  finding.body.add(quality_table(finding, bench, configs));
  const auto rmse = [&](const char* name, const MeasuredPicture& drawing) {
    return Quantity{std::string("the RMSE about edges of the ") + name, bench.errors_at(drawing, where).rmse, "", 4};
  };
  finding.expect_below(rmse("bilateral filter", by_bilateral), rmse("Gaussian", by_gaussian));
  finding.expect_above(psnr(bench, bilateral), psnr(bench, gaussian));
  return finding;
}

}  // namespace penumbra::reproduce
