#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/params.h"

namespace penumbra::io {

// Selects a technique or a preset by name; throws Error when there is none of that name.
using SelectTechnique = std::function<void(ParamSet&, std::string_view name)>;

// Applies a preset file to `params`; parameters that the file doesn't mention keep their values. A preset is TOML:
// `technique = "pcss"` at the top, then parameters by name, as tables ([pcss], filter_taps = 16) or dotted keys. The
// technique is selected first, so that a file's own values override those of a named preset. Throws Error: "file:line:
// fault"; `params` is then unchanged.
void read_preset(const std::filesystem::path& path, ParamSet& params, const SelectTechnique& select);

// The text of a preset that read_preset() turns default parameters into `params` with: the technique and every changed
// value.
std::string preset_text(const ParamSet& params);
void write_preset(const std::filesystem::path& path, const ParamSet& params);

}  // namespace penumbra::io
