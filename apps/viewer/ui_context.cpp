#include "viewer/ui_context.h"

#include <imgui.h>
#include <imgui_internal.h>  // closing popups

#include <filesystem>

#include "viewer/font.h"

namespace vasa::viewer {
namespace {

constexpr float kFontPixels = 15;
static_assert(int(Key::last) < 512, "ImGui has room for 512 keys");

void mapKeys(ImGuiIO& io) {
  const auto map = [&](ImGuiKey theirs, Key ours) { io.KeyMap[theirs] = int(ours); };
  map(ImGuiKey_Tab, Key::tab);
  map(ImGuiKey_LeftArrow, Key::left);
  map(ImGuiKey_RightArrow, Key::right);
  map(ImGuiKey_UpArrow, Key::up);
  map(ImGuiKey_DownArrow, Key::down);
  map(ImGuiKey_PageUp, Key::pageUp);
  map(ImGuiKey_PageDown, Key::pageDown);
  map(ImGuiKey_Home, Key::home);
  map(ImGuiKey_End, Key::end);
  map(ImGuiKey_Insert, Key::insert);
  map(ImGuiKey_Delete, Key::del);
  map(ImGuiKey_Backspace, Key::backspace);
  map(ImGuiKey_Space, Key::space);
  map(ImGuiKey_Enter, Key::enter);
  map(ImGuiKey_Escape, Key::escape);
  for (const char letter : {'A', 'C', 'V', 'X', 'Y', 'Z'})
    map(letter == 'A'   ? ImGuiKey_A
        : letter == 'C' ? ImGuiKey_C
        : letter == 'V' ? ImGuiKey_V
        : letter == 'X' ? ImGuiKey_X
        : letter == 'Y' ? ImGuiKey_Y
                        : ImGuiKey_Z,
        keyOf(letter));
}

// A quiet grey desk, so that the picture has the colours; one accent, the arteries' red.
void setStyle(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.WindowBorderSize = 0;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.PopupRounding = 4;
  style.ScrollbarRounding = 4;
  style.WindowPadding = {12, 10};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.ScrollbarSize = 12;
  style.GrabMinSize = 12;
  ImVec4* colours = style.Colors;
  colours[ImGuiCol_Text] = {0.90f, 0.91f, 0.92f, 1};
  colours[ImGuiCol_TextDisabled] = {0.60f, 0.62f, 0.65f, 1};
  colours[ImGuiCol_WindowBg] = {0.13f, 0.135f, 0.145f, 1};
  colours[ImGuiCol_ChildBg] = colours[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  colours[ImGuiCol_PopupBg] = {0.16f, 0.165f, 0.175f, 1};
  colours[ImGuiCol_Border] = {0.27f, 0.28f, 0.30f, 1};
  colours[ImGuiCol_FrameBg] = {0.21f, 0.215f, 0.23f, 1};
  colours[ImGuiCol_FrameBgHovered] = {0.27f, 0.275f, 0.295f, 1};
  colours[ImGuiCol_FrameBgActive] = {0.31f, 0.315f, 0.335f, 1};
  const ImVec4 accent{0.83f, 0.32f, 0.29f, 1}, bright{0.93f, 0.42f, 0.38f, 1}, dim{0.50f, 0.22f, 0.21f, 1};
  colours[ImGuiCol_CheckMark] = colours[ImGuiCol_SliderGrab] = accent;
  colours[ImGuiCol_SliderGrabActive] = bright;
  colours[ImGuiCol_Button] = {0.25f, 0.255f, 0.275f, 1};
  colours[ImGuiCol_ButtonHovered] = {0.33f, 0.335f, 0.36f, 1};
  colours[ImGuiCol_ButtonActive] = dim;
  colours[ImGuiCol_Header] = {0.20f, 0.205f, 0.22f, 1};
  colours[ImGuiCol_HeaderHovered] = {0.27f, 0.275f, 0.295f, 1};
  colours[ImGuiCol_HeaderActive] = dim;
  colours[ImGuiCol_PlotHistogram] = colours[ImGuiCol_PlotLines] = accent;
  colours[ImGuiCol_PlotLinesHovered] = bright;
  colours[ImGuiCol_TextSelectedBg] = dim;
  colours[ImGuiCol_TableHeaderBg] = {0.18f, 0.185f, 0.20f, 1};
  colours[ImGuiCol_NavHighlight] = accent;
  colours[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0};  // pictures below are not drawn anew (UiChanges)
  colours[ImGuiCol_TitleBgActive] = colours[ImGuiCol_TitleBg] = colours[ImGuiCol_Header];
  style.ScaleAllSizes(scale);
}

void addFonts(ImGuiIO& io, float scale) {
  static const ImWchar letters[] = {0x20,   0x17f,  0x2010, 0x2027, 0x2030, 0x203a, 0x2080,
                                    0x209c, 0x2190, 0x2193, 0x2248, 0x2265, 0};
  std::error_code ignored;
  if (std::filesystem::exists(kFontFile, ignored)) {
    io.Fonts->AddFontFromFileTTF(kFontFile, kFontPixels * scale, nullptr, letters);
  } else {
    ImFontConfig config;
    config.SizePixels = 13 * scale;
    io.Fonts->AddFontDefault(&config);
  }
}

struct Feeder {
  ImGuiIO& io;
  void operator()(const PointerMoved& event) { io.MousePos = {event.place.x, event.place.y}; }
  void operator()(const ButtonChanged& event) { io.MouseDown[int(event.button)] = event.down; }
  void operator()(const Scrolled& event) { io.MouseWheel += event.steps; }
  void operator()(const KeyChanged& event) {
    const auto down = [&](Key key) { return io.KeysDown[int(key)]; };
    io.KeysDown[int(event.key)] = event.down;
    io.KeyCtrl = down(Key::leftControl) || down(Key::rightControl);
    io.KeyShift = down(Key::leftShift) || down(Key::rightShift);
    io.KeyAlt = down(Key::leftAlt) || down(Key::rightAlt);
  }
  void operator()(const TextTyped& event) { io.AddInputCharacter(event.codepoint); }
  void operator()(const WindowResized&) {}
  void operator()(const FileDropped&) {}
  void operator()(const CloseAsked&) {}
};

}  // namespace

UiContext::UiContext(float scale) : scale_(scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // settings are kept by settings.h
  io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  io.BackendPlatformName = "vasa";
  mapKeys(io);
  setStyle(scale);
  addFonts(io, scale);
}

UiContext::~UiContext() { ImGui::DestroyContext(); }

void UiContext::feed(const InputEvent& event) {
  std::visit(Feeder{ImGui::GetIO()}, event);
  // ImGui takes what is marked in a menu by Space alone.
  if (const auto* key = std::get_if<KeyChanged>(&event);
      key && key->key == Key::enter && (inMenu() || !key->down))
    ImGui::GetIO().KeysDown[int(Key::space)] = key->down;
}

bool UiContext::wantsPointer() const { return ImGui::GetIO().WantCaptureMouse; }

bool UiContext::isHeld() const { return ImGui::IsAnyItemActive(); }

bool UiContext::wantsKeys() const { return ImGui::GetIO().WantTextInput; }

bool UiContext::closePopups() {
  if (ImGui::GetCurrentContext()->OpenPopupStack.empty()) return false;
  ImGui::ClosePopupToLevel(0, true);
  return true;
}

bool UiContext::inMenu() const {
  const auto& open = ImGui::GetCurrentContext()->OpenPopupStack;
  return !open.empty() && !(open.front().Window && open.front().Window->Flags & ImGuiWindowFlags_Modal);
}

void UiContext::useKeysInMenus(bool on) {
  ImGuiIO& io = ImGui::GetIO();
  if (on)
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  else
    io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
}

bool UiContext::alt() const { return ImGui::GetIO().KeyAlt; }

Window::Pointer UiContext::pointer() const {
  switch (ImGui::GetMouseCursor()) {
    case ImGuiMouseCursor_TextInput:
      return Window::Pointer::text;
    case ImGuiMouseCursor_Hand:
      return Window::Pointer::hand;
    case ImGuiMouseCursor_ResizeEW:
      return Window::Pointer::resizeAcross;
    case ImGuiMouseCursor_ResizeNS:
      return Window::Pointer::resizeDown;
    default:
      return Window::Pointer::arrow;
  }
}

void UiContext::begin(std::uint32_t width, std::uint32_t height, double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {float(width), float(height)};
  io.DeltaTime = std::max(float(seconds), 1e-4f);
  ImGui::NewFrame();
}

ImDrawData& UiContext::end() {
  ImGui::Render();
  return *ImGui::GetDrawData();
}

void UiContext::useClipboard(Window& window) {
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = &window;
  io.SetClipboardTextFn = [](void* user, const char* text) {
    static_cast<Window*>(user)->setClipboard(text);
  };
  io.GetClipboardTextFn = [](void* user) {
    static std::string kept;  // ImGui reads it after the call
    kept = static_cast<Window*>(user)->clipboard();
    return kept.c_str();
  };
}

}  // namespace vasa::viewer
