#pragma once

#include <span>
#include <string>

#include "cli/command_line.h"
#include "io/report.h"
#include "report/page.h"
#include "reproduce/finding.h"
#include "reproduce/workbench.h"

namespace penumbra::reproduce {

// All findings as a page, JSON, comma-separated values and lines for a terminal, with the same figures. On one machine
// only the figures of costs differ from run to run. In JSON, infinite figures (nothing differs) are "inf" and figures
// that could not be measured are null.
penumbra::report::Page page_of(std::span<const Finding> findings, const Workbench& bench,
                               const cli::Arguments& arguments);
io::Json json_of(std::span<const Finding> findings, const Workbench& bench);
std::string csv_of(std::span<const Finding> findings);
std::string text_of(std::span<const Finding> findings, const Options& options);

}  // namespace penumbra::reproduce
