#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/key.h"
#include "io/report.h"

namespace penumbra::plan {

// A file that belongs to a result: a picture, packed floats.
struct ResultFile {
  std::string name;
  std::vector<std::byte> bytes;
};

// What working on an item gives.
struct Result {
  io::Json data;  // figures; its keys are the command's own
  std::vector<ResultFile> files;

  // Throws Error if there is no file of that name.
  const ResultFile& file(const std::string& name) const;
};

// A folder, perhaps shared by many machines, with one file for each result, named by its key, and one with the message
// of each item that failed. Files are written under another name and renamed once they are on the disk, so that what
// has a key's name is whole, whichever process was killed when; two processes that work on one item write the same.
// docs/formats.md describes the files.
class Results {
 public:
  // `command` is written into the files. The folder is created when first needed.
  Results(std::filesystem::path folder, std::string command)
      : folder_(std::move(folder)), command_(std::move(command)) {}

  // Whether a file of that name is there, whole or not.
  bool has(const io::Key& key) const;
  // Nothing if it is not there, or not as it was written.
  std::optional<Result> find(const io::Key& key) const;
  // Throws Error if it can't be written. Removes the message of an earlier failure.
  void keep(const io::Key& key, const Result& result) const;

  // The message of the failure; empty: there is none.
  std::string failure(const io::Key& key) const;
  void keep_failure(const io::Key& key, const std::string& message) const;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path file_of(const io::Key& key) const;

 private:
  std::filesystem::path failure_file_of(const io::Key& key) const;

  std::filesystem::path folder_;
  std::string command_;
};

}  // namespace penumbra::plan
