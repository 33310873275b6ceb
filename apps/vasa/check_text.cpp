#include "check_text.h"

#include <fmt/format.h>

#include <cmath>

namespace vasa::cli {
namespace {

// Keys end in their unit; people read millimetres.
std::pair<std::string, Report> inMillimetres(const std::string& key, const Report& value) {
  if (!key.ends_with("_m") || !value.is_number()) return {key, value};
  return {key + "m", 1e3 * value.get<double>()};
}

std::vector<std::string> columnsOf(const Report& frame) {
  if (frame.contains("paper_pairs_before"))
    return {"frame",
            "exact_pairs_before",
            "paper_pairs_before",
            "paper_false_pairs_before",
            "exact_pairs_after",
            "paper_pairs_after",
            "exact_detect_ms",
            "paper_detect_ms"};
  return {"frame",        "contacts_before", "contacts_after", "depth_after_m", "moved_max_m",
          "volume_error", "kinks",           "narrow_spans",   "solve_ms"};
}

std::string frameTable(const Report& frames) {
  std::string head, rows;
  const auto columns = columnsOf(frames.front());
  for (const Report& frame : frames) {
    for (const std::string& column : columns) {
      const auto [name, value] = inMillimetres(column, frame[column]);
      const std::size_t width = std::max<std::size_t>(name.size() + 2, 10);
      if (&frame == &frames.front()) head += fmt::format("{:>{}}", name, width);
      rows += value.is_number_float() ? fmt::format("{:>{}.6f}", value.get<double>(), width)
                                      : fmt::format("{:>{}}", value.dump(), width);
    }
    rows += "\n";
  }
  return head + "\n" + rows;
}

// "3, worst left popliteal vein (1.05, frame 14)" of a list of vessels.
std::string vesselsOf(const Report& list, const char* of) {
  const Report* worst = nullptr;
  for (const Report& vessel : list)
    if (!worst || std::abs(vessel[of].get<double>()) > std::abs((*worst)[of].get<double>())) worst = &vessel;
  if (!worst) return "0";
  return fmt::format("{}, worst {} ({:.2f}, frame {})", list.size(), plainText((*worst)["vessel"]),
                     (*worst)[of].get<double>(), (*worst)["frame"].get<std::uint32_t>());
}

std::string shownText(const std::string& key, const Report& value) {
  if (!value.is_array()) return plainText(value);
  return vesselsOf(value, key == "kinked" ? "bend" : key == "strained" ? "length_change" : "length_step");
}

std::string counted(std::size_t count, const char* one, const char* several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

// "No vessel runs through another in any of 34 frames: certified." and what else a reader must know.
std::string verdict(const Report& report) {
  const Report &summary = report["summary"], &frames = report["frames"];
  const auto number = [&](const char* key) {
    return summary.contains(key) ? summary[key].get<double>() : 0.0;
  };
  const auto bad = std::size_t(number("frames_with_penetration_after"));
  std::string text;
  if (bad == 0) {
    text = frames.size() == 1
               ? "No vessel runs through another: certified."
               : fmt::format("No vessel runs through another in any of {} frames: certified.", frames.size());
    if (const Report& exempt = summary["certificate"]["rest_pairs_exempt"]; exempt != 0)
      text += fmt::format(" Exempt: {} that overlap at rest.",
                          counted(exempt, "pair of tubes", "pairs of tubes"));
  } else {
    const Report* worst = &frames.front();
    for (const Report& frame : frames)
      if (frame["depth_after_m"] > (*worst)["depth_after_m"]) worst = &frame;
    text = fmt::format("Vessels run through one another in {} of {}, at worst {:.2f} mm deep in frame {}.",
                       bad, counted(frames.size(), "frame", "frames"),
                       1e3 * (*worst)["depth_after_m"].get<double>(), (*worst)["frame"].get<std::uint32_t>());
  }
  if (const auto passages = std::size_t(number("passages")); passages > 0)
    text += fmt::format(" {} another on the way from frame to frame.",
                        counted(passages, "time a vessel passes through", "times vessels pass through"));
  else if (summary["passages_from_rest"] == true)
    text += fmt::format(" None passes through another on the way from rest{}.",
                        frames.size() > 1 ? " or from frame to frame" : "");
  else if (frames.size() > 1)
    text += " None passes through another from frame to frame.";
  if (const auto tubes = std::size_t(number("obstacle_deeper_after")); tubes > 0)
    text += fmt::format(" Up to {} deeper in bone or heart than at rest.",
                        counted(tubes, "tube lies", "tubes lie"));
  if (const auto kinks = std::size_t(number("kinks")); kinks > 0)
    text += fmt::format(" Up to {} kinked in a frame.", counted(kinks, "span is", "spans are"));
  if (const auto narrow = std::size_t(number("narrow_spans")); narrow > 0)
    text += fmt::format(" For want of room up to {} thinner, to {:.0f} % at least.",
                        counted(narrow, "span is", "spans are"), 100 * number("least_lumen"));
  return text;
}

}  // namespace

std::string checkText(const Report& report) {
  std::string text = frameTable(report["frames"]) + "\n";
  for (const auto& [key, value] : report["summary"].items()) {
    const auto [name, shown] = inMillimetres(key, value);
    text += fmt::format("{:<32}{}\n", name, shownText(key, shown));
  }
  return text + "\n" + verdict(report) + "\n";
}

}  // namespace vasa::cli
