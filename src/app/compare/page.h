#pragma once

#include <string>

#include "app/compare/comparison.h"
#include "report/page.h"

namespace penumbra::app {

// A comparison as a page: for each scene a table, cost against error, and pictures against the reference's. `arguments`
// are those of the command.
report::Page comparison_page(const Comparison& comparison, const CompareOptions& options,
                             const studio::Arguments& arguments);

}  // namespace penumbra::app
