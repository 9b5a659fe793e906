#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

namespace penumbra::viewer {

// The states that Undo and Redo go through. It watches the present state frame by frame, so that nothing that changes
// it has to report a step. `State` needs ==; where two states are equal the later one is kept.
template <class State>
class History {
 public:
  static constexpr std::size_t most = 200;  // steps back; the oldest ones are forgotten

  // Forgets all steps: what was changed no longer exists.
  void start(State now) {
    past_.clear();
    future_.clear();
    present_ = std::move(now);
  }

  // Takes a frame's state. All that changes while the user holds a widget, a button or a key is one step.
  void note(const State& now, bool held) {
    if (!present_) return start(now);
    if (now != *present_) {
      if (held) return;
      future_.clear();
      past_.push_back(std::move(*present_));
      if (past_.size() > most) past_.pop_front();
    }
    present_ = now;
  }

  // Takes a state that differs from the present one by no step of the user's.
  void amend(const State& now) { present_ = now; }

  bool can_undo() const { return !past_.empty(); }
  bool can_redo() const { return !future_.empty(); }
  // The state before the last step or after the next one, which note() then expects; nothing if there is none. `now`
  // is the present one: a change that is still held ends as a step first.
  std::optional<State> undo(const State& now) { return step(now, past_, future_); }
  std::optional<State> redo(const State& now) { return step(now, future_, past_); }

 private:
  std::optional<State> step(const State& now, std::deque<State>& from, std::deque<State>& to) {
    note(now, /* held= */ false);
    if (from.empty()) return {};
    to.push_back(std::exchange(*present_, std::move(from.back())));
    from.pop_back();
    return present_;
  }

  std::optional<State> present_;
  std::deque<State> past_, future_;  // the nearest one last
};

}  // namespace penumbra::viewer
