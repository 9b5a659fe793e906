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

namespace penumbra::truth {

// How the scene is laid out for tracing.
struct BuildOptions {
  // Triangles, copies counted, up to which every copy of a primitive gets triangles of its own. That is faster and
  // exact; beyond, copies share them, and are placed as exactly as single precision turns a ray instead of a triangle.
  std::size_t flat_triangles = 4'000'000;
  std::size_t memory = 0;  // bytes that Embree may use; 0: all there are
  // Asked to stop, from any thread: Tracer() throws Interrupted.
  std::stop_token stop = {};
};

struct BuildStats {
  std::size_t triangles = 0;  // that cast, copies counted
  std::size_t stored = 0;     // of them in memory
  std::size_t instances = 0;  // copies that share triangles
  std::size_t memory = 0;     // bytes that Embree holds
  double seconds = 0;
};

struct TraceOptions {
  // Of each pixel, rounded up to a multiple of eight: eight scramblings, each with an eighth of the points. Eight times
  // a power of two is best: the points then fill the light evenly.
  int samples = 256;
  // Over 0: `samples` (at least 64) are the first round. Pixels whose standard error is over this go on in rounds that
  // double their samples, until no more than a thousandth of the receivers is over it, or a pixel has max_samples. A
  // pixel whose samples all agree may still have a penumbra that they missed: if a neighbour's visibility is another,
  // it goes on until it has 2 / error samples.
  double error = 0;
  std::uint32_t seed = 0;
  int threads = 0;  // 0: one a core
  // Called now and then on the thread that called trace(), with the share of the work that is done; with `error` an
  // estimate that may grow slowly but never falls. False: stop, trace() throws Interrupted.
  std::function<bool(double share_done)> progress;
};

// Most samples of a pixel that an error bound can ask for.
constexpr int max_samples = 65536;

// Tracer() or trace() was told to stop.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

struct Traced {
  std::vector<float> visibility;      // a pixel: 1 lit, 0 in shadow; 1 where no surface is
  std::vector<float> standard_error;  // of it: that of the scramblings' mean (sample deviation / √8)
  std::vector<float> hard;            // visibility of the light's centre: 0 or 1
  long long rays = 0;                 // that were traced; surfaces that face away from the light need none
  double seconds = 0;
  int samples = 0;  // the most in a pixel
};

// The visibility integral, ray traced over a light's true shape: the truth that techniques are measured against. Casts
// a ray for each sample, from the receiver off its plane by what single precision needs (after Wächter and Binder 2019,
// "A fast and robust method for avoiding self-intersection"). Every triangle casts from both sides, points and lines
// don't, masked and blended surfaces where their alpha passes. A light behind a surface doesn't reach it. Uses Embree
// (Wald et al. 2014).
class Tracer {
 public:
  // Copies what it needs: scene and geometry may go. Throws Error if there is not enough memory, and Interrupted.
  Tracer(const scene::Scene& scene, const scene::PosedGeometry& geometry, const BuildOptions& options = {});
  ~Tracer();
  Tracer(Tracer&& other) noexcept;
  Tracer& operator=(Tracer&& other) noexcept;
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  // Receivers of a picture, row by row, `width` in a row. The result depends on them, the light, samples, error and
  // seed: not on the number of threads. Throws Interrupted.
  Traced trace(std::span<const Receiver> receivers, int width, const Light& light,
               const TraceOptions& options = {}) const;

  const BuildStats& stats() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::truth
