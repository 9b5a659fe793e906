#pragma once

#include <span>
#include <string>

#include "cli/command_line.h"
#include "io/report.h"
#include "report/page.h"
#include "reproduce/finding.h"
#include "reproduce/workbench.h"

namespace penumbra::reproduce {

// All findings as a page, JSON, comma-separated values and lines for a terminal. They hold the same figures. Only those
// whose names speak of costs differ from run to run on one machine. In JSON, what is infinite (nothing differs) is
// "inf" and what could not be measured is null.
penumbra::report::Page page_of(std::span<const Finding> findings, const Workbench& bench,
                               const cli::Arguments& arguments);
io::Json json_of(std::span<const Finding> findings, const Workbench& bench);
std::string csv_of(std::span<const Finding> findings);
std::string text_of(std::span<const Finding> findings, const Options& options);

}  // namespace penumbra::reproduce
