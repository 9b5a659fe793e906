#include "manual/settings.h"

#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra::manual {

std::vector<Setting> settings() {
  std::vector<Setting> result;
  for (const Param& param : render::Renderer::params(session::all_techniques())) {
    Setting setting{.name = param.name, .help = param.help, .values = param.choices};
    if (std::holds_alternative<bool>(param.default_value)) setting.values = {"on", "off"};
    if (setting.values.empty()) setting.values = {to_text(param.default_value)};
    result.push_back(std::move(setting));
  }
  return result;
}

}  // namespace penumbra::manual
