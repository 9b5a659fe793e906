// A merge of very many items reads them one after the other: its memory is about that of the report. The variable
// PENUMBRA_MERGE_ITEMS sets how many (2000).

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include "compare/command.h"
#include "compare/part_result.h"
#include "compare/pictures.h"
#include "image/packed.h"
#include "support/temp_folder.h"

namespace penumbra::test {
namespace {

constexpr int width = 64, height = 36;

std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t whole = 0, pages = 0;
  file >> whole >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Of this process so far.
std::size_t most_resident() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

// What a worker would keep for an item: pictures of noise over a part of the picture, so that none equals another.
compare::ComparedScene drawn(std::size_t number, bool with_reference) {
  std::vector<std::uint8_t> display(std::size_t{width} * height * 3, 128);
  std::vector<float> visibility(std::size_t{width} * height, 1.0f), error(visibility.size(), 0.0f);
  std::uint64_t state = number * 0x9e3779b97f4a7c15ULL + 1;
  for (std::size_t i = 0; i < visibility.size() / 4; ++i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    display[i * 3] = static_cast<std::uint8_t>(state >> 40);
    visibility[i] = static_cast<float>(state >> 40) / static_cast<float>(1 << 24);
    error[i] = visibility[i] - 0.5f;
  }
  compare::ComparedScene scene{.receivers = visibility.size(), .pixels = visibility.size()};
  scene.lights = {render::SunLight{}};
  compare::ComparedTechnique technique{.shadow_bytes = 1000};
  technique.cost = {.median = NAN, .min = NAN, .max = NAN};
  technique.figures.rmse = 0.01;
  technique.figures.p99 = 0.3;
  technique.pictures = compare::encoded_pictures(display, visibility, {width, height});
  technique.pictures.error = image::pack_floats(error);
  if (with_reference) scene.reference = technique.pictures;
  scene.techniques.push_back(technique);
  return scene;
}

TEST(MergeMemory, IsThatOfTheReport) {
  const char* wanted = std::getenv("PENUMBRA_MERGE_ITEMS");
  constexpr std::size_t techniques = 100, usual_items = 2000;
  const std::size_t scenes = (wanted == nullptr ? usual_items : std::stoul(wanted)) / techniques;
  test::TempFolder folder;
  cli::Arguments arguments;
  for (std::size_t i = 0; i < scenes; ++i) arguments.push_back("scene_" + std::to_string(i) + ".glb");
  std::string names;
  for (std::size_t i = 0; i < techniques; ++i)
    names += (i == 0 ? "" : ",") + ("hard:bias.constant=" + std::to_string(0.001 * static_cast<double>(i + 1)));
  arguments.insert(arguments.end(),
                   {"--technique", names, "--size", "64x36", "--no-cost", "--quiet", "-o", "plan.json"});
  const std::unique_ptr<plan::Job> job = compare::make_job(arguments, arguments.size() - 1);
  ASSERT_EQ(job->count(), scenes * techniques);

  const plan::Results results(folder.path() / "results", "compare");
  const compare::DrawnBy by{.device = {{"renderer", "none"}}, .backend = "none"};
  std::size_t bytes = 0;
  const auto key = [](std::size_t item) { return io::Key{item << 56, item}; };
  for (std::size_t item = 0; item < job->count(); ++item) {
    results.keep(key(item), compare::result_of(drawn(item, item < scenes), by));
    bytes += std::filesystem::file_size(results.file_of(key(item)));
  }

  const std::size_t before = resident();
  std::vector<int> reads(job->count(), 0);
  const auto start = std::chrono::steady_clock::now();
  const std::filesystem::path report_folder = folder.path() / "report";
  job->merge(
      [&](std::size_t item) {
        ++reads[item];
        return *results.find(key(item));
      },
      report_folder);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::size_t report = 0;
  for (const std::filesystem::path& file : job->outputs(report_folder)) report += std::filesystem::file_size(file);
  std::printf("merge of %zu items, %.1f MiB: %.1f s, report of %.1f MiB, at most %.1f MiB of memory more\n",
              job->count(), static_cast<double>(bytes) / (1 << 20), seconds.count(),
              static_cast<double>(report) / (1 << 20), static_cast<double>(most_resident() - before) / (1 << 20));
  for (const int count : reads) ASSERT_EQ(count, 1) << "each result is read once";
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(most_resident() - before, report + report / 2);
#endif
}

}  // namespace
}  // namespace penumbra::test
