#include <set>

#include "io/gltf_accessor.h"
#include "io/gltf_check.h"

namespace vasa::gltf {
namespace {

constexpr std::size_t kMaximumSets = 4;  // of four joints each; only the strongest four are used

// What checkMeshes must know of an accessor; they have passed checkAccessors.
struct Shape {
  std::string type;
  std::int64_t component = 0;
  bool normalised = false;
  std::int64_t count = 0;
  std::uint64_t begin = 0;   // byteOffset, of the accessor and of its view
  std::uint64_t stride = 0;  // as the elements lie
  bool stored = false;       // has a buffer view
  bool strided = false;      // which has a stride
  std::size_t view = 0;
};

class Shapes {
 public:
  explicit Shapes(const JsonView& root) : views_(root.items("bufferViews")), firstIn_(views_.size()) {
    for (const JsonView& accessor : root.items("accessors")) shapes_.push_back(shapeOf(accessor));
    quantised_ = false;
    for (const JsonView& extension : root.items("extensionsUsed"))
      quantised_ = quantised_ || extension.text() == "KHR_mesh_quantization";
  }
  const Shape& referredBy(const JsonView& index) const {
    return shapes_[index.index(shapes_.size(), "accessors")];
  }
  bool quantised() const { return quantised_; }
  /// Several attributes in one buffer view may be meant to be interleaved, or not: only a stride tells.
  bool sharesUnstrided(const Shape& shape) {
    if (!shape.stored || shape.strided) return false;
    const Shape*& first = firstIn_[shape.view];
    if (!first) first = &shape;
    return first != &shape;
  }

