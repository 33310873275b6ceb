#include "viewer/undo_history.h"

namespace vasa::viewer {
namespace {

constexpr std::size_t kMostSteps = 1000;  // some kB each

}  // namespace

// A joint whose sliders are shown but not moved is not posed.
Undoable UndoHistory::kept(const ViewState& state) {
  Undoable value = state;
  std::erase_if(value.turns, [](const JointTurn& turn) { return !turn.any(); });
  return value;
}

void UndoHistory::start(const ViewState& state) {
  saved_ = kept(state);
  steps_ = {saved_};
  at_ = 0;
}

void UndoHistory::watch(const ViewState& state, bool held) {
  if (held) return;
  Undoable now = kept(state);
  if (now == steps_[at_]) return;
  steps_.resize(at_ + 1);
  steps_.push_back(std::move(now));
  if (steps_.size() > kMostSteps) steps_.erase(steps_.begin());
  at_ = steps_.size() - 1;
}

void UndoHistory::go(ViewState& state, std::size_t to) {
  at_ = to;
  static_cast<Undoable&>(state) = steps_[at_];
}

bool UndoHistory::undo(ViewState& state) {
  watch(state, false);
  if (!canUndo()) return false;
  go(state, at_ - 1);
  return true;
}

bool UndoHistory::redo(ViewState& state) {
  watch(state, false);
  if (!canRedo()) return false;
  go(state, at_ + 1);
  return true;
}

bool UndoHistory::unsaved(const ViewState& state) const {
  const Undoable now = kept(state);
  return now.journal != saved_.journal || now.turns != saved_.turns || now.hidden != saved_.hidden ||
         now.labelled != saved_.labelled || now.views != saved_.views;
}

}  // namespace vasa::viewer
