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

}  // namespace penumbra::viewer
