#pragma once

#include "cli/encoded_file.h"
#include "cli/output_names.h"
#include "cli/usage.h"
#include "image/write.h"
#include "truth/technique.h"

namespace penumbra::app {

// The file of a traced frame: an EXR with the layers shadow, standard_error, hard and receiver, or a PNG of the shadow
// alone. Throws Error.
cli::EncodedFile encoded_picture(const cli::OutputNames& names, int frame, const cli::Size& size,
                                 const truth::TruthTechnique::Last& last, const image::Metadata& metadata);

}  // namespace penumbra::app
