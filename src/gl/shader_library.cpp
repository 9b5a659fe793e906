#include "shader_library.h"

#include <algorithm>

#include "../core/error.h"

namespace penumbra::gl {

const Program& ShaderLibrary::get(const ProgramDesc& desc) {
  const auto found = entries_.find(desc);
  if (found == entries_.end()) {
    auto program = std::make_unique<Program>(desc, files_);
    return *entries_.emplace(desc, Entry{.program = std::move(program), .used = frame_}).first->second.program;
  }
  Entry& entry = found->second;
  entry.used = frame_;
  if (entry.stale) rebuild(desc, entry);
  outdated_ |= !entry.error.empty();
  return *entry.program;
}

void ShaderLibrary::next_frame() {
  ++frame_;
  std::vector<std::map<ProgramDesc, Entry>::iterator> idle;
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    if (is_idle(entry->second)) idle.push_back(entry);
  }
  if (idle.size() <= most_idle_) return;
  std::ranges::sort(idle, {}, [](const auto& entry) { return entry->second.used; });
  idle.resize(idle.size() - most_idle_);
  for (const auto& entry : idle) entries_.erase(entry);
}

void ShaderLibrary::rebuild(const ProgramDesc& desc, Entry& entry) {
  entry.stale = false;
  entry.error.clear();
  try {
    *entry.program = Program(desc, files_);
  } catch (const Error& error) {
    entry.error = error.what();
  }
}

void ShaderLibrary::changed(std::string_view file) {
  ++changes_;
  for (auto& [desc, entry] : entries_) {
    // A failed rebuild may depend on files that the last good program does not.
    const bool depends = std::ranges::find(entry.program->files(), file) != entry.program->files().end();
    if (depends || !entry.error.empty()) entry.stale = true;
  }
}

ShaderLibrary::Reload ShaderLibrary::reload() {
  Reload result;
  for (auto& [desc, entry] : entries_) {
    if (!entry.stale) continue;
    if (is_idle(entry)) {  // whether it still fails is not known
      entry.error.clear();
      continue;
    }
    rebuild(desc, entry);
    ++(entry.error.empty() ? result.rebuilt : result.failed);
  }
  return result;
}

std::vector<std::string> ShaderLibrary::errors() const {
  std::vector<std::string> messages;
  for (const auto& [desc, entry] : entries_) {
    const bool told = std::ranges::find(messages, entry.error) != messages.end();
    if (!entry.error.empty() && !told) messages.push_back(entry.error);
  }
  return messages;
}

}  // namespace penumbra::gl
