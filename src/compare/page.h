#pragma once

#include <string>

#include "compare/comparison.h"
#include "report/page.h"

namespace penumbra::compare {

// Adds the next scene, and its section to the page: a table, a plot of cost against error (if costs were measured), and
// pictures beside the reference's.
void add_scene(Comparison& comparison, const CompareOptions& options, ComparedScene scene);

// The HTML page of a comparison, into which its sections move. `arguments` are those of the command.
report::Page comparison_page(Comparison& comparison, const CompareOptions& options, const cli::Arguments& arguments);

}  // namespace penumbra::compare
