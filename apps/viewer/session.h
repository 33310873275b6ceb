#pragma once
#include <chrono>
#include <deque>
#include <future>

#include "gpu/swapchain.h"
#include "render/profiler.h"
#include "viewer/app.h"
#include "viewer/editor.h"
#include "viewer/exporter.h"
#include "viewer/file_chooser.h"
#include "viewer/loader.h"
#include "viewer/paint.h"
#include "viewer/painter.h"
#include "viewer/panels.h"
#include "viewer/picture_clipboard.h"
#include "viewer/pointer.h"
#include "viewer/pose_tool.h"
#include "viewer/recording.h"
#include "viewer/reshaper.h"
#include "viewer/scene_keeper.h"
#include "viewer/settings.h"
#include "viewer/timings.h"
#include "viewer/ui_context.h"
#include "viewer/ui_pass.h"
#include "viewer/undo_history.h"

namespace vasa::viewer {

/// [s] of a script's frames, least of a person's
constexpr double kScriptFrame = 1.0 / 30, kFrame = 1.0 / 60;
constexpr int kRestingFrames = 3;  ///< pictures of the panels until they have come to rest

/// What a session opens first.
Loader::Wanted firstWanted(const ViewOptions& options);

/// A window's surface; goes before the device.
class Surface {
 public:
  Surface(const Window& window, VkInstance instance)
      : instance_(instance), surface_(window.makeSurface(instance)) {}
  ~Surface() { vkDestroySurfaceKHR(instance_, surface_, nullptr); }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  VkSurfaceKHR handle() const { return surface_; }

 private:
  VkInstance instance_;
  VkSurfaceKHR surface_;
};

/// One run of the app: the loop, and what it holds together. Shapes are made on a thread of their own
/// (PoseWorker) while this one draws; nothing is drawn while nothing changes. With a script, time goes on by
/// a thirtieth of a second a frame and shapes are waited for, so that the same script gives the same
/// pictures.
class Session {
 public:
  /// @param loader  loads firstWanted() already
  Session(const ViewOptions& options, const Settings& settings, Window& window, Loader& loader);
  Result<ViewReport> run();

 private:
  Result<ViewReport> go();
  Result<void> checkRecord() const;
  Result<void> keepScript();
  std::string keepUnsaved();
  Error keepWhatIsThere(Error error);
  using Clock = std::chrono::steady_clock;

  // input
  void gather();
  void takeWindowEvents();
  void takeScript();
  void takeSize(std::uint32_t width, std::uint32_t height);
  InputEvent asDrawn(InputEvent event) const;
  void handle(const InputEvent& given);
  void click(const Click& click);
  void openContext(vec2 place);
  void escape();
  void stay();
  bool askForMenu(const KeyChanged& key);
  std::optional<VesselPlace> vesselAt(vec2 place) const;
  void lookUnderPointer();
  bool isHidden(vec3 place) const;

  // time and shapes
  double pass();
  void openFiles();
  void startOpening();
  /// What the loader is at.
  struct Opening {
    Loader::Wanted wanted;
    std::vector<std::filesystem::path> files;
    bool motionAlone = false;  // for what is shown
  };
  void load(Opening opening);
  void refuse(const Error& error);
  void askForFile();
  void takeFile();
  void startExport(const std::filesystem::path& file);
  void watchExport();
  void goOn();
  bool asksFirst() const;
  void remember(const std::vector<std::filesystem::path>& files);
  void adopt();
  void beginWith();
  void goOnWith(std::shared_ptr<const Document> moved);
  void cancelLoading();
  void watchLoading();
  void tidy();
  void takeChoices();
  void takeClip();
  void orderShape();
  void takeShape();
  void follow();
  bool idle() const;
  /// Time goes on in steps and shapes are waited for.
  bool steady() const { return (options_.script && !liveUntil_) || recording_.running(); }

  // edits
  void reshape();
  void changeTo(std::shared_ptr<const Document> edited);
  void noteEdit();
  void travel();
  void nameSteps();
  void entitle();
  Result<void> mayWrite(const std::filesystem::path& scene) const;
  void saveScene(const std::filesystem::path& as = {});

