// VTK's XML files, whose arrays may be packed: a few bytes of a file may say a megabyte.
#include <doctest/doctest.h>
#include <zlib.h>

#include "fuzz/growth.h"
#include "io/base64.h"
#include "io/vtk.h"
#include "io/vtp.h"
#include "network/centrelines.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// Zeros, packed as tightly as zlib can.
std::string packedZeros(std::size_t megabytes) {
  const std::vector<Bytef> zeros(1 << 20);
  std::vector<Bytef> packed(compressBound(zeros.size()));
  uLongf size = packed.size();
  compress2(packed.data(), &size, zeros.data(), zeros.size(), 9);
  std::vector<std::uint32_t> header{std::uint32_t(megabytes), 1 << 20, 0};
  header.insert(header.end(), megabytes, std::uint32_t(size));
  std::vector<std::byte> data;
  for (std::size_t i = 0; i < megabytes; ++i)
    data.insert(data.end(), reinterpret_cast<std::byte*>(packed.data()),
                reinterpret_cast<std::byte*>(packed.data() + size));
  return encodeBase64(std::as_bytes(std::span(header))) + encodeBase64(data);
}

std::string vtpWith(const std::string& pieces) {
  return R"(<VTKFile type="PolyData" byte_order="LittleEndian" compressor="vtkZLibDataCompressor"><PolyData>)" +
         pieces + "</PolyData></VTKFile>";
}
std::string vtpPiece(const std::string& cells) {
  return R"(<Piece NumberOfPoints="2" NumberOfLines="1"><Points><DataArray type="Float32" format="ascii">0 0 0 1 0 0</DataArray></Points>)"
         R"(<PointData><DataArray type="Float32" Name="Radius" format="ascii">1 1</DataArray></PointData>)"
         R"(<Lines><DataArray type="Int32" Name="connectivity" format="ascii">0 1</DataArray><DataArray type="Int32" Name="offsets" format="ascii">2</DataArray></Lines>)"
         "<CellData>" +
         cells + "</CellData></Piece>";
}

}  // namespace

TEST_CASE("grids of nasty shapes grow in proportion") {
  const auto array = [](const char* name, const std::string& values) {
    return "<DataArray type=\"UInt8\" Name=\"" + std::string(name) + "\" " + values + "</DataArray>";
  };
  const auto grid = [&](const std::string& inside) {
    return R"(<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" compressor="vtkZLibDataCompressor"><UnstructuredGrid><Piece><Points><DataArray type="Float32" format="ascii">0 0 0 1 0 0</DataArray></Points>)" +
           inside + "</Piece></UnstructuredGrid></VTKFile>";
  };
  const auto zeros = [&](std::size_t n) { return "format=\"binary\">" + packedZeros(n); };
  checkGrowth({{"packed cells", 16,
                [&](std::size_t n) {
                  return grid("<Cells>" + array("connectivity", "format=\"ascii\">0") +
                              array("offsets", zeros(n)) + array("types", zeros(n)) + "</Cells>");
                }},
               {"packed corners", 16,
                [&](std::size_t n) {
                  return grid("<Cells>" + array("connectivity", zeros(n)) +
                              array("offsets", "format=\"ascii\">1") + array("types", "format=\"ascii\">1") +
                              "</Cells>");
                }},
               {"packed data", 16,
                [&](std::size_t n) { return grid("<CellData>" + array("a", zeros(n)) + "</CellData>"); }},
               {"cells", 50'000,
                [&](std::size_t n) {
                  return grid("<Cells>" + array("connectivity", "format=\"ascii\">0 1") +
                              array("offsets", "format=\"ascii\">" + times(n, "2 ")) +
                              array("types", "format=\"ascii\">" + times(n, "3 ")) + "</Cells>");
                }}},
              [](const std::string& file) { return messageOf(parseVtkSurface(bytesOf(file), "f")); });
}

TEST_CASE("VTP of nasty shapes grows in proportion") {
  const auto packed = [](std::size_t megabytes, const char* type) {
    return vtpWith(R"(<Piece NumberOfPoints="2" NumberOfLines="1"><Points><DataArray type=")" +
                   std::string(type) + R"(" format="binary">)" + packedZeros(megabytes) +
                   "</DataArray></Points></Piece>");
  };
  const std::string array = R"(<DataArray type="Int8" Name="a" format="ascii">0</DataArray>)";
  checkGrowth(
      {{"packed zeros", 16, [&](std::size_t n) { return packed(n, "UInt8"); }},
       {"many packed zeros", 256, [&](std::size_t n) { return packed(n, "Float64"); }},
       {"pieces", 200, [&](std::size_t n) { return vtpWith(times(n, vtpPiece(""))); }},
       {"arrays of one name", 1'000, [&](std::size_t n) { return vtpWith(vtpPiece(times(n, array))); }},
       {"arrays", 1'000,
        [](std::size_t n) {
          return vtpWith(vtpPiece(times(n, [](std::size_t i) {
            return R"(<DataArray type="Int8" Name="a)" + of(i) + R"(" format="ascii">0</DataArray>)";
          })));
        }},
       {"elements", 20'000, [](std::size_t n) { return vtpWith(vtpPiece("") + times(n, "<a/>")); }}},
      [](const std::string& file) { return messageOf(parseVtp(bytesOf(file), "f")); });
  // One long step, and many short ones beside it.
  const auto crowd = [](std::size_t n) {
    std::string points = "0 0 0 1000 0 0 ", radii = "0.0001 0.0001 ", lines = "0 1 ", ends = "2 ";
    for (std::size_t i = 0; i < 2 * n; ++i)
      points += of(i) + "e-3 " + of(i % 2) + "e-2 1 ", radii += "0.0001 ", lines += of(i + 2) + " ";
    for (std::size_t i = 0; i < n; ++i) ends += of(2 * i + 4) + " ";
    return vtpWith(
        R"(<Piece NumberOfPoints=")" + of(2 * n + 2) + R"(" NumberOfLines=")" + of(n + 1) +
        R"("><Points><DataArray type="Float32" format="ascii">)" + points +
        R"(</DataArray></Points><PointData><DataArray type="Float32" Name="Radius" format="ascii">)" + radii +
        R"(</DataArray></PointData><Lines><DataArray type="Int32" Name="connectivity" format="ascii">)" +
        lines + R"(</DataArray><DataArray type="Int32" Name="offsets" format="ascii">)" + ends +
        "</DataArray></Lines></Piece>");
  };
  const auto lines = parseVtp(bytesOf(crowd(20'000)), "f");
  REQUIRE(lines.ok());
  CHECK(messageOf(centrelinesOfVtp(*lines, "f", VesselKind::artery)).find("1000 comparisons a point") !=
        std::string::npos);
}
