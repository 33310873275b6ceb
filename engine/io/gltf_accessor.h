#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/gltf_asset.h"

namespace vasa::gltf {

/// How one element of an accessor lies in memory. Matrix columns begin at multiples of four bytes.
struct ElementLayout {
  std::uint32_t componentBytes = 0;
  std::uint32_t rows = 0;     ///< components of a vector, or of a matrix column
  std::uint32_t columns = 0;  ///< 1 for scalars and vectors

  std::uint32_t components() const { return rows * columns; }
  std::uint32_t columnBytes() const {
    return columns > 1 ? (rows * componentBytes + 3) / 4 * 4 : rows * componentBytes;
  }
  /// Without the padding after a matrix's last column, which need not be there.
  std::uint32_t bytes() const { return (columns - 1) * columnBytes() + rows * componentBytes; }
  /// Distance of neighbours where the buffer view gives no stride.
  std::uint32_t packedBytes() const { return columns * columnBytes(); }
};

/// 0 for anything but the six component types of glTF.
std::uint32_t componentBytes(std::int64_t componentType);
bool isFloatComponent(std::int64_t componentType);

/// @param type  "SCALAR", "VEC2" ... "MAT4"; rows stays 0 for anything else
ElementLayout elementLayout(std::int64_t componentType, const std::string& type);
ElementLayout elementLayout(const Model::Accessor& accessor);

inline constexpr std::size_t kAll = ~std::size_t(0);

/// Whether the accessor's bytes are in the file. One without a buffer view is all zeros and counts as there.
bool hasData(const Asset& asset, int accessor);

/// Whether it has bytes of its own at all, be it a sparse part only.
bool isStored(const Asset& asset, int accessor);

/// All components of all elements in order, sparse values put in, normalised integers mapped to [0, 1] or
/// [-1, 1] (glTF 2.0, 3.11). Throws BrokenRule where the data is not in the file.
/// @param atMost  elements to read, from the first
std::vector<float> readFloats(const Asset& asset, int accessor, std::size_t atMost = kAll);

/// The same for integers (indices, joints).
std::vector<std::uint32_t> readIntegers(const Asset& asset, int accessor);

/// The positions that a sparse accessor overrides; empty for others.
std::vector<std::uint32_t> readSparseIndices(const Asset& asset, int accessor);

}  // namespace vasa::gltf
