# Run by cpack before it makes packages of the folder CPACK_TEMPORARY_DIRECTORY: packs manual pages and changelogs, and
# removes debugging symbols from static libraries, as Debian's policy asks.
cmake_policy(VERSION 3.25)
find_program(gzip gzip REQUIRED)
find_program(strip strip REQUIRED)
file(GLOB_RECURSE documents "${CPACK_TEMPORARY_DIRECTORY}/*.1" "${CPACK_TEMPORARY_DIRECTORY}/changelog*")
foreach(document IN LISTS documents)
  execute_process(COMMAND "${gzip}" -9 -n "${document}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB_RECURSE libraries "${CPACK_TEMPORARY_DIRECTORY}/*.a")
foreach(library IN LISTS libraries)
  execute_process(COMMAND "${strip}" --strip-debug --enable-deterministic-archives "${library}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
