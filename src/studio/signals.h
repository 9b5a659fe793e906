#pragma once

namespace penumbra::studio {

// From now on SIGINT and SIGTERM remove unfinished files and end the program with exit code 130 or 143.
void clean_up_on_signals();

}  // namespace penumbra::studio
