#include "gpu/pushed_addresses.h"

#include <algorithm>
#include <map>
#include <utility>

namespace vasa::gpu {
namespace {

// The few instructions and words of SPIR-V (Khronos, SPIR-V specification 1.6, sections 2.3 and 3) that
// declare types and how their members are decorated.
constexpr std::uint32_t kHeaderWords = 5;
constexpr std::uint32_t kTypeStruct = 30, kTypePointer = 32, kVariable = 59, kMemberDecorate = 72;
constexpr std::uint32_t kNonWritable = 24, kOffset = 35;
constexpr std::uint32_t kPushConstant = 9, kPhysicalStorageBuffer = 5349;

struct Pointer {
  std::uint32_t storage = 0;
  std::uint32_t pointee = 0;
};

struct Module {
  std::map<std::uint32_t, std::vector<std::uint32_t>> structs;  // id -> types of its members
  std::map<std::uint32_t, Pointer> pointers;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> offsets;  // (struct, member)
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> readOnly;
  std::uint32_t pushBlock = 0;  // the type of the push constants

  explicit Module(std::span<const std::uint32_t> words) {
    for (std::size_t at = kHeaderWords; at < words.size();) {
      const std::uint32_t length = words[at] >> 16;
      if (length == 0 || at + length > words.size()) return;
      read(words[at] & 0xffffu, words.subspan(at + 1, length - 1));
      at += length;
    }
  }

  void read(std::uint32_t operation, std::span<const std::uint32_t> operands) {
    if (operation == kTypeStruct) {
      structs[operands[0]] = {operands.begin() + 1, operands.end()};
    } else if (operation == kTypePointer) {
      pointers[operands[0]] = {operands[1], operands[2]};
    } else if (operation == kVariable && operands[2] == kPushConstant) {
      pushBlock = pointers[operands[0]].pointee;
    } else if (operation == kMemberDecorate && operands[2] == kOffset) {
      offsets[{operands[0], operands[1]}] = operands[3];
    } else if (operation == kMemberDecorate && operands[2] == kNonWritable) {
      readOnly[{operands[0], operands[1]}] = true;
    }
  }

  bool isWritten(std::uint32_t block) const {
    const auto members = structs.find(block);
    if (members == structs.end()) return true;
    for (std::uint32_t member = 0; member < members->second.size(); ++member)
      if (!readOnly.contains({block, member})) return true;
    return false;
  }

  void collect(std::uint32_t block, std::uint32_t base, std::vector<PushedAddress>& found) const {
    const auto members = structs.find(block);
    if (members == structs.end()) return;
    for (std::uint32_t member = 0; member < members->second.size(); ++member) {
      const auto offset = offsets.find({block, member});
      const std::uint32_t place = base + (offset == offsets.end() ? 0 : offset->second);
      const std::uint32_t type = members->second[member];
      if (const auto pointer = pointers.find(type); pointer == pointers.end())
        collect(type, place, found);
      else if (pointer->second.storage == kPhysicalStorageBuffer)
        found.push_back({place, isWritten(pointer->second.pointee)});
    }
  }
};

}  // namespace

std::vector<PushedAddress> pushedAddresses(const ShaderCode& code) {
  const Module module(code.words);
  std::vector<PushedAddress> found;
  module.collect(module.pushBlock, 0, found);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace vasa::gpu
