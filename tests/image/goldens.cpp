#include "image/goldens.h"

namespace penumbra::test {

namespace {

// Processors with and without fused multiply-add round shaders differently, so a point beside an edge may change sides.
constexpr Tolerance rounding{1, 0.005, "processors round differently: with and without fused multiply-add"};
// What is traced on the CPU: Embree's kernels for SSE, AVX2 and AVX-512 meet an edge at different rounded distances.
constexpr Tolerance tracing{1, 0.01, "rays meet edges by kernels that differ from processor to processor"};
// Each frame repeats what rounding did in the one before.
constexpr Tolerance history{2, 0.01, "frames that build on each other pass on what rounding did in each"};

}  // namespace

std::span<const Golden> goldens() {
  // clang-format off
  static const std::vector<Golden> list{
      // Every technique on two scenes.
      {"none_posts", "posts", "none", {}, &rounding},
      {"none_foliage", "foliage", "none", {}, &rounding},
      {"hard_posts", "posts", "hard", {}, &rounding},
      {"hard_foliage", "foliage", "hard", {}, &rounding},
      {"pcf_posts", "posts", "pcf", {}, &rounding},
      {"pcf_foliage", "foliage", "pcf", {}, &rounding},
      {"pcss_posts", "posts", "pcss", {"sun.angle=2"}, &rounding},
      {"pcss_foliage", "foliage", "pcss", {}, &rounding},
      {"pcss_compute_posts", "posts", "pcss_compute", {"sun.angle=2"}, &rounding},
      {"pcss_compute_fence", "fence", "pcss_compute", {}, &rounding},
      {"brute_force_posts", "posts", "brute_force", {"sun.angle=2"}, &rounding},
      {"brute_force_fence", "fence", "brute_force", {}, &rounding},
      {"brute_force_compute_posts", "posts", "brute_force_compute", {"sun.angle=2"}, &rounding},
      {"brute_force_compute_fence", "fence", "brute_force_compute", {}, &rounding},
      {"truth_posts", "posts", "truth", {"truth.samples=64", "sun.angle=2"}, &tracing},
      {"truth_foliage", "foliage", "truth", {"truth.samples=64"}, &tracing},
      {"thesis_thesis", "thesis", "thesis", {}, &rounding},
      {"thesis_moving", "moving", "thesis", {}, &history, "shadow", 6},
      {"thesis_compute_thesis", "thesis", "thesis_compute", {}, &rounding},
      {"thesis_compute_moving", "moving", "thesis_compute", {}, &history, "shadow", 6},
      {"thesis_8x8_thesis", "thesis", "thesis_8x8", {}, &rounding},
      {"thesis_8x8_moving", "moving", "thesis_8x8", {}, &history, "shadow", 6},
      {"thesis_8x8_compute_thesis", "thesis", "thesis_8x8_compute", {}, &rounding},
      {"thesis_8x8_compute_moving", "moving", "thesis_8x8_compute", {}, &history, "shadow", 6},
      // Every filter, under both drivers.
      {"filter_median", "thesis", "thesis", {"filter.penumbra=median", "filter.visibility=none"}, &rounding},
      {"filter_box", "thesis", "thesis", {"filter.visibility=box"}, &rounding},
      {"filter_gaussian", "thesis", "thesis", {"filter.visibility=gaussian"}, &rounding},
      {"filter_bilateral", "thesis", "thesis", {"filter.visibility=bilateral"}, &rounding},
      {"filter_bilateral_separable", "thesis", "thesis_compute", {"filter.visibility=bilateral_separable"}, &rounding},
      // Every AOV.
      {"aov_color", "courtyard", "pcss", {}, &rounding, "color"},
      {"aov_shadow", "courtyard", "pcss", {}, &rounding, "shadow"},
      {"aov_depth", "courtyard", "pcss", {}, &rounding, "depth", 1, 0, 40},
      {"aov_normal", "courtyard", "pcss", {}, &rounding, "normal", 1, -1, 1},
      {"aov_geometric_normal", "courtyard", "pcss", {}, &rounding, "geometric_normal", 1, -1, 1},
      {"aov_albedo", "courtyard", "pcss", {}, &rounding, "albedo"},
      {"aov_material", "courtyard", "pcss", {}, &rounding, "material"},
      {"aov_emission", "courtyard", "pcss", {}, &rounding, "emission"},
      {"aov_motion", "moving", "pcss", {}, &rounding, "motion", 2, -8, 8},
      {"aov_cascade", "courtyard", "pcss", {}, &rounding, "cascade", 1, -1, 4},
      {"aov_blocker", "courtyard", "pcss", {}, &rounding, "blocker", 1, 0, 8},
      {"aov_penumbra", "courtyard", "pcss", {}, &rounding, "penumbra", 1, 0, 0.2f},
      {"aov_under_texel", "courtyard", "pcss", {}, &rounding, "under_texel"},
      {"aov_history", "moving", "thesis", {}, &history, "history", 6, 0, 8},
  };
  // clang-format on
  return list;
}

}  // namespace penumbra::test
