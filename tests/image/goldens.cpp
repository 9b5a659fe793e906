#include "image/goldens.h"

namespace penumbra::test {

namespace {

// Processors with and without fused multiply-add round shaders differently, so a point beside an edge may change sides.
constexpr Tolerance rounding{1, 0.005, "processors round differently: with and without fused multiply-add"};
// What is traced on the CPU: Embree's kernels for SSE, AVX2 and AVX-512 meet an edge at different rounded distances.
constexpr Tolerance tracing{1, 0.01, "rays meet edges by kernels that differ from processor to processor"};
// Each frame repeats what rounding did in the one before.
constexpr Tolerance history{2, 0.01, "frames that build on each other pass on what rounding did in each"};

constexpr Tolerance other_version{8, 0.1,
                                  "another version than that which recorded them rasterises and rounds differently"};

// The moving box, bar, ball and cube with their shadows.
constexpr GoldenView casters{{-2.2f, 2.6f, 4.5f}, {-2.4f, 0.3f, -0.5f}, 40};
// A lamp in its lantern.
constexpr GoldenView lantern{{0.6f, 2.5f, -3.2f}, {1.1f, 2.48f, -4.22f}, 12};

}  // namespace

const Tolerance& tolerance_of_other_versions() { return other_version; }

std::span<const Golden> goldens() {
  // clang-format off
  static const std::vector<Golden> list{
      // Every technique on two scenes.
      {"none_posts", "posts", "none", {}, &rounding, {}},
      {"none_foliage", "foliage", "none", {}, &rounding, {}},
      {"hard_posts", "posts", "hard", {}, &rounding, {"technique=none"}},
      {"hard_foliage", "foliage", "hard", {}, &rounding, {"technique=none"}},
      {"shadow_volume_posts", "posts", "shadow_volume", {}, &rounding, {"technique=none"}},
      {"shadow_volume_foliage", "foliage", "shadow_volume", {}, &rounding, {"technique=none", "technique=hard"}},
      {"pcf_posts", "posts", "pcf", {}, &rounding, {"technique=hard"}},
      {"pcf_foliage", "foliage", "pcf", {}, &rounding, {"technique=hard"}},
      {"pcf_hardware_posts", "posts", "pcf_hardware", {}, &rounding, {"technique=none"}},
      {"pcf_hardware_foliage", "foliage", "pcf_hardware", {}, &rounding, {"technique=none"}},
      {"pcf_tent_posts", "posts", "pcf_tent", {"pcf_tent.width=7"}, &rounding, {"technique=hard"}},
      {"pcf_tent_foliage", "foliage", "pcf_tent", {"pcf_tent.width=7"}, &rounding, {"technique=hard"}},
      {"pcf_poisson_posts", "posts", "pcf_poisson", {}, &rounding, {"technique=hard"}},
      {"pcf_poisson_foliage", "foliage", "pcf_poisson", {}, &rounding, {"technique=hard"}},
      {"vsm_posts", "posts", "vsm", {}, &rounding, {"technique=hard"}},
      {"vsm_foliage", "foliage", "vsm", {}, &rounding, {"technique=hard"}},
      {"evsm_posts", "posts", "evsm", {}, &rounding, {"technique=hard"}},
      {"evsm_foliage", "foliage", "evsm", {}, &rounding, {"technique=hard"}},
      {"msm_posts", "posts", "msm", {}, &rounding, {"technique=hard"}},
      {"msm_foliage", "foliage", "msm", {}, &rounding, {"technique=hard"}},
      {"esm_posts", "posts", "esm", {}, &rounding, {"technique=hard"}},
      {"esm_foliage", "foliage", "esm", {}, &rounding, {"technique=hard"}},
      {"csm_fourier_posts", "posts", "csm_fourier", {"cascades.size=512"}, &rounding, {"technique=hard"}},
      {"csm_fourier_foliage", "foliage", "csm_fourier", {"cascades.size=512"}, &rounding, {"technique=hard"}},
      {"cssm_posts", "posts", "cssm", {"sun.angle=2", "cascades.size=512"}, &rounding, {"technique=hard"}},
      {"cssm_foliage", "foliage", "cssm", {"sun.angle=2", "cascades.size=512"}, &rounding, {"technique=hard"}},
      {"pcss_posts", "posts", "pcss", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"pcss_foliage", "foliage", "pcss", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"pcss_compute_posts", "posts", "pcss_compute", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"pcss_compute_fence", "fence", "pcss_compute", {}, &rounding, {"technique=hard"}},
      {"slices_posts", "posts", "slices", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"slices_foliage", "foliage", "slices", {"sun.angle=4"}, &rounding, {"technique=pcss"}},
      {"backprojection_posts", "posts", "backprojection", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"backprojection_foliage", "foliage", "backprojection", {"sun.angle=4"}, &rounding, {"technique=pcss"}},
      {"ssss_posts", "posts", "ssss", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"ssss_foliage", "foliage", "ssss", {"sun.angle=4"}, &rounding, {"technique=pcss"}},
      {"vssm_posts", "posts", "vssm", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"vssm_foliage", "foliage", "vssm", {"sun.angle=4"}, &rounding, {"technique=pcss"}},
      {"slices_denoised_posts", "posts", "slices_denoised", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"slices_denoised_foliage", "foliage", "slices_denoised", {"sun.angle=4"}, &rounding, {"technique=pcss"}},
      {"slices_sparse_posts", "posts", "slices_sparse", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"slices_sparse_foliage", "foliage", "slices_sparse", {"sun.angle=4"}, &rounding, {"technique=pcss"}},
      {"slices_history_thesis", "thesis", "slices_history", {}, &history, {"technique=hard", "history.mean=false"}, "shadow", 4},
      {"slices_history_foliage", "foliage", "slices_history", {"sun.angle=4"}, &history, {"technique=hard", "history.mean=false"}, "shadow", 4},
      {"brute_force_posts", "posts", "brute_force", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"brute_force_fence", "fence", "brute_force", {}, &rounding, {"technique=hard"}},
      {"brute_force_compute_posts", "posts", "brute_force_compute", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"brute_force_compute_fence", "fence", "brute_force_compute", {}, &rounding, {"technique=hard"}},
      {"truth_posts", "posts", "truth", {"truth.samples=64", "sun.angle=2"}, &tracing, {"technique=hard"}},
      {"truth_foliage", "foliage", "truth", {"truth.samples=64"}, &tracing, {"technique=hard"}},
      // The presets of the thesis. With all weight on the present frame there is no history.
      {"thesis_thesis", "thesis", "thesis", {}, &history, {"technique=hard", "filter.visibility=none", "history.alpha=1"}, "shadow", 4},
      {"thesis_moving", "moving", "thesis", {"sun.angle=8"}, &history, {"technique=hard", "movement.map=none"}, "shadow", 4, 0, 1, &casters},
      {"thesis_compute_thesis", "thesis", "thesis_compute", {}, &history, {"filter.visibility=none"}, "shadow", 4},
      {"thesis_compute_moving", "moving", "thesis_compute", {"sun.angle=8"}, &history, {"movement.map=none"}, "shadow", 4, 0, 1, &casters},
      {"thesis_8x8_thesis", "thesis", "thesis_8x8", {}, &rounding, {"filter.visibility=none"}},
      {"thesis_8x8_moving", "moving", "thesis_8x8", {"sun.angle=8"}, &rounding, {"technique=hard", "filter.visibility=none"}, "shadow", 4, 0, 1, &casters},
      {"thesis_8x8_compute_thesis", "thesis", "thesis_8x8_compute", {}, &rounding, {"filter.visibility=none"}},
      {"thesis_8x8_compute_moving", "moving", "thesis_8x8_compute", {"sun.angle=8"}, &rounding, {"filter.visibility=none"}, "shadow", 4, 0, 1, &casters},
      // Every denoiser on two scenes, with what it keeps from frame to frame.
      {"history_thesis", "thesis", "thesis", {"filter.visibility=none"}, &history, {"history.alpha=1"}, "shadow", 4},
      {"history_foliage", "foliage", "thesis", {"sun.angle=4", "filter.visibility=none"}, &history, {"history.alpha=1"}, "shadow", 4},
      // Traced where the map can't decide: rays are the same with every rasteriser.
      {"hybrid_posts", "posts", "hybrid", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"hybrid_foliage", "foliage", "hybrid", {"sun.angle=4"}, &rounding, {"technique=hard"}},
      {"hybrid_denoised_posts", "posts", "hybrid_denoised", {"sun.angle=2"}, &rounding, {"technique=hard"}},
      {"hybrid_denoised_foliage", "foliage", "hybrid_denoised", {"sun.angle=4"}, &rounding, {"technique=hard"}},
      // Maps fitted to what the view shows.
      {"visible_posts", "posts", "pcss", {"cascades.fit=visible", "cascades.size=256"}, &rounding, {"cascades.fit=stable"}},
      // Every filter.
      {"filter_median", "foliage", "thesis", {"sun.angle=4", "filter.penumbra=median"}, &rounding, {"filter.penumbra=none"}, "blocker", 1, 0, 6},
      {"filter_median_visibility", "thesis", "thesis", {"filter.visibility=median_visibility"}, &rounding, {"filter.visibility=none"}},
      {"filter_box", "thesis", "thesis", {"filter.visibility=box"}, &rounding, {"filter.visibility=none"}},
      {"filter_gaussian", "thesis", "thesis", {"filter.visibility=gaussian"}, &rounding, {"filter.visibility=none"}},
      {"filter_bilateral", "thesis", "thesis", {"filter.visibility=bilateral"}, &rounding, {"filter.visibility=none"}},
      {"filter_bilateral_separable", "thesis", "thesis_compute", {"filter.visibility=bilateral_separable"}, &rounding, {"filter.visibility=none"}},
      {"filter_isophote", "thesis", "thesis", {"filter.visibility=isophote"}, &rounding, {"filter.visibility=none"}},
      // Every AOV.
      {"aov_color", "courtyard", "pcss", {}, &rounding, {"technique=none"}, "color"},
      {"aov_shadow", "courtyard", "pcss", {"sun.angle=2"}, &rounding, {"technique=hard"}, "shadow"},
      {"aov_depth", "courtyard", "pcss", {}, &rounding, {}, "depth", 1, 0, 40},
      {"aov_normal", "courtyard", "pcss", {}, &rounding, {}, "normal", 1, -1, 1},
      {"aov_geometric_normal", "courtyard", "pcss", {}, &rounding, {}, "geometric_normal", 1, -1, 1},
      {"aov_position", "courtyard", "pcss", {}, &rounding, {}, "position", 10, -10, 10},
      {"aov_albedo", "courtyard", "pcss", {}, &rounding, {}, "albedo"},
      {"aov_material", "courtyard", "pcss", {}, &rounding, {}, "material"},
      {"aov_emission", "courtyard", "pcss", {}, &rounding, {}, "emission", 1, 0, 1, &lantern},
      {"aov_motion", "moving", "pcss", {}, &rounding, {}, "motion", 2, -8, 8, &casters},
      {"aov_cascade", "courtyard", "pcss", {}, &rounding, {}, "cascade", 1, -1, 4},
      {"aov_blocker", "courtyard", "pcss", {}, &rounding, {"technique=hard"}, "blocker", 1, 0, 8},
      {"aov_penumbra", "courtyard", "pcss", {}, &rounding, {"technique=hard"}, "penumbra", 1, 0, 0.2f},
      {"aov_under_texel", "courtyard", "pcss", {}, &rounding, {"technique=none"}, "under_texel"},
      {"aov_texel", "courtyard", "pcss", {}, &rounding, {"cascades.size=1024"}, "texel", 1, 0, 0.5f},
      {"aov_history", "moving", "thesis", {"sun.angle=8"}, &history, {"movement.map=none"}, "history", 4, 0, 8, &casters},
  };
  // clang-format on
  return list;
}

}  // namespace penumbra::test
