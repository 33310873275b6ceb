// tinyobjloader turns what it cannot parse into zeros and keeps faces whose indices lie outside the vertices,
// so the text is checked line by line first, and the loader only sees a file that is known to be sound.
#include "io/obj.h"

#include <tiny_obj_loader.h>

#include <istream>
#include <streambuf>
#include <unordered_map>

#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "io/words.h"

namespace vasa {
namespace {

struct FaceCorner {
  long long index;
  std::size_t line;
};

class LineCheck {
 public:
  LineCheck(const std::filesystem::path& path, const ImportFrame& frame) : file_(path.string()), frame_(frame) {}

  Result<void> run(std::string_view text) {
    Checkpoints checkpoints;
    while (!text.empty()) {
      checkpoints.pass();
      ++line_;
      std::string_view line = nextLine(text);
      const std::string_view keyword = nextWord(line);
      if (keyword == "v") {
        if (auto checked = vertex(line); !checked) return checked;
      } else if (keyword == "f") {
        if (auto checked = face(line); !checked) return checked;
      }
    }
    // A positive index may name a vertex that follows further down, so the upper bound is checked last.
    for (const FaceCorner& corner : corners_)
      if (corner.index > vertices_) return fail(corner.line, outside(corner.index));
    if (!faces_)
      return badInput(file_ + ": the file has no faces; export the surface as polygons, not points or curves");
    return {};
  }

 private:
  Error fail(std::size_t line, const std::string& what) const {
    return badInput(file_ + ":" + std::to_string(line) + ": " + what);
  }
  std::string outside(long long index) const {
    return "face index " + std::to_string(index) + " lies outside the " + std::to_string(vertices_) +
           " vertices; export the file again";
  }
  Result<void> vertex(std::string_view line) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = nextWord(line);
      double value = 0;
      if (!parseNumber(word, value))
        return fail(line_, "a vertex needs three finite numbers, found '" + std::string(word.substr(0, 40)) + "'");
      if (std::abs(value) * frame_.metresPerUnit > kLargestImportedCoordinate)
        return fail(line_, "coordinate " + std::string(word.substr(0, 40)) +
                               " is farther than 1000 km away; give the file's unit with --scale");
    }
    ++vertices_;
    return {};
  }
  Result<void> face(std::string_view line) {
    int count = 0;
    for (std::string_view word = nextWord(line); !word.empty() && word[0] != '#'; word = nextWord(line), ++count) {
      const std::string_view number = word.substr(0, word.find('/'));
      long long index = 0;
      const auto [stop, fault] = std::from_chars(number.data(), number.data() + number.size(), index);
      if (fault != std::errc{} || stop != number.data() + number.size() || index == 0)
        return fail(line_, "a face corner needs a vertex index, found '" + std::string(word.substr(0, 40)) + "'");
      if (index < -vertices_) return fail(line_, outside(index));
      if (index > 0) corners_.push_back({index, line_});
    }
    if (count < 3) return fail(line_, "a face needs at least three corners, found " + std::to_string(count));
    ++faces_;
    return {};
  }

  std::string file_;
  ImportFrame frame_;
  std::size_t line_ = 0;
  long long vertices_ = 0;
  std::size_t faces_ = 0;
  std::vector<FaceCorner> corners_;
};

// Text as a stream that can be cancelled.
class CancellableText : public std::streambuf {
 public:
  explicit CancellableText(std::string_view text) : rest_(text) {}

 private:
  int_type underflow() override {
    checkpoint();
    if (rest_.empty()) return traits_type::eof();
    const std::string_view part = rest_.substr(0, kPart);
    rest_.remove_prefix(part.size());
    char* const first = const_cast<char*>(part.data());  // never written to
    setg(first, first, first + part.size());
    return traits_type::to_int_type(*first);
  }

  static constexpr std::size_t kPart = 1 << 16;
  std::string_view rest_;
};

TriangleMesh meshOf(const tinyobj::attrib_t& attributes, const tinyobj::mesh_t& shape, const ImportFrame& frame) {
  TriangleMesh mesh;
  std::unordered_map<int, std::uint32_t> numbers;
  const auto vertexOf = [&](int index) {
    const auto [found, fresh] = numbers.try_emplace(index, std::uint32_t(mesh.positions.size()));
    if (fresh) {
      const auto* p = &attributes.vertices[3 * std::size_t(index)];
      mesh.positions.push_back(frame.toHouse({p[0], p[1], p[2]}));
    }
    return found->second;
  };
  Checkpoints checkpoints;
  for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
    checkpoints.pass();
    const uvec3 triangle{vertexOf(shape.indices[i].vertex_index), vertexOf(shape.indices[i + 1].vertex_index),
                         vertexOf(shape.indices[i + 2].vertex_index)};
    if (triangle.x != triangle.y && triangle.y != triangle.z && triangle.z != triangle.x)
      mesh.triangles.push_back(triangle);
  }
  return mesh;
}

bool indicesValid(const tinyobj::attrib_t& attributes, const tinyobj::mesh_t& shape) {
  for (const tinyobj::index_t& index : shape.indices)
    if (index.vertex_index < 0 || std::size_t(index.vertex_index) >= attributes.vertices.size() / 3) return false;
  return true;
}

}  // namespace

Result<std::vector<MeshElement>> readObj(const std::filesystem::path& path, const ImportFrame& frame) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  return parseObj({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path, frame);
}

Result<std::vector<MeshElement>> parseObj(const std::string& text, const std::filesystem::path& path, const ImportFrame& frame) {
  if (auto checked = LineCheck(path, frame).run(text); !checked) return checked.error();

  CancellableText source(text);
  std::istream stream(&source);
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  const bool read = tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr, true, false);
  checkpoint();  // a stream keeps to itself what is thrown while it looks ahead
  if (!read) return badInput(path.string() + ": " + error + "; export the file again");
  std::vector<MeshElement> elements;
  for (const tinyobj::shape_t& shape : shapes) {
    if (shape.mesh.indices.empty()) continue;
    if (!indicesValid(attributes, shape.mesh))
      return badInput(path.string() + ": object '" + shape.name + "' uses vertices that do not exist");
    MeshElement element{shape.name.empty() ? path.stem().string() : shape.name, {}, {},
                        meshOf(attributes, shape.mesh, frame)};
    if (!element.mesh.empty()) elements.push_back(std::move(element));
  }
  if (elements.empty())
    return badInput(path.string() + ": every face has lost its area; export the surface again");
  return elements;
}

}  // namespace vasa
