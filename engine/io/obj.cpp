#include "io/obj.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/ids.h"
#include "core/log.h"
#include "core/text_file.h"
#include "io/colour_runs.h"
#include "io/words.h"
#include "mesh/polygon.h"

namespace vasa {
namespace {

// An object takes some 500 bytes of memory.
constexpr std::size_t kBytesAnObject = 64, kFreeObjects = 100'000;

struct Face {
  std::size_t first;  // of its corners; the next face's is behind its last
  std::size_t line;
};

struct Object {
  struct Run {
    std::size_t first, end;  // of its faces, in the file's order
  };
  std::string name, material;  // the latter of its first face
  std::vector<Run> runs;
};
struct Material {
  std::size_t firstFace;  // that is drawn with it, until the next one
  std::string name;
};
// Longer ones name nothing that a reader knows; each object has a copy.
constexpr std::size_t kLongestMaterial = 128;

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const ImportFrame& frame)
      : path_(path), file_(path.string()), frame_(frame) {}

  Result<std::vector<MeshElement>> run(std::string_view text) {
    std::string kept;
    const auto plain = plainText(text, file_, kept);
    if (!plain) return plain.error();
    text = *plain;
    const std::size_t mostObjects = text.size() / kBytesAnObject + kFreeObjects;
    Checkpoints checkpoints;
    while (!text.empty()) {
      checkpoints.pass();
      std::string_view line = takeLine(text);
      const std::string_view keyword = nextWord(line);
      if (keyword == "v") {
        if (auto read = vertex(line); !read) return read.error();
      } else if (keyword == "f") {
        if (auto read = face(line); !read) return read.error();
        if (objects_.size() > mostObjects)
          return fail(line_, "more than the " + std::to_string(mostObjects) +
                                 " objects and groups accepted for a file of this size; split it");
      } else if (keyword == "l") {
        ++linesLeft_;
      } else if (keyword == "usemtl") {
        material_ = restOf(line);
        isMaterialNew_ = true;
      } else if (keyword == "o" || keyword == "g") {
        begin(line, keyword == "g");
      }
    }
    if (faces_.empty())
      return badInput(
          file_ +
          ": the file has no faces; export the surface as polygons (centre lines are read from .swc, .vtp "
          "and .vtk, with radii)");
    // A positive index may name a vertex that follows further down, so the upper bound is checked last.
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (const std::uint32_t corner : cornersOf(i))
        if (corner >= positions_.size()) return fail(faces_[i].line, outside(std::int64_t(corner) + 1));
    if (linesLeft_ > 0)
      logWarning(file_ + ": lines (l, " + std::to_string(linesLeft_) +
                 ") beside its faces are left out, as they have no radii; centre lines are read from "
                 ".swc, .vtp and .vtk");
    return elements();
  }

 private:
  Error fail(std::size_t line, const std::string& what) const {
    return badInput(file_ + ":" + std::to_string(line) + ": " + what);
  }
  std::string outside(std::int64_t index) const {
    return "face index " + std::to_string(index) + " lies outside the " + std::to_string(positions_.size()) +
           " vertices; export the file again";
  }

  // A line, and those that a backslash at its end joins to it; a comment may end with a folder's name.
  std::string_view takeLine(std::string_view& text) {
    std::string_view line = nextLine(text);
    ++line_;
    const auto goesOn = [](std::string_view part) {
      if (part.ends_with('\r')) part.remove_suffix(1);
      return part.ends_with('\\');
    };
    if (!goesOn(line) || line.starts_with('#')) return line;
    joined_.clear();
    for (; goesOn(line); ++line_, line = nextLine(text))
      joined_.append(line.substr(0, line.rfind('\\'))).append(1, ' ');
    return joined_.append(line);
  }