 private:
  Shape shapeOf(const JsonView& accessor) const {
    const auto offset = [](const JsonView& object) {
      const auto found = object.find("byteOffset");
      return found ? std::uint64_t(found->integer(0, std::int64_t(1) << 40)) : 0;
    };
    const auto normalised = accessor.find("normalized");
    Shape shape;
    shape.type = accessor.at("type").text();
    shape.component = accessor.at("componentType").integer(0, 65535);
    shape.normalised = normalised && normalised->boolean();
    shape.count = accessor.at("count").integer(0, std::int64_t(1) << 40);
    shape.stride = elementLayout(shape.component, shape.type).packedBytes();
    if (const auto view = accessor.find("bufferView")) {
      const JsonView& bufferView = views_[view->index(views_.size(), "bufferViews")];
      shape.stored = true;
      shape.begin = offset(accessor) + offset(bufferView);
      shape.view = view->index(views_.size(), "bufferViews");
      if (const auto stride = bufferView.find("byteStride"))
        shape.strided = true, shape.stride = std::uint64_t(stride->integer(4, 252));
    }
    return shape;
  }
  std::vector<JsonView> views_;
  std::vector<Shape> shapes_;
  std::vector<const Shape*> firstIn_;  // that an attribute uses, one a view
  bool quantised_;
};

bool isUnsignedSmall(const Shape& shape) {
  return shape.component == kUnsignedByte || shape.component == kUnsignedShort;
}

// What a set of JOINTS_n or WEIGHTS_n attributes is called without its number.
std::string_view setName(std::string_view attribute) {
  const std::size_t underscore = attribute.find('_');
  return underscore == attribute.npos || underscore == 0 ? attribute : attribute.substr(0, underscore);
}

void checkVector(const JsonView& place, const Shape& shape, const char* type, bool quantised) {
  if (shape.type != type) place.fail(std::string("must be ") + type + ", is " + shape.type);
  if (!isFloatComponent(shape.component) && !quantised)
    place.fail("must be of floats", "export without quantisation, or declare KHR_mesh_quantization");
}

void checkAttribute(std::string_view name, const JsonView& place, const Shape& shape, bool quantised) {
  if (shape.component == kUnsignedInt) place.fail("a vertex attribute must not be of 32-bit integers");
  if (shape.stored && (shape.begin % 4 != 0 || shape.stride % 4 != 0))
    place.fail("vertex attributes must lie at multiples of 4 bytes: begins at " +
               std::to_string(shape.begin) + ", stride " + std::to_string(shape.stride));
  const std::string_view set = setName(name);
  if (name == "POSITION" || name == "NORMAL") checkVector(place, shape, "VEC3", quantised);
  if (set == "JOINTS") {
    if (shape.type != "VEC4") place.fail("must be VEC4, is " + shape.type);
    if (!isUnsignedSmall(shape) || shape.normalised)
      place.fail("joints must be unsigned 8-bit or 16-bit integers, not normalised");
  }
  if (set == "WEIGHTS") {
    if (shape.type != "VEC4") place.fail("must be VEC4, is " + shape.type);
    if (!isFloatComponent(shape.component) && !(isUnsignedSmall(shape) && shape.normalised))
      place.fail("weights must be floats, or normalised unsigned 8-bit or 16-bit integers");
  }
}

void checkInfluenceSets(const JsonView& attributes, const std::set<std::string_view>& names) {
  std::size_t joints = 0, weights = 0;
  for (const std::string_view name : names) {
    joints += setName(name) == "JOINTS";
    weights += setName(name) == "WEIGHTS";
  }
  if (joints > kMaximumSets)
    attributes.fail(std::to_string(joints) + " sets of joints are more than the " +
                        std::to_string(kMaximumSets) + " that are accepted",
                    "export with fewer influences a vertex");
  if (joints != weights)
    attributes.fail(std::to_string(joints) + " sets of joints do not go with " + std::to_string(weights) +
                    " sets of weights");
  for (const char* set : {"JOINTS_", "WEIGHTS_"})
    for (std::size_t i = 0; i < joints; ++i)
      if (!names.contains(set + std::to_string(i)))
        attributes.fail(std::string("must have ") + set + std::to_string(i) + ": sets are numbered from 0");
}

void checkAttributes(const JsonView& attributes, Shapes& shapes, std::int64_t& vertexCount) {
  std::set<std::string_view> names;
  vertexCount = -1;
  for (const auto& [name, place] : attributes.members()) {
    const Shape& shape = shapes.referredBy(place);
    checkAttribute(name, place, shape, shapes.quantised());
    if (shapes.sharesUnstrided(shape))
      place.fail("its buffer view holds another attribute, too, and has no byteStride");
    if (vertexCount >= 0 && shape.count != vertexCount)
      place.fail("has " + std::to_string(shape.count) + " elements where the others have " +
                 std::to_string(vertexCount));
    vertexCount = shape.count;
    names.insert(name);
  }
  if (names.empty()) attributes.fail("must not be empty");
  checkInfluenceSets(attributes, names);
}

void checkIndices(const JsonView& place, const Shapes& shapes) {
  const Shape& shape = shapes.referredBy(place);
  if (shape.type != "SCALAR" || shape.normalised ||
      (!isUnsignedSmall(shape) && shape.component != kUnsignedInt))
    place.fail("indices must be scalars of unsigned 8, 16 or 32 bits, not normalised");
  if (shape.strided) place.fail("indices must lie one behind the other, without a byteStride");
}

void checkTargets(const JsonView& primitive, const Shapes& shapes, std::int64_t vertexCount) {
  for (const JsonView& target : primitive.items("targets"))
    for (const auto& [name, place] : target.members()) {
      const Shape& shape = shapes.referredBy(place);
      if (shape.count != vertexCount)
        place.fail("has " + std::to_string(shape.count) + " elements where the mesh has " +
                   std::to_string(vertexCount));
      if (!primitive.at("attributes").has(name))
        place.fail("displaces " + std::string(name) + ", which the mesh does not have");
      if (name == "POSITION") checkVector(place, shape, "VEC3", shapes.quantised());
    }
}

void checkPrimitive(const JsonView& primitive, const JsonView& root, Shapes& shapes) {
  std::int64_t vertexCount = 0;
  checkAttributes(primitive.at("attributes"), shapes, vertexCount);
  if (const auto indices = primitive.find("indices")) checkIndices(*indices, shapes);
  if (const auto mode = primitive.find("mode")) mode->integer(0, 6);
  if (const auto material = primitive.find("material"))
    material->index(countOf(root, "materials"), "materials");
  checkTargets(primitive, shapes, vertexCount);
}

}  // namespace

void checkMorphWeights(const JsonView& weights, std::size_t targets) {
  if (weights.size() != targets)
    weights.fail("must hold one number for each of " + std::to_string(targets) + " morph targets");
  weights.numbers(targets);
}

void checkMeshes(const JsonView& root) {
  Shapes shapes(root);
  for (const JsonView& mesh : root.items("meshes")) {
    const auto primitives = mesh.at("primitives").items();
    if (primitives.empty()) mesh.at("primitives").fail("must not be empty");
    const std::size_t targets = countOf(primitives[0], "targets");
    for (const JsonView& primitive : primitives) {
      checkPrimitive(primitive, root, shapes);
      if (countOf(primitive, "targets") != targets)
        primitive.fail("must have as many morph targets as the mesh's first primitive");
    }
    if (const auto weights = mesh.find("weights")) checkMorphWeights(*weights, targets);
  }
}

}  // namespace vasa::gltf
