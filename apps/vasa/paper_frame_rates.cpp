#include <fmt/format.h>

#include "core/cancellation.h"
#include "core/log.h"
#include "paper_study.h"
#include "render/profiler.h"

// Table III: render, collision, total and frames a second at the paper's resolutions, leaving out what cannot
// be seen and, as the paper does, drawing every triangle.
namespace vasa::cli {
namespace {

struct PaperRow {
  SweepShape shape;
  double render, collision, total, fps;
};
constexpr PaperRow kPaper[] = {
    {{4, 5}, 17, 4, 21, 48}, {{4, 10}, 21, 8, 29, 35}, {{8, 5}, 19, 8, 27, 37}, {{8, 10}, 32, 8, 40, 25}};

double sumOf(const ProfileRow& row, std::initializer_list<const char*> names) {
  double sum = 0;
  for (const auto& [name, value] : row.stages)
    for (const char* wanted : names)
      if (name == wanted) sum += value;
  return sum;
}

Report oursOf(const ProfileRow& row) {
  return {{"render_ms", sumOf(row, {"picture_ms"})},
          {"collision_ms", sumOf(row, {"volume_ms", "detect_ms", "obstacles_ms", "avoid_ms", "certify_ms"})},
          {"total_ms", sumOf(row, {"picture_ms", "solve_ms"})},
          {"frame_ms", sumOf(row, {"frame_ms"})},
          {"fps", row.fps()},
          {"triangles", row.triangles},
          {"triangles_drawn", std::uint64_t(sumOf(row, {"triangles_drawn"}))},
          {"template_bytes", row.templateBytes}};
}

ProfileSetting settingOf(const PaperStudy& study, bool cull) {
  return {.scene = &study.scene,
          .clip = study.clip,
          .meshes = {},
          .render = {.width = study.size.width,
                     .height = study.size.height,
                     .samples = 1,
                     .table = &study.table,
                     .cull = cull},
          .look = {},
          .camera =
              [&study](const FrameMaker& maker) {
                return study.camera.at(study.scene, maker.pose(), maker.points());
              },
          .avoid = true,
          .frames = study.quick ? 2u : 40u};
}

}  // namespace

Result<Report> frameRateTable(const PaperStudy& study, gpu::Device& device) {
  std::vector<ProfileQuads> quads;
  for (const PaperRow& row : kPaper) quads.push_back({row.shape, 0});
  std::vector<ProfileRow> measured[2];
  for (const bool cull : {true, false}) {
    Profiler profiler(device, settingOf(study, cull), quads);
    ProgressLine progress(cull ? "table III" : "table III, every triangle");
    while (profiler.step()) {
      checkpoint();
      progress.update(profiler.done(), profiler.total());
    }
    measured[cull] = profiler.rows();
  }
  Report rows = Report::array();
  for (std::size_t i = 0; i < std::size(kPaper); ++i) {
    const PaperRow& paper = kPaper[i];
    rows.push_back({{"quads", fmt::format("{}x{}", paper.shape.around, paper.shape.along)},
                    {"ours", oursOf(measured[true][i])},
                    {"ours_every_triangle", oursOf(measured[false][i])},
                    {"paper",
                     {{"render_ms", paper.render},
                      {"collision_ms", paper.collision},
                      {"total_ms", paper.total},
                      {"fps", paper.fps}}}});
  }
  return rows;
}

}  // namespace vasa::cli
