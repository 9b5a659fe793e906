#pragma once

#include <filesystem>
#include <string>

#include "io/report.h"

namespace penumbra::viewer {

// Reads a JSON file that the viewer has written, and that anything may have changed since: its size, depth and number
// of keys are limited. Throws Error with the cause alone.
io::Json read_json(const std::filesystem::path& file);

// The value of a key of an object, or null.
const io::Json* find(const io::Json& object, const char* key);

// "ignored the WHAT in 'FILE': CAUSE", one line of limited length whatever text of the file the cause quotes.
std::string ignored(const char* what, const std::filesystem::path& file, std::string cause);

}  // namespace penumbra::viewer
