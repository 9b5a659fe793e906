#include "session/shader_reload.h"

#include <algorithm>
#include <chrono>
#include <string_view>

namespace penumbra::session {

namespace {

// Compares paths as the user wrote them, because a watch reports a folder's files under the folder's own name.
bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// A path with a slash at its end has one more component, which is empty.
std::filesystem::path without_slash(const std::filesystem::path& folder) {
  return folder.has_filename() || !folder.has_relative_path() ? folder : folder.parent_path();
}

// The lines after the heading, which names the program.
std::string_view faults_of(std::string_view error) { return error.substr(std::min(error.find('\n'), error.size())); }

}  // namespace

std::vector<std::string> shader_faults(const gl::ShaderLibrary& library) {
  std::vector<std::string> result;
  for (std::string& error : library.errors()) {
    const auto is_same = [&](const std::string& told) {
      return faults_of(told) == faults_of(error) && !faults_of(error).empty();
    };
    if (std::ranges::none_of(result, is_same)) result.push_back(std::move(error));
  }
  return result;
}

ShaderReload reload_shaders(gl::ShaderLibrary& library, std::span<const std::filesystem::path> changed) {
  ShaderReload result;
  const std::filesystem::path folder = without_slash(library.files().overlay_directory());
  if (folder.empty()) return result;
  for (const std::filesystem::path& file : changed) {
    if (!lies_in(file, folder)) continue;
    result.files.push_back(file);
    library.changed(file.lexically_relative(folder).generic_string());
  }
  if (result.files.empty()) return result;
  const auto start = std::chrono::steady_clock::now();
  const gl::ShaderLibrary::Reload reload = library.reload();
  result.rebuilt = reload.rebuilt;
  result.failed = reload.failed;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.errors = shader_faults(library);
  return result;
}

}  // namespace penumbra::session
