#include "viewer/server_refusals.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "view/virtual_display.h"
#include "viewer/window.h"

// Last, for its macros.
#include <X11/Xlib.h>

// GLFW's header for it asks for Xrandr's, too.
extern "C" Display* glfwGetX11Display();

using namespace vasa;

TEST_CASE("what the X server refuses does not end the program") {
  const test::VirtualDisplay display;
  const std::string name = display.variable().substr(std::string("DISPLAY=").size());
  REQUIRE(setenv("DISPLAY", name.c_str(), 1) == 0);
  {
    auto window = viewer::Window::open("test", 320, 240);
    REQUIRE(window);
    Display* const server = glfwGetX11Display();
    constexpr XID noWindow = 1;
    XMapWindow(server, noWindow);
    XSync(server, False);
    window->resize(400, 300);
    window->wait(0);
    CHECK(window->width() == 400);
    XMapWindow(server, noWindow);  // looked at when the window has gone
  }
  const auto after = XSetErrorHandler(nullptr), xlibs = XSetErrorHandler(nullptr);
  CHECK((after == xlibs));
  unsetenv("DISPLAY");
}
