#include "io/presets.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "io/output_file.h"

namespace penumbra::io {

namespace {

std::string read_text(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) fail("cannot read preset {}: it is a folder", quoted(path));
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("cannot read preset {}: {}", quoted(path), std::strerror(errno));
  std::string text(largest_preset + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  const auto length = static_cast<std::size_t>(stream.gcount());
  if (length > largest_preset) fail("cannot read preset {}: it is larger than 1 MiB", quoted(path));
  text.resize(length);
  return text;
}

}  // namespace

void read_preset(const std::filesystem::path& path, ParamSet& params, const SelectTechnique& select) {
  apply_preset(read_text(path), path.string(), params, select);
}

void write_preset(const std::filesystem::path& path, const ParamSet& params) { write_text(path, preset_text(params)); }

}  // namespace penumbra::io
