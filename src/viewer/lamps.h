#pragma once

#include <string>
#include <vector>

#include "viewer/panels.h"

namespace penumbra::viewer {

// A spot or point lamp that shines.
struct ShownLamp {
  LampName name;
  render::LampLight light;
};

// Those of the file, as they stand at the document's time, and those of the user.
std::vector<ShownLamp> shown_lamps(const Panel& panel);

// "light 2", "lamp 0": of widgets.
std::string text_of(const LampName& name);

// Changes a lamp of the user. A lamp of the file is first replaced by one of the user, which no longer follows the
// file's animation. Returns the name that it has from then on.
LampName change_lamp(const Panel& panel, const LampName& name, const render::LampLight& light);

// Turns a light of the file on or off in the options, by index, since names may be equal or contain a comma. All of
// them are the same as no choice.
void choose_light(cli::SceneOptions& options, std::size_t index, bool on, const std::vector<std::string>& names);
bool is_chosen(const cli::SceneOptions& options, std::size_t index, const std::vector<std::string>& names);

// A number that no lamp of the user has.
int free_number(const std::vector<render::LampLight>& lamps);

}  // namespace penumbra::viewer
