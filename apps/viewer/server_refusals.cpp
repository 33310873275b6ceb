#include "viewer/server_refusals.h"

#include <X11/Xlib.h>
#include <fmt/format.h>

#include <array>

#include "core/log.h"

namespace vasa::viewer {
namespace {

bool warns = false;  // Xlib's handler is one for the whole program

int tell(Display* display, XErrorEvent* refused) {
  std::array<char, 256> reason{};
  XGetErrorText(display, refused->error_code, reason.data(), int(reason.size()));
  const std::string text = fmt::format("the X server refuses request {}.{}: {}; the session goes on",
                                       refused->request_code, refused->minor_code, reason.data());
  if (warns)
    logWarning(text);
  else
    logDetail(text);
  warns = false;
  return 0;
}

}  // namespace

ServerRefusals::ServerRefusals() {
  warns = true;
  XSetErrorHandler(tell);
}

ServerRefusals::~ServerRefusals() { XSetErrorHandler(nullptr); }

void ServerRefusals::hush() { warns = false; }

}  // namespace vasa::viewer
