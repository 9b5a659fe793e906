#include "image/image_library.h"

#include <filesystem>
#include <vector>

#include "core/error.h"
#include "gl/shared_library.h"
#include "image/module_folder.h"
#include "io/program_path.h"

namespace penumbra::image {

namespace {

namespace fs = std::filesystem;

constexpr const char* module_file = "penumbra_openimageio.so";

std::vector<fs::path>& more_folders() {
  static std::vector<fs::path> folders;
  return folders;
}

// Next to the program, as it is built; above a test's folder; or where it is installed.
std::string module_path() {
  std::error_code fault;
  const fs::path folder = io::program_path(fault).parent_path();
  if (fault)
    fail("JPEG and EXR need {}, which lies beside the program; where that is can't be told: {}", module_file,
         fault.message());
  std::vector<fs::path> places{folder, folder / "..", folder / PENUMBRA_MODULE_FOLDER};
  places.insert(places.end(), more_folders().begin(), more_folders().end());
  for (const fs::path& place : places) {
    const fs::path path = place / module_file;
    if (fs::exists(path, fault)) return path.lexically_normal().string();
  }
  fail("JPEG and EXR need {}, which is missing from {}", module_file,
       (folder / PENUMBRA_MODULE_FOLDER).lexically_normal().string());
}

const ImageLibrary& load() {
  const gl::SharedLibrary module("JPEG and EXR", {module_path().c_str()});  // is never unloaded
  const ImageLibrary* (*library)() = nullptr;
  module.require(library, "penumbra_image_library");
  return *library();
}

}  // namespace

void add_module_folder(const fs::path& folder) { more_folders().push_back(folder); }

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load();
  return library;
}

}  // namespace penumbra::image