  Result<void> vertex(std::string_view line) {
    dvec3 place;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = nextWord(line);
      if (!parseNumber(word, place[axis]))
        return fail(line_, "a vertex needs three finite numbers, found '" + std::string(word.substr(0, 40)) +
                               "'" +
                               (word.find(',') != word.npos ? "; write decimal points, not commas" : ""));
      if (std::abs(place[axis]) * frame_.metresPerUnit > kLargestImportedCoordinate)
        return fail(line_,
                    "coordinate " + std::string(word.substr(0, 40)) +
                        " is farther than 1000 km away; give the file's unit with vasa convert --unit");
    }
    positions_.push_back(frame_.toHouse(place));
    colour(line);
    return {};
  }

  // Red, green and blue behind the place, as MeshLab and Blender write them; they count where all vertices
  // have them. Two kinds of vessel in one object are told by nothing else.
  void colour(std::string_view rest) {
    vec3 told;
    for (int k = 0; k < 3; ++k) {
      double value = 0;
      if (!parseNumber(nextWord(rest), value) || value < 0 || value > 255) return;
      told[k] = float(value);
      if (value > 1) brightest_ = 255;  // bytes, as some scripts write them
    }
    if (colours_.size() + 1 == positions_.size()) colours_.push_back(told);
  }

  static std::string_view restOf(std::string_view line) {
    const std::size_t from = std::min(line.find_first_not_of(" \t"), line.size()),
                      to = line.find_last_not_of(" \t\r");
    const std::string_view rest = to == line.npos ? std::string_view{} : line.substr(from, to + 1 - from);
    return rest.size() <= kLongestMaterial ? rest : std::string_view{};
  }

  Result<void> face(std::string_view line) {
    if (!inRun_) beginRun();
    if (isMaterialNew_) materials_.push_back({faces_.size(), material_});
    isMaterialNew_ = false;
    faces_.push_back({corners_.size(), line_});
    objects_[object_].runs.back().end = faces_.size();
    const auto vertices = std::int64_t(positions_.size());
    for (std::string_view word = nextWord(line); !word.empty() && word[0] != '#'; word = nextWord(line)) {
      const std::string_view number = word.substr(0, word.find('/'));
      std::int64_t index = 0;
      if (!parseInteger(number, index) || index == 0)
        return fail(line_, "a face corner needs a vertex index, found '" + std::string(word.substr(0, 40)) +
                               "'" + (number == "0" ? "; indices begin at 1: export the file again" : ""));
      if (index < -vertices || index > std::int64_t(0xffffffff)) return fail(line_, outside(index));
      corners_.push_back(std::uint32_t(index > 0 ? index - 1 : vertices + index));
    }
    const std::size_t count = corners_.size() - faces_.back().first;
    if (count < 3) return fail(line_, "a face needs at least three corners, found " + std::to_string(count));
    if (count > kMostCorners)
      return fail(line_, "a face of " + std::to_string(count) + " corners has more than the " +
                             std::to_string(kMostCorners) + " that are accepted; export triangles");
    return {};
  }

  void begin(std::string_view line, bool group) {
    name_.clear();
    for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line))
      name_.append(name_.empty() ? "" : " ").append(word);
    if (!group) groups_.clear();
    group_ = group && !name_.empty();
    inRun_ = false;
  }
  // The first face behind a line that names an object or a group: what has no faces is none. A group goes on
  // where it is named again (as for each material of a surface), within one object: others have groups of the
  // same names.
  void beginRun() {
    inRun_ = true;
    object_ = objects_.size();
    if (group_) object_ = groups_.try_emplace(name_, object_).first->second;
    if (object_ == objects_.size()) objects_.push_back({name_, material_, {}});
    objects_[object_].runs.push_back({faces_.size(), faces_.size()});
  }

  std::span<const std::uint32_t> cornersOf(std::size_t face) const {
    const std::size_t first = faces_[face].first,
                      end = face + 1 < faces_.size() ? faces_[face + 1].first : corners_.size();
    return std::span(corners_).subspan(first, end - first);
  }

  Result<std::vector<MeshElement>> elements() {
    numbers_.assign(positions_.size(), kNone);
    std::vector<MeshElement> elements;
    elements.reserve(objects_.size());
    for (Object& object : objects_) {
      MeshElement element{object.name.empty() ? path_.stem().string() : std::move(object.name), {}, {}, {}};
      takeFaces(object.runs, element);
      element.colour = element.materials.empty() ? std::nullopt : element.materials.front().colour;
      if (!object.material.empty()) element.surroundings.push_back(std::move(object.material));
      if (!element.mesh.empty()) elements.push_back(std::move(element));
    }
    if (elements.empty()) return badInput(file_ + ": every face has lost its area; export the surface again");
    return elements;
  }

  void takeFaces(std::span<const Object::Run> runs, MeshElement& element) {
    TriangleMesh& mesh = element.mesh;
    used_.clear();
    Checkpoints checkpoints;
    for (const auto [first, end] : runs) {
      auto material = std::ranges::upper_bound(materials_, first, {}, &Material::firstFace);
      if (material != materials_.begin()) --material;
      for (std::size_t face = first; face < end; ++face) {
        checkpoints.pass();
        for (; material != materials_.end() && material->firstFace <= face; ++material)
          element.materials.push_back({material->name, {}, std::uint32_t(mesh.triangles.size())});
        addFace(cornersOf(face), mesh);
      }
    }
    if (colours_.size() == positions_.size()) addColours(element);
    for (const std::uint32_t vertex : used_) numbers_[vertex] = kNone;
  }
  // To an element whose vertices are those of used_.
  void addColours(MeshElement& element) {
    std::vector<vec3> colours;
    for (const std::uint32_t vertex : used_)
      colours.push_back(glm::pow(colours_[vertex] / brightest_, vec3(2.2f)));  // linear
    std::vector<MeshMaterial> named = std::move(element.materials);
    if (named.empty() || named.front().firstTriangle > 0) named.insert(named.begin(), MeshMaterial{});
    element.materials.clear();
    for (std::size_t m = 0; m < named.size(); ++m) {
      const std::size_t end =
          m + 1 < named.size() ? named[m + 1].firstTriangle : element.mesh.triangles.size();
      if (named[m].firstTriangle < end)
        addColourRuns(element.mesh, named[m].firstTriangle, end, colours, 0, named[m], element.materials);
    }
  }
  void addFace(std::span<const std::uint32_t> corners, TriangleMesh& mesh) {
    places_.clear(), cut_.clear();
    for (const std::uint32_t corner : corners) places_.push_back(positions_[corner]);
    cutPolygon(places_, cut_);
    for (const uvec3& t : cut_) {
      uvec3 triangle;
      for (int k = 0; k < 3; ++k) {
        std::uint32_t& number = numbers_[corners[t[k]]];
        if (number == kNone) {
          number = std::uint32_t(mesh.positions.size());
          mesh.positions.push_back(places_[t[k]]);
          used_.push_back(corners[t[k]]);
        }
        triangle[k] = number;
      }
      if (triangle.x != triangle.y && triangle.y != triangle.z && triangle.z != triangle.x)
        mesh.triangles.push_back(triangle);
    }
  }

  const std::filesystem::path& path_;
  std::string file_;
  ImportFrame frame_;
  std::size_t line_ = 0, linesLeft_ = 0;
  std::vector<vec3> positions_;
  std::vector<vec3> colours_;  // as told, of as many of the first vertices as have one
  float brightest_ = 1;        // what a full colour is
  std::vector<std::uint32_t> corners_;
  std::vector<Face> faces_;
  std::vector<Object> objects_;
  std::string joined_;                         // the line in work where it is of several
  std::string name_, material_;                // of the faces to come
  bool group_ = false;                         // the name is a group's
  bool isMaterialNew_ = false;                 // no face has it yet
  std::vector<Material> materials_;            // by their first faces
  bool inRun_ = false;                         // faces of the name have come
  std::size_t object_ = 0;                     // of the last face
  std::map<std::string, std::size_t> groups_;  // of the file's object in work
  std::vector<std::uint32_t> numbers_;         // of the object in work, one a vertex
  std::vector<std::uint32_t> used_;            // vertices that have one
  std::vector<vec3> places_;
  std::vector<uvec3> cut_;  // of the face in work
};

}  // namespace

Result<std::vector<MeshElement>> readObj(const std::filesystem::path& path, const ImportFrame& frame) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  return parseObj({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path, frame);
}

Result<std::vector<MeshElement>> parseObj(std::string_view text, const std::filesystem::path& path,
                                          const ImportFrame& frame) {
  return ObjReader(path, frame).run(text);
}

}  // namespace vasa