  // pictures
  Layout layoutNow() const;
  Rect pictureRect() const;
  Camera cameraNow() const;
  Aabb bodyBox() const;
  Shot shotNow();
  void moveCamera();
  Detail detailNow() const;
  bool drawScene();
  bool makeStill(const Shot& fine);
  void leaveStill();
  void drawWindow();
  void noteFirst();
  void meetWishes();
  void saveForScript();
  Result<void> keepSettings() const;
  void pastePose();
  void record();
  void profile();
  /// @param more  to be said with its name
  bool save(const SavePicture& wish, const char* more = "");
  double framesPerSecond() const;
  void copyPicture();
  void saveProfile();
  void say(std::string message, double seconds = 4);
  void rest(double drawn);
  ViewReport report() const;

  const ViewOptions& options_;
  Window& window_;
  UiContext ui_;
  gpu::Device device_;
  Surface surface_;
  gpu::Swapchain swapchain_;
  UiPass canvas_;
  Painter painter_;
  ViewState state_;
  PointerTool pointer_;
  PoseTool poseTool_;
  Editor editor_;
  FileChooser files_;
  Exporter exporter_;
  UndoHistory history_;
  SceneKeeper keeper_;
  Recording recording_;
  std::optional<PictureClipboard> pictureClipboard_;  // once something was copied
  std::unique_ptr<Profiler> profiler_;
  Loader& loader_;
  PoseWorker worker_;
  std::shared_ptr<const Document> document_;
  std::shared_ptr<const Document> coming_;  // edited, until it has a shape
  std::optional<PoseOrder> ordered_;        // last
  Reshaper reshaper_;
  std::vector<std::string> wanted_;  // journal of the latest wish
  bool wantedLive_ = false;
  std::optional<Clock::time_point> editedAt_;  // what is coming, until it is seen
  std::string title_;
  std::shared_ptr<const PosedBody> body_;
  KeptColours spanColours_;
  Timings timings_;
  ScriptRecorder recorder_;
  std::deque<InputEvent> events_;
  std::vector<std::filesystem::path> dropped_;  // to be opened
  Opening opening_;
  std::vector<Opening> interrupted_;  // by others: begun again if those cannot be opened
  std::size_t step_ = 0;              // of the script
  std::uint32_t passing_ = 0;         // frames that it lets pass
  bool settling_ = false;
  std::optional<Clock::time_point> liveUntil_;
  std::optional<SavePicture> saving_;
  std::optional<Shot> shown_, making_;            // the latter: a still, slice by slice
  Detail detail_;                                 // of both
  vec3 way_{0}, carried_{0};                      // of the body over the floor; of the camera along with it
  double now_ = 0, still_ = 0, scrolledAt_ = -1;  // [s]
  double movedAt_ = -1;                           // [s] the pointer; < 0: what lies under it is known
  Clock::time_point last_ = Clock::now();
  std::optional<Clock::time_point> lastShown_;
  Clock::time_point loadStart_, lastWatched_;
  bool arriving_ = false;   // loaded, but not seen yet
  bool beginning_ = false;  // ... and the view that it begins with is still being found
  enum class Untidy { no, growing, loaded } untidy_ = Untidy::no;  // what has left freed memory behind
  std::future<void> tidying_;
  std::uint32_t width_ = 0, height_ = 0;  // [pixels] of the window as it is drawn
  vec2 drawnShare_{1};                    // of its own pixels
  int panelFrames_ = kRestingFrames;
  bool ending_ = false, profiling_ = false;
  bool altAlone_ = false;     // pressed, and nothing since
  bool goesOnSaved_ = false;  // with what waits, once the dialog has a name to save it under
  bool exportMore_ = false;   // slices of its pictures wait
  std::string message_;
  double messageUntil_ = 0;
  std::optional<Error> failure_;
  ViewReport report_;
};

}  // namespace vasa::viewer
