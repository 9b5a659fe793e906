#pragma once

#include <filesystem>

namespace penumbra::io {

// Outputs that are written to, because no other file can take their place: character devices, pipes, and links to what
// a process has open, such as /dev/stdout, /dev/fd/3 and a shell's >(command).

// Whether `path` is a link of procfs to what a process has open.
bool is_open_file(const std::filesystem::path& path);
// Whether `path`, which is no other symbolic link, is such an output.
bool is_stream(const std::filesystem::path& path);

// Throws Error unless something could be written. `name`: what messages call the output.
void check_stream(const std::filesystem::path& path, const std::filesystem::path& name);
// Appends the content of a file. A pipe must have a reader. Throws Error if the system refuses a part.
void write_to_stream(const std::filesystem::path& path, const std::filesystem::path& name,
                     const std::filesystem::path& from);

}  // namespace penumbra::io
