#include "report.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/visible.h"

namespace vasa::cli {

Result<void> printBytes(std::span<const std::byte> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
    if (errno == EPIPE) throw ReaderGone{};
    return ioError(std::string("standard output: cannot write: ") + std::strerror(errno));
  }
  return {};
}

Result<void> printText(const std::string& text) {
  const std::string shown = visibleLines(text);
  return printBytes(std::as_bytes(std::span(shown)));
}

std::string asArgument(const std::string& path) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789./_-+,:@%=";
  if (!path.empty() && path.find_first_not_of(kPlain) == path.npos) return path;
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string plainText(const Report& value) {
  if (value.is_string()) return visible(value.get<std::string>());
  return value.is_number_float() ? fmt::format("{:.6g}", value.get<double>()) : value.dump();
}

Result<void> printJson(const Report& report) {
  // Names come from files: bytes that are no UTF-8 are replaced rather than refused.
  return printText(report.dump(2, ' ', false, Report::error_handler_t::replace) + "\n");
}

}  // namespace vasa::cli
