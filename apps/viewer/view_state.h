#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "atlas/colouring.h"
#include "body/joint_motion.h"
#include "network/route.h"
#include "render/look.h"
#include "scene/scene_file.h"
#include "viewer/cut_plane.h"
#include "viewer/export_wish.h"
#include "viewer/forces.h"
#include "viewer/orbit.h"
#include "viewer/outliner.h"
#include "viewer/playback.h"
#include "viewer/vessel_names.h"

namespace vasa::viewer {

/// How finely the picture is drawn.
struct Detail {
  bool automatic = true;
  int around = 8, along = 5;  ///< quads, where not automatic
  int capillaries = 0;        ///< generations
  bool operator==(const Detail&) const = default;
};

/// What a click in the picture does while a vessel is edited.
enum class EditTool : std::uint8_t { change, branch, graft };

/// What a context menu is about: a vessel (the chosen one), a joint, or neither.
struct ContextTarget {
  bool vessel = false;
  JointId joint;
  bool opens = false;  ///< with the next picture
};

/// What waits for an answer because something is not saved, or is still being written.
enum class Waiting : std::uint8_t { nothing, quit, open };

/// What undoing brings back (undo_history.h); small, by value.
struct Undoable {
  std::string preset = "atlas";
  Look look = *lookNamed("atlas");
  Detail detail;
  bool fineStills = true;  ///< what stands still is drawn anew with 4 samples a pixel and occlusion
  Forces forces;
  Orbit orbit;    ///< beside a body that has not walked: Session adds the way
  float cut = 0;  ///< Orbit::camera()
  CutPlane cutPlane;
  bool follow = true;     ///< the camera goes along with a body that walks
  bool contacts = false;  ///< vessels grey, those that touch in colour
  atlas::Colouring colouring = atlas::Colouring::kind;
  bool legend = false;            ///< what the colours mean, in the picture
  VesselNames hidden, labelled;   ///< not shown; named in the picture also when they are not chosen
  std::vector<ViewChoice> views;  ///< kept under numbers
  std::vector<JointTurn> turns;
  std::vector<std::string> journal;  ///< lines of edits (edit/journal.h), on top of those of other files

  bool operator==(const Undoable&) const = default;
};

/// Everything a person can set, apart from how it is set: panels and shortcuts write it, the loop reads it.
/// Nothing in here knows of windows or of Vulkan.
struct ViewState : Undoable {
  Playback playback;
  bool panels = true, timing = false, help = false;
  bool posing = false;     ///< joints can be dragged
  bool bothSides = false;  ///< ... and the body's other side does what is done to one
  bool editing = false;    ///< the chosen vessel can be changed
  EditTool editTool = EditTool::change;
  ContextTarget context;
  bool fullScreen = false;
  JointId joint;           ///< whose sliders are shown
  bool recording = false;  ///< pictures go to a video, a thirtieth of a second each
  std::optional<VesselPlace> selected;
  std::vector<VesselId> alsoChosen;      ///< together with it (chosenVessels())
  std::optional<VesselPlace> pointedAt;  ///< what lies under a pointer that rests
  OutlinerState outliner;
  bool isolate = false;    ///< only the selected vessel and its relatives are shown
  bool measuring = false;  ///< clicks set `from` and `to`, by turns
  std::optional<VesselPlace> from, to;
  std::string search;

  std::string undone, redone;  ///< what would be (undoName()); empty: there is nothing
  int menu = -1;               ///< of kMenuNames, opens with the next picture

  // Wishes, taken back when they are met.
  bool wishQuit = false, wishPicture = false, wishProfile = false, wishHome = false, wishFocus = false,
       wishSearch = false, wishCancel = false, wishUndo = false, wishRedo = false, wishSave = false,
       wishDelete = false, wishDeleteTree = false, wishDiscard = false, wishStay = false,
       wishCopyPose = false, wishPastePose = false, wishOpen = false, wishCopyPicture = false,
       wishFullScreen = false, wishGoOn = false, wishExport = false, wishCancelExport = false;
  bool wishSaveAs = false, wishSaveProfile = false;
  /// Files that are to be opened together in place of what is shown.
  std::vector<std::filesystem::path> wishFiles;
  ExportWish exportWish;                           ///< as the dialog has it
  std::vector<std::filesystem::path> chosenFiles;  ///< in the dialog of files, for its purpose; none yet

  Waiting waiting = Waiting::nothing;  ///< whether to go on without that is being asked
  std::string failure;              ///< why something could not be opened, until it is read; empty: it could
  std::vector<std::string> recent;  ///< paths of what was opened lately, the latest first
};

/// Whose colours are explained as soon as they change.
inline void setColouring(ViewState& state, atlas::Colouring colouring) {
  state.colouring = colouring;
  state.legend = true;
}

}  // namespace vasa::viewer
