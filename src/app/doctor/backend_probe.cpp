#include "app/doctor/backend_probe.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <functional>

#include "core/error.h"
#include "gl/context.h"

namespace penumbra::app {

namespace {

using io::Json;

constexpr std::chrono::seconds patience(20);

// Everything that the child writes, until it closes the pipe or the time limit is reached.
bool read_all(int pipe, std::string& text) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd waiting{pipe, POLLIN, 0};
    if (left.count() <= 0 || poll(&waiting, 1, static_cast<int>(left.count())) == 0) return false;
    char buffer[4096];
    const ssize_t count = read(pipe, buffer, sizeof buffer);
    if (count == 0) return true;
    if (count > 0) text.append(buffer, static_cast<size_t>(count));
  }
}

void write_all(int pipe, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t count = write(pipe, text.data() + done, text.size() - done);
    if (count < 0) return;
    done += static_cast<size_t>(count);
  }
}

[[noreturn]] void run_child(int pipe, const std::function<Json()>& work) {
  // Keeps the driver's messages on stderr out of the report.
  if (std::freopen("/dev/null", "w", stderr) == nullptr) std::fclose(stderr);
  Json result;
  try {
    result = {{"result", work()}};
  } catch (const std::exception& error) {
    result = {{"fault", error.what()}};
  }
  write_all(pipe, io::text_of(result));
  _exit(0);
}

std::string ending(int status) {
  if (WIFSIGNALED(status)) return fmt::format("the driver crashed ({})", strsignal(WTERMSIG(status)));
  return fmt::format("the driver ended the process (exit code {})", WEXITSTATUS(status));
}

// {"result": …} or {"fault": "…"}.
Json in_child(const std::function<Json()>& work) {
  int ends[2];
  if (pipe(ends) != 0) fail("cannot make a pipe: {}", std::strerror(errno));
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) fail("cannot start a process: {}", std::strerror(errno));
  if (child == 0) {
    close(ends[0]);
    run_child(ends[1], work);
  }
  close(ends[1]);
  std::string text;
  const bool ended = read_all(ends[0], text);
  close(ends[0]);
  if (!ended) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (!ended) return {{"fault", fmt::format("no answer in {} s", patience.count())}};
  Json result = Json::parse(text, nullptr, /* allow_exceptions= */ false);
  if (!result.is_object()) return {{"fault", ending(status)}};
  return result;
}

}  // namespace

Json probe_backend(const std::string& name) {
  Json answer = in_child([&name] {
    gl::ContextOptions options;
    options.visible = false;
    const auto context = gl::make_context(name, options);
    return io::to_json(gl::device_info());
  });
  if (answer.contains("fault")) {
    std::string fault = answer["fault"];
    if (fault.starts_with(name + ": ")) fault.erase(0, name.size() + 2);
    return {{"name", name}, {"works", false}, {"fault", fault}};
  }
  return {{"name", name}, {"works", true}, {"device", answer["result"]}};
}

std::vector<std::string> probe_egl_devices() {
  const Json answer = in_child([] { return Json(gl::egl_devices()); });
  return answer.contains("result") ? answer["result"].get<std::vector<std::string>>() : std::vector<std::string>{};
}

}  // namespace penumbra::app
