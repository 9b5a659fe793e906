// Usage: penumbra_scene_check bad_scenes|mutations
//   bad_scenes  every file of $PENUMBRA_ASSETS/bad_scenes ends as its class in manifest.csv demands
//   mutations   thousands of damaged copies of valid scenes are refused or loaded, never worse

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/error.h"
#include "core/log.h"
#include "image/read.h"
#include "scene/gltf.h"
#include "scene_check/checks.h"
#include "support/scene_faults.h"

namespace penumbra::test {
namespace {

constexpr unsigned int seconds_a_file = 10;
constexpr long most_resident_kib = 2L << 20;

// All that the handler of the alarm signal uses.
std::array<char, 512> current_file{};

void report_hang(int) {
  static const char text[] = "FAILED: hangs: ";
  [[maybe_unused]] auto written = write(STDERR_FILENO, text, sizeof text - 1);
  written = write(STDERR_FILENO, current_file.data(), std::strlen(current_file.data()));
  written = write(STDERR_FILENO, "\n", 1);
  _exit(1);
}

int check_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak resident memory: %ld MiB\n", usage.ru_maxrss / 1024);
  if (usage.ru_maxrss <= most_resident_kib) return 0;
  std::printf("FAILED: peak resident memory is over %ld MiB\n", most_resident_kib / 1024);
  return 1;
}

}  // namespace

void start_hang_guard(const std::string& file) {
  std::snprintf(current_file.data(), current_file.size(), "%s", file.c_str());
  alarm(seconds_a_file);
}

Reading read_and_check(const std::filesystem::path& file) {
  scene::Scene scene;
  try {
    scene = scene::read_gltf(file, image::image_decoder(), {.limits = {.image_bytes = std::size_t{1} << 30}});
  } catch (const Error& e) {
    return {Outcome::refused, e.what()};
  }
  check_scene(scene);
  return {};
}

}  // namespace penumbra::test

int main(int argc, char** argv) {
  using namespace penumbra;
  const std::string check = argc == 2 ? argv[1] : "";
  if (check != "bad_scenes" && check != "mutations") {
    std::fprintf(stderr, "usage: %s bad_scenes|mutations\n", argv[0]);
    return 2;
  }
  const char* const assets = std::getenv("PENUMBRA_ASSETS");
  const auto folder = std::filesystem::path(assets ? assets : "") / (check == "mutations" ? "scenes" : check);
  if (assets == nullptr || !std::filesystem::is_directory(folder)) {
    std::printf("skipped: the environment variable PENUMBRA_ASSETS names no folder with %s\n",
                folder.filename().c_str());
    return 0;
  }
  std::signal(SIGALRM, test::report_hang);
  set_log_sink([](LogLevel, std::string_view) {});
  int failures = check == "mutations" ? test::check_mutations(folder) : test::check_bad_scenes(folder);
  failures += test::check_memory();
  return failures == 0 ? 0 : 1;
}
