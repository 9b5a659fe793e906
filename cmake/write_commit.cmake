# Run by penumbra_embed_commit(): writes the commit that is checked out in ROOT to OUTPUT, if OUTPUT has another one.
cmake_policy(VERSION 3.25)
set(commit "unknown")
if(GIT)
  execute_process(COMMAND "${GIT}" -C "${ROOT}" rev-parse --short=12 HEAD
    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  execute_process(COMMAND "${GIT}" -C "${ROOT}" rev-parse --show-prefix
    OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  # If the sources are a copy within another project's checkout, that project's commit does not describe them.
  if(NOT failed AND prefix STREQUAL "")
    execute_process(COMMAND "${GIT}" -C "${ROOT}" diff --quiet HEAD RESULT_VARIABLE changed ERROR_QUIET)
    # Sources are found by their names, so that those which Git does not know are compiled too.
    execute_process(COMMAND "${GIT}" -C "${ROOT}" ls-files --others --exclude-standard -- src glsl presets python tools
      OUTPUT_VARIABLE unknown ERROR_QUIET)
    set(commit "${head}")
    if(changed OR NOT unknown STREQUAL "")
      string(APPEND commit "-changed")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT "#include \"bench/machine.h\"

namespace penumbra::bench {

const char* commit() { return \"@commit@\"; }

}  // namespace penumbra::bench
")
