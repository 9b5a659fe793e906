#include "reproduce/configs.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra::reproduce {

NamedConfig sampled(const std::string& noise, const std::string& pattern, const Taps& taps) {
  const std::string with = noise == "none" ? "without noise" : "with " + noise + " noise";
  return {fmt::format("{} {}×{} {}", pattern, taps.blocker, taps.filter, with),
          {"pcss",
           {"sampling.scramble=shift", "sampling.noise=" + noise, "sampling.blocker_pattern=" + pattern,
            "sampling.filter_pattern=" + pattern, fmt::format("pcss.blocker_taps={}", taps.blocker),
            fmt::format("pcss.filter_taps={}", taps.filter)}}};
}

double fixed_sigma(const Workbench& bench) {
  constexpr double largest = 24;  // of filter.max_sigma
  return std::min(bench.height() / 90.0, largest);
}

NamedConfig denoised(const Workbench& bench, const NamedConfig& noisy, const std::string& filter) {
  NamedConfig result = noisy;
  result.name += filter == "gaussian" ? ", Gaussian" : ", bilateral";
  for (const std::string& value :
       {"filter.visibility=" + filter, std::string("filter.penumbra=median"), std::string("filter.width=1"),
        fmt::format("filter.max_sigma={}", fixed_sigma(bench))})
    result.config.values.push_back(value);
  return result;
}

}  // namespace penumbra::reproduce
