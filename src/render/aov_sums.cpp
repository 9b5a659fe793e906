#include "render/aov_sums.h"

#include <algorithm>

namespace penumbra::render {

AovSums::AovSums(std::span<const std::string> names, std::size_t lights) {
  for (const Aov& aov : aovs()) {
    if (std::ranges::find(names, aov.name) == names.end()) continue;
    if (aov.reduction == Reduction::nearest_center || aov.name == "color") continue;
    for (std::size_t light = 0; light < (aov.of_light ? lights : 1); ++light)
      sums_.push_back({.aov = &aov, .light = static_cast<int>(light), .totals = {}, .counts = {}});
  }
}

bool AovSums::read_mask() const {
  return std::ranges::any_of(sums_, [](const Sum& sum) { return sum.aov->of_light; });
}

void AovSums::add(const FrameParts& sample) {
  for (Sum& sum : sums_) {
    const std::vector<float> values = read_aov(sample, sum.aov->name, sum.light);
    sum.totals.resize(values.size());
    sum.counts.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (sum.aov->reduction == Reduction::mean_of_valid && values[i] == 0.0f) continue;
      sum.totals[i] += values[i];
      ++sum.counts[i];
    }
  }
}

AovMeans AovSums::means() const {
  AovMeans means;
  for (const Sum& sum : sums_) {
    std::vector<float>& mean = means[sum.aov->name].emplace_back();
    mean.reserve(sum.totals.size());
    for (std::size_t i = 0; i < sum.totals.size(); ++i)
      mean.push_back(sum.counts[i] == 0 ? 0.0f : static_cast<float>(sum.totals[i] / sum.counts[i]));
  }
  return means;
}

}  // namespace penumbra::render
