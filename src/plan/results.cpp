#include "plan/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "core/read_file.h"
#include "io/output_file.h"
#include "plan/json_reader.h"

namespace penumbra::plan {

namespace {

namespace fs = std::filesystem;
using io::Json;

constexpr const char* format = "penumbra.result/1";
constexpr std::size_t largest_result = std::size_t{1} << 33, largest_message = 1 << 16;
constexpr std::size_t trailer = 32 + 1;  // the checksum's digits and a line break

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

io::Key key_of(std::string_view text) {
  io::Hasher hasher;
  hasher.add(text);
  return hasher.key();
}

// A line of JSON, the files' bytes one after the other, and the checksum of all that in the last line.
std::string encoded(const io::Key& key, const std::string& command, const Result& result) {
  Json files = Json::array();
  for (const ResultFile& file : result.files) files.push_back({{"name", file.name}, {"bytes", file.bytes.size()}});
  const Json head = {
      {"format", format}, {"key", key.text()}, {"command", command}, {"data", result.data}, {"files", files}};
  std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  for (const ResultFile& file : result.files) text += text_of(file.bytes);
  return text + key_of(text).text() + "\n";
}

Result decoded(std::string_view text, const io::Key& key, const std::string& command) {
  if (text.size() < trailer) fail("it is too short");
  const std::string_view body = text.substr(0, text.size() - trailer);
  if (text.substr(body.size()) != key_of(body).text() + "\n") fail("its checksum is wrong");
  const std::size_t line = std::min(body.find('\n'), body.size());
  const Json head = parse_json(body.substr(0, line));
  check_format(head, format);
  if (text_in(head, "key") != key.text() || text_in(head, "command") != command) fail("it is of another item");
  Result result{.data = member_of(head, "data"), .files = {}};
  std::string_view rest = body.substr(std::min(line + 1, body.size()));
  for (const Json& file : array_in(head, "files")) {
    const std::size_t bytes = whole_in(file, "bytes", rest.size());
    const auto* begin = reinterpret_cast<const std::byte*>(rest.data());
    result.files.push_back({.name = text_in(file, "name"), .bytes = {begin, begin + bytes}});
    rest.remove_prefix(bytes);
  }
  if (!rest.empty()) fail("it is too long");
  return result;
}

}  // namespace

const ResultFile& Result::file(const std::string& name) const {
  const auto found = std::ranges::find(files, name, &ResultFile::name);
  if (found == files.end()) fail("a result lacks '{}'", name);
  return *found;
}

// Not all in one folder: some file systems get slow with very many names.
fs::path Results::file_of(const io::Key& key) const {
  const std::string name = key.text();
  return folder_ / name.substr(0, 2) / (name + ".result");
}

fs::path Results::failure_file_of(const io::Key& key) const { return file_of(key).replace_extension(".failed"); }

bool Results::has(const io::Key& key) const {
  std::error_code unread;
  return fs::is_regular_file(file_of(key), unread);
}

std::optional<Result> Results::find(const io::Key& key) const {
  if (!has(key)) return std::nullopt;
  try {
    return decoded(text_of(read_file(file_of(key), largest_result)), key, command_);
  } catch (const Error&) {
    return std::nullopt;
  }
}

void Results::keep(const io::Key& key, const Result& result) const {
  const fs::path path = file_of(key);
  // Beforehand, since OutputFile would remove a folder that it made when it fails, under another process's hands.
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  io::OutputFile file(path);
  file.write(encoded(key, command_, result));
  file.commit_durably();
  fs::remove(failure_file_of(key), error);
}

std::string Results::failure(const io::Key& key) const {
  try {
    std::string text(text_of(read_file(failure_file_of(key), largest_message)));
    while (text.ends_with('\n')) text.pop_back();
    return text;
  } catch (const Error&) {
    return {};
  }
}

void Results::keep_failure(const io::Key& key, const std::string& message) const {
  const fs::path path = failure_file_of(key);
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  io::write_text(path, message + "\n");
}

}  // namespace penumbra::plan
