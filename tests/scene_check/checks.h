#pragma once

#include <filesystem>
#include <string>

namespace penumbra::test {

// Ends the process, with the file's name, when a file takes longer: a hang must fail the suite, not stall it.
void start_hang_guard(const std::string& file);

enum class Outcome { loaded, refused };

struct Reading {
  Outcome outcome = Outcome::loaded;
  std::string message;  // why the file was refused
};

// Reads a file and checks what scene.h promises of the scene, in several poses. A refusal (Error) is a valid outcome;
// any other failure throws.
Reading read_and_check(const std::filesystem::path& file);

// Each returns the number of failures, which it has printed.
int check_bad_scenes(const std::filesystem::path& folder);
int check_mutations(const std::filesystem::path& scenes);

}  // namespace penumbra::test
