#pragma once

#include "cli/command_line.h"
#include "compare/comparison.h"

namespace penumbra::compare {

// Warns of values on the command line that change nothing.
void warn_of_settings(const CompareOptions& options, const ComparedValues& values);

// Writes the page and the tables to where the options say, and warns of values that are not finite; the comparison is
// left without its sections. `arguments` are those of the command. Throws Error.
void write_reports(Comparison& comparison, const CompareOptions& options, const cli::Arguments& arguments);

}  // namespace penumbra::compare
