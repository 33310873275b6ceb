#include "io/foreign_files.h"

#include <fstream>
#include <string_view>

#include "core/atomic_file.h"
#include "core/letters.h"
#include "io/markups.h"
#include "io/swc.h"
#include "io/vtk_rule.h"
#include "io/vtp.h"
#include "io/words.h"

namespace vasa {
namespace {

// What others write, and what to do with it where vessels, a body or a motion is asked for. Each row's kinds
// are told by the endings that stand in it between blanks.
struct Foreign {
  std::string_view endings, vessels, body, motion;
};
constexpr std::string_view kToBvh =
    "open it in Blender and export the armature's motion as .bvh (clips of the "
    "body's own file go by their names)";
constexpr std::string_view kNoBody =
    "it has no skeleton: vasa convert reads vessels, and vasa fit --from the skin of a scan";
constexpr std::string_view kMotion = "it is a motion, and no vessels";
constexpr std::string_view kMotionForBody =
    "it is a motion: name a body in its place, and the motion where one is asked for";
constexpr std::string_view kSwcLines =
    "write centre lines as .swc, a line `id type x y z radius parent` for each sample";
constexpr Foreign kForeign[] = {
    {" .ply .off .dae .fbx .3ds .blend .usd .usda .usdc .usdz .abc .ma .mb .max .c4d .x .pmx .3mf .wrl .x3d ",
     "open it in Blender or MeshLab and export it as .glb or .obj",
     "open it in Blender and export it with its armature as .glb", kToBvh},
    {" .step .stp .iges .igs .3dm .brep ", "open it in FreeCAD and export it as .obj or .stl", "", ""},
    {" .byu .gii .msh .mesh ", "open it in the program that made it, ParaView or Gmsh, and save it as .stl",
     "", ""},
    {" .asc .nlx .ndf .hoc .nml ",
     "convert it to .swc first (the tracing program exports it, or L-Measure does)", "", ""},
    {" .traces ", "export it in SNT as .swc", "", ""},
    {" .eswc ", "name it .swc: columns after the seventh are passed over", "", ""},
    {" .vti .vtr .vts .vtm .pvd .vtkhdf .foam ",
     "extract its surface or lines (ParaView: Extract Surface) and save them as .vtp", "", ""},
    {" .nrrd .nii .mha .mhd .dcm .tif .tiff ",
     "make a surface of the labelled volume first (3D Slicer: export the segmentation as .stl or .obj)", "",
     ""},
    {" .mrk .fcsv .mrml .mrb ",
     "save the model in 3D Slicer as .stl, or the centre lines with radii (Extract Centerline) as .vtp (the "
     "model) or .mrk.json (the curves)",
     "", ""},
    {" .pth .paths .ctgr .mdl ", "export the model in SimVascular as .vtp or .stl", "", ""},
    // Graphs of vessels: of Amira, TubeTK, igraph and others.
    {" .am .tre .graphml .gml .gexf .graph .hx ",
     "write its points as .swc, a line `id type x y z radius parent` for each, or its surface as .stl", "",
     ""},
    {" .csv .txt .xyz .tsv .xlsx .dat .mat .npy .npz .pkl .h5 .hdf5 ", kSwcLines, "",
     "turn it into .bvh first, with joints and their turns (Blender exports an armature's motion so)"},
    {" .tck .trk .trx ", kSwcLines, "", ""},
    {" .c3d .trc .amc .asf .htr .mvn .mvnx .bip .vmd .vrma .anim .sto .mot ", kMotion, kMotionForBody,
     "turn it into .bvh first (Blender imports .c3d, and exports an armature's motion as .bvh)"},
    {" .bvh ", kMotion, kMotionForBody, ""},
    {" .obj .stl .vtp .vtu .vtk .swc ", "", kNoBody, ""},
    {" .glb .gltf ", "", "", kToBvh},
    {" .vrm ", "it is a body, and no vessels: other commands take it with --body", "", kToBvh},
    {" .vasa ", "it is a network already: other commands take it with --network",
     "it is a network: name a body in its place, and the network where vessels are asked for", ""},
    {" .gz .zip .7z .rar .tar .bz2 .xz ", "unpack it first", "unpack it first", "unpack it first"}};

std::string remedyOf(const std::string& extension, FileUse use) {
  if (extension.empty()) return {};
  for (const Foreign& kind : kForeign) {
    if (kind.endings.find(" " + extension + " ") == std::string_view::npos) continue;
    const std::string_view remedy = use == FileUse::vessels ? kind.vessels
                                    : use == FileUse::body  ? kind.body
                                                            : kind.motion;
    return remedy.empty() ? std::string() : "; " + std::string(remedy);
  }
  return {};
}

// "# units: inches": the word must be the line's last, as "1 unit = 213 mm" tells something else.
double unitOfComment(std::string_view line) {
  constexpr std::pair<std::string_view, double> kWords[] = {
      {" m meter meters metre metres ", 1},
      {" cm centimeter centimeters centimetre centimetres ", 0.01},
      {" mm millimeter millimeters millimetre millimetres ", 0.001},
      {" in inch inches ", 0.0254},
      {" um micron microns micrometer micrometers micrometre micrometres ", 1e-6}};
  const std::size_t at = line.find("unit");
  if (!line.starts_with('#') || at == line.npos) return 0;
  line.remove_prefix(at + 4);
  if (line.starts_with('s')) line.remove_prefix(1);
  const std::string_view sign = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
  if (!sign.starts_with(':') && !sign.starts_with('=')) return 0;
  const std::string word = ' ' + std::string(nextWord(line, " \t\r:=")) + ' ';
  if (!nextWord(line).empty()) return 0;
  for (const auto& [words, metres] : kWords)
    if (words.find(word) != words.npos) return metres;
  return 0;
}

}  // namespace

std::string extensionOf(const std::filesystem::path& path) { return lowerCase(path.extension().string()); }

bool isGltfFile(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return extension == ".glb" || extension == ".gltf" || extension == ".vrm";
}

Error withTrueKind(Error error, const std::filesystem::path& path) {
  if (error.fault != Fault::badInput) return error;
  std::string head(4096, ' ');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), std::streamsize(head.size()));
  head = lowerCase(head);
  struct Sign {
    const char *begins, *holds, *kind;
  };
  // Some begin alike: of these the rest tells.
  constexpr Sign kSigns[] = {{"gltf", "", ".glb"},           {"solid", "facet", ".stl"},
                             {"ply", "format", ".ply"},      {"hierarchy", "root", ".bvh"},
                             {"<", "<vtkfile", ".vtp"},      {"{", "\"asset\"", ".gltf"},
                             {"# vtk datafile", "", ".vtk"}, {"", "\nv ", ".obj"}};
  const std::size_t first = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  for (const auto& [begins, holds, kind] : kSigns) {
    if (!std::string_view(head).substr(first).starts_with(begins) || head.find(holds) == head.npos) continue;
    const auto family = [](const std::filesystem::path& name) {
      const std::string extension = extensionOf(name);
      return isGltfFile(name) ? std::string(".glb") : extension.starts_with(".vt") ? ".vtp" : extension;
    };
    if (family(path) != family("a" + std::string(kind)))
      error.message += std::string("; by its content it is a ") + kind + " file: name it so";
    break;
  }
  return error;
}

