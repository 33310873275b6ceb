#pragma once
#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace vasa {

/// Why something could not be done. The values are the process's exit codes.
enum class Fault : int {
  failed = 1,          ///< anything else
  usage = 2,           ///< the command line is wrong
  badInput = 3,        ///< a file's content is wrong, or two inputs do not fit together
  noDevice = 4,        ///< no usable Vulkan device
  deviceLost = 5,      ///< the Vulkan device went away
  io = 6,              ///< a file could not be read or written
  resumeMismatch = 7,  ///< --resume found output of another run
  interrupted = 130,   ///< SIGINT
  terminated = 143,    ///< SIGTERM
};

/// What went wrong, for a person: the message names file, place, cause and remedy.
struct Error {
  Fault fault = Fault::failed;
  std::string message;
};

inline Error badInput(std::string message) { return {Fault::badInput, std::move(message)}; }
inline Error ioError(std::string message) { return {Fault::io, std::move(message)}; }

/// A value, or the error that stood in its way.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return assert(ok()), std::get<0>(state_); }
  const T& value() const& { return assert(ok()), std::get<0>(state_); }
  T&& value() && { return assert(ok()), std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const { return assert(!ok()), std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or the error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), ok_(false) {}
  bool ok() const { return ok_; }
  explicit operator bool() const { return ok_; }
  const Error& error() const { return assert(!ok_), error_; }

 private:
  Error error_;
  bool ok_ = true;
};

}  // namespace vasa
