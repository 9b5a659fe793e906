// Lets C++ compile GLSL structs and plain GLSL functions by giving GLSL's types and functions the same names in C++.
#ifndef PENUMBRA_LANGUAGE_H
#define PENUMBRA_LANGUAGE_H

#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace penumbra::glsl {
using namespace glm;  // NOLINT(google-build-using-namespace): GLSL's names are the point
using uint = std::uint32_t;
}  // namespace penumbra::glsl
#define GLSL_BEGIN namespace penumbra::glsl {
#define GLSL_END }
#define GLSL_FUNCTION inline
#else
#define GLSL_BEGIN
#define GLSL_END
#define GLSL_FUNCTION
#endif

#endif
