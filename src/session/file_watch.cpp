#include "session/file_watch.h"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <utility>

#include "core/error.h"
#include "io/output_file.h"

namespace penumbra::session {

namespace {

namespace fs = std::filesystem;

// In folders along the path to a file only created, deleted and renamed entries matter, not the contents of files:
// other programs write to /tmp all the time.
constexpr std::uint32_t names_change = IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO;
constexpr std::uint32_t texts_change = IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB;

bool is_hidden(const fs::path& path) { return path.filename().native().starts_with('.'); }

// Relative to a folder, or absolute: then from the root.
void push_front(std::deque<std::string>& parts, const fs::path& path) {
  std::vector<std::string> front;
  for (const fs::path& part : path.relative_path()) {
    if (!part.empty() && part != ".") front.push_back(part.native());
  }
  parts.insert(parts.begin(), front.begin(), front.end());
}

}  // namespace

FileWatch::FileWatch() : inotify_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (inotify_ >= 0) return;
  if (errno == EMFILE)
    fail(
        "cannot watch files: the limit of inotify instances (sysctl fs.inotify.max_user_instances) or of open files "
        "(ulimit -n) is reached");
  fail("cannot watch files: {}", std::strerror(errno));
}

FileWatch::~FileWatch() { close(inotify_); }

void FileWatch::add_folder(const fs::path& folder) {
  folders_.push_back(folder);
  refresh();
}

void FileWatch::add_file(const fs::path& file) {
  files_.push_back(file);
  refresh();
}

void FileWatch::set_files(std::vector<fs::path> files) {
  files_ = std::move(files);
  refresh();
}

// Resolves the path as the system does, and records each entry along it, symbolic links included.
void FileWatch::survey_path(Survey& survey, const fs::path& path, const fs::path& told_as) {
  constexpr int most_links = 40;
  std::deque<std::string> parts;
  push_front(parts, fs::absolute(path));
  fs::path folder = "/";
  for (int links = 0; !parts.empty();) {
    const std::string name = parts.front();
    parts.pop_front();
    if (name == "..") {
      folder = folder.parent_path();
      continue;
    }
    const fs::path entry = folder / name;
    std::error_code error;
    const fs::file_status status = fs::symlink_status(entry, error);
    std::set<fs::path>& files = survey.places[folder].names[name];
    if (fs::is_symlink(status)) {
      if (++links > most_links) return;
      const fs::path target = fs::read_symlink(entry, error);
      push_front(parts, target);
      if (target.is_absolute()) folder = "/";
    } else if (parts.empty()) {
      files.insert(told_as);
    } else if (fs::is_directory(status)) {
      folder = entry;
    } else {
      return;
    }
  }
}

void FileWatch::survey_file(Survey& survey, const fs::path& file) {
  struct stat status = {};
  if (stat(file.c_str(), &status) != 0 || S_ISDIR(status.st_mode)) return;
  survey.files[file] = {.device = status.st_dev,
                        .inode = status.st_ino,
                        .size = status.st_size,
                        .seconds = status.st_mtim.tv_sec,
                        .nanoseconds = status.st_mtim.tv_nsec,
                        .mode = status.st_mode};
}

// `above` are the real folders that this one lies in: a link to one of them would be a loop.
void FileWatch::survey_folder(Survey& survey, const fs::path& folder, std::set<fs::path>& above) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (error || !fs::is_directory(real, error) || !above.insert(real).second) return;
  survey.places[real].prefixes.insert(folder);
  for (fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_symlink(ignored)) survey_path(survey, entry->path(), entry->path());
    if (!entry->is_directory(ignored)) {
      survey_file(survey, entry->path());
    } else if (!is_hidden(entry->path())) {
      survey_folder(survey, entry->path(), above);
    }
  }
  above.erase(real);
}

FileWatch::Survey FileWatch::survey() const {
  Survey survey;
  for (const fs::path& file : files_) {
    survey_path(survey, file, file);
    survey_file(survey, file);
  }
  for (const fs::path& folder : folders_) {
    survey_path(survey, folder, folder);
    std::set<fs::path> above;
    survey_folder(survey, folder, above);
  }
  return survey;
}

