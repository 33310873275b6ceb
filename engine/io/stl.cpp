#include "io/stl.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>
#include <tuple>

#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/letters.h"
#include "core/text_file.h"
#include "io/words.h"

namespace vasa {
namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50;

// Facets with their own corners -> shared vertices, corners at the same place only, numbered as they come.
// Sorted and not hashed: places can be chosen so that they all meet in one place of a hash table.
class Welder {
 public:
  void reserve(std::size_t facets) { corners_.reserve(3 * facets); }
  void add(vec3 p) { corners_.push_back(p + vec3(0)); }  // -0 and +0 are one place

  TriangleMesh mesh() const {
    std::vector<std::uint32_t> order(corners_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [this](std::uint32_t i) {
      return std::tuple(corners_[i].x, corners_[i].y, corners_[i].z, i);
    });
    std::vector<std::uint32_t> first(corners_.size());  // of each corner, the first at its place
    for (std::size_t k = 0; k < order.size(); ++k)
      first[order[k]] =
          k > 0 && corners_[order[k]] == corners_[order[k - 1]] ? first[order[k - 1]] : order[k];
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < corners_.size();
         ++i) {  // the first comes before the others: its number is known by then
      if (first[i] == i) {
        first[i] = std::uint32_t(mesh.positions.size());
        mesh.positions.push_back(corners_[i]);
      } else {
        first[i] = first[first[i]];
      }
    }
    for (std::size_t i = 0; i + 2 < first.size(); i += 3)
      if (const uvec3 t(first[i], first[i + 1], first[i + 2]); t.x != t.y && t.y != t.z && t.z != t.x)
        mesh.triangles.push_back(t);
    return mesh;
  }

 private:
  std::vector<vec3> corners_;
};

std::string coordinateFault(dvec3 p, const ImportFrame& frame) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return "a coordinate is not finite";
  if (glm::length(p) * frame.metresPerUnit > kLargestImportedCoordinate)
    return "a coordinate is farther than 1000 km away; give the file's unit with vasa convert --unit";
  return {};
}

std::uint32_t littleEndian(const std::byte* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value |= std::uint32_t(bytes[i]) << (8 * i);
  return value;
}

Result<std::vector<MeshElement>> readBinary(const std::string& file, const std::string& name,
                                            std::span<const std::byte> bytes, const ImportFrame& frame) {
  std::uint64_t count = littleEndian(bytes.data() + 80);
  // Programs that write as they go cannot go back to say how many there were.
  if (const std::size_t rest = bytes.size() - kHeaderBytes; count == 0 && rest % kFacetBytes == 0)
    count = rest / kFacetBytes;
  if (bytes.size() < kHeaderBytes + count * kFacetBytes)
    return badInput(file + ": the file is cut short: it promises " + std::to_string(count) +
                    " triangles and holds " + std::to_string((bytes.size() - kHeaderBytes) / kFacetBytes) +
                    "; copy or export it again");
  Welder welder;
  welder.reserve(count);
  Checkpoints checkpoints;
  for (std::uint64_t i = 0; i < count; ++i) {
    checkpoints.pass();
    for (int corner = 0; corner < 3; ++corner) {
      const std::byte* at = bytes.data() + kHeaderBytes + i * kFacetBytes + 12 + 12 * corner;
      const dvec3 p(std::bit_cast<float>(littleEndian(at)), std::bit_cast<float>(littleEndian(at + 4)),
                    std::bit_cast<float>(littleEndian(at + 8)));
      if (const std::string fault = coordinateFault(p, frame); !fault.empty())
        return badInput(file + ": triangle " + std::to_string(i) + ": " + fault);
      welder.add(frame.toHouse(p));
    }
  }
  return std::vector<MeshElement>{{name, {}, {}, welder.mesh()}};
}

// Words of an ASCII file with their line numbers.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}
  std::string_view next() {
    while (!rest_.empty() && std::strchr(" \t\r\n", rest_[0])) drop(1);
    std::size_t size = 0;
    while (size < rest_.size() && !std::strchr(" \t\r\n", rest_[size])) ++size;
    const std::string_view word = rest_.substr(0, size);
    drop(size);
    return word;
  }
  std::string restOfLine() {
    const std::size_t stop = std::min(rest_.find('\n'), rest_.size());
    std::string_view text = rest_.substr(0, stop);
    drop(stop);
    while (!text.empty() && std::strchr(" \t\r", text.front())) text.remove_prefix(1);
    while (!text.empty() && std::strchr(" \t\r", text.back())) text.remove_suffix(1);
    return std::string(text);
  }
  std::size_t line = 1;

 private:
  void drop(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) line += rest_[i] == '\n';
    rest_.remove_prefix(count);
  }
  std::string_view rest_;
};

class AsciiReader {
 public:
  AsciiReader(std::string file, std::string name, std::string_view text, const ImportFrame& frame)
      : file_(std::move(file)), name_(std::move(name)), words_(text), frame_(frame) {}

