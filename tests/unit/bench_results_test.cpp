// What bench writes of results that are made up here.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/results.h"
#include "io/text.h"
#include "render/renderer.h"

namespace penumbra::test {
namespace {

using bench::Cost;
using bench::Results;

bench::Entry entry(const char* technique) {
  const shadow::Registry& registry = shadow::built_in_registry();
  bench::Entry entry{.label = technique, .params = ParamSet(render::Renderer::params(registry))};
  registry.select(entry.params, technique);
  return entry;
}

Cost cost(const char* label) {
  const bench::Summary one{.median = 1, .min = 1, .max = 1, .count = 4};
  return {.label = label,
          .passes = {{.name = "shadow mask", .ms = one, .share = 1, .shadow = true}},
          .frame = one,
          .cpu = one,
          .passes_sum = one,
          .sum_ratio = 1,
          .shadow = one,
          .swept = one};
}

// One point of a sweep, with values along its axes that no other figure has.
Results results_of(const std::string& sweep) {
  Results results;
  results.scene = "steps.glb";
  results.sun = true;
  results.entries = {entry("pcss")};
  results.sweep = bench::make_sweep(sweep, {});
  bench::Measured point{
      .point = results.sweep.points.front(), .size = {64, 36}, .triangles = 1002, .costs = {cost("pcss")}};
  for (std::size_t i = 0; i < point.point.at.size(); ++i) point.point.at[i] = 0.125 + static_cast<double>(i);
  results.points = {point};
  return results;
}

std::vector<std::string> first_line(const std::string& csv) { return io::split(csv.substr(0, csv.find("\r\n")), ','); }

TEST(BenchResults, NoAxisIsNamedAsAnotherFigureOfAPoint) {
  for (const std::string& sweep : bench::sweep_names()) {
    const Results results = results_of(sweep);
    const std::vector<std::string> columns = first_line(csv_of(results));
    EXPECT_EQ(std::set(columns.begin(), columns.end()).size(), columns.size()) << sweep;
    const auto point = nlohmann::json::parse(json_of(results)).at("points").at(0);
    for (std::size_t i = 0; i < results.sweep.axes.size(); ++i)
      EXPECT_EQ(point.at(results.sweep.axes[i].name), 0.125 + static_cast<double>(i)) << sweep;
    EXPECT_EQ(point.at("width"), 64) << sweep;
    EXPECT_EQ(point.at("height"), 36) << sweep;
    EXPECT_EQ(point.at("triangles"), 1002) << sweep;
  }
}

TEST(BenchResults, TellTheNumberOfThreads) {
  Results results = results_of("");
  const std::vector<std::string> columns = first_line(csv_of(results));
  EXPECT_EQ(std::ranges::count(columns, "threads"), 1);
  EXPECT_TRUE(nlohmann::json::parse(json_of(results)).at("threads").is_null());
  results.threads = 97;
  EXPECT_EQ(nlohmann::json::parse(json_of(results)).at("threads"), 97);
  EXPECT_NE(csv_of(results).find(",97,"), std::string::npos);
}

TEST(BenchResults, HeadColumnsOfTheTerminalWithWhatTheyShow) {
  for (const auto& [sweep, head] : {std::pair("map_size", "map side"), std::pair("resolution", "size"),
                                    std::pair("casters", "caster triangles"), std::pair("cascades", "cascades")}) {
    const std::string text = text_of(results_of(sweep));
    EXPECT_NE(text.find(fmt::format("{:>18}{:>24}\n", head, "pcss ms")), std::string::npos) << text;
  }
}

TEST(BenchResults, TellTheCascadesThatAllTechniquesHave) {
  Results results = results_of("");
  EXPECT_EQ(setting_of(results), "steps.glb, 64×36, 4 cascades of 2048×2048, maps kept where nothing moved");
  results.entries.push_back(entry("hard"));
  EXPECT_NE(setting_of(results).find("4 cascades of 2048×2048"), std::string::npos);
  for (const auto& [name, value] : {std::pair("cascades.count", 2), std::pair("cascades.size", 1024)}) {
    results.entries.back() = entry("hard");
    results.entries.back().params.set(name, value);
    EXPECT_EQ(setting_of(results).find("2048"), std::string::npos) << name;
    EXPECT_NE(setting_of(results).find("cascades.count and cascades.size say of each"), std::string::npos) << name;
  }
  results.entries.resize(1);
  results.entries[0].params.set("cascades.fit", "visible");
  EXPECT_NE(setting_of(results).find(", the texels of 4 cascades of 2048×2048,"), std::string::npos);
  results.entries[0].params.set("cascades.count", 1);
  EXPECT_NE(setting_of(results).find(", 1 cascade of 2048×2048,"), std::string::npos);
  results.sun = false;
  EXPECT_EQ(setting_of(results).find("cascades"), std::string::npos);
}

TEST(BenchResults, TellHowManyFramesDrewAPass) {
  Results results = results_of("");
  EXPECT_EQ(text_of(results).find("of 4 frames"), std::string::npos);
  results.points[0].costs[0].passes[0].ms.count = 3;
  EXPECT_NE(text_of(results).find("in 3 of 4 frames"), std::string::npos);
  EXPECT_NE(html_of(results).find("in 3 of 4 frames"), std::string::npos);
}

}  // namespace
}  // namespace penumbra::test
