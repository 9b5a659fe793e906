// Compiles tinygltf's functions from its header. Macros keep that from including its own copies of these two headers.
#include <fstream>
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