ToldFrame toldFrame(const std::filesystem::path& path) {
  std::error_code ignored;
  if (isGltfFile(path) || !std::filesystem::is_regular_file(path, ignored)) return {};
  std::string head(4096, ' ');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), std::streamsize(head.size()));
  const auto says = [&](std::string_view text) { return head.find(text) != head.npos; };
  ToldFrame told;
  if (says("uses centimeters as units") || says("UNITS=cm")) told.metresPerUnit = 0.01;
  if (says("UNITS=mm")) told.metresPerUnit = 0.001;
  if (const std::string extension = extensionOf(path); extension == ".obj" || extension == ".swc")
    for (std::string_view rest = head; !rest.empty() && told.metresPerUnit == 0;)
      told.metresPerUnit = unitOfComment(lowerCase(nextLine(rest)));
  if (told.metresPerUnit == 0 && extensionOf(path) == ".swc") told.metresPerUnit = swcUnit(head);
  // .vtp files have the axes as data, packed as all others are.
  std::string space;
  if (says("Name=\"SPACE\""))
    if (const auto bytes = readFile(path, vtk::kMaximumBytes)) space = vtpSpace(*bytes);
  if (says("SPACE=LPS") || space == "LPS") told.up = ImportFrame::Up::z;
  if (says("SPACE=RAS") || space == "RAS") told.up = ImportFrame::Up::zBackwards;
  return told;
}

std::string remedyFor(const std::filesystem::path& path, FileUse use) {
  const std::string extension = extensionOf(path);
  if (use == FileUse::vessels && isMarkupsFile(path)) return "; vasa convert makes a network of it";
  // a.nii.gz, a.mrk.json: what stands before tells.
  if (extension == ".gz" || extension == ".json")
    if (std::string inner = remedyFor(path.stem(), use); !inner.empty()) return inner;
  return remedyOf(extension, use);
}

}  // namespace vasa
