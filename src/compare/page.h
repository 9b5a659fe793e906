#pragma once

#include <string>

#include "compare/comparison.h"
#include "report/page.h"

namespace penumbra::compare {

// The HTML page of a comparison: for each scene a table, a plot of cost against error, and pictures beside the
// reference's. `arguments` are those of the command.
report::Page comparison_page(const Comparison& comparison, const CompareOptions& options,
                             const cli::Arguments& arguments);

}  // namespace penumbra::compare
