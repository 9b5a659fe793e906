#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "scene/posed_geometry.h"
#include "truth/light.h"
#include "truth/receiver.h"
#include "truth/sampling.h"

namespace penumbra::truth {

// How the acceleration structure is built.
struct BuildOptions {
  // Up to this many triangles (instances counted) every instance of a primitive gets its own copy of the triangles,
  // which is faster and exact. Beyond it, instances share triangles; rays are then transformed to the instance's space
  // in single precision, which adds rounding errors.
  std::size_t flat_triangles = 4'000'000;
  std::size_t memory = 0;  // bytes that Embree may use; 0: no limit
  int threads = 0;         // that build; 0: one for each core
  // A stop request, from any thread, makes Tracer() throw Interrupted.
  std::stop_token stop = {};
};

struct BuildStats {
  std::size_t triangles = 0;  // that cast shadows, instances counted
  std::size_t stored = 0;     // triangles that are in memory
  std::size_t instances = 0;  // instances that share triangles
  std::size_t memory = 0;     // bytes that Embree allocated
  double seconds = 0;
};

struct TraceOptions {
  // Samples of each pixel, rounded up to a multiple of eight: eight scramblings share them evenly. Best is eight times
  // a power of two, which covers the light evenly.
  int samples = 256;
  // 0: every pixel gets `samples`. Above 0: adaptive sampling to this standard error. The first round takes `samples`
  // (at least 64). Pixels whose standard error is larger continue in rounds that double their samples, until at most a
  // thousandth of the receivers exceed it or a pixel has max_samples. If all samples of a pixel agree, it may still be
  // in a penumbra that they missed: if a neighbour has another visibility, it continues to 2 / error samples.
  double error = 0;
  std::uint32_t seed = 0;
  // With Scramblings::one the samples cover the light more evenly, but Traced has visibility alone, and `error` must be
  // 0.
  Scramblings scramblings = Scramblings::eight;
  int threads = 0;  // 0: one for each core
  // Called repeatedly on the thread that called trace(), with the share of the work that is done, 0 to 1; with `error`
  // it is an estimate, which never falls. If it returns false, trace() stops and throws Interrupted.
  std::function<bool(double share_done)> progress;
};

// The samples of each pixel in the first round; without `error` there is no other.
int first_samples(const TraceOptions& options);

// The most samples of a pixel with adaptive sampling.
constexpr int max_samples = 65536;

// Thrown by Tracer() and trace() when the caller interrupts them.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

struct Traced {
  std::vector<float> visibility;      // one value per pixel: 1 lit, 0 in shadow; 1 where there is no surface
  std::vector<float> standard_error;  // sample deviation of the scramblings' means / √8
  std::vector<float> hard;            // visibility of the light's centre: 0 or 1
  long long rays = 0;                 // rays that were traced; surfaces that face away from the light need none
  double seconds = 0;
  int samples = 0;  // of the pixel with the most
};

// Computes the visibility integral by ray tracing a light's true shape: the ground truth for techniques. Each sample is
// a ray that starts off the receiver's plane by as much as single precision requires (after Wächter and Binder 2019, "A
// fast and robust method for avoiding self-intersection"). Triangles cast shadows from the faces that
// PosedSurface::faces names, masked and blended ones where their alpha passes; points and lines cast none. Light from
// behind a surface does not reach it. Uses Embree (Wald et al. 2014).
class Tracer {
 public:
  // Copies what it needs: scene and geometry may be destroyed afterwards. Throws Error if there is not enough memory,
  // and Interrupted.
  Tracer(const scene::Scene& scene, const scene::PosedGeometry& geometry, const BuildOptions& options = {});
  ~Tracer();
  Tracer(Tracer&& other) noexcept;
  Tracer& operator=(Tracer&& other) noexcept;
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  // `receivers` are the pixels of a picture, row by row, `width` in each row. The result depends on them, the light,
  // samples, error and seed, but not on the number of threads. Throws Interrupted.
  Traced trace(std::span<const Receiver> receivers, int width, const TracedLight& light,
               const TraceOptions& options = {}) const;

  const BuildStats& stats() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::truth
