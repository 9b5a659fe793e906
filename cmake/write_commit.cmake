# Run by penumbra_embed_commit(): writes the commit that ROOT is at to OUTPUT, where OUTPUT says another.
cmake_policy(VERSION 3.25)
set(commit "unknown")
if(GIT)
  execute_process(COMMAND "${GIT}" -C "${ROOT}" rev-parse --short=12 HEAD
    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  execute_process(COMMAND "${GIT}" -C "${ROOT}" rev-parse --show-prefix
    OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  # A copy of the sources within another project's checkout is none of its commits.
  if(NOT failed AND prefix STREQUAL "")
    execute_process(COMMAND "${GIT}" -C "${ROOT}" diff --quiet HEAD RESULT_VARIABLE changed ERROR_QUIET)
    set(commit "${head}")
    if(changed)
      string(APPEND commit "-changed")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT "#include \"bench/machine.h\"

namespace penumbra::bench {

const char* commit() { return \"@commit@\"; }

}  // namespace penumbra::bench
")
