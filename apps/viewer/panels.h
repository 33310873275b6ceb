#pragma once
#include <memory>
#include <string>

#include "render/profiler.h"
#include "viewer/actions.h"
#include "viewer/layout.h"
#include "viewer/loader.h"
#include "viewer/pose_worker.h"
#include "viewer/timings.h"
#include "viewer/view_state.h"

// What is on the window beside the picture. Each function declares one panel with Dear ImGui: it shows what
// is, and writes what a person changes into the state. Between UiContext::begin() and end() only.
namespace vasa::viewer {

class Editor;
class FileChooser;

struct PanelInput {
  ViewState& state;
  const Document* document = nullptr;  ///< null: nothing is loaded
  const PosedBody* body = nullptr;     ///< null: no shape yet
  const Timings& timings;
  Layout layout;
  float scale = 1;                      ///< pixels for one of an ordinary screen
  Camera camera;                        ///< of the picture
  Aabb bodyBox;                         ///< where the body is [m]
  FileChooser* files = nullptr;         ///< the dialog in which files are chosen
  Editor* editor = nullptr;             ///< null: nothing can be edited
  std::optional<std::size_t> heldGrip;  ///< of the mannequin, that is being dragged
  const Profiler* profiler = nullptr;   ///< running or done; null: never run
  bool fine = false;                    ///< the picture is a still
  double framesPerSecond = 0;           ///< of what moves; 0: nothing does
  std::string message;                  ///< the latest news, e.g. of a picture that was written
  std::optional<Loader::Stage> loading;
  std::string loadingTitle;
  bool unsaved = false;     ///< edits or the pose
  std::string exportTitle;  ///< of what is being written; empty: nothing is
  float exportShare = 0;    ///< done of it, 0..1
};

void showPanels(const PanelInput& in);  ///< all of them

void showTransport(const PanelInput& in);
void showHeads(const PanelInput& in);  ///< texts over the picture
void showLoading(const PanelInput& in);
void showExporting(const PanelInput& in);                ///< how far an export is
void showBar(const PanelInput& in);                      ///< menus and tools
void showActionItem(const PanelInput& in, ActionId id);  ///< a menu's entry, in a menu
void showColourings(const PanelInput& in);               ///< a menu of them, in a menu
void showContextMenu(const PanelInput& in);              ///< of what was clicked with the right button
void showHelp(const PanelInput& in);                     ///< keys and what they do
void showLookSection(const PanelInput& in);
void showCutControls(const PanelInput& in);
void showCutOutline(const PanelInput& in);  ///< the cutting plane's, over the picture
void showVesselSection(const PanelInput& in);
void showInspectorSection(const PanelInput& in);
void showChosen(
    const PanelInput& in);  ///< the chosen vessel's line over the picture, also where something hides it
void showOutliner(const PanelInput& in);  ///< the list of all vessels
void showNames(const PanelInput& in);     ///< of what is pointed at and chosen, over the picture
void showLegend(const PanelInput& in);    ///< what the colours mean, over the picture
void showPoseSection(const PanelInput& in);
void showHandles(const PanelInput& in);  ///< joints to drag, over the picture
/// What edits the chosen vessel: over the picture, and in the panels where that is too small
void showEdit(const PanelInput& in);
void showEditSection(const PanelInput& in);
void showRefusal(const PanelInput& in);  ///< of an edit, in a text over the picture, where that is too small
void showEditHandle(const PanelInput& in);  ///< the chosen place, to drag
void showQuestion(
    const PanelInput& in);               ///< before quitting or opening something else with something unsaved
void showFailure(const PanelInput& in);  ///< why something could not be opened
void showFileChooser(const PanelInput& in);  ///< the dialog in which files are chosen
void showTimingSection(const PanelInput& in);

}  // namespace vasa::viewer
