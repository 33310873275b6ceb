#include "viewer/window.h"

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

#include "gpu/error.h"
#include "viewer/server_refusals.h"

// GLFW's keys are ours where they are printable; the others are listed.
namespace vasa::viewer {

struct Window::State {
  GLFWwindow* window = nullptr;
  std::vector<InputEvent> events;
  std::array<GLFWcursor*, 5> pointers{};
  Pointer pointer = Pointer::arrow;
  glm::ivec2 corner{0}, size{0};  // before it filled the screen
  ServerRefusals refusals;
};

namespace {

Key keyOfGlfw(int key) {
  if (key >= GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT) return Key(key);
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return Key(int(Key::f1) + key - GLFW_KEY_F1);
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return Key('0' + key - GLFW_KEY_KP_0);
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return Key::escape;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return Key::enter;
    case GLFW_KEY_TAB:
      return Key::tab;
    case GLFW_KEY_BACKSPACE:
      return Key::backspace;
    case GLFW_KEY_INSERT:
      return Key::insert;
    case GLFW_KEY_DELETE:
      return Key::del;
    case GLFW_KEY_RIGHT:
      return Key::right;
    case GLFW_KEY_LEFT:
      return Key::left;
    case GLFW_KEY_DOWN:
      return Key::down;
    case GLFW_KEY_UP:
      return Key::up;
    case GLFW_KEY_PAGE_UP:
      return Key::pageUp;
    case GLFW_KEY_PAGE_DOWN:
      return Key::pageDown;
    case GLFW_KEY_HOME:
      return Key::home;
    case GLFW_KEY_END:
      return Key::end;
    case GLFW_KEY_KP_DECIMAL:
      return Key::period;
    case GLFW_KEY_LEFT_SHIFT:
      return Key::leftShift;
    case GLFW_KEY_LEFT_CONTROL:
      return Key::leftControl;
    case GLFW_KEY_LEFT_ALT:
      return Key::leftAlt;
    case GLFW_KEY_RIGHT_SHIFT:
      return Key::rightShift;
    case GLFW_KEY_RIGHT_CONTROL:
      return Key::rightControl;
    case GLFW_KEY_RIGHT_ALT:
      return Key::rightAlt;
    default:
      return Key::none;
  }
}

std::string glfwError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

template <class Event>
void report(GLFWwindow* window, Event event) {
  static_cast<std::vector<InputEvent>*>(glfwGetWindowUserPointer(window))
      ->emplace_back(std::in_place_type<Event>, std::move(event));
}

// A window's coordinates are not its pixels on every system.
vec2 pixelsPerUnit(GLFWwindow* window) {
  int width = 1, height = 1, pixelsAcross = 1, pixelsDown = 1;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixelsAcross, &pixelsDown);
  if (width <= 0 || height <= 0) return vec2(1);
  return {float(pixelsAcross) / float(width), float(pixelsDown) / float(height)};
}

glm::ivec2 defaultSize() {
  glm::ivec2 size{1280, 720};
  GLFWmonitor* screen = glfwGetPrimaryMonitor();
  if (!screen) return size;
  vec2 scale{1};
  glm::ivec2 corner, room{0};
  glfwGetMonitorContentScale(screen, &scale.x, &scale.y);
  glfwGetMonitorWorkarea(screen, &corner.x, &corner.y, &room.x, &room.y);
  size = glm::ivec2(vec2(size) * glm::max(scale, 1.0f));
  return room.x > 0 && room.y > 0 ? glm::min(size, room) : size;
}

void listen(GLFWwindow* window) {
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    report(w, PointerMoved{vec2(x, y) * pixelsPerUnit(w)});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    if (button <= GLFW_MOUSE_BUTTON_MIDDLE) report(w, ButtonChanged{Button(button), action == GLFW_PRESS});
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { report(w, Scrolled{float(y)}); });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    if (const Key ours = keyOfGlfw(key); ours != Key::none)
      report(w, KeyChanged{ours, action != GLFW_RELEASE});
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned codepoint) { report(w, TextTyped{codepoint}); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int width, int height) {
    report(w, WindowResized{std::uint32_t(width), std::uint32_t(height)});
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) report(w, FileDropped{paths[i]});
  });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) {
    glfwSetWindowShouldClose(w, GLFW_FALSE);  // the app decides
    report(w, CloseAsked{});
  });
}

}  // namespace

