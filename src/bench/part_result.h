#pragma once

#include "bench/results.h"
#include "plan/results.h"

namespace penumbra::bench {

// The results of one point, to be kept, and read again: all that is measured, exactly.
plan::Result result_of(const Results& measured);

// Those of one point that were kept, without entries, models and what identifies the program. Throws Error if the
// result lacks something.
Results kept_point(const plan::Result& result);

}  // namespace penumbra::bench
