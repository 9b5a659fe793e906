// Benchmarks of CPU work outside and beside the frame: reading glTF, baking noise, building the tracer's acceleration
// structure, tracing, metrics.
//   bench_cpu --benchmark_filter=read_gltf

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "image/read.h"
#include "metrics/error_figures.h"
#include "metrics/flip.h"
#include "metrics/ssim.h"
#include "render/setup.h"
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

// The scene in its rest pose, without skins and morphs.
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

// Adds receivers on a triangle, in proportion to its area. `wanted` carries the fraction of a receiver that is left
// over to the next triangle.
void add_receivers(std::vector<truth::Receiver>& receivers, const std::array<glm::dvec3, 3>& corners, double density,
                   double& wanted) {
  const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0], cross = glm::cross(u, v);
  const double twice_area = glm::length(cross), reach = glm::length(u) + glm::length(v);
  for (wanted += density * twice_area / 2; wanted >= 1; wanted -= 1) {
    // Martin Roberts's R2 sequence, folded into the triangle.
    const auto index = static_cast<double>(receivers.size());
    glm::dvec2 at = glm::fract(index * glm::dvec2(0.7548776662466927, 0.5698402909980532));
    if (at.x + at.y > 1) at = 1.0 - at;
    receivers.push_back(
        {.position = corners[0] + at.x * u + at.y * v, .normal = cross / twice_area, .there = true, .extent = reach});
  }
}

// About `count` receivers over the whole scene, triangle after triangle.
std::vector<truth::Receiver> receivers_on(const scene::PosedGeometry& geometry, double count) {
  const auto each_triangle = [&geometry](const auto& take) {
    for (const scene::PosedSurface& surface : geometry.surfaces) {
      const std::vector<std::uint32_t>& indices = surface.primitive->indices;
      for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        std::array<glm::dvec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
          corners[k] = glm::dvec3(surface.world * glm::vec4(surface.positions[indices[i + k]], 1));
        take(corners);
      }
    }
  };
  double area = 0, wanted = 0;
  each_triangle([&area](const auto& c) { area += glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) / 2; });
  std::vector<truth::Receiver> receivers;
  each_triangle([&](const auto& corners) { add_receivers(receivers, corners, count / area, wanted); });
  return receivers;
}

// Traces on all cores; the counter is in rays per second.
void trace_rays(benchmark::State& state, const char* name) {
  const scene::Scene scene = scene::read_gltf(path_of(name), image::image_decoder());
  const scene::PosedGeometry geometry = at_rest(scene);
  const truth::Tracer tracer(scene, geometry);
  constexpr int row = 256;
  std::vector<truth::Receiver> receivers = receivers_on(geometry, row * 144);
  receivers.resize(receivers.size() / row * row);
  const truth::TracedSun sun{.to_light = render::choose_setup(scene, scene::rest_pose(scene)).sun.to_light};
  double rays = 0;
  for ([[maybe_unused]] auto _ : state)
    rays += static_cast<double>(tracer.trace(receivers, row, sun, {.samples = 64}).rays);
  state.counters["rays"] = benchmark::Counter(rays, benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(trace_rays, courtyard, "courtyard")->Unit(benchmark::kMillisecond)->UseRealTime();

constexpr int width = 640, height = 360;

// A visibility picture with soft edges, displaced by `shift`.
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
        measure(metrics::ImageView{width, height, test}, metrics::ImageView{width, height, reference}));
  }
}
using Pictures = const metrics::ImageView&;
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
