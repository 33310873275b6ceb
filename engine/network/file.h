#pragma once
#include <filesystem>

#include "core/result.h"
#include "network/network.h"

// The .vasa file. Little-endian:
//   header   "VASA", u32 version, u64 length of what follows, u64 XXH3 of what follows
//   chunks   four letters, u32 length, payload; unknown chunks are passed over
//     META   f32 body height [m]
//     VESL   count, then per vessel: u8 kind, name, ontology id, point count; of both texts the number of
//     bytes
//            that they share with the vessel's before, and the rest
//     NODE   count, then per node: u8 has host, [host vessel, f32 parameter], ends (2 · vessel + last)
//     PNTS   f32 x y z r a de Boor point (exact), or
//     PNTQ   f32 origin x y z, i8 exponent of the position step, f32 radius step, then u16 x y z r a point
//     PTCH   (only where patches were kept) count, then per patch: u8 rings, per ring: vessel, f32 parameter,
//     centre x y z,
//            outward x y z, radius, vertices of its loop; vertices, f32 origin x y z, i8 exponent of the
//            position step, per vertex u16 x y z and u8 a ring; triangles, three indices each
// Names together take at most four times the chunk's bytes and 16 MiB.
// Counts and lengths inside VESL, NODE and PTCH are LEB128; strings are a length and UTF-8 bytes.
namespace vasa {

struct NetworkFileOptions {
  /// 8 bytes a point instead of 16. Positions move by at most half a step, a power of two chosen from the
  /// network's extent (15 µm for a standing body); radii by at most 1/131070 of the largest.
  bool quantise = false;
};

/// The largest move of a point [m], per axis, that quantising this network causes.
float quantisationError(const Network& network);

std::vector<std::byte> encodeNetwork(const Network& network, NetworkFileOptions options = {});

/// @param name  of the file, for messages
Result<Network> decodeNetwork(std::span<const std::byte> bytes, const std::string& name);

/// Written atomically. @return the bytes written
Result<std::size_t> writeNetwork(const std::filesystem::path& path, const Network& network,
                                 NetworkFileOptions options = {});
Result<Network> readNetwork(const std::filesystem::path& path);

}  // namespace vasa
