#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdlib>

#include "scene/exporting.h"
#include "viewer/exporter.h"
#include "viewer/file_chooser.h"
#include "viewer/panels.h"

// The dialog in which a file is chosen. What is typed has the keys, Up and Down mark a line, Tab completes,
// Enter takes; with Shift they take further lines in, as clicks with Ctrl and Shift do.
namespace vasa::viewer {
namespace {

bool pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

std::string sizeText(std::uintmax_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  return bytes < 1'000'000 ? fmt::format("{:.0f} kB", 1e-3 * double(bytes))
                           : fmt::format("{:.1f} MB", 1e-6 * double(bytes));
}

// Above the list: where one is.
void showFolder(FileChooser& files) {
  if (ImGui::Button("Up")) files.go(files.folder().parent_path());
  ImGui::SameLine();
  if (const char* home = std::getenv("HOME"); home && *home) {
    if (ImGui::Button("Home")) files.go(home);
    ImGui::SameLine();
  }
  ImGui::AlignTextToFramePadding();
  // Of a long way its end tells more.
  std::string text = files.folder().string();
  const float room = ImGui::GetContentRegionAvail().x;
  while (text.size() > 4 && ImGui::CalcTextSize(text.c_str()).x > room)
    text = "..." + text.substr(std::min<std::size_t>(text.size(), 5));
  ImGui::TextUnformatted(text.c_str());
}

// @return whether a line was double-clicked
bool showRows(FileChooser& files, float height, bool scroll) {
  bool twice = false;
  if (ImGui::BeginChild("##rows", {0, height}, true)) {
    std::optional<int> clicked;
    for (int r = 0; r < int(files.rows().size()); ++r) {
      const FileRow& row = files.rows()[std::size_t(r)];
      ImGui::PushID(r);
      const std::string text = row.folder ? row.name + "/" : row.name;
      if (ImGui::Selectable(text.c_str(), files.marked() == r || files.isTaken(r),
                            ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups)) {
        clicked = r;
        twice = ImGui::IsMouseDoubleClicked(0);
      }
      if (!row.folder) {
        const std::string size = sizeText(row.bytes);
        ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(size.c_str()).x);
        ImGui::TextDisabled("%s", size.c_str());
      }
      if (scroll && files.marked() == r) ImGui::SetScrollHereY(0.5f);
      ImGui::PopID();
    }
    const ImGuiIO& io = ImGui::GetIO();
    if (clicked && !twice && io.KeyCtrl)
      files.toggle(*clicked);
    else if (clicked && !twice && io.KeyShift)
      files.extend(*clicked);
    else if (clicked)
      files.mark(*clicked);
    if (files.rows().empty()) ImGui::TextDisabled("Nothing here.");
  }
  ImGui::EndChild();
  return twice;
}

int complete(ImGuiInputTextCallbackData* data) {
  auto& files = *static_cast<FileChooser*>(data->UserData);
  files.typed.assign(data->Buf, std::size_t(data->BufTextLen));
  const std::string text = files.completed();
  data->DeleteChars(0, data->BufTextLen);
  data->InsertChars(0, text.c_str());
  return 0;
}

void showTyped(FileChooser& files, bool focus) {
  if (focus) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputTextWithHint("##typed", "A name or a path", &files.typed,
                               ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_AutoSelectAll,
                               complete, &files))
    files.typing();
}

// As what, how large and how much of the clip; by the name's extension.
void showExportChoices(const PanelInput& in, FileChooser& files) {
  ExportWish& wish = in.state.exportWish;
  const std::filesystem::path typed = files.typed;
  std::string kind = typed.extension().string();
  ImGui::SetNextItemWidth(90 * in.scale);
  if (ImGui::BeginCombo("as", kind.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const std::string& extension : exportExtensions())
      if (ImGui::Selectable(extension.c_str(), extension == kind))
        files.typed = std::filesystem::path(typed).replace_extension(extension).string();
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  if (isPicture(typed) || isFilm(typed)) {
    int size[2] = {int(wish.width), int(wish.height)};
    ImGui::SetNextItemWidth(130 * in.scale);
    if (ImGui::InputInt2("pixels", size)) {
      wish.width = std::uint32_t(std::clamp(size[0], 16, 8192));
      wish.height = std::uint32_t(std::clamp(size[1], 16, 8192));
    }
    ImGui::SameLine();
  }
  const auto exported = exportKindOf(typed);
  if (isFilm(typed) || (exported && holdsMotion(*exported)))
    ImGui::Checkbox("the whole clip", &wish.wholeClip);
  else
    ImGui::AlignTextToFramePadding(), ImGui::TextDisabled("of what is shown");
}

constexpr const char* titleOfChooser(FilePurpose purpose) {
  return purpose == FilePurpose::open ? "Open" : purpose == FilePurpose::saveScene ? "Save as" : "Export";
}

}  // namespace

void showFileChooser(const PanelInput& in) {
  FileChooser& files = *in.files;
  const char* title = titleOfChooser(files.purpose());
  const std::string id = std::string(title) + "###files";
  const bool starts = files.isOpen() && !ImGui::IsPopupOpen(id.c_str());
  if (starts) ImGui::OpenPopup(id.c_str());
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float edge = 12 * in.scale;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, 0, {0.5f, 0.5f});
  ImGui::SetNextWindowSize(
      {std::min(window.x - 2 * edge, 620 * in.scale), std::min(window.y - 2 * edge, 460 * in.scale)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, std::max(1.0f, in.scale));
  const bool shown =
      ImGui::BeginPopupModal(id.c_str(), nullptr,
                             ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                 ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse);
  ImGui::PopStyleVar();
  if (!shown) return;
  showFolder(files);
  const bool stepped = pressed(ImGuiKey_DownArrow) || pressed(ImGuiKey_UpArrow);
  const int way = pressed(ImGuiKey_DownArrow) ? 1 : -1;
  if (stepped && ImGui::GetIO().KeyShift)
    files.extendStep(way);
  else if (stepped)
    files.step(way);
  const bool enters = pressed(ImGuiKey_Enter);
  const float line = ImGui::GetFrameHeightWithSpacing(), text = ImGui::GetTextLineHeightWithSpacing();
  const bool exports = files.purpose() == FilePurpose::exportFile;
  const float below = (exports ? 3 : 2) * line + (files.message().empty() ? 0 : 2 * text);
  bool take = showRows(files, std::max(ImGui::GetContentRegionAvail().y - below, 3 * text), stepped);
  showTyped(files, starts || enters);
  if (exports) showExportChoices(in, files);
  if (!files.message().empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.98f, 0.62f, 0.35f, 1));
    ImGui::TextWrapped("%s", files.message().c_str());
    ImGui::PopStyleColor();
  }
  const std::string label = files.purpose() != FilePurpose::open ? "Save (Enter)"
                            : files.count() > 1 ? fmt::format("Open {} files (Enter)", files.count())
                                                : "Open (Enter)";
  take |= ImGui::Button((label + "###take").c_str()) || enters;
  ImGui::SameLine();
  if (ImGui::Button("Cancel (Esc)")) files.close();
  if (!files.extensions().empty()) {
    ImGui::SameLine();
    bool all = files.allFiles();
    if (ImGui::Checkbox("All files", &all)) files.showAllFiles(all);
  }
  if (take)
    if (const auto file = files.enter()) in.state.chosenFiles = files.withOthers(*file);
  if (!files.isOpen()) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace vasa::viewer
