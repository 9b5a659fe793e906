#include "viewer/render_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace penumbra::viewer {

namespace {

constexpr const char* this_program = "/proc/self/exe";
constexpr std::size_t most_output = 64 * 1024;

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t before = text.rfind('\n');
  return before == std::string::npos ? text : text.substr(before + 1);
}

// Starts `arguments` with both outputs in `output`; the process, or -1 with errno's value in `fault`.
int spawn(std::vector<std::string> arguments, int output, int& fault) {
  std::string name = "penumbra";
  std::vector<char*> words{name.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  // The viewer ends it by SIGTERM, also where the viewer itself was started with that signal ignored.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t as_usual;
  sigemptyset(&as_usual);
  sigaddset(&as_usual, SIGTERM);
  posix_spawnattr_setsigdefault(&attributes, &as_usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = -1;
  fault = posix_spawn(&process, this_program, &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return fault == 0 ? process : -1;
}

}  // namespace

RenderProcess::~RenderProcess() {
  if (runs()) {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }
  if (output_ >= 0) close(output_);
}

void RenderProcess::start(const std::vector<std::string>& arguments, std::vector<std::filesystem::path> files) {
  if (runs()) fail("another picture is still being written");
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("penumbra render: {}", std::strerror(errno));
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  int fault = 0;
  process_ = spawn(arguments, ends[1], fault);
  close(ends[1]);
  if (process_ < 0) {
    close(ends[0]);
    fail("penumbra render: {}", std::strerror(fault));
  }
  output_ = ends[0];
  stopped_ = false;
  text_.clear();
  files_ = std::move(files);
  written_ = 0;
  started_ = std::filesystem::file_time_type::clock::now();
}

void RenderProcess::stop() {
  if (!runs()) return;
  kill(process_, SIGTERM);
  stopped_ = true;
}

double RenderProcess::progress() {
  const auto is_written = [this](const std::filesystem::path& file) {
    std::error_code missing;
    const auto time = std::filesystem::last_write_time(file, missing);
    return !missing && time >= started_;
  };
  while (written_ < files_.size() && is_written(files_[written_])) ++written_;
  return files_.empty() ? 0.0 : static_cast<double>(written_) / static_cast<double>(files_.size());
}

void RenderProcess::read_output() {
  std::array<char, 4096> block{};
  for (ssize_t count = 0; (count = read(output_, block.data(), block.size())) > 0;) {
    text_.append(block.data(), static_cast<std::size_t>(count));
    if (text_.size() > most_output) text_.erase(0, text_.size() - most_output);
  }
}

std::optional<RenderProcess::Result> RenderProcess::finished() {
  if (!runs()) return {};
  read_output();
  int status = 0;
  if (waitpid(process_, &status, WNOHANG) == 0) return {};
  read_output();
  close(std::exchange(output_, -1));
  process_ = -1;
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (stopped_ && !good) return Result{.good = true, .text = "stopped writing"};
  if (WIFSIGNALED(status))
    return Result{.good = false, .text = fmt::format("penumbra render: signal {}", WTERMSIG(status))};
  return Result{.good = good, .text = last_line(text_)};
}

}  // namespace penumbra::viewer