// Returns whether a folder is watched that was not watched before.
bool FileWatch::watch_places() {
  std::map<int, fs::path> descriptors;
  for (const auto& [folder, place] : known_.places) {
    const bool holds_files = !place.prefixes.empty() ||
                             std::ranges::any_of(place.names, [](const auto& name) { return !name.second.empty(); });
    const std::uint32_t mask = names_change | (holds_files ? texts_change : 0) | IN_DELETE_SELF | IN_MOVE_SELF;
    const int descriptor = inotify_add_watch(inotify_, folder.c_str(), mask | IN_ONLYDIR | IN_EXCL_UNLINK);
    if (descriptor >= 0) {
      descriptors[descriptor] = folder;
    } else if (errno == ENOSPC || errno == ENOMEM) {
      fail("cannot watch {}: the limit of inotify watches is reached (sysctl fs.inotify.max_user_watches)",
           io::quoted(folder));
    }  // else it was removed, or may not be read; files in it may still be accessible by their paths
  }
  bool grown = false;
  for (const auto& [descriptor, folder] : descriptors) {
    const auto before = descriptors_.find(descriptor);
    grown |= before == descriptors_.end() || before->second != folder;
  }
  for (const auto& [descriptor, folder] : descriptors_) {
    if (!descriptors.contains(descriptor)) inotify_rm_watch(inotify_, descriptor);
  }
  descriptors_ = std::move(descriptors);
  return grown;
}

// Lists the files again after the last folder is watched, so that files created between listing and watching are found.
void FileWatch::refresh() {
  do {
    known_ = survey();
  } while (watch_places());
}

std::vector<fs::path> FileWatch::poll(std::chrono::milliseconds timeout) {
  const Clock::time_point end = Clock::now() + timeout;
  throw_fault();
  while (true) {
    Clock::time_point now = Clock::now();
    read_events(now);
    const Clock::time_point due = std::min(last_event_ + idle, first_event_ + longest_wait);
    if (pending_ && now >= due) {
      if (std::vector<fs::path> changes = take_changes(); !changes.empty()) return changes;
      throw_fault();
      now = Clock::now();
    }
    if (now >= end) return {};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>((pending_ ? std::min(due, end) : end) - now);
    pollfd wait = {.fd = inotify_, .events = POLLIN, .revents = 0};
    ::poll(&wait, 1, static_cast<int>(left.count()));
  }
}

void FileWatch::throw_fault() {
  if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
}

void FileWatch::read_events(Clock::time_point now) {
  alignas(inotify_event) std::array<char, 16384> buffer;
  while (true) {
    const ssize_t size = read(inotify_, buffer.data(), buffer.size());
    if (size <= 0) return;
    const bool was_pending = std::exchange(pending_, false);
    for (const char* at = buffer.data(); at < buffer.data() + size;) {
      const auto& event = *reinterpret_cast<const inotify_event*>(at);
      note(event.wd, event.mask, event.len > 0 ? event.name : "");
      at += sizeof(inotify_event) + event.len;
    }
    if (pending_) last_event_ = now;
    if (pending_ && !was_pending) first_event_ = now;
    pending_ |= was_pending;
  }
}

void FileWatch::note(int descriptor, std::uint32_t mask, const char* name) {
  if ((mask & IN_Q_OVERFLOW) != 0) {
    pending_ = lost_ = true;
    return;
  }
  const auto found = descriptors_.find(descriptor);
  if (found == descriptors_.end()) return;
  const auto at = known_.places.find(found->second);
  if (*name == '\0' || at == known_.places.end()) {  // the folder itself is gone or was moved
    pending_ = true;
    return;
  }
  const Place& place = at->second;
  for (const fs::path& prefix : place.prefixes) touched_.insert(prefix / name);
  const auto single = place.names.find(name);
  if (single != place.names.end()) touched_.insert(single->second.begin(), single->second.end());
  pending_ |= !place.prefixes.empty() || single != place.names.end();
}

// Files with events, and files whose stamps differ: there are no events for the files in a folder that was moved or
// removed as a whole. A file that was created and removed again in between, as editors do, is not a change.
std::vector<fs::path> FileWatch::take_changes() {
  pending_ = false;
  const bool all = std::exchange(lost_, false);
  const std::set<fs::path> touched = std::exchange(touched_, {});
  const std::map<fs::path, Stamp> before = known_.files;
  try {
    refresh();
  } catch (...) {
    fault_ = std::current_exception();
  }
  std::set<fs::path> changes;
  for (const auto& [file, stamp] : before) {
    const auto now = known_.files.find(file);
    if (all || touched.contains(file) || now == known_.files.end() || now->second != stamp) changes.insert(file);
  }
  for (const auto& [file, stamp] : known_.files) {
    if (!before.contains(file)) changes.insert(file);
  }
  return {changes.begin(), changes.end()};
}

}  // namespace penumbra::session
