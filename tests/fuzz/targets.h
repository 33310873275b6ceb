#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

// What is done with hostile bytes, a function a kind of file. Each reads them as that kind; what is accepted
// is used as the program uses it and must hold to what its header promises (std::abort where it does not).
namespace vasa::fuzz {

using Bytes = std::span<const std::byte>;

void swc(Bytes bytes);
void markups(Bytes bytes);
void vtk(Bytes bytes);
void vtp(Bytes bytes);
void bvh(Bytes bytes);
void obj(Bytes bytes);
void stl(Bytes bytes);
void gltf(Bytes bytes);   ///< .glb or .gltf, as a body and as vessels
void map(Bytes bytes);    ///< pairs of joints
void rules(Bytes bytes);  ///< of growth; behind a line `---` their regions
void scene(Bytes bytes);  ///< a scene's JSON
void vasa(Bytes bytes);   ///< a network's chunks: header and checksum are made to fit
void vedit(Bytes bytes);  ///< a journal of edits
void replay(
    Bytes bytes);  ///< one of at most three, made on two vessels: thousands of times slower than its reading

struct Target {
  const char* name;  ///< also of its folder in corpus/
  void (*run)(Bytes);
};
std::span<const Target> targets();

}  // namespace vasa::fuzz
