#include "viewer/document.h"

#include <algorithm>
#include <future>
#include <optional>

#include "core/cancellation.h"
#include "core/parallel.h"
#include "core/stage_log.h"
#include "edit/replay.h"
#include "network/measure.h"
#include "surface/fork_memory.h"

namespace vasa::viewer {
namespace {

// A journal as the lines that mean something.
Result<std::vector<std::string>> linesOf(const std::filesystem::path& path) {
  const auto edits = readJournal(path);
  if (!edits) return edits.error();
  std::vector<std::string> lines;
  for (const Edit& edit : *edits) lines.push_back(journalLine(edit.operation));
  return lines;
}

Aabb boundsOf(const Scene& scene) {
  Aabb bounds = measure(scene.network, scene.network.points()).bounds;
  for (const SkinnedMesh& mesh : scene.body.meshes) bounds.add(mesh.mesh.bounds());
  return bounds;
}

bool sameLayout(const Network& a, const Network& b) {
  return std::ranges::equal(a.vessels(), b.vessels(), {}, &Vessel::pointCount, &Vessel::pointCount);
}

// Vessels keep their numbers, and some may have been appended.
bool continues(const Network& before, const Network& after) {
  const auto old = before.vessels(), all = after.vessels();
  return all.size() >= old.size() &&
         std::ranges::equal(old, all.first(old.size()), {}, &Vessel::name, &Vessel::name);
}

std::shared_ptr<const SweepTable> tableOf(const Network& network, const Document& before, bool live) {
  if (live && sameLayout(network, before.scene.network)) return before.table;
  ForkPlan plan = live && continues(before.scene.network, network)
                      ? planForksAs(network, before.table->ways, *before.forks)
                      : planForks(network, *before.forks);
  PatchTable patches = takePatches(network, plan);
  SweepTable table = makeSweepTable(network, std::move(plan));
  table.patches = std::move(patches);
  return std::make_shared<const SweepTable>(std::move(table));
}

// What each vessel was in the base, for Rebinder.
std::vector<Rebinder::Kept> keptOf(const Network& base, const Replay& replay) {
  std::vector<Rebinder::Kept> vessels;
  for (std::size_t v = 0; v < replay.origins.size(); ++v) {
    const Vessel& vessel = replay.network.vessels()[v];
    const bool kept = replay.origins[v].valid() && !replay.redrawn[v];
    vessels.push_back({vessel.firstPoint, vessel.pointCount,
                       kept ? std::optional(base.vessel(replay.origins[v]).firstPoint) : std::nullopt});
  }
  return vessels;
}

}  // namespace

struct GrowthBehind::Work {
  SceneGrowth growth;
  const Scene& scene;
  const SweepTable& table;
  Cancellation cancellation;
  std::future<bool> done;
  std::optional<bool> whole;  // what came of it
};

GrowthBehind::GrowthBehind(SceneGrowth rules, const Scene& scene, const SweepTable& table)
    : work_(std::make_unique<Work>(Work{std::move(rules), scene, table, {}, {}, {}})) {}

GrowthBehind::GrowthBehind() = default;
GrowthBehind& GrowthBehind::operator=(GrowthBehind&&) noexcept = default;

GrowthBehind::~GrowthBehind() {
  if (!work_ || !work_->done.valid()) return;
  work_->cancellation.ask();
  work_->done.wait();
}

void GrowthBehind::begin() const {
  if (!work_ || work_->done.valid() || work_->whole) return;
  work_->done = std::async(std::launch::async, [&work = *work_] {
    const CancellationScope scope(work.cancellation);
    const StageLog stage("behind the picture: settling where capillaries grow");
    giveWay();
    try {
      settleGrowth(work.growth, work.scene, work.table);
    } catch (const Cancelled&) {
      return false;
    }
    return true;
  });
}

bool GrowthBehind::settled() const {
  if (!work_ || work_->whole) return true;
  return work_->done.valid() && work_->done.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

const SceneGrowth* GrowthBehind::get() const {
  if (!work_) return nullptr;
  begin();
  if (!work_->whole) work_->whole = work_->done.get();
  return *work_->whole ? &work_->growth : nullptr;
}

std::string titleOf(const SceneFile& file) {
  return file.networks.empty() ? file.body.filename().string() : file.networks.front().filename().string();
}

Result<std::shared_ptr<const Document>> loadDocument(const SceneFile& file, const Furnishing& furnishing,
                                                     const ReadingProgress& told,
                                                     const std::optional<std::vector<std::string>>& edits) {
  auto document = std::make_shared<Document>();
  document->file = file;
  document->title = titleOf(file);
  SceneFile others = file;
  std::vector<std::string> journal;
  if (!file.edits.empty() && !file.path.empty() && file.edits.back() == ownJournal(file.path)) {
    if (!edits) {
      auto lines = linesOf(file.edits.back());
      if (!lines) return lines.error();
      journal = std::move(*lines);
    }
    others.edits.pop_back();
  }
  if (edits) journal = *edits;
  auto scene = loadScene(others, told);
  if (!scene) return scene.error();
  document->scene = std::move(*scene);
  if (!file.clip.empty())
    if (const auto clip = findClip(document->scene.body, file.clip); !clip) return clip.error();
  const std::filesystem::path folder =
      file.capillaries.rules.empty() ? furnishing.rules : file.capillaries.rules;
  auto growth = folder.empty() ? Result<SceneGrowth>(SceneGrowth{}) : readGrowth(folder);
  if (!growth) return growth.error();
  const auto ranges = furnishing.ranges.empty() ? Result<std::vector<JointRange>>(std::vector<JointRange>{})
                                                : readJointRanges(furnishing.ranges);
  if (!ranges) return ranges.error();
  document->mannequin = std::make_shared<const Mannequin>(document->scene.body.skeleton, *ranges);
  checkpoint();
  const char* what = "planning where vessels join, preparing the body's meshes";
  const StageLog stage(what);
  told(what, 0, 0);
  parallelFor(3, 1, [&](std::size_t part) {
    if (part == 0)
      document->table = std::make_shared<const SweepTable>(makeSweepTable(document->scene.network));
    else if (part == 1)
      document->clearedLimbs = clearLimbs(file, document->scene.body, document->scene.body.clips);
    else
      document->levels = std::make_shared<const BodyLevels>(
          bodyLevels(document->scene.body.meshes, &document->scene.body.skeleton));
  });
  document->bounds = boundsOf(document->scene);
  document->groups = std::make_shared<const atlas::VesselGroups>(atlas::groupsOf(document->scene));
  document->base = std::make_shared<const Network>(document->scene.network);
  document->rebinder = std::make_shared<const Rebinder>(document->scene.body, document->scene.binding.spines);
  document->baseBinding = std::make_shared<const Binding>(document->scene.binding);
  document->rules = folder;
  document->forks = std::make_shared<ForkMemory>();
  if (!journal.empty()) return editedDocument(*document, std::move(journal), false);
  if (!folder.empty()) {
    document->growth = GrowthBehind(std::move(*growth), document->scene, *document->table);
    document->growth.begin();
  }
  return std::shared_ptr<const Document>(std::move(document));
}

std::filesystem::path ownJournal(const std::filesystem::path& scene) {
  return std::filesystem::path(scene).replace_extension(".vedit");
}

Result<std::shared_ptr<const Document>> editedDocument(const Document& document,
                                                       std::vector<std::string> journal, bool live) {
  std::string text;
  for (const std::string& line : journal) text += line + "\n";
  const auto edits = parseJournal(text, "edit");
  if (!edits) return edits.error();
  Replay replay = replayEdits(*document.base, *edits);
  for (const ReplayRow& row : replay.rows)
    if (!row.applied()) return badInput(row.refusal);
  checkpoint();
  auto made = std::make_shared<Document>();
  made->file = document.file;
  made->levels = document.levels;
  made->mannequin = document.mannequin;
  made->title = document.title;
  made->clearedLimbs = document.clearedLimbs;
  made->base = document.base;
  made->baseBinding = document.baseBinding;
  made->rebinder = document.rebinder;
  made->rules = document.rules;
  made->journal = std::move(journal);
  made->scene.body = document.scene.body;
  made->scene.holds = document.scene.holds;
  made->scene.binding = document.rebinder->rebind(*document.baseBinding, replay.network.points(),
                                                  keptOf(*document.base, replay));
  made->scene.network = std::move(replay.network);
  checkpoint();
  made->live = live;
  made->forks = document.forks;
  made->origins = std::move(replay.origins);
  made->table = tableOf(made->scene.network, document, live);
  const bool dragged = made->table == document.table;  // what follows is seen to once it is let go
  made->bounds = dragged ? document.bounds : boundsOf(made->scene);
  made->groups =
      dragged ? document.groups : std::make_shared<const atlas::VesselGroups>(atlas::groupsOf(made->scene));
  if (!made->rules.empty()) {
    auto growth = readGrowth(made->rules);
    if (!growth) return growth.error();
    made->growth = GrowthBehind(std::move(*growth), made->scene, *made->table);
  }
  return std::shared_ptr<const Document>(std::move(made));
}

}  // namespace vasa::viewer
