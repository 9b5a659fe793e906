#pragma once

#include <cstddef>
#include <optional>

#include "bench/options.h"
#include "bench/results.h"
#include "scene/gltf.h"
#include "shadow/registry.h"

namespace penumbra::bench {

// A point of a sweep by its index, and how many points the sweep was planned with.
struct OnePoint {
  std::size_t index = 0, of = 1;
};

// Measures everything that the options ask for, of techniques of the registry, on the current context. `only`: one
// point of the sweep alone; the results then have no model. Throws Error, also if the sweep has another number of
// points on this device.
Results measure(const Options& options, const scene::ImageDecoder& decode, const shadow::Registry& registry,
                const std::optional<OnePoint>& only = {});

// The points that would be measured on the current context. Throws Error.
Sweep sweep_of(const Options& options, const scene::ImageDecoder& decode, const shadow::Registry& registry);

// Fits the models of results that have all their points.
void fit_models(Results& results);

}  // namespace penumbra::bench
