#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "cli/encoded_file.h"
#include "cli/output_names.h"
#include "cli/usage.h"
#include "image/write.h"
#include "truth/technique.h"

namespace penumbra::app {

// The files of a frame that was traced for that many lights: one EXR with the layers shadow, standard_error, hard and
// receiver of each light, or a PNG of the shadow for each.
std::vector<std::filesystem::path> picture_files(const cli::OutputNames& names, int frame, std::size_t lights);

// These files, of the last frame. Throws Error.
std::vector<cli::EncodedFile> encoded_pictures(const cli::OutputNames& names, int frame, const cli::Size& size,
                                               const truth::TruthTechnique& truth, std::size_t lights,
                                               const image::Metadata& metadata);

}  // namespace penumbra::app
