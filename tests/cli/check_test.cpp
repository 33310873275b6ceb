#include <doctest/doctest.h>

#include "cli/program.h"

using namespace vasa::test;

TEST_CASE("check has a row a frame and the worst of each in its summary") {
  const auto outcome = runProgram({"check", "--clip", "walk", "--frames", "8:10", "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  REQUIRE(report["frames"].size() == 3);
  CHECK(report["frames"][0]["frame"] == 8);
  for (const auto& frame : report["frames"])
    for (const char* key : {"frame", "contacts_before", "contacts_after", "depth_before_m", "depth_after_m",
                            "certified", "volume_error", "moved_max_m", "moved_rms_m", "kinks", "solve_ms"})
      CHECK_MESSAGE(frame.contains(key), key);
  for (const auto& frame : report["frames"]) {
    CHECK(frame["certified"] == (frame["contacts_after"] == 0));
    CHECK(frame["contacts_after"] <= frame["contacts_before"]);
    CHECK(report["summary"]["contacts_before"] >= frame["contacts_before"]);
  }
  for (const char* key : {"frames_with_penetration_after", "excluded_pairs", "depth_after_m", "certificate"})
    CHECK_MESSAGE(report["summary"].contains(key), key);
  for (const char* list : {"kinked", "strained", "fast"})
    CHECK_MESSAGE(report["summary"][list].empty(), list);
}

TEST_CASE("check tells what passes through what from rest to its first frame and from frame to frame") {
  const auto report =
      runProgram({"check", "--clip", "squat", "--frames", "44:46", "--places", "--json"}).json();
  std::size_t before = 0;
  for (const auto& frame : report["frames"]) {
    before += frame["passages_before"].get<std::size_t>();
    CHECK(frame["passages"] == frame["passed"].size());
  }
  CHECK(report["frames"][0]["passages_before"] > 0);  // the body bends its knees without looking
  CHECK(report["summary"]["passages_before"] == before);
  CHECK(report["summary"]["passages"] == 0);
  CHECK(report["summary"]["passages_from_rest"] == true);
  // From a frame that a track holds on, the way began there.
  const TemporaryFolder folder;
  const std::string track = (folder.path() / "walk.track").string();
  for (const bool known : {false, true})
    CHECK(
        runProgram({"check", "--clip", "walk", "--frames", known ? "4:5" : "0:2", "--track", track, "--json"})
            .json()["summary"]["passages_from_rest"] == !known);
  const auto still = runProgram({"check", "--clip", "squat", "--frames", "44"});
  CHECK(still.out.find("None passes through another on the way from rest.") != std::string::npos);
}

TEST_CASE("check tells how far corrections step from frame to frame, at the rate that is asked for") {
  const auto outcome = runProgram({"check", "--clip", "elbow", "--fps", "15", "--frames", "20:22", "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  REQUIRE(report["frames"].size() == 3);
  CHECK(!report["frames"][0].contains("correction_step_max_m"));
  std::uint32_t excess = 0, frames = 0;
  for (const std::size_t at : {1, 2}) {
    const auto& frame = report["frames"][at];
    CHECK(frame["correction_step_max_m"] <= report["summary"]["correction_step_max_m"]);
    CHECK(frame.contains("correction_step_worst") == (frame["correction_step_excess"] > 0));
    excess += frame["correction_step_excess"].get<std::uint32_t>();
    frames += frame["correction_step_excess"] > 0;
  }
  CHECK(report["summary"]["correction_step_excess"] == excess);
  CHECK(report["summary"]["correction_step_excess_frames"] == frames);
  CHECK(report["summary"].contains("correction_step_worst") == (frames > 0));
  // The same poses by the clip's own numbers, of which there are twice as many.
  const auto own = runProgram({"check", "--clip", "elbow", "--frames", "40", "--json"}).json();
  CHECK(own["frames"][0]["contacts_before"] == report["frames"][0]["contacts_before"]);
  CHECK(own["frames"][0]["moved_max_m"] == report["frames"][0]["moved_max_m"]);
  CHECK(!own["summary"].contains("correction_step_excess"));
}

TEST_CASE(
    "check names vessels that change their length fast: each with its worst frame, the worst of them for people") {
  // A thirtieth of the frames: from one to the next arms are raised.
  const auto outcome = runProgram({"check", "--clip", "arms_overhead", "--fps", "1", "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  const auto& fast = report["summary"]["fast"];
  REQUIRE(!fast.empty());
  for (const auto& vessel : fast) {
    CHECK(std::abs(vessel["length_step"].get<double>()) > 0.05);
    CHECK(vessel["frame"] < report["frames"].size());
    CHECK(!vessel["vessel"].get<std::string>().empty());
  }
  const auto text = runProgram({"check", "--clip", "arms_overhead", "--fps", "1"});
  CHECK(text.out.find(", worst ") != std::string::npos);
}

TEST_CASE("check --method paper looks by the paper's detection, too, which misses nothing and reports more") {
  const auto frame = runProgram({"check", "--clip", "twist", "--frames", "20", "--method", "paper", "--json"})
                         .json()["frames"][0];
  CHECK(frame["exact_pairs_before"] == frame["contacts_before"]);
  CHECK(frame["exact_pairs_before"] > 0);
  CHECK(frame["paper_missed_pairs"] == 0);
  for (const std::string when : {"before", "after"}) {
    const auto count = [&](const char* what) { return frame[std::string(what) + when].get<int>(); };
    CHECK(count("paper_pairs_") == count("exact_pairs_") + count("paper_false_pairs_"));
  }
  CHECK(frame["paper_false_pairs_before"] > 0);
  CHECK(frame["paper_detect_ms"] > 0);
  CHECK(frame["exact_detect_ms"] > 0);
  const auto text = runProgram({"check", "--clip", "twist", "--frames", "20", "--method", "paper"});
  CHECK(text.out.find("paper_false_pairs_before") != std::string::npos);
  CHECK(runProgram({"check", "--method", "boxes"}).exit == 2);
}

TEST_CASE("check refuses a clip and frames that do not exist") {
  CHECK(runProgram({"check", "--clip", "no such clip"}).exit == 3);
  CHECK(runProgram({"check", "--clip", "walk", "--frames", "9000"}).exit == 2);
  CHECK(runProgram({"check", "--clip", "walk", "--fps", "1", "--frames", "30"}).exit == 2);
  CHECK(runProgram({"check", "--clip", "walk", "--fps", "0"}).exit == 2);
}

TEST_CASE("check ends with a verdict in a sentence, lengths for people in millimetres") {
  const auto outcome = runProgram({"check", "--clip", "fist", "--frames", "0:2"});
  CHECK(outcome.exit == 0);
  CHECK(outcome.out.find("No vessel runs through another in any of 3 frames: certified.") !=
        std::string::npos);
  CHECK(outcome.out.find("None passes through another on the way from rest or from frame to frame.") !=
        std::string::npos);
  CHECK(outcome.out.find("depth_after_mm") != std::string::npos);
  CHECK(outcome.out.find("depth_after_m ") == std::string::npos);
}
