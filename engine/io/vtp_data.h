#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The data blocks of VTK's XML files.
namespace vasa::vtp {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
std::optional<Scalar> scalarNamed(std::string_view name);  ///< "Float64" ...
std::size_t sizeOf(Scalar scalar);

/// What the file's first element says about all blocks.
struct Encoding {
  bool wideHeader = false;  ///< lengths are 64 bits
  bool bigEndian = false;
  bool zlib = false;
};

/// How many bytes a block holds, before anything is unpacked; `fault` tells why nobody knows.
std::optional<std::uint64_t> contentBytes(std::span<const std::byte> block, const Encoding& encoding,
                                          std::string& fault);

/// The content of one block: behind its length, or its compressed pieces. `fault` tells why there is none.
std::optional<std::vector<std::byte>> unpack(std::span<const std::byte> block, const Encoding& encoding,
                                             std::string& fault);

/// The number at a place [bytes] as a 64-bit float; integers beyond 2^53 lose digits, which no use here
/// minds.
double numberAt(const std::byte* at, Scalar scalar, bool bigEndian);

}  // namespace vasa::vtp
