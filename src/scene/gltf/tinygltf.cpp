// tinygltf's functions, from its header.
#include <nlohmann/json.hpp>  // which the header is told not to include itself

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
