#pragma once
#include <vector>

#include "viewer/view_state.h"

namespace vasa::viewer {

/// Undo and redo of whatever Undoable holds: a row of its values, and where in it one is. It is told the
/// state once a frame and finds out itself what has changed, so that nothing that changes a state knows of
/// it.
class UndoHistory {
 public:
  /// A new beginning, which counts as saved.
  void start(const ViewState& state);
  /// @param held  something is being dragged or typed: what changes until it is let go is one step
  void watch(const ViewState& state, bool held);
  /// What has not become a step yet becomes one first. False: there is nothing to go back, or on, to.
  bool undo(ViewState& state);
  bool redo(ViewState& state);
  bool canUndo() const { return at_ > 0; }
  bool canRedo() const { return at_ + 1 < steps_.size(); }

  /// Where one is, and the steps to either side; null where there is none.
  const Undoable& now() const { return steps_[at_]; }
  const Undoable* before() const { return canUndo() ? &steps_[at_ - 1] : nullptr; }
  const Undoable* after() const { return canRedo() ? &steps_[at_ + 1] : nullptr; }

  void markSaved(const ViewState& state) { saved_ = kept(state); }
  /// Whether edits, the pose, what is hidden or labelled, or kept views are others than those that were
  /// saved: looks are quickly made again.
  bool unsaved(const ViewState& state) const;

 private:
  static Undoable kept(const ViewState& state);
  void go(ViewState& state, std::size_t to);

  std::vector<Undoable> steps_{Undoable{}};
  std::size_t at_ = 0;
  Undoable saved_;
};

}  // namespace vasa::viewer
