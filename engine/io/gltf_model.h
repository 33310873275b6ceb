#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "body/clip.h"
#include "body/skeleton.h"
#include "io/gltf_json.h"

// What is used of a glTF document, as plain numbers. Optional indices are -1 where they are absent.
namespace vasa::gltf {

/// glTF's own numbers: types of components, modes of primitives that make triangles.
enum ComponentType : int {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};
enum Mode : int { kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

struct Model {
  struct BufferView {
    int buffer = 0;
    std::size_t byteOffset = 0, byteLength = 0, byteStride = 0;  // stride 0: none given
  };
  struct Sparse {
    std::size_t count = 0;  // 0: none
    int indicesView = -1, indicesType = 0, valuesView = -1;
    std::size_t indicesOffset = 0, valuesOffset = 0;
  };
  struct Accessor {
    int bufferView = -1, componentType = 0;
    bool normalised = false;
    std::string type;
    std::size_t byteOffset = 0, count = 0;
    std::vector<double> least, most;  // empty: not given
    Sparse sparse;
  };
  struct Primitive {
    int position = -1, normal = -1, indices = -1, material = -1, mode = kTriangles;
    std::size_t vertices = 0;          // of any attribute
    std::vector<int> joints, weights;  // accessors, one a set
    int colour = -1;                   // of vertices: RGB or RGBA
    int vessel = -1;                   // the attribute _VESSEL: which of the mesh's vessels, a vertex each
    std::vector<int> targets;          // positions' displacements of every morph target; -1: it has none
  };
  /// As encodeGlb() names them in a mesh's extras (io/animated_mesh.h).
  struct VesselLabel {
    std::string name, kind, ontologyId;
  };
  struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> weights;  // of the morph targets
    std::vector<VesselLabel> vessels;
  };
  struct Node {
    std::string name;
    int mesh = -1, skin = -1;
    JointTransform transform;
    std::vector<float> matrix;  // column by column, in place of the transform; empty: none
    std::vector<int> children;
    std::vector<float> weights;  // in place of the mesh's; empty: none
  };
  struct Skin {
    std::vector<int> joints;
    int inverseBindMatrices = -1;
  };
  struct Material {
    std::string name;
    vec4 baseColour{1};
    bool blends = false;
  };
  enum class Path { translation, rotation, scale, other };
  struct Sampler {
    int input = -1, output = -1;
    Interpolation interpolation = Interpolation::linear;
  };
  struct Channel {
    int sampler = -1, node = -1;
    Path path = Path::other;
  };
  struct Animation {
    std::string name;
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
  };
  /// Of a node's or a mesh's extras.
  struct Labels {
    std::string category, ontologyId;
  };

  std::vector<BufferView> bufferViews;
  std::vector<Accessor> accessors;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<Skin> skins;
  std::vector<Material> materials;
  std::vector<Animation> animations;
  bool hasScenes = false;
  std::vector<int> sceneNodes;                   // roots of the default scene
  std::vector<int> hidden;                       // nodes that say so (KHR_node_visibility)
  std::map<int, Labels> nodeLabels, meshLabels;  // of those that have any
  std::map<int, std::string> humanoid;           // nodes that VRM's table says are a human's bones, and which
};

/// How far the morph targets of a node's mesh are in at rest.
std::span<const float> weightsOf(const Model& model, const Model::Node& node);

/// Memory that modelOf() takes at its peak, without the document and its text [bytes].
/// @param root  has passed checkStructure
std::size_t modelMemory(const JsonView& root);

/// Read by tinygltf. Throws BrokenRule. @param document  has passed checkStructure and checkAmounts; used up
Model modelOf(nlohmann::json document);

}  // namespace vasa::gltf
