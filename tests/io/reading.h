#pragma once
#include <doctest/doctest.h>

#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "io/import_frame.h"
#include "support/shared_data.h"

namespace vasa::test {

inline const ImportFrame kMillimetres{0.001, ImportFrame::Up::y};

inline std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}

/// What was read is no input that is accepted, and the message says this.
template <class T>
void expectFault(const Result<T>& read, const char* message) {
  REQUIRE(!read.ok());
  CHECK(read.error().fault == Fault::badInput);
  CHECK_MESSAGE(read.error().message.find(message) != std::string::npos, read.error().message);
}

/// What a file that must be valid is read as.
inline Body bodyOf(GltfBuilder file) {
  const TemporaryFolder folder;
  auto result = readBody(writeBytes(folder.path() / "a.glb", file.glb()));
  REQUIRE_MESSAGE(result.ok(), (result ? "" : result.error().message));
  return std::move(result).value();
}

}  // namespace vasa::test
