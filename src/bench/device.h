#pragma once

#include <memory>
#include <string>

#include "bench/options.h"
#include "bench/results.h"
#include "gl/context.h"

namespace penumbra::bench {

// Opens the context to measure on: the options' own, or else the first that is no software rasteriser, or any. Throws
// Error.
std::unique_ptr<gl::Context> open_measured(const Options& options);

// Writes the results to a file, in the format of its extension. Throws Error.
void write(const Results& results, const std::string& output);

}  // namespace penumbra::bench
