#include "viewer/picture_clipboard.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <xcb/xcb.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <span>
#include <string_view>
#include <thread>
#include <utility>

namespace vasa::viewer {
namespace {

template <class Reply>
using Owned = std::unique_ptr<Reply, decltype(&std::free)>;

template <class Reply>
Owned<Reply> owned(Reply* reply) {
  return {reply, &std::free};
}

constexpr std::uint32_t kHead = 64;  // [bytes] more than what a request has before its data

}  // namespace

struct PictureClipboard::State {
  xcb_connection_t* connection = xcb_connect(nullptr, nullptr);
  xcb_window_t window = 0;
  xcb_atom_t clipboard = 0, targets = 0, png = 0, text = 0;
  int wake = eventfd(0, EFD_CLOEXEC);
  std::atomic<bool> ends{false};
  std::mutex mutex;  // of what is offered
  std::vector<std::byte> picture;
  std::string name;
  std::thread answers;

  bool works() const { return wake >= 0 && xcb_connection_has_error(connection) == 0; }
  void begin();
  void rouse() const;
  void answer();
  void answer(const xcb_selection_request_event_t& asked);
  bool put(const xcb_selection_request_event_t& asked, xcb_atom_t property);
};

void PictureClipboard::State::begin() {
  const auto atom = [&](std::string_view called) {
    const auto asked = xcb_intern_atom(connection, 0, std::uint16_t(called.size()), called.data());
    const auto reply = owned(xcb_intern_atom_reply(connection, asked, nullptr));
    return reply ? reply->atom : xcb_atom_t(XCB_ATOM_NONE);
  };
  clipboard = atom("CLIPBOARD"), targets = atom("TARGETS"), png = atom("image/png"),
  text = atom("UTF8_STRING");
  window = xcb_generate_id(connection);
  const xcb_screen_t* screen = xcb_setup_roots_iterator(xcb_get_setup(connection)).data;
  xcb_create_window(connection, XCB_COPY_FROM_PARENT, window, screen->root, 0, 0, 1, 1, 0,
                    XCB_WINDOW_CLASS_INPUT_ONLY, XCB_COPY_FROM_PARENT, 0, nullptr);  // never shown
  xcb_flush(connection);
  answers = std::thread([this] { answer(); });
}

// Until the object goes or the server does.
void PictureClipboard::State::answer() {
  std::array<pollfd, 2> either{{{xcb_get_file_descriptor(connection), POLLIN, 0}, {wake, POLLIN, 0}}};
  while (!ends && works()) {
    while (const auto event = owned(xcb_poll_for_event(connection))) {
      const int kind = event->response_type & 0x7f;
      if (kind == XCB_SELECTION_REQUEST)
        answer(reinterpret_cast<const xcb_selection_request_event_t&>(*event));
      if (kind == XCB_SELECTION_CLEAR) {  // something else was copied
        const std::lock_guard lock(mutex);
        picture.clear();
        name.clear();
      }
    }
    if (ends) return;
    poll(either.data(), either.size(), -1);
    std::uint64_t count = 0;
    if (either[1].revents != 0 && read(wake, &count, sizeof(count)) < 0) return;
  }
}

void PictureClipboard::State::rouse() const {
  const std::uint64_t one = 1;
  (void)!write(wake, &one, sizeof(one));
}

// Onto the window of who asks. What would not fit into one request is refused.
bool PictureClipboard::State::put(const xcb_selection_request_event_t& asked, xcb_atom_t property) {
  const auto set = [&](xcb_atom_t type, std::uint8_t bits, std::span<const std::byte> bytes) {
    if (bytes.empty() || bytes.size() + kHead > std::size_t(4) * xcb_get_maximum_request_length(connection))
      return false;
    xcb_change_property(connection, XCB_PROP_MODE_REPLACE, asked.requestor, property, type, bits,
                        std::uint32_t(bytes.size() / (bits / 8)), bytes.data());
    return true;
  };
  const std::lock_guard lock(mutex);
  const std::array kinds{targets, png, text};
  if (asked.target == targets) return set(XCB_ATOM_ATOM, 32, std::as_bytes(std::span(kinds)));
  if (asked.target == png) return set(png, 8, picture);
  if (asked.target == text) return set(text, 8, std::as_bytes(std::span(std::as_const(name))));
  return false;
}

void PictureClipboard::State::answer(const xcb_selection_request_event_t& asked) {
  const xcb_atom_t property = asked.property != XCB_ATOM_NONE ? asked.property : asked.target;
  xcb_selection_notify_event_t told{};
  told.response_type = XCB_SELECTION_NOTIFY;
  told.time = asked.time;
  told.requestor = asked.requestor;
  told.selection = asked.selection;
  told.target = asked.target;
  told.property = put(asked, property) ? property : xcb_atom_t(XCB_ATOM_NONE);
  static_assert(sizeof(told) <= 32);
  std::array<char, 32> event{};  // that long on the wire
  std::copy_n(reinterpret_cast<const char*>(&told), sizeof(told), event.data());
  xcb_send_event(connection, 0, asked.requestor, 0, event.data());
  xcb_flush(connection);
}

PictureClipboard::PictureClipboard() : state_(std::make_unique<State>()) {
  if (state_->works()) state_->begin();
}

PictureClipboard::~PictureClipboard() {
  state_->ends = true;
  if (state_->answers.joinable()) state_->rouse(), state_->answers.join();
  if (state_->wake >= 0) close(state_->wake);
  xcb_disconnect(state_->connection);
}

bool PictureClipboard::offer(std::vector<std::byte> png, std::string name) {
  if (!state_->answers.joinable() || !state_->works()) return false;
  {
    const std::lock_guard lock(state_->mutex);
    state_->picture = std::move(png);
    state_->name = std::move(name);
  }
  xcb_connection_t* connection = state_->connection;
  xcb_set_selection_owner(connection, state_->window, state_->clipboard, XCB_CURRENT_TIME);
  const auto asked = xcb_get_selection_owner(connection, state_->clipboard);
  const auto owner = owned(xcb_get_selection_owner_reply(connection, asked, nullptr));
  state_->rouse();  // who waits for a reply takes events from the socket, too
  return owner && owner->owner == state_->window;
}

}  // namespace vasa::viewer
