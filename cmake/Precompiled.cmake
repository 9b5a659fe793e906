# Headers of the standard library and of other projects, parsed once for many files instead of once for each. Nothing of
# the project's own is among them, so that changing a header here rebuilds what includes it and no more. CLI11 and
# nlohmann/json are not among them either, since they would add code to compile to every file. A file still includes all
# that it uses: clang-tidy, and the compiler with -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON, see none of these headers.
set(penumbra_headers_library <algorithm> <array> <bit> <cassert> <charconv> <chrono> <cmath> <cstddef> <cstdint> <cstring>
  <deque> <filesystem> <functional> <limits> <map> <memory> <numeric> <optional> <set> <span> <string> <string_view>
  <utility> <variant> <vector> <fmt/format.h> <glm/glm.hpp> <glm/gtc/matrix_transform.hpp> <glm/gtc/type_ptr.hpp>)
set(penumbra_headers_tests ${penumbra_headers_library} <fstream> <random> <gtest/gtest.h>)

# penumbra_precompile(TARGET SET): TARGET uses the precompiled headers of a set: library or tests. A set is compiled once,
# by an object library of its own: as position-independent code for the layers, as that of a program for the tests.
function(penumbra_precompile target set)
  set(provider penumbra_headers_${set})
  if(NOT TARGET ${provider})
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/${provider}.cpp" CONTENT "")
    add_library(${provider} OBJECT "${PROJECT_BINARY_DIR}/generated/${provider}.cpp")
    target_link_libraries(${provider} PRIVATE penumbra_options fmt::fmt glm::glm)
    if(set STREQUAL tests)
      target_link_libraries(${provider} PRIVATE GTest::gtest)
      set_target_properties(${provider} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${provider} PRIVATE -fPIE)
    endif()
    target_precompile_headers(${provider} PRIVATE ${${provider}})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${provider})
endfunction()
