#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/log.h"
#include "scene/gltf.h"

namespace penumbra::test {

// A folder for one test's files; the destructor removes it.
class ScratchFolder {
 public:
  ScratchFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("penumbra_") + test->test_suite_name() + test->name() + std::to_string(getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_ / "scene");
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  // `name` is relative to the scene's folder.
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    auto file = path_ / "scene" / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
    return file;
  }
  std::filesystem::path scene() const { return path_ / "scene"; }

 private:
  std::filesystem::path path_;
};

inline std::string base64(const std::string& bytes) {
  static const char* const alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

inline std::string data_uri(const std::string& bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// Builds a glTF: data becomes one buffer, with a bufferView and an accessor for each call of add().
class GltfBuilder {
 public:
  // Returns the accessor's index. `more`: further members of the accessor, as JSON.
  template <class T>
  int add(const std::vector<T>& values, const std::string& type, int components, const std::string& more = "") {
    const int component_type = code(values.data());
    const std::size_t offset = buffer_.size();
    buffer_ += bytes_of(values);
    views_ += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}}})", comma(views_), offset,
                          values.size() * sizeof(T));
    accessors_ += fmt::format(
        R"({}{{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}{}}})", comma(accessors_), count_,
        component_type, values.size() / static_cast<std::size_t>(components), type, more.empty() ? "" : ",", more);
    while (buffer_.size() % 4 != 0) buffer_ += '\0';
    return count_++;
  }

  // `rest`: all other members of the document, as JSON.
  std::string text(const std::string& rest) const {
    return fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"{}"}}],)"
                       R"("bufferViews":[{}],"accessors":[{}],{}}})",
                       buffer_.size(), data_uri(buffer_), views_, accessors_, rest);
  }

 private:
  static const char* comma(const std::string& list) { return list.empty() ? "" : ","; }
  static int code(const int8_t*) { return 5120; }
  static int code(const uint8_t*) { return 5121; }
  static int code(const int16_t*) { return 5122; }
  static int code(const uint16_t*) { return 5123; }
  static int code(const uint32_t*) { return 5125; }
  static int code(const float*) { return 5126; }

  std::string buffer_, views_, accessors_;
  int count_ = 0;
};

// One mesh drawn by one node.
inline std::string one_mesh(const std::string& primitive, const std::string& more = "") {
  return R"("meshes":[{"primitives":[)" + primitive + R"(]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])" +
         (more.empty() ? "" : ",") + more;
}

inline scene::Image no_image(std::span<const std::byte>, const std::string& name) { fail("no decoder for {}", name); }

// Replaces a decoder in tests that do not need the pixels.
inline scene::Image any_image(std::span<const std::byte>, const std::string& name) {
  return {.name = name, .width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
}

inline scene::Scene load_text(const std::string& text, const scene::ReadLimits& limits = {}) {
  const ScratchFolder folder;
  return scene::read_gltf(folder.write("scene.gltf", text), any_image, {.limits = limits});
}

// The warnings that `action` logs.
inline std::vector<std::string> warnings_of(const std::function<void()>& action) {
  std::vector<std::string> warnings;
  set_log_sink([&](LogLevel level, std::string_view message) {
    if (level == LogLevel::warning) warnings.emplace_back(message);
  });
  action();
  set_log_sink({});
  return warnings;
}

// The message of the Error that `action` throws; empty when it throws none.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

}  // namespace penumbra::test
