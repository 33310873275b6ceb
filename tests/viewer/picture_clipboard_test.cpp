#include "viewer/picture_clipboard.h"

#include <doctest/doctest.h>
#include <xcb/xcb.h>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>

#include "../view/virtual_display.h"

using namespace vasa::viewer;

namespace {

// Another program that pastes.
class Paster {
 public:
  Paster() : connection_(xcb_connect(nullptr, nullptr)), window_(xcb_generate_id(connection_)) {
    REQUIRE(xcb_connection_has_error(connection_) == 0);
    const xcb_screen_t* screen = xcb_setup_roots_iterator(xcb_get_setup(connection_)).data;
    xcb_create_window(connection_, XCB_COPY_FROM_PARENT, window_, screen->root, 0, 0, 1, 1, 0,
                      XCB_WINDOW_CLASS_INPUT_ONLY, XCB_COPY_FROM_PARENT, 0, nullptr);
  }
  Paster(const Paster&) = delete;
  Paster& operator=(const Paster&) = delete;
  ~Paster() { xcb_disconnect(connection_); }

  xcb_atom_t atom(const std::string& name) {
    const auto asked = xcb_intern_atom(connection_, 0, std::uint16_t(name.size()), name.data());
    xcb_intern_atom_reply_t* reply = xcb_intern_atom_reply(connection_, asked, nullptr);
    const xcb_atom_t found = reply->atom;
    std::free(reply);
    return found;
  }

  // What the clipboard holds of this kind; nothing where it holds none, or nobody answers.
  std::optional<std::string> paste(const std::string& kind) {
    const xcb_atom_t property = atom("PASTED");
    xcb_convert_selection(connection_, window_, atom("CLIPBOARD"), atom(kind), property, XCB_CURRENT_TIME);
    xcb_flush(connection_);
    for (int tries = 0; tries < 500; ++tries) {
      xcb_generic_event_t* event = xcb_poll_for_event(connection_);
      if (!event) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        continue;
      }
      const bool told = (event->response_type & 0x7f) == XCB_SELECTION_NOTIFY;
      const bool given =
          told && reinterpret_cast<xcb_selection_notify_event_t*>(event)->property != XCB_ATOM_NONE;
      std::free(event);
      if (told) return given ? std::optional(read(property)) : std::nullopt;
    }
    return std::nullopt;
  }

  // In place of what is there.
  void copy() {
    xcb_set_selection_owner(connection_, window_, atom("CLIPBOARD"), XCB_CURRENT_TIME);
    xcb_flush(connection_);
  }

 private:
  std::string read(xcb_atom_t property) {
    const auto asked =
        xcb_get_property(connection_, 1, window_, property, XCB_GET_PROPERTY_TYPE_ANY, 0, 1u << 24);
    xcb_get_property_reply_t* reply = xcb_get_property_reply(connection_, asked, nullptr);
    const std::string bytes(static_cast<const char*>(xcb_get_property_value(reply)),
                            std::size_t(xcb_get_property_value_length(reply)));
    std::free(reply);
    return bytes;
  }

  xcb_connection_t* connection_;
  xcb_window_t window_;
};

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

}  // namespace

TEST_CASE("another program pastes a copied picture, or its name, until something else is copied") {
  const vasa::test::VirtualDisplay display;
  REQUIRE(setenv("DISPLAY", display.variable().substr(8).c_str(), 1) == 0);
  PictureClipboard clipboard;
  Paster other;
  CHECK_FALSE(other.paste("image/png"));
  const std::string picture(1'500'000, 'p');  // as large as pictures are
  REQUIRE(clipboard.offer(bytesOf("an earlier one"), "/a/b.png"));
  REQUIRE(clipboard.offer(bytesOf(picture), "/a/c.png"));
  CHECK(other.paste("image/png") == picture);
  CHECK(other.paste("UTF8_STRING") == "/a/c.png");
  CHECK_FALSE(other.paste("image/jpeg"));
  const auto kinds = other.paste("TARGETS");
  REQUIRE(kinds);
  CHECK(kinds->size() == 3 * sizeof(xcb_atom_t));
  other.copy();
  CHECK_FALSE(other.paste("image/png"));
  CHECK(clipboard.offer(bytesOf("another"), "/a/d.png"));
  CHECK(other.paste("image/png") == "another");
}

TEST_CASE("without an X server nothing is offered") {
  REQUIRE(setenv("DISPLAY", ":987", 1) == 0);
  PictureClipboard clipboard;
  CHECK_FALSE(clipboard.offer(bytesOf("a picture"), "/a/b.png"));
}
