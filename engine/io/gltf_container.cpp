#include "io/gltf_container.h"

#include <cstdint>
#include <cstring>
#include <string>

#include "core/log.h"
#include "core/text_file.h"
#include "io/foreign_files.h"
#include "io/gltf_rule.h"
#include "io/read_limits.h"

// GLB (glTF 2.0, section 4.4): magic, version, total length; then chunks of length, type, payload. The first
// is JSON, the second may be BIN, further types are to be skipped. All numbers are little-endian 32-bit.
namespace vasa::gltf {
namespace {

constexpr std::uint64_t kHeaderBytes = 12;
constexpr std::uint64_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A;   // "JSON"
constexpr std::uint32_t kBin = 0x004E4942;    // "BIN"
constexpr const char* kIncomplete = "copy or download the file again";

std::uint32_t word(std::span<const std::byte> bytes, std::uint64_t at) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t(bytes[at + i]) << (8 * i);
  return value;
}

std::string atByte(std::uint64_t offset) { return "GLB byte " + std::to_string(offset); }

std::string_view asText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint64_t checkHeader(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  if (bytes.size() < kHeaderBytes)
    breaks(atByte(bytes.size()), "the file ends inside the 12-byte header", kIncomplete);
  if (word(bytes, 0) != kMagic) breaks(atByte(0), "does not begin with \"glTF\"", "give a glTF 2.0 file");
  if (word(bytes, 4) != 2)
    breaks(atByte(4), "container version " + std::to_string(word(bytes, 4)) + " must be 2",
           "export as glTF 2.0");
  const std::uint64_t length = word(bytes, 8);
  if (length < kHeaderBytes + kChunkHeaderBytes)
    breaks(atByte(8), "length " + std::to_string(length) + " has no room for a chunk", kExportAgain);
  if (length > bytes.size())
    breaks(atByte(8),
           "length " + std::to_string(length) + " is more than the file's " + std::to_string(bytes.size()) +
               " bytes",
           kIncomplete);
  if (length < bytes.size()) logWarning(path.string() + ": bytes after the end of the GLB are ignored");
  return length;
}

struct Chunk {
  std::uint32_t type;
  std::span<const std::byte> payload;
};

Chunk chunkAt(std::span<const std::byte> bytes, std::uint64_t offset) {
  if (offset + kChunkHeaderBytes > bytes.size())
    breaks(atByte(offset), "the file ends inside a chunk's header", kIncomplete);
  const std::uint64_t length = word(bytes, offset);
  if (length % 4 != 0)
    breaks(atByte(offset), "chunk length " + std::to_string(length) + " must be a multiple of 4",
           kExportAgain);
  if (offset + kChunkHeaderBytes + length > bytes.size())
    breaks(atByte(offset), "chunk of " + std::to_string(length) + " bytes reaches past the end", kIncomplete);
  return {word(bytes, offset + 4), bytes.subspan(offset + kChunkHeaderBytes, length)};
}

Container splitGlb(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  const std::uint64_t length = checkHeader(bytes, path);
  bytes = bytes.first(length);
  Container container;
  container.isGlb = true;
  std::size_t number = 0;
  for (std::uint64_t offset = kHeaderBytes; offset < length; ++number) {
    const Chunk chunk = chunkAt(bytes, offset);
    if (number == 0) {
      if (chunk.type != kJson) breaks(atByte(offset + 4), "the first chunk must be JSON", kExportAgain);
      if (chunk.payload.empty()) breaks(atByte(offset), "the JSON chunk is empty", kExportAgain);
      container.json = asText(chunk.payload);
    } else if (chunk.type == kJson) {
      breaks(atByte(offset + 4), "a second JSON chunk", kExportAgain);
    } else if (chunk.type == kBin) {
      if (container.binary) breaks(atByte(offset + 4), "a second BIN chunk", kExportAgain);
      if (number != 1) breaks(atByte(offset + 4), "the BIN chunk must be the second", kExportAgain);
      container.binary = chunk.payload;
    }
    offset += kChunkHeaderBytes + chunk.payload.size();
  }
  return container;
}

// Memory that the parsed document takes [bytes], rather too much than too little: a list's slots while it
// grows, a tree's nodes, texts.
constexpr std::size_t kASlot = 48, kAMember = 96, kAText = 48, kABracket = 64;

// @return the memory that the parsed document takes [bytes]
std::size_t checkNesting(std::string_view text) {
  std::size_t depth = 0, memory = 0, textBegin = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\')
        ++i;
      else if (c == '"') {
        inString = false;
        memory += kAText + (i - textBegin > 16 ? i - textBegin : 0);
      }
    } else if (c == '"') {
      inString = true;
      textBegin = i;
    } else if (c == ':') {
      memory += kAMember - kAText;  // its key has been counted
    } else if (c == ',') {
      memory += kASlot;
    } else if (c == '{' || c == '[') {
      memory += kABracket + kASlot;
      if (++depth > kMaximumNesting)
        breaks("JSON byte " + std::to_string(i),
               "nested more than " + std::to_string(kMaximumNesting) + " deep",
               "no glTF needs that: this is not a usable file");
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return memory;
}

bool isGlb(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  return (bytes.size() >= 4 && word(bytes, 0) == kMagic) || extensionOf(path) == ".glb";
}

}  // namespace

Container openContainer(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  if (const auto other = otherContent(asText(bytes)))
    breaks("byte 0", std::string(other->what), std::string(other->remedy));
  const Container container =
      isGlb(bytes, path) ? splitGlb(bytes, path) : Container{asText(bytes), std::nullopt, false};
  if (container.json.size() > kMaximumJsonBytes)
    breaks("JSON",
           std::to_string(container.json.size()) + " bytes are more than the " +
               std::to_string(kMaximumJsonBytes) + " that are accepted",
           "store data in binary buffers");
  if (container.json.starts_with("\xEF\xBB\xBF"))
    breaks("JSON byte 0", "begins with a byte order mark", "save the JSON as UTF-8 without one");
  const std::size_t memory = checkNesting(container.json), most = partOfMemory(bytes.size(), 11, 24);
  if (memory > most) breaks("JSON", beyondMemory(memory, most), "split or reduce the asset");
  return container;
}

}  // namespace vasa::gltf