Result<Window> Window::open(const std::string& title, std::uint32_t width, std::uint32_t height) {
  if (!glfwInit())
    return Error{
        Fault::failed,
        "no window can be opened (" + glfwError() +
            "); start vasa view on a desktop, or run it under xvfb-run; vasa render needs no window"};
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  const glm::ivec2 size = width > 0 ? glm::ivec2(width, height) : defaultSize();
  GLFWwindow* window = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
  if (!window) {
    const std::string reason = glfwError();
    glfwTerminate();
    return Error{Fault::failed, "the window cannot be opened (" + reason + ")"};
  }
  glfwSetWindowSizeLimits(window, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  auto* state = new State{.window = window};
  glfwSetWindowUserPointer(window, &state->events);
  const std::array shapes{GLFW_ARROW_CURSOR, GLFW_IBEAM_CURSOR, GLFW_HAND_CURSOR, GLFW_HRESIZE_CURSOR,
                          GLFW_VRESIZE_CURSOR};
  for (std::size_t i = 0; i < shapes.size(); ++i) state->pointers[i] = glfwCreateStandardCursor(shapes[i]);
  listen(window);
  return Window(state);
}

Window::Window(Window&& other) noexcept : state_(std::exchange(other.state_, nullptr)) {}

Window::~Window() {
  if (!state_) return;
  state_->refusals.hush();
  for (GLFWcursor* pointer : state_->pointers)
    if (pointer) glfwDestroyCursor(pointer);
  glfwDestroyWindow(state_->window);
  glfwTerminate();
  delete state_;
}

std::vector<const char*> Window::instanceExtensions() {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (!names)
    throw gpu::Error({Fault::noDevice, "no Vulkan driver here can draw into a window (" + glfwError() +
                                           "); install mesa-vulkan-drivers or your GPU's driver"});
  return {names, names + count};
}

VkSurfaceKHR Window::makeSurface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  gpu::check(glfwCreateWindowSurface(instance, state_->window, nullptr, &surface), "glfwCreateWindowSurface");
  return surface;
}

void Window::wait(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

std::vector<InputEvent> Window::takeEvents() { return std::exchange(state_->events, {}); }

void Window::wake() { glfwPostEmptyEvent(); }

std::uint32_t Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(state_->window, &width, &height);
  return glfwGetWindowAttrib(state_->window, GLFW_ICONIFIED) ? 0 : std::uint32_t(width);
}

std::uint32_t Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(state_->window, &width, &height);
  return glfwGetWindowAttrib(state_->window, GLFW_ICONIFIED) ? 0 : std::uint32_t(height);
}

float Window::scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(state_->window, &x, &y);
  return y > 0 ? y : 1;
}

void Window::resize(std::uint32_t width, std::uint32_t height) {
  const vec2 pixels = pixelsPerUnit(state_->window);
  glfwSetWindowSize(state_->window, int(float(width) / pixels.x), int(float(height) / pixels.y));
}

// The screen that has most of it.
bool Window::setFullScreen(bool on) {
  GLFWwindow* const window = state_->window;
  if (!on) {
    if (state_->size.x > 0)
      glfwSetWindowMonitor(window, nullptr, state_->corner.x, state_->corner.y, state_->size.x,
                           state_->size.y, GLFW_DONT_CARE);
    return false;
  }
  glfwGetWindowPos(window, &state_->corner.x, &state_->corner.y);
  glfwGetWindowSize(window, &state_->size.x, &state_->size.y);
  int count = 0, most = 0;
  GLFWmonitor* best = glfwGetPrimaryMonitor();
  GLFWmonitor** screens = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    glm::ivec2 at{0};
    glfwGetMonitorPos(screens[i], &at.x, &at.y);
    const GLFWvidmode* mode = glfwGetVideoMode(screens[i]);
    if (!mode) continue;
    const glm::ivec2 shared =
        glm::min(at + glm::ivec2(mode->width, mode->height), state_->corner + state_->size) -
        glm::max(at, state_->corner);
    const int area = std::max(shared.x, 0) * std::max(shared.y, 0);
    if (area > most) most = area, best = screens[i];
  }
  const GLFWvidmode* mode = best ? glfwGetVideoMode(best) : nullptr;
  if (!mode) return false;
  glfwSetWindowMonitor(window, best, 0, 0, mode->width, mode->height, mode->refreshRate);
  return true;
}

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(state_->window, title.c_str()); }

void Window::setPointer(Pointer pointer) {
  if (pointer == state_->pointer) return;
  state_->pointer = pointer;
  glfwSetCursor(state_->window, state_->pointers[std::size_t(pointer)]);
}

GLFWwindow* Window::handle() const { return state_->window; }

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(state_->window);
  return text ? text : "";
}

void Window::setClipboard(const std::string& text) { glfwSetClipboardString(state_->window, text.c_str()); }

}  // namespace vasa::viewer
