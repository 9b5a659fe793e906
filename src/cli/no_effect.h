#pragma once

#include <span>
#include <string>

#include "cli/options.h"
#include "core/params.h"
#include "shadow/registry.h"

namespace penumbra::cli {

// Why a parameter can't change what is drawn with these values: "history.reuse is false". Empty if it may.
std::string why_without_effect(const std::string& name, const ParamSet& params, const shadow::Registry& registry);

// Warns of each parameter that the user sets by --set or --sun-angle although it changes no picture that is drawn with
// any of these values.
void warn_without_effect(const ShadowOptions& options, std::span<const ParamSet> drawn,
                         const shadow::Registry& registry);
// The same for assignments "NAME=VALUE".
void warn_without_effect(std::span<const std::string> assignments, std::span<const ParamSet> drawn,
                         const shadow::Registry& registry);

// Warns of --fps where a single picture is drawn.
void warn_of_rate(const SceneOptions& options);

// The kinds of light that shine on a scene.
struct LightKinds {
  bool sun = true, lamps = true;
};

// Warns of each parameter that the user sets, and of --lamp-radius, although no light shines that it belongs to.
void warn_without_lights(const SceneOptions& scene, const ShadowOptions& shadows, const LightKinds& shining);

}  // namespace penumbra::cli
