#include <CLI/CLI.hpp>
#include <string>

#include "app/commands.h"
#include "app/doctor/backend_probe.h"
#include "core/error.h"
#include "gl/context.h"
#include "io/report.h"

namespace penumbra::app {

namespace {

using io::Json;

constexpr const char* advice =
    "No backend gives an OpenGL 4.5 core context here. On a machine without a GPU install Mesa's software rasteriser "
    "(Debian: apt install libegl1 libgl1-mesa-dri libosmesa6); on one with a GPU install its driver with EGL.";

Json examine() {
  Json backends = Json::array();
  for (const char* name : {"egl", "osmesa", "window"}) backends.push_back(probe_backend(name));
  Json devices = Json::array();
  for (const std::string& device : probe_egl_devices()) devices.push_back(device);
  return io::document("doctor", 1, {{"version", cli::version()}, {"backends", backends}, {"egl_devices", devices}});
}

bool works(const Json& backend) { return backend["works"].get<bool>(); }

bool any_works(const Json& report) {
  for (const Json& backend : report["backends"]) {
    if (works(backend)) return true;
  }
  return false;
}

void print_backend(const Json& backend) {
  const std::string name = backend["name"];
  if (!works(backend)) {
    fmt::print("{:<8} does not work: {}\n", name, backend["fault"].get<std::string>());
    return;
  }
  const Json& device = backend["device"];
  fmt::print("{:<8} works, {}\n", name, device["software"].get<bool>() ? "in software" : "on a GPU");
  for (const char* field : {"vendor", "renderer", "version", "glsl_version"})
    fmt::print("  {:<14} {}\n", field, device[field].get<std::string>());
}

// One table for all: backends of one driver have the same limits.
void print_limits(const Json& report) {
  for (const Json& backend : report["backends"]) {
    if (!works(backend)) continue;
    fmt::print("\nlimits of {}\n", backend["name"].get<std::string>());
    for (const auto& [name, value] : backend["device"]["limits"].items())
      fmt::print("  {:<44} {}\n", name, value.get<long long>());
    return;
  }
}

void print_report(const Json& report) {
  fmt::print("{}\n\n", report["version"].get<std::string>());
  for (const Json& backend : report["backends"]) print_backend(backend);
  const Json& devices = report["egl_devices"];
  if (!devices.empty()) fmt::print("\nEGL devices (--egl-device)\n");
  for (size_t i = 0; i < devices.size(); ++i) fmt::print("  {:<14} {}\n", i, devices[i].get<std::string>());
  print_limits(report);
}

}  // namespace

int run_doctor(const Arguments& arguments) {
  CLI::App app("Print which OpenGL backends work here", "penumbra doctor");
  bool json = false;
  app.add_flag("--json", json, "Print JSON")->disable_flag_override();
  if (!cli::parse(app, arguments)) return 0;
  const Json report = examine();
  if (json) {
    fmt::print("{}", io::text_of(report));
  } else {
    print_report(report);
  }
  if (any_works(report)) return 0;
  fail("{}", advice);
}

}  // namespace penumbra::app
