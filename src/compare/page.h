#pragma once

#include <string>

#include "compare/comparison.h"
#include "report/page.h"

namespace penumbra::compare {

// A comparison as a page: for each scene a table, cost against error, and pictures against the reference's. `arguments`
// are those of the command.
report::Page comparison_page(const Comparison& comparison, const CompareOptions& options,
                             const cli::Arguments& arguments);

}  // namespace penumbra::compare