  Result<std::vector<MeshElement>> run() {
    std::vector<MeshElement> elements;  // named by their titles at first
    Welder welder;
    std::string title;
    Checkpoints checkpoints;
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      checkpoints.pass();
      if (sameLetters(word, "solid")) {
        welder = {};
        title = words_.restOfLine();
      } else if (sameLetters(word, "endsolid")) {
        words_.restOfLine();
        if (TriangleMesh mesh = welder.mesh(); !mesh.empty())
          elements.push_back({title, {}, {}, std::move(mesh)});
        welder = {};
      } else if (sameLetters(word, "facet")) {
        if (auto read = facet(welder); !read) return read.error();
      } else {
        return fail("expected 'facet' or 'endsolid', found '" + std::string(word.substr(0, 40)) +
                    "'; export the surface again, as binary STL if need be");
      }
    }
    if (!welder.mesh().empty()) return fail("the file ends before 'endsolid'; copy or export it again");
    giveNames(elements);
    return elements;
  }

 private:
  // What stands behind "solid" tells solids of a file apart; of a single one it is most often the exporter's
  // own name, and the file's says more.
  void giveNames(std::vector<MeshElement>& solids) const {
    for (MeshElement& solid : solids)
      if (!solid.name.empty()) solid.surroundings = {solid.name};  // it may still say what it is
    if (solids.size() == 1) solids.front().name = name_;
    if (solids.size() < 2) return;
    std::map<std::string, std::size_t> titles;
    for (const MeshElement& solid : solids) ++titles[solid.name];
    std::size_t number = 0;
    for (MeshElement& solid : solids)
      if (solid.name.empty() || titles[solid.name] > 1) {
        do solid.name = name_ + " " + std::to_string(++number);
        while (titles.contains(solid.name));
      }
  }
  Error fail(const std::string& what) const {
    return badInput(file_ + ":" + std::to_string(words_.line) + ": " + what);
  }
  // normal x y z outer loop (vertex x y z) x 3 endloop endfacet
  Result<void> facet(Welder& welder) {
    for (std::string_view word = words_.next(); !sameLetters(word, "loop"); word = words_.next())
      if (word.empty() || sameLetters(word, "endfacet")) return fail("a facet without 'outer loop'");
    for (int corner = 0; corner < 3; ++corner) {
      if (const std::string_view word = words_.next(); !sameLetters(word, "vertex"))
        return fail("a facet needs three corners, found '" + std::string(word.substr(0, 40)) + "'");
      dvec3 p;
      for (int axis = 0; axis < 3; ++axis)
        if (const std::string_view word = words_.next(); !number(word, p[axis]))
          return fail("a corner needs three finite numbers, found '" + std::string(word.substr(0, 40)) + "'" +
                      (word.find(',') != word.npos ? "; write decimal points, not commas" : ""));
      if (const std::string fault = coordinateFault(p, frame_); !fault.empty()) return fail(fault);
      welder.add(frame_.toHouse(p));
    }
    if (!sameLetters(words_.next(), "endloop") || !sameLetters(words_.next(), "endfacet"))
      return fail("a facet with more than three corners");
    return {};
  }
  static bool number(std::string_view word, double& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    return fault == std::errc{} && stop == word.data() + word.size();
  }

  std::string file_, name_;
  Words words_;
  ImportFrame frame_;
};

Result<std::vector<MeshElement>> readAscii(const std::string& file, const std::string& name,
                                           std::string_view text, const ImportFrame& frame) {
  std::string kept;
  const auto plain = plainText(text, file, kept);
  if (!plain) return plain.error();
  return AsciiReader(file, name, *plain, frame).run();
}

// Binary files may begin with "solid", too, but no text holds a zero byte.
bool beginsAsText(std::string_view text) {
  const std::string_view line = text.substr(0, std::min(text.find('\n'), kHeaderBytes)),
                         head = text.substr(0, 2 * kHeaderBytes);
  if (head.find('\0') != head.npos) return false;
  for (std::size_t i = 0; i + 5 <= line.size(); ++i)
    if (sameLetters(line.substr(i, 5), "solid")) return true;
  return false;
}

}  // namespace

Result<std::vector<MeshElement>> parseStl(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                          const ImportFrame& frame) {
  const std::string file = path.string(), name = path.stem().string();
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const bool fitsBinary =
      bytes.size() >= kHeaderBytes &&
      bytes.size() == kHeaderBytes + kFacetBytes * std::uint64_t(littleEndian(bytes.data() + 80));
  if (const auto other = otherContent(text); other && !fitsBinary)
    return badInput(file + ": " + other->text());
  const bool ascii = !fitsBinary && beginsAsText(text);
  if (!ascii && bytes.size() < kHeaderBytes)
    return badInput(file + ": neither ASCII nor binary STL: " + std::to_string(bytes.size()) +
                    " bytes; copy or export it again");
  auto elements = ascii ? readAscii(file, name, text, frame) : readBinary(file, name, bytes, frame);
  if (!elements) return elements;
  if (elements->empty() || elements->front().mesh.empty())
    return badInput(file + ": the file has no triangles with an area; export the surface again");
  return elements;
}

Result<std::vector<MeshElement>> readStl(const std::filesystem::path& path, const ImportFrame& frame) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  return parseStl(*bytes, path, frame);
}

}  // namespace vasa
