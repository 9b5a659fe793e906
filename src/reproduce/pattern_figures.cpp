// Figures 4.2 to 4.7: patterns and noise at several numbers of taps.
#include <string>
#include <vector>

#include "reproduce/configs.h"
#include "reproduce/figures.h"

namespace penumbra::reproduce {

namespace {

constexpr const char* by_psnr =
    "PSNR in the penumbra against converged PCSS, for what the thesis shows to the eye: less noise is a higher PSNR.";
constexpr const char* by_blur =
    "PSNR in the penumbra against converged PCSS after errors went through a Gaussian of 1.5 pixels: grain that the "
    "eye "
    "averages away does not count, bands and blotches do.";

Finding finding_of(Workbench& bench, const char* id, const char* title, const std::vector<NamedConfig>& configs) {
  Finding finding;
  finding.id = id;
  finding.title = title;
  finding.body = crop_tiles(bench, configs, noisiest_crop(bench));
  finding.body.add(quality_table(finding, bench, configs));
  return finding;
}

Quantity psnr(Workbench& bench, const NamedConfig& named) { return psnr_of(named, bench.draw(named.config)); }
Quantity blurred(Workbench& bench, const NamedConfig& named) {
  return psnr_blurred_of(named, bench.draw(named.config));
}

std::vector<NamedConfig> at_all_taps(const char* noise, const char* pattern) {
  return {sampled(noise, pattern, few_taps), sampled(noise, pattern, some_taps), sampled(noise, pattern, many_taps)};
}

}  // namespace

Finding figure_4_2(Workbench& bench) {
  const NamedConfig regular = sampled("none", "regular", few_taps), uniform = sampled("white", "uniform", few_taps);
  std::vector<NamedConfig> configs = at_all_taps("none", "regular");
  configs.push_back(sampled("white", "regular", few_taps));
  configs.push_back(uniform);
  Finding finding = finding_of(bench, "4.2", "Regular sampling", configs);
  const MeasuredPicture& bands = bench.draw(regular.config);
  finding.body.add(report::tiles(
      {tile("The whole picture, " + regular.name, "", grey_picture(bands.visibility, bench.width(), bench.height())),
       tile("The whole picture, converged PCSS", "", grey_picture(bench.pcss(), bench.width(), bench.height()))}));
  finding.claim = "A regular grid suffers from aliasing and bands and is typically avoided (section 2.6.1).";
  finding.test = std::string(by_blur) +
                 " Bands stay and noise goes, so the regular grid must then be worse than "
                 "uniform random points with white noise.";
  finding.expect_below(blurred(bench, regular), blurred(bench, uniform));
  return finding;
}

Finding figure_4_3(Workbench& bench) {
  const std::vector<NamedConfig> configs = at_all_taps("white", "uniform");
  Finding finding = finding_of(bench, "4.3", "Uniform random points with white noise", configs);
  finding.claim = "Noise falls from 16×8 to 64×64 taps.";
  finding.test = by_psnr;
  finding.expect_above(psnr(bench, configs[1]), psnr(bench, configs[0]));
  finding.expect_above(psnr(bench, configs[2]), psnr(bench, configs[1]));
  return finding;
}

Finding figure_4_4(Workbench& bench) {
  std::vector<NamedConfig> configs = at_all_taps("white", "poisson");
  for (const Taps& taps : {few_taps, some_taps}) configs.push_back(sampled("white", "uniform", taps));
  Finding finding = finding_of(bench, "4.4", "Poisson disk with white noise", configs);
  finding.claim = "The noise of a penumbra differs significantly between sampling patterns (chapter 4).";
  finding.test = std::string(by_psnr) +
                 " We expect Poisson disks to be less noisy than uniform points: at equal taps by at least 1 dB.";
  finding.expect_above_by(clear_gain, psnr(bench, configs[0]), psnr(bench, configs[3]));
  finding.expect_above_by(clear_gain, psnr(bench, configs[1]), psnr(bench, configs[4]));
  return finding;
}

Finding figure_4_5(Workbench& bench) {
  std::vector<NamedConfig> configs = at_all_taps("white", "hammersley");
  for (const Taps& taps : {few_taps, some_taps}) configs.push_back(sampled("white", "poisson", taps));
  Finding finding = finding_of(bench, "4.5", "Hammersley points with white noise", configs);
  finding.claim = "A low-discrepancy sequence is effective in creating a well distributed penumbra (chapter 6).";
  finding.test = std::string(by_psnr) +
                 " The thesis calls Poisson disks low-discrepancy too (section 2.6.1). We expect Hammersley points, "
                 "whose discrepancy is lower, to have less noise at equal taps.";
  finding.expect_above(psnr(bench, configs[0]), psnr(bench, configs[3]));
  finding.expect_above(psnr(bench, configs[1]), psnr(bench, configs[4]));
  return finding;
}

Finding figure_4_6(Workbench& bench) {
  std::vector<NamedConfig> configs;
  for (const char* noise : {"white", "blue"}) {
    for (const Taps& taps : {few_taps, some_taps}) configs.push_back(sampled(noise, "poisson", taps));
  }
  Finding finding = finding_of(bench, "4.6", "White against blue noise, Poisson disk", configs);
  finding.claim = "Blue noise significantly improves the pattern of a penumbra's noise (section 6.1).";
  finding.test = std::string(by_blur) + " Blue noise must be at least 1 dB above white at equal taps.";
  finding.expect_above_by(clear_gain, blurred(bench, configs[2]), blurred(bench, configs[0]));
  finding.expect_above_by(clear_gain, blurred(bench, configs[3]), blurred(bench, configs[1]));
  return finding;
}

Finding figure_4_7(Workbench& bench) {
  const NamedConfig best = sampled("blue", "hammersley", few_taps), random = sampled("white", "uniform", few_taps),
                    white = sampled("white", "hammersley", few_taps);
  std::vector<NamedConfig> configs = at_all_taps("blue", "hammersley");
  for (const char* noise : {"white", "blue"}) {
    for (const char* pattern : {"uniform", "poisson", "poisson_hierarchical", "hammersley", "halton", "vogel"}) {
      const NamedConfig other = sampled(noise, pattern, few_taps);
      if (other.name != best.name) configs.push_back(other);
    }
  }
  Finding finding = finding_of(bench, "4.7", "Blue noise and Hammersley points", configs);
  finding.claim =
      "Low-discrepancy points with blue noise greatly improve the pattern of the penumbra's noise (chapter 5) over "
      "random points, and over the same points without it.";
  finding.test = std::string(by_blur) +
                 " At 16×8 taps they must be at least 1 dB above uniform points, and above Hammersley points, with "
                 "white noise. All "
                 "other pairs of a pattern and a noise are beside them.";
  finding.expect_above_by(clear_gain, blurred(bench, best), blurred(bench, random));
  finding.expect_above_by(clear_gain, blurred(bench, best), blurred(bench, white));
  return finding;
}

}  // namespace penumbra::reproduce
