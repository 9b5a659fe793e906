# Libraries of other projects, as penumbra::NAME. Found by header and library file, not by the packages' own CMake files:
# Debian's for OpenImageIO names an include folder that only exists with OpenCV installed. Imported targets count as
# system headers: their warnings are off.

# penumbra_dependency(NAME HEADER file [LIBRARIES names...]): each name one library file to link.
function(penumbra_dependency name)
  cmake_parse_arguments(arg "" "HEADER" "LIBRARIES" ${ARGN})
  find_path(PENUMBRA_${name}_INCLUDE ${arg_HEADER})
  if(NOT PENUMBRA_${name}_INCLUDE)
    message(FATAL_ERROR "${name}: header ${arg_HEADER} not found; install it (run.sh lists the packages)")
  endif()
  add_library(penumbra::${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(penumbra::${name} SYSTEM INTERFACE "${PENUMBRA_${name}_INCLUDE}")
  foreach(library IN LISTS arg_LIBRARIES)
    find_library(PENUMBRA_${name}_${library} ${library})
    if(NOT PENUMBRA_${name}_${library})
      message(FATAL_ERROR "${name}: library ${library} not found; install it (run.sh lists the packages)")
    endif()
    target_link_libraries(penumbra::${name} INTERFACE "${PENUMBRA_${name}_${library}}")
  endforeach()
  mark_as_advanced(PENUMBRA_${name}_INCLUDE)
endfunction()
