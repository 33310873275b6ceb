#include "io/foreign_files.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/letters.h"
#include "io/markups.h"
#include "io/words.h"

namespace vasa {
namespace {

template <std::size_t N>
bool isAny(std::string_view extension, const std::array<std::string_view, N>& of) {
  return std::ranges::find(of, extension) != of.end();
}

constexpr std::array<std::string_view, 20> kModels{
    ".ply", ".off", ".dae", ".fbx", ".3ds", ".blend", ".usd", ".usda", ".usdc", ".usdz",
    ".abc", ".ma",  ".mb",  ".max", ".c4d", ".x",     ".pmx", ".3mf",  ".wrl",  ".x3d"};
constexpr std::array<std::string_view, 4> kParts{".step", ".stp", ".iges", ".igs"};
constexpr std::array<std::string_view, 4> kMeshes{".byu", ".gii", ".msh", ".mesh"};
constexpr std::array<std::string_view, 3> kTracings{".asc", ".nlx", ".ndf"};
constexpr std::array<std::string_view, 5> kGrids{".vtu", ".vti", ".vtr", ".vts", ".vtm"};
constexpr std::array<std::string_view, 5> kVolumes{".nrrd", ".nii", ".mha", ".mhd", ".dcm"};
constexpr std::array<std::string_view, 4> kPacked{".gz", ".zip", ".7z", ".rar"};
constexpr std::array<std::string_view, 4> kSlicer{".mrk", ".fcsv", ".mrml", ".mrb"};
constexpr std::array<std::string_view, 4> kSimVascular{".pth", ".paths", ".ctgr", ".mdl"};
constexpr std::array<std::string_view, 5> kTables{".csv", ".txt", ".xyz", ".tsv", ".xlsx"};
constexpr std::array<std::string_view, 5> kCaptures{".c3d", ".trc", ".amc", ".asf", ".htr"};
constexpr std::array<std::string_view, 5> kVessels{".obj", ".stl", ".vtp", ".vtk", ".swc"};

std::string vesselRemedy(const std::string& extension) {
  if (isAny(extension, kModels)) return "; open it in Blender or MeshLab and export it as .glb or .obj";
  if (isAny(extension, kParts)) return "; open it in FreeCAD and export it as .obj or .stl";
  if (isAny(extension, kGrids))
    return "; extract its surface (ParaView: Extract Surface) and save it as .vtp";
  if (isAny(extension, kVolumes))
    return "; make a surface of the labelled volume first (3D Slicer: export the segmentation as .stl or .obj)";
  if (isAny(extension, kSlicer))
    return "; save the model in 3D Slicer as .stl, or the centre lines with radii (Extract Centerline) as .vtp "
           "(the model) or .mrk.json (the curves)";
  if (isAny(extension, kSimVascular)) return "; export the model in SimVascular as .vtp or .stl";
  if (isAny(extension, kMeshes))
    return "; open it in the program that made it, ParaView or Gmsh, and save it as .stl";
  if (isAny(extension, kTracings))
    return "; convert it to .swc first (the tracing program exports it, or L-Measure does)";
  if (extension == ".traces") return "; export it in SNT as .swc";
  if (extension == ".eswc") return "; name it .swc: columns after the seventh are passed over";
  if (isAny(extension, kTables))
    return "; write centre lines as .swc, a line `id type x y z radius parent` for each sample";
  if (extension == ".bvh" || isAny(extension, kCaptures)) return "; it is a motion, and no vessels";
  if (extension == ".vasa") return "; it is a network already: other commands take it with --network";
  if (extension == ".vrm") return "; it is a body, and no vessels: other commands take it with --body";
  return {};
}

std::string bodyRemedy(const std::string& extension) {
  if (isAny(extension, kModels)) return "; open it in Blender and export it with its armature as .glb";
  if (isAny(extension, kVessels))
    return "; it has no skeleton: vasa convert reads vessels, and vasa fit --from the skin of a scan";
  if (extension == ".bvh" || isAny(extension, kCaptures))
    return "; it is a motion: name a body in its place, and the motion where one is asked for";
  if (extension == ".vasa")
    return "; it is a network: name a body in its place, and the network where vessels are asked for";
  return {};
}

std::string motionRemedy(const std::string& extension) {
  if (isAny(extension, kCaptures))
    return "; turn it into .bvh first (Blender imports .c3d, and exports an armature's motion as .bvh)";
  if (isAny(extension, kModels) || extension == ".glb" || extension == ".gltf" || extension == ".vrm")
    return "; open it in Blender and export the armature's motion as .bvh (clips of the body's own file go by "
           "their names)";
  return {};
}

}  // namespace

std::string extensionOf(const std::filesystem::path& path) { return lowerCase(path.extension().string()); }

bool isGltfFile(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return extension == ".glb" || extension == ".gltf" || extension == ".vrm";
}

std::string remedyFor(const std::filesystem::path& path, FileUse use) {
  const std::string extension = extensionOf(path);
  if (use == FileUse::vessels && isMarkupsFile(path)) return "; vasa convert makes a network of it";
  // a.nii.gz, a.mrk.json: what stands before tells.
  if (extension == ".gz" || extension == ".json")
    if (std::string inner = remedyFor(path.stem(), use); !inner.empty()) return inner;
  if (isAny(extension, kPacked)) return "; unpack it first";
  return use == FileUse::vessels ? vesselRemedy(extension)
         : use == FileUse::body  ? bodyRemedy(extension)
                                 : motionRemedy(extension);
}

}  // namespace vasa
