#include "report.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace vasa::cli {

Result<void> printText(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    return ioError(std::string("standard output: cannot write: ") + std::strerror(errno));
  return {};
}

std::string plainText(const Report& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{:.6g}", value.get<double>()) : value.dump();
}

Result<void> printJson(const Report& report) {
  // Names come from files: bytes that are no UTF-8 are replaced rather than refused.
  return printText(report.dump(2, ' ', false, Report::error_handler_t::replace) + "\n");
}

}  // namespace vasa::cli
