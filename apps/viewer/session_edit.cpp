#include <algorithm>
#include <utility>

#include "edit/replay.h"
#include "viewer/session.h"
#include "viewer/undo_name.h"

// How a session goes from one document to the next: by the journal in its state, whoever wrote it there, an
// edit or undoing one.
namespace vasa::viewer {
namespace {

constexpr double kScrollEnds = 0.3;  // [s] steps of the wheel that follow one another are one

// The same place on the edited vessel of this name, where there is one.
std::optional<VesselPlace> carriedOver(const std::optional<VesselPlace>& place, const Network& before,
                                       const Network& after) {
  if (!place) return std::nullopt;
  const std::string& name = before.vessel(place->vessel).name;
  const auto found = std::ranges::find(after.vessels(), name, &Vessel::name);
  if (found == after.vessels().end()) return std::nullopt;
  return placeAt(after, {std::uint32_t(found - after.vessels().begin())}, shareOf(before, *place));
}

}  // namespace

// Back and on through what was done; what was done in this frame becomes a step.
void Session::travel() {
  if (!document_) return;
  for (const bool tree : {false, true})
    if (std::exchange(tree ? state_.wishDeleteTree : state_.wishDelete, false) && state_.editing)
      editor_.remove(tree, *document_, state_);
  if (state_.wishUndo && editor_.dropPassed(*document_, state_)) {
    state_.wishUndo = false;
    panelFrames_ = kRestingFrames;
  }
  const bool undo = std::exchange(state_.wishUndo, false), redo = std::exchange(state_.wishRedo, false);
  // Where the camera begins is no step, nor an edit that may yet be refused.
  const bool held = state_.wishHome || state_.wishFocus || pointer_.dragging() || poseTool_.held() ||
                    editor_.held() || ui_.isHeld() || now_ - scrolledAt_ < kScrollEnds ||
                    state_.journal != document_->journal;
  if (beginning_) {
    history_.start(state_);
    nameSteps();
    return;
  }
  if (undo || redo) {
    const bool gone = undo ? history_.undo(state_) : history_.redo(state_);
    if (!gone) say(undo ? "Nothing to undo" : "Nothing to redo");
    editor_.refusal.clear();
  } else {
    history_.watch(state_, held);
  }
  nameSteps();
  entitle();
}

void Session::nameSteps() {
  const Mannequin& mannequin = *document_->mannequin;
  const Undoable &now = history_.now(), *before = history_.before(), *after = history_.after();
  std::string undone = before ? undoName(*before, now, mannequin) : "",
              redone = after ? undoName(now, *after, mannequin) : "";
  if (undone == state_.undone && redone == state_.redone) return;
  state_.undone = std::move(undone), state_.redone = std::move(redone);
  panelFrames_ = kRestingFrames;
}

// One document at a time: what is coming is seen before the next is made.
void Session::reshape() {
  if (!document_ || !body_) return;
  const bool live = editor_.held() || ui_.isHeld();
  if (!coming_ && (state_.journal != wanted_ || (wantedLive_ && !live))) {
    wanted_ = state_.journal;
    wantedLive_ = live;
    reshaper_.want({document_, wanted_, live});
  }
  if (steady()) reshaper_.wait();
  if (coming_) return;
  auto outcome = reshaper_.take();
  if (!outcome || outcome->wish.document->base != document_->base) return;  // of what was shown before
  if (outcome->made) {
    editor_.refusal.clear();
    coming_ = std::move(*outcome->made);
    editedAt_ = outcome->wish.since;
    return;
  }
  editor_.refusal = outcome->made.error().message;
  panelFrames_ = kRestingFrames;
  if (live || outcome->wish.journal != state_.journal) return;
  // One that a drag made is made anew as it stays, unless that is what was refused.
  wantedLive_ = document_->live && outcome->wish.journal != document_->journal;
  state_.journal = wanted_ = document_->journal;
}

void Session::changeTo(std::shared_ptr<const Document> edited) {
  const Network& before = document_->scene.network;
  const Network& after = edited->scene.network;
  for (auto* place : {&state_.selected, &state_.from, &state_.to})
    *place = carriedOver(*place, before, after);
  std::vector<VesselId> also;
  for (const VesselId vessel : state_.alsoChosen)
    if (const auto there = carriedOver(VesselPlace{vessel, 0}, before, after)) also.push_back(there->vessel);
  state_.alsoChosen = std::move(also);
  state_.pointedAt.reset();
  if (!state_.selected) state_.isolate = false;
  document_ = std::move(edited);
  profiler_.reset();
  profiling_ = false;
  panelFrames_ = kRestingFrames;
}

void Session::noteEdit() {
  if (coming_ || !editedAt_ || !shown_ || shown_->body->order.document != document_) return;
  timings_.addEdit(std::chrono::duration<double, std::milli>(Clock::now() - *editedAt_).count());
  editedAt_.reset();
}

void Session::entitle() {
  if (!document_) return;
  std::string title = (history_.unsaved(state_) ? "* " : "") + document_->title + " - vasa";
  if (title != title_) window_.setTitle(title_ = std::move(title));
}

// A script saves no scene elsewhere than its pictures, not even the one that it opened; the journal goes
// beside it.
Result<void> Session::mayWrite(const std::filesystem::path& scene) const {
  if (!options_.script) return {};
  for (const auto& file : {scene, ownJournal(scene)})
    if (const auto place = placeBelow(options_.out, std::filesystem::absolute(file)); !place)
      return place.error();
  return {};
}

void Session::saveScene(const std::filesystem::path& as) {
  if (!document_) return;
  if (const auto& scene = as.empty() ? keeper_.path() : as; !scene.empty())
    if (const auto allowed = mayWrite(scene); !allowed) {
      failure_ = allowed.error();
      return;
    }
  if (state_.journal != document_->journal) return say("An edit is still being made; save again in a moment");
  const auto written = keeper_.save(*document_, state_, freeName(options_.out, "json"), as);
  if (!written) {
    if (options_.script) failure_ = written.error();
    state_.failure = written.error().message;
    return say(written.error().message, 8);
  }
  remember({*written});
  history_.markSaved(state_);
  entitle();
  report_.files.push_back(*written);
  say("wrote " + written->string());
}

}  // namespace vasa::viewer
