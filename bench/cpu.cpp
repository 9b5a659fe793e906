// What the CPU does before and beside a frame: reading glTF, baking noise, building the tracer's tree, metrics.
//   bench_cpu --benchmark_filter=read_gltf

#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "image/read.h"
#include "metrics/error_figures.h"
#include "metrics/flip.h"
#include "metrics/ssim.h"
#include "scene/gltf.h"
#include "scene/pose.h"
#include "scene/posed_geometry.h"
#include "shadow/noise.h"
#include "truth/tracer.h"

namespace penumbra {
namespace {

std::string path_of(const char* scene) { return std::string(PENUMBRA_ROOT "/scenes/") + scene + ".glb"; }

void read_gltf(benchmark::State& state, const char* scene) {
  const scene::ImageDecoder decode = image::image_decoder();
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(scene::read_gltf(path_of(scene), decode));
}
BENCHMARK_CAPTURE(read_gltf, courtyard, "courtyard")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_gltf, foliage, "foliage")->Unit(benchmark::kMillisecond);

void bake_noise(benchmark::State& state, const char* kind) {
  const int size = static_cast<int>(state.range(0));
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(shadow::make_noise(kind, size, 2, 1, 1));
}
BENCHMARK_CAPTURE(bake_noise, void_and_cluster, "void_and_cluster")->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bake_noise, blue, "blue")->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);

// The scene as its file has it, without skins and morphs.
scene::PosedGeometry at_rest(const scene::Scene& scene) {
  const scene::Pose pose = scene::rest_pose(scene);
  scene::PosedGeometry geometry;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].mesh < 0 || !pose.drawn[i]) continue;
    for (const scene::Primitive& primitive : scene.meshes[static_cast<std::size_t>(scene.nodes[i].mesh)].primitives)
      geometry.surfaces.push_back({&primitive, primitive.positions, pose.world[i]});
  }
  return geometry;
}

void build_tree(benchmark::State& state, const char* name) {
  const scene::Scene scene = scene::read_gltf(path_of(name), image::image_decoder());
  const scene::PosedGeometry geometry = at_rest(scene);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(truth::Tracer(scene, geometry));
}
BENCHMARK_CAPTURE(build_tree, courtyard, "courtyard")->Unit(benchmark::kMillisecond)->UseRealTime();

constexpr int width = 640, height = 360;

// Visibility with soft edges, the second one a little beside the first.
std::vector<float> visibility(float shift) {
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float wave = std::sin((static_cast<float>(x) + shift) * 0.05F) + std::cos(static_cast<float>(y) * 0.04F);
      pixels.push_back(std::min(std::max(0.5F + wave, 0.0F), 1.0F));
    }
  }
  return pixels;
}

template <class Metric>
void metric(benchmark::State& state, Metric measure) {
  const std::vector<float> test = visibility(0), reference = visibility(1);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(
        measure(metrics::Picture{width, height, test}, metrics::Picture{width, height, reference}));
  }
}
using Pictures = const metrics::Picture&;
BENCHMARK_CAPTURE(metric, error_figures, [](Pictures a, Pictures b) {
  return metrics::error_figures(a, b);
})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(metric, ssim, [](Pictures a, Pictures b) {
  return metrics::ssim(a, b);
})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(metric, flip, [](Pictures a, Pictures b) {
  return metrics::flip(a, b);
})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace penumbra

BENCHMARK_MAIN();
