#include "studio/scene_files.h"

#include "io/output_file.h"
#include "studio/usage.h"

namespace penumbra::studio {

void check_spared(const std::vector<std::filesystem::path>& scene_files, std::string_view option,
                  const std::filesystem::path& result) {
  for (const std::filesystem::path& file : scene_files) {
    if (io::would_replace(result, file)) fail_usage("{} would overwrite the scene's file {}", option, io::quoted(file));
  }
}

}  // namespace penumbra::studio
