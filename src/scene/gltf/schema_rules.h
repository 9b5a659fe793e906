#pragma once

#include <cfloat>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace penumbra::scene::gltf {

enum class Type { boolean, integer, number, numbers, text, object, array, index };

struct Check {
  Type type;
  bool required = false;
  std::string of_type = {};              // required only where the owner's member "type", checked before, is this
  double min = -FLT_MAX, max = FLT_MAX;  // range of a number, an integer, or each element of an array of numbers
  std::size_t length = 0;                // of an array of numbers; 0: any
  std::string into;                      // for an index: the path of the array that it refers to
  std::vector<std::string> words;        // text: the allowed ones; empty: any
  std::vector<int64_t> values;           // integer: the allowed ones; empty: any in range
};

// `path` is a list of members separated by '.'; "[]" after a member means each element of an array, "{}" each member of
// an object.
struct Rule {
  std::string path;
  Check check;
};

// The rules that the reader checks a document against.
const std::vector<Rule>& schema();

}  // namespace penumbra::scene::gltf
