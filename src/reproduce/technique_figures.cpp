// Sections 2.2 and 2.3 of the thesis's background, which has no figures of these techniques: what it says of maps that
// are filtered before they are compared, measured.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "reproduce/crops.h"
#include "reproduce/figures.h"

namespace penumbra::reproduce {

namespace {

constexpr double alike = 3;                 // dB
constexpr double narrow = 0.2, wide = 0.8;  // metres

NamedConfig filtered(const std::string& name, const std::string& technique, double radius,
                     std::vector<std::string> values) {
  values.push_back(fmt::format("{}.radius={}", technique, radius));
  return {name, {technique, std::move(values)}};
}

NamedConfig compared(double radius) {
  return filtered(fmt::format("percentage-closer filter, {} cm", 100 * radius), "pcf", radius, {"pcf.filter_taps=256"});
}

// Of two pictures, over the receivers.
struct Difference {
  double rms = 0, mean = 0;  // of a over b
};

Difference difference(Workbench& bench, const NamedConfig& a, const NamedConfig& b) {
  const std::vector<float>&first = bench.draw(a.config).visibility, &second = bench.draw(b.config).visibility;
  double squares = 0, sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < first.size(); ++i) {
    if (bench.receivers()[i] == 0) continue;
    const double apart = static_cast<double>(first[i]) - static_cast<double>(second[i]);
    squares += apart * apart;
    sum += apart;
    ++count;
  }
  const auto n = static_cast<double>(count);
  return {.rms = std::sqrt(squares / n), .mean = sum / n};
}

Quantity apart(Workbench& bench, const NamedConfig& a, const NamedConfig& b) {
  return {"the difference of " + a.name + " from the same filter by comparison", difference(bench, a, b).rms, "", 4};
}

Quantity brightness(Workbench& bench, const NamedConfig& a, const NamedConfig& b) {
  return {"the mean brightness of " + a.name + " above the same filter by comparison",
          100 * difference(bench, a, b).mean, "%", 3};
}

}  // namespace

Finding section_2_2(Workbench& bench) {
  const NamedConfig comparison = compared(narrow), wide_comparison = compared(wide);
  const NamedConfig variance = filtered("a variance shadow map", "vsm", narrow, {"vsm.bleeding=0"});
  const NamedConfig cut = filtered("a variance shadow map whose bleeding is cut", "vsm", narrow, {"vsm.bleeding=0.3"});
  const NamedConfig few = filtered("a Fourier series of 4 terms", "csm_fourier", narrow, {"csm_fourier.terms=4"});
  const NamedConfig many = filtered("a Fourier series of 16 terms", "csm_fourier", narrow, {});
  const NamedConfig lowered =
      filtered("a Fourier series of 16 lowered terms", "csm_fourier", narrow, {"csm_fourier.attenuation=4"});
  const NamedConfig small = filtered("an exponential shadow map, 20 cm", "esm", narrow, {"esm.classification=none"});
  const NamedConfig large = filtered("an exponential shadow map, 80 cm", "esm", wide, {"esm.classification=none"});
  const std::vector<NamedConfig> shown{{"hard", {"hard", {}}}, comparison, variance, cut, few, many, lowered, small};
  Finding finding;
  finding.kind = Finding::Kind::section;
  finding.id = "2.2";
  finding.title = "Filtering before the comparison";
  finding.claim =
      "A variance shadow map gives an upper bound of the occlusion and may leak light; 16 terms of a Fourier series "
      "give good results, few ring, and lowering high terms makes the step less steep; exponential shadow maps suit "
      "small kernels.";
  finding.test =
      "Mean and root mean square, over the receivers, of the difference from percentage-closer filtering with 256 "
      "taps. Both have a radius of 20 or 80 cm: a disc for the taps, a Gaussian for the maps. The bound of a "
      "variance shadow map is one of the light (Donnelly and Lauritzen 2006), so it must be brighter on average, and "
      "less so if its bleeding is cut; 16 terms must be nearer than 4, and nearer than 16 lowered ones; "
      "exponentials of 20 cm must be nearer than those of 80 cm.";
  finding.body = crop_tiles(bench, shown, noisiest_crop(bench));
  finding.body.add(quality_table(finding, bench, shown));
  finding.expect_at_least(brightness(bench, variance, comparison), 0);
  finding.expect_below(brightness(bench, cut, comparison), brightness(bench, variance, comparison));
  finding.expect_below(apart(bench, many, comparison), apart(bench, few, comparison));
  finding.expect_below(apart(bench, many, comparison), apart(bench, lowered, comparison));
  finding.expect_below(apart(bench, small, comparison), apart(bench, large, wide_comparison));
  return finding;
}

Finding section_2_3(Workbench& bench) {
  const NamedConfig fast{"PCSS of 16×16 taps", {"pcss", {}}};
  const NamedConfig fourier{"convolution soft shadow maps, 16 terms", {"cssm", {"cssm.terms=16"}}};
  const NamedConfig variance{"variance soft shadow maps", {"vssm", {}}};
  const std::vector<NamedConfig> shown{fast, variance, fourier};
  Finding finding;
  finding.kind = Finding::Kind::section;
  finding.id = "2.3";
  finding.title = "Soft shadows from filtered maps";
  finding.claim =
      "The mean blocker depth and the filter of PCSS can come from filtered maps at a cost that does not grow with the "
      "penumbra; what suppresses the ringing of Fourier series brightens contacts.";
  finding.test =
      "Variance soft shadow maps must be within 3 dB of PCSS in the penumbra, against the truth; the mean error of "
      "convolution soft shadow maps must be above that of PCSS.";
  finding.body = crop_tiles(bench, shown, noisiest_crop(bench));
  finding.body.add(quality_table(finding, bench, shown));
  const auto bias = [&](const NamedConfig& named) {
    return Quantity{"the bias of " + named.name, 100 * bench.draw(named.config).to_truth.bias, "%", 3};
  };
  finding.expect_near(psnr_truth_of(variance, bench.draw(variance.config)),
                      psnr_truth_of(fast, bench.draw(fast.config)), alike);
  finding.expect_above(bias(fourier), bias(fast));
  return finding;
}

}  // namespace penumbra::reproduce
