#pragma once
#include <nlohmann/json_fwd.hpp>

#include "io/gltf_buffers.h"

namespace vasa::gltf {

/// Makes a document with compressed parts one without: buffer views of EXT_meshopt_compression and primitives
/// of KHR_draco_mesh_compression are decoded into buffers of their own, and the document names these instead.
/// Throws BrokenRule: data that cannot be decoded or that hold other amounts than the document says, and
/// parts that unpack to more than kUnpackedTimes their size and kUnpackedFreeMiB (io/read_limits.h).
/// @param document  has passed checkStructure; must pass it again afterwards, as views have moved
/// @return bytes unpacked; 0: nothing was compressed, and nothing has changed
std::size_t unpack(nlohmann::json& document, Buffers& buffers);

/// What to do about packed data that cannot be decoded.
inline constexpr const char* kDamaged = "export or download the file again";

/// Coders of meshes reach 5 to 30 to one on what scanners and artists make.
inline constexpr std::size_t kUnpackedTimes = 40, kUnpackedFreeMiB = 8;

/// One primitive's Draco data. Defined in gltf_draco.cpp, which alone knows the library.
/// @param place       of the primitive's extension
/// @param accessors   of the document; those of the primitive get a buffer view each
void unpackDraco(const JsonView& place, std::span<const std::byte> data, nlohmann::json& document,
                 nlohmann::json& primitive, Buffers& buffers);

/// Puts decoded bytes beside the others. @return the number of the new buffer view
std::size_t addView(nlohmann::json& document, Buffers& buffers, std::vector<std::byte> bytes);

}  // namespace vasa::gltf
