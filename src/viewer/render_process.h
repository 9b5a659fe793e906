#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace penumbra::viewer {

// Runs `penumbra render` in a separate process: the window stays responsive, and the files are those that the same
// command writes in a shell.
class RenderProcess {
 public:
  RenderProcess() = default;
  ~RenderProcess();  // ends the process, which removes unfinished files
  RenderProcess(const RenderProcess&) = delete;
  RenderProcess& operator=(const RenderProcess&) = delete;

  // `arguments` begin with "render"; `files` are what it will write, in that order. Throws Error where no process can
  // be started.
  void start(const std::vector<std::string>& arguments, std::vector<std::filesystem::path> files);
  bool runs() const { return process_ > 0; }
  // Asks it to end; finished() says so once it has.
  void stop();
  // The share of the files that are written.
  double progress();

  struct Result {
    bool good = false;
    std::string text;  // the last line of its output
  };
  // The result, once it has ended. Never waits.
  std::optional<Result> finished();

 private:
  void read_output();

  int process_ = -1, output_ = -1;
  bool stopped_ = false;
  std::string text_;
  std::vector<std::filesystem::path> files_;
  std::size_t written_ = 0;  // of them, in order
  std::filesystem::file_time_type started_;
};

}  // namespace penumbra::viewer
