#include "viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include <cstdlib>

#include "view/virtual_display.h"

using namespace vasa;
using namespace vasa::viewer;
using namespace vasa::test;

TEST_CASE("what a window system reports of a window becomes our events, in its order") {
  const VirtualDisplay display(192);
  const std::string name = display.variable().substr(std::string("DISPLAY=").size());
  REQUIRE(setenv("DISPLAY", name.c_str(), 1) == 0);
  {
    auto window = viewer::Window::open("test", 0, 0);
    REQUIRE(window);
    CHECK(window->scale() == doctest::Approx(2));
    CHECK(window->width() == 2560);
    CHECK(window->height() == 1440);
    GLFWwindow* const handle = window->handle();
    window->takeEvents();
    // GLFW hands out its callbacks when others take their place.
    const char* dropped[] = {"/somewhere/body.glb", "/somewhere/vessels.vasa"};
    glfwSetDropCallback(handle, nullptr)(handle, 2, dropped);
    glfwSetScrollCallback(handle, nullptr)(handle, 0, -1.5);
    glfwSetKeyCallback(handle, nullptr)(handle, GLFW_KEY_KP_ENTER, 0, GLFW_PRESS, 0);
    glfwSetWindowCloseCallback(handle, nullptr)(handle);
    const auto events = window->takeEvents();
    REQUIRE(events.size() == 5);
    CHECK(std::get<FileDropped>(events[0]).path == "/somewhere/body.glb");
    CHECK(std::get<FileDropped>(events[1]).path == "/somewhere/vessels.vasa");
    CHECK(std::get<Scrolled>(events[2]).steps == -1.5f);
    CHECK(std::get<KeyChanged>(events[3]).key == Key::enter);
    CHECK(std::holds_alternative<CloseAsked>(events[4]));
    CHECK_FALSE(glfwWindowShouldClose(handle));  // the app decides
    CHECK(window->takeEvents().empty());
  }
  unsetenv("DISPLAY");
}
