#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "params.h"

namespace penumbra {

constexpr std::size_t largest_preset = 1 << 20;  // bytes; a preset of every parameter is a few kilobytes

// Selects a technique or a preset by name; throws Error when there is none of that name.
using SelectTechnique = std::function<void(ParamSet&, std::string_view name)>;
// Whether what a preset says of a parameter is left out.
using IsLeftOut = std::function<bool(std::string_view name)>;

// Applies the text of a preset to `params`; parameters that it doesn't mention keep their values. A preset is TOML:
// `technique = "pcss"` at the top, then parameters by name, as tables ([pcss], filter_taps = 16) or dotted keys. The
// technique is selected first, so that a preset's own values override those of a named one. Throws Error: "file:line:
// fault", with `file` as what messages call the text; `params` is then unchanged.
void apply_preset(std::string_view text, const std::string& file, ParamSet& params, const SelectTechnique& select,
                  const IsLeftOut& left_out = {});

// The text of a preset that apply_preset() turns default parameters into `params` with: the technique and every changed
// value.
std::string preset_text(const ParamSet& params);

}  // namespace penumbra
