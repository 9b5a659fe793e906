#pragma once

#include <string>

#include "cli/command_line.h"
#include "compare/comparison.h"
#include "io/report.h"

namespace penumbra::compare {

// A comparison as text for a terminal, comma-separated values and JSON. They agree in their figures; JSON has all
// figures, the parameters, and everything needed to draw the same pictures again. Only the columns cost_* differ from
// run to run; without costs they are empty. Infinite figures (nothing differs) are "inf", also in JSON, as text;
// figures that could not be measured are empty in CSV and null in JSON.
std::string terminal_table(const ComparedScene& scene);
std::string csv_table(const Comparison& comparison);
io::Json json_of(const Comparison& comparison, const CompareOptions& options, const cli::Arguments& arguments);

}  // namespace penumbra::compare
