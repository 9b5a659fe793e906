#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "io/report.h"

namespace penumbra::plan {

// Reads JSON that anybody may have written. All throw Error with the fault alone: the caller names the file.

// `filter`: see nlohmann's parser_callback_t. JSON that is nested more than 64 deep is refused.
io::Json parse_json(std::string_view text, const io::Json::parser_callback_t& filter = nullptr);

// The object's "format" must be that one.
void check_format(const io::Json& json, std::string_view format);

const io::Json& member_of(const io::Json& json, const char* name);
const io::Json& array_in(const io::Json& json, const char* name);
std::string text_in(const io::Json& json, const char* name);
std::string text_of_value(const io::Json& value, const char* name);
// A whole number from 0 to `largest`.
std::size_t whole_in(const io::Json& json, const char* name, std::size_t largest);
// Finite, and not below 0.
double number_in(const io::Json& json, const char* name);

// A number as io::json_number() writes it: null is NaN, "inf" and "-inf" are infinite.
double any_number_in(const io::Json& json, const char* name);

}  // namespace penumbra::plan
