#include "viewer/document.h"

#include <algorithm>
#include <chrono>

#include "network/measure.h"

namespace vasa::viewer {
namespace {

struct Cancelled {};

std::string titleOf(const SceneFile& file) {
  return file.networks.empty() ? file.body.filename().string() : file.networks.front().filename().string();
}

bool ready(const std::future<Loader::Answer>& answer) {
  return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

Result<std::shared_ptr<const Document>> loadDocument(const SceneFile& file, const std::filesystem::path& rules,
                                                     const std::function<void(const char*)>& stage) {
  auto document = std::make_shared<Document>();
  document->file = file;
  document->title = titleOf(file);
  stage("reading body and vessels");
  auto scene = loadScene(file);
  if (!scene) return scene.error();
  document->scene = std::move(*scene);
  if (!file.clip.empty())
    if (const auto clip = findClip(document->scene.body, file.clip); !clip) return clip.error();
  const std::filesystem::path folder = file.capillaries.rules.empty() ? rules : file.capillaries.rules;
  if (!folder.empty()) {
    stage("preparing capillaries");
    auto growth = loadGrowth(document->scene, folder);
    if (!growth) return growth.error();
    document->growth = std::make_unique<SceneGrowth>(std::move(*growth));
  }
  stage("preparing the body's meshes");
  document->levels = bodyLevels(document->scene.body.meshes);
  stage("measuring");
  document->bounds = measure(document->scene.network, document->scene.network.points()).bounds;
  for (const SkinnedMesh& mesh : document->scene.body.meshes) document->bounds.add(mesh.mesh.bounds());
  return std::shared_ptr<const Document>(std::move(document));
}

Loader::~Loader() {
  drop();
  for (const auto& job : dropped_) job->answer.wait();
}

void Loader::start(const SceneFile& file, const std::filesystem::path& rules, std::function<void()> changed) {
  drop();
  title_ = titleOf(file);
  job_ = std::make_shared<Job>();
  Job* job = job_.get();
  job->answer = std::async(std::launch::async, [job, file, rules, changed]() -> Answer {
    const auto stage = [&](const char* name) {
      if (job->cancelled) throw Cancelled{};
      job->stage = name;
      changed();
    };
    try {
      Answer answer = loadDocument(file, rules, stage);
      job->stage = "done";
      changed();
      return answer;
    } catch (const Cancelled&) {
      return Error{Fault::failed, "cancelled"};
    } catch (const std::exception& error) {
      return Error{Fault::failed, error.what()};
    }
  });
}

void Loader::drop() {
  if (!job_) return;
  job_->cancelled = true;
  dropped_.push_back(std::move(job_));
  std::erase_if(dropped_, [](const auto& job) { return ready(job->answer); });
}

void Loader::cancel() {
  drop();
}

const char* Loader::stage() const {
  return job_ ? job_->stage.load() : "";
}

std::unique_ptr<Loader::Answer> Loader::take() {
  if (!job_ || !ready(job_->answer)) return nullptr;
  auto answer = std::make_unique<Answer>(job_->answer.get());
  job_.reset();
  return answer;
}

void Loader::wait() const {
  if (job_) job_->answer.wait();
}

}  // namespace vasa::viewer
