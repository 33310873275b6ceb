#include "viewer/ui_changes.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <string>
#include <vector>

using namespace vasa::viewer;

namespace {

constexpr ImGuiWindowFlags kFlags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
constexpr Rect kPicture{0, 0, 300, 200};

// A picture with a head on it, a side and a foot, as the app has them.
class Panels {
 public:
  Panels() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = {400, 250};
    ImGui::GetStyle().WindowBorderSize = 0;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  }
  ~Panels() { ImGui::DestroyContext(); }

  // Corners, for each window that is to be drawn.
  std::vector<int> draw(const std::string& foot, const char* tip = nullptr) {
    ImGui::NewFrame();
    window("head", {10, 10}, {80, 30}, "head");
    window("side", {300, 0}, {100, 200}, "side");
    window("foot", {0, 200}, {400, 50}, foot.c_str());
    if (tip) window("tip", {310, 20}, {60, 30}, tip);
    ImGui::Render();
    ImDrawData& data = *ImGui::GetDrawData();
    changes.keepChanged(data, kPicture);
    std::vector<int> corners;
    int sum = 0;
    for (int i = 0; i < data.CmdListsCount; ++i)
      corners.push_back(data.CmdLists[i]->VtxBuffer.Size), sum += corners.back();
    CHECK(sum == data.TotalVtxCount);
    return corners;
  }

  UiChanges changes;

 private:
  static void window(const char* name, ImVec2 place, ImVec2 size, const char* text) {
    ImGui::SetNextWindowPos(place);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin(name, nullptr, kFlags);
    ImGui::TextUnformatted(text);
    ImGui::End();
  }
};

}  // namespace

TEST_CASE("windows are drawn again where they or what lies below them changed") {
  Panels panels;
  const std::size_t whole = panels.draw("0 / 85").size();
  CHECK(whole == 3);
  CHECK(panels.draw("0 / 85").size() == 1);  // the head: the picture has been put over it
  CHECK(panels.draw("1 / 85").size() == 2);
  CHECK(panels.draw("1 / 85").size() == 1);
  CHECK(panels.draw("1 / 85", "tip").size() == whole + 1);
  CHECK(panels.draw("1 / 85", "tip").size() == 1);
  CHECK(panels.draw("1 / 85", "top").size() == 3);  // the side below it too
  CHECK(panels.draw("1 / 85").size() == whole);
  panels.changes.forget();
  CHECK(panels.draw("1 / 85").size() == whole);
}
