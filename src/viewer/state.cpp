#include "viewer/state.h"

#include "truth/reference.h"

namespace penumbra::viewer {

void UiState::compare(bool on) {
  comparison.on = on;
  if (!on || !comparison.params.rows().empty()) return;
  comparison.params = document.params;
  if (playback.playing || document.params.get_word("technique") == "truth") return;
  comparison.params.set("technique", std::string("truth"));
  truth::make_reference(comparison.params);
}

Document UiState::document_b() const {
  Document b = document;
  b.params = comparison.params;
  for (const Param& row : b.params.rows()) {
    const bool shared =
        truth::is_of_scene(row.name) || row.name.starts_with("exposure.") || row.name.starts_with("render.");
    if (shared) b.params.set(row.name, document.params.value(row.name));
  }
  return b;
}

}  // namespace penumbra::viewer
