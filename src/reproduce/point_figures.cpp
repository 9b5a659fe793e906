// Figures 2.8 to 2.10 and 2.13: patterns of sample points and their rotation on the torus.
#include <fmt/format.h>

#include <functional>
#include <glm/common.hpp>
#include <map>
#include <utility>

#include "report/number.h"
#include "report/picture.h"
#include "reproduce/figures.h"
#include "reproduce/point_plot.h"
#include "shadow/sampling.h"

namespace penumbra::reproduce {

namespace {

using Points = std::vector<glm::vec2>;

constexpr int count = 256;  // as in the thesis
constexpr std::size_t prefix_count = 16;
constexpr std::size_t set_count = 8;  // of a random pattern, whose mean is taken

constexpr const char* test =
    "Star discrepancy (the largest error of the share of points in a box at the origin: less is more even) and the "
    "least distance between two points on the torus; of random patterns the mean of 8 sets.";

std::span<const glm::vec2> prefix(const Points& points) { return std::span(points).first(prefix_count); }

// The point sets of a pattern: `set_count` of a random pattern, one of any other.
const std::vector<Points>& sets_of(const std::string& pattern) {
  static std::map<std::string, std::vector<Points>> known;
  std::vector<Points>& sets = known[pattern];
  for (std::uint64_t seed = 0; sets.size() < set_count; ++seed) {
    Points points = shadow::square_points(pattern, count, seed);
    if (!sets.empty() && points == sets.front()) break;
    sets.push_back(std::move(points));
  }
  return sets;
}

double mean_over_sets(const char* pattern, const std::function<double(const Points&)>& measure) {
  double sum = 0;
  for (const Points& points : sets_of(pattern)) sum += measure(points);
  return sum / static_cast<double>(sets_of(pattern).size());
}

Quantity discrepancy(const char* pattern, const std::string& name) {
  const auto measure = [](const Points& points) { return shadow::star_discrepancy(points); };
  return {"the star discrepancy of " + name, mean_over_sets(pattern, measure), "", 4};
}

Quantity distance(const char* pattern, const std::string& name) {
  const auto measure = [](const Points& points) { return shadow::least_toroidal_distance(points); };
  return {"the least distance of " + name, mean_over_sets(pattern, measure), "", 4};
}

Quantity prefix_discrepancy(const char* pattern, const std::string& name) {
  const auto measure = [](const Points& points) { return shadow::star_discrepancy(prefix(points)); };
  return {"the star discrepancy of the first 16 of " + name, mean_over_sets(pattern, measure), "", 4};
}

Quantity prefix_distance(const char* pattern, const std::string& name) {
  const auto measure = [](const Points& points) { return shadow::least_toroidal_distance(prefix(points)); };
  return {"the least distance of the first 16 of " + name, mean_over_sets(pattern, measure), "", 4};
}

report::Tile plot(const std::string& title, const Points& points, std::size_t highlighted = 0) {
  const std::string note = fmt::format("{} points, D* {}, least distance {}", points.size(),
                                       report::fixed(shadow::star_discrepancy(points), 4),
                                       report::fixed(shadow::least_toroidal_distance(points), 4));
  return {.title = title, .note = note, .body = point_plot(title, {points, highlighted})};
}

}  // namespace

Finding figure_2_8(Workbench&) {
  Finding finding;
  finding.id = "2.8";
  finding.title = "Regular and uniform random points";
  finding.claim =
      "The regular grid has a low discrepancy; uniform random points clump because theirs is high (section 2.6.1).";
  finding.test = test;
  finding.body = report::tiles(
      {plot("Regular grid", sets_of("regular").front()), plot("Uniform random", sets_of("uniform").front())});
  finding.expect_below(discrepancy("regular", "the regular grid"), discrepancy("uniform", "uniform points"));
  finding.expect_above(distance("regular", "the regular grid"), distance("uniform", "uniform points"));
  return finding;
}

Finding figure_2_9(Workbench&) {
  Finding finding;
  finding.id = "2.9";
  finding.title = "Poisson disk and hierarchical Poisson disk";
  finding.claim =
      "The first 16 points of a Poisson disk clump; those of the hierarchical one are well spread, so that it can be "
      "sampled progressively.";
  finding.test = std::string(test) + " Both for the first 16 of 256 points, which are coloured.";
  finding.body = report::tiles({plot("Poisson disk", sets_of("poisson").front(), prefix_count),
                                plot("Hierarchical", sets_of("poisson_hierarchical").front(), prefix_count)});
  finding.expect_below(prefix_discrepancy("poisson_hierarchical", "the hierarchical one"),
                       prefix_discrepancy("poisson", "the Poisson disk"));
  finding.expect_above(prefix_distance("poisson_hierarchical", "the hierarchical one"),
                       prefix_distance("poisson", "the Poisson disk"));
  finding.record(distance("poisson", "all 256 of the Poisson disk"));
  finding.record(distance("poisson_hierarchical", "all 256 of the hierarchical one"));
  return finding;
}

Finding figure_2_10(Workbench&) {
  Finding finding;
  finding.id = "2.10";
  finding.title = "Hammersley and Halton points";
  finding.claim =
      "Both have a low discrepancy; Hammersley points are made for their number, while any beginning of the Halton "
      "sequence is well spread.";
  finding.test = std::string(test) + " The first 16 of 256 points are coloured.";
  finding.body = report::tiles({plot("Hammersley", sets_of("hammersley").front(), prefix_count),
                                plot("Halton", sets_of("halton").front(), prefix_count)});
  const Quantity poisson = discrepancy("poisson", "a Poisson disk");
  finding.expect_below(discrepancy("hammersley", "Hammersley points"), poisson);
  finding.expect_below(discrepancy("halton", "Halton points"), poisson);
  finding.expect_below(prefix_discrepancy("halton", "256 Halton points"),
                       prefix_discrepancy("hammersley", "256 Hammersley points"));
  return finding;
}

Finding figure_2_13(Workbench&) {
  constexpr float offset = 0.05f;  // as in the thesis
  constexpr int shown = 64;
  const Points points = shadow::square_points("poisson", shown);
  Points rotated;
  for (const glm::vec2& point : points) rotated.push_back(glm::fract(point + glm::vec2(offset)));
  const auto measured = [](const char* name, const Points& set) -> Quantity {
    return {fmt::format("the least distance {} the rotation", name), shadow::least_toroidal_distance(set), "", 4};
  };
  const Quantity before = measured("before", points), after = measured("after", rotated);
  Finding finding;
  finding.id = "2.13";
  finding.title = "Cranley-Patterson rotation";
  finding.claim =
      "Points moved on the torus keep what made them good, provided that the set respects its radius across the "
      "borders.";
  finding.test =
      "The least distance between two of 64 Poisson points on the torus, before and after a move by (0.05, 0.05): it "
      "may change by rounding alone. The star discrepancy may change, since it depends on where the origin is; it is "
      "listed too.";
  finding.body = report::tiles(
      {{.title = "Dots: original; rings: moved by (0.05, 0.05)",
        .note = "64 points of a Poisson disk",
        .body = point_plot("Poisson points and the same moved on the torus", {points, points.size()}, rotated)}});
  finding.expect_near(after, before, 1e-4);
  finding.record({"the star discrepancy before", shadow::star_discrepancy(points), "", 4});
  finding.record({"the star discrepancy after", shadow::star_discrepancy(rotated), "", 4});
  return finding;
}

}  // namespace penumbra::reproduce
