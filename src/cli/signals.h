#pragma once

namespace penumbra::cli {

// From now on SIGINT and SIGTERM remove unfinished files and end the program with exit code 130 or 143.
void clean_up_on_signals();

// From now on a file that would grow past this process's limit (ulimit -f) can't be written, as on a full disk; it
// would end the program by SIGXFSZ else.
void fail_writes_past_the_limit();

}  // namespace penumbra::cli
