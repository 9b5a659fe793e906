#pragma once

#include "compare/drawing.h"
#include "plan/results.h"

namespace penumbra::compare {

// The result of drawing a part, to be kept, and read again. Everything that a report shows is kept exactly, except what
// the command line says already.
plan::Result result_of(const ComparedScene& drawn, const DrawnBy& by);

// A part that was kept. Throws Error if the result lacks something.
struct KeptPart {
  ComparedScene scene;
  DrawnBy by;
};
KeptPart kept_part(const plan::Result& result, const CompareOptions& options, const ComparedValues& values,
                   const Part& part);

}  // namespace penumbra::compare
