#pragma once

namespace penumbra::cli {

// From now on SIGINT and SIGTERM remove unfinished files and end the program with exit code 130 or 143.
void clean_up_on_signals();

// From now on, writing past this process's limit on file sizes (ulimit -f) is an error, as on a full disk. Without this
// call the signal SIGXFSZ would end the program.
void fail_writes_past_the_limit();

}  // namespace penumbra::cli
