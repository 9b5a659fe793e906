#pragma once

#include <filesystem>
#include <string>

namespace penumbra::test {

// Ends the process when a file takes longer, naming it: a hang must fail the suite, not stall it.
void start_hang_guard(const std::string& file);

enum class Outcome { loaded, refused };

struct Reading {
  Outcome outcome = Outcome::loaded;
  std::string message;  // of a refusal
};

// Reads a file and checks what scene.h promises of it, in several poses. A refusal is an outcome; anything else that
// goes wrong throws.
Reading read_and_check(const std::filesystem::path& file);

// Each returns the number of failures, which it has printed.
int check_bad_scenes(const std::filesystem::path& folder);
int check_mutations(const std::filesystem::path& scenes);

}  // namespace penumbra::test
