#pragma once

#include <vector>

namespace penumbra::cli {

// Those of SIGINT, SIGTERM and SIGHUP that are not ignored. Programs that a script starts in the background ignore the
// first, and those of nohup the last.
std::vector<int> ending_signals();

// From now on SIGINT, SIGTERM and SIGHUP remove unfinished files and end the program with 128 plus the signal's number
// as exit code, if they are ending_signals().
void clean_up_on_signals();

// From now on, writing past this process's limit on file sizes (ulimit -f) is an error, as on a full disk. Without this
// call the signal SIGXFSZ would end the program.
void fail_writes_past_the_limit();

}  // namespace penumbra::cli
