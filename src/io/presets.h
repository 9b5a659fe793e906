#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/params.h"

namespace penumbra::io {

// Selects a technique or a preset by name; throws Error when there is none of that name.
using SelectTechnique = std::function<void(ParamSet&, std::string_view name)>;

// Sets `params` to what a preset file says; what the file doesn't mention stays. A preset is TOML: `technique = "pcss"`
// at the top, then parameters by name, as tables ([pcss], filter_taps = 16) or dotted keys. The technique is selected
// first, so that a file's own values win over a named preset's. Throws Error: "file:line: fault"; then `params` is
// unchanged.
void read_preset(const std::filesystem::path& path, ParamSet& params, const SelectTechnique& select);

// The preset that read_preset() turns defaults into `params` with: the technique and every changed value.
std::string preset_text(const ParamSet& params);
void write_preset(const std::filesystem::path& path, const ParamSet& params);

}  // namespace penumbra::io
