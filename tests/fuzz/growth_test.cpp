// Shapes that once took time or memory in the square of a file's size, or a thousand times its size: each is
// made n, 2n and 4n large, and read or refused within the limits of io/read_limits.h.
#include <doctest/doctest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "collide/network_tubes.h"
#include "core/hash.h"
#include "core/log.h"
#include "fuzz/processor_time.h"
#include "growth/growth_rules.h"
#include "growth/regions.h"
#include "io/base64.h"
#include "io/bvh.h"
#include "io/gltf.h"
#include "io/markups.h"
#include "io/obj.h"
#include "io/read_limits.h"
#include "io/stl.h"
#include "io/swc.h"
#include "io/vtk.h"
#include "io/vtp.h"
#include "network/centrelines.h"
#include "network/file.h"
#include "scene/scene_file.h"
#include "support/live_memory.h"

using namespace vasa;
using namespace vasa::test;

namespace {

struct Shape {
  const char* name;
  std::size_t n;  // the smallest
  std::function<std::string(std::size_t)> make;
};

std::string times(std::size_t n, const std::function<std::string(std::size_t)>& part) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += part(i);
  return text;
}
std::string times(std::size_t n, const std::string& part) {
  return times(n, [&](std::size_t) { return part; });
}
std::string of(std::size_t i) { return std::to_string(i); }

/// The least of three runs: what else the machine does only adds. @param read  gives the message of a refusal
double secondsFor(const std::string& file, const std::function<std::string(const std::string&)>& read,
                  std::string& refusal) {
  double least = 1e9;
  for (int run = 0; run < 3; ++run) {
    const double before = processorSeconds();
    refusal = read(file);
    least = std::min(least, processorSeconds() - before);
  }
  return least;
}

void checkGrowth(const std::vector<Shape>& shapes,
                 const std::function<std::string(const std::string&)>& read) {
  const LogLevel level = logLevel();
  setLogLevel(LogLevel::quiet);
  for (const Shape& shape : shapes) {
    CAPTURE(std::string(shape.name));
    double seconds[3];
    std::string told;
    for (int k = 0; k < 3; ++k) {
      const std::string file = shape.make(shape.n << k);
      const std::size_t before = restartPeak();
      std::string refusal;
      seconds[k] = secondsFor(file, read, refusal);
      const std::size_t memory = peakMemory() - before;
      CAPTURE(file.size());
      CAPTURE(memory);
      if (countsMemory()) CHECK(memory <= kMemoryTimes * file.size() + kMemoryFree);
      told += "  " + of(file.size() / 1000) + " kB " + of(std::size_t(seconds[k] * 1e6)) + " us " +
              of(memory / 1000) + " kB" + (refusal.empty() ? "" : " refused");
      if (k == 2 && !refusal.empty()) told += ": " + refusal.substr(0, 160);
    }
    MESSAGE(std::string(shape.name) << told);
    // In proportion it is four times as long, in the square sixteen times. The tenth of a second is for what
    // the system does.
    CHECK(seconds[2] < 8 * seconds[0] + 0.1);
  }
  setLogLevel(level);
}

template <class T>
std::string messageOf(const Result<T>& result) {
  if (result) return {};
  CHECK(result.error().fault == Fault::badInput);
  return result.error().message;
}

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

constexpr float kTriangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

std::string gltfWith(const std::string& rest) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
         encodeBase64(std::as_bytes(std::span(kTriangle))) +
         R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],)" + rest + "}";
}
const std::string kAccessor = R"({"bufferView":0,"type":"VEC3","componentType":5126,"count":3})";
const std::string kAccessors = R"("accessors":[)" + kAccessor + "],";
const std::string kMesh = kAccessors + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)";

std::string list(const std::string& items) { return "[" + items.substr(0, items.size() - 1) + "]"; }

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

// The chunks of a network with header and checksum.
std::string vasaOf(const std::string& body) {
  std::string file = "VASA";
  const std::uint32_t version = 1;
  const std::uint64_t length = body.size(), hash = hashBytes(bytesOf(body));
  file.append(reinterpret_cast<const char*>(&version), 4).append(reinterpret_cast<const char*>(&length), 8);
  return file.append(reinterpret_cast<const char*>(&hash), 8) + body;
}
std::string chunk(const char* tag, const std::string& payload) {
  const auto size = std::uint32_t(payload.size());
  return std::string(tag, 4).append(reinterpret_cast<const char*>(&size), 4) + payload;
}
std::string leb(std::size_t value) {
  std::string out;
  for (; value >= 0x80; value >>= 7) out += char(value | 0x80);
  return out + char(value);
}

}  // namespace

TEST_CASE("glTF of nasty shapes grows in proportion") {
  const auto nodes = [](const std::string& all) { return gltfWith(kMesh + R"("nodes":)" + list(all)); };
  checkGrowth(
      {
          {"empty nodes", 30'000, [&](std::size_t n) { return nodes(R"({"mesh":0},)" + times(n, "{},")); }},
          {"nodes with one mesh", 10'000, [&](std::size_t n) { return nodes(times(n, R"({"mesh":0},)")); }},
          {"a chain of nodes", 8'000,
           [&](std::size_t n) {
             return nodes(times(n, [](std::size_t i) { return R"({"children":[)" + of(i + 1) + "]},"; }) +
                          R"({"mesh":0},)");
           }},
          {"children of one node", 10'000,
           [&](std::size_t n) {
             return nodes(R"({"mesh":0,"children":)" +
                          list(times(n, [](std::size_t i) { return of(i + 1) + ","; })) + "}," +
                          times(n, "{},"));
           }},
          {"primitives", 4'000,
           [](std::size_t n) {
             return gltfWith(kAccessors + R"("meshes":[{"primitives":)" +
                             list(times(n, R"({"attributes":{"POSITION":0}},)")) +
                             R"(}],"nodes":[{"mesh":0}])");
           }},
          {"buffers", 2'000,
           [](std::size_t n) {
             std::string file = gltfWith(kMesh + R"("nodes":[{"mesh":0}])");
             const std::size_t end = file.find("],\"bufferViews");
             return file.insert(
                 end, times(n, R"(,{"byteLength":3,"uri":"data:application/octet-stream;base64,AAAA"})"));
           }},
          {"accessors that share their data", 3'000,
           [](std::size_t n) {
             return gltfWith(
                 R"("accessors":)" + list(times(n, kAccessor + ",")) +
                 R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}])");
           }},
          {"accessors without data", 2'000,
           [](std::size_t n) {
             return gltfWith(
                 R"("accessors":)" +
                 list(kAccessor + "," + times(n, R"({"type":"MAT4","componentType":5126,"count":100000},)")) +
                 R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}])");
           }},
          {"numbers that nobody reads", 100'000,
           [](std::size_t n) {
             return gltfWith(kMesh + R"("nodes":[{"mesh":0,"extras":)" + list(times(n, "0,")) + "}]");
           }},
          {"names that nobody reads", 10'000,
           [](std::size_t n) {
             return gltfWith(kMesh + R"("nodes":[{"mesh":0,"extras":{"a":0)" +
                             times(n, [](std::size_t i) { return ",\"" + of(i) + "\":{}"; }) + "}}]");
           }},
          {"nodes with one mesh of many vessels", 2'000,
           [](std::size_t n) {
             return gltfWith(
                 kAccessors +
                 R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}],"extras":{"vessels":)" +
                 list(times(n, R"({"name":"a"},)")) + R"(}}],"nodes":)" + list(times(n, R"({"mesh":0},)")));
           }},
          {"nodes with one mesh of many morph targets", 2'000,
           [](std::size_t n) {
             return gltfWith(kAccessors +
                             R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":)" +
                             list(times(n, R"({"POSITION":0},)")) + R"(}],"weights":)" +
                             list(times(n, "0,")) + R"(}],"nodes":)" + list(times(n, R"({"mesh":0},)")));
           }},
          {"a broken end", 20'000,
           [&](std::size_t n) { return nodes(times(n, R"({"mesh":0},)") + R"({"mesh":7},)"); }},
      },
      [](const std::string& file) {
        std::vector<std::byte> bytes(bytesOf(file).begin(), bytesOf(file).end());
        return messageOf(parseGltfElements(std::move(bytes), "f"));
      });
}

TEST_CASE("bodies of nasty shapes grow in proportion") {
  const std::string skin =
      R"("accessors":[)" + kAccessor +
      R"(,{"type":"VEC4","componentType":5121,"count":3},{"type":"VEC4","componentType":5126,"count":3}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],)";
  checkGrowth({{"joints", 4'000,
                [&](std::size_t n) {
                  return gltfWith(
                      skin + R"("skins":[{"joints":)" +
                      list(times(n, [](std::size_t i) { return of(i + 1) + ","; })) + R"(}],"nodes":)" +
                      list(R"({"children":)" + list(times(n, [](std::size_t i) { return of(i + 1) + ","; })) +
                           "}," + times(n, "{},") + R"({"mesh":0,"skin":0},)"));
                }},
               {"skins that share a joint", 4'000,
                [&](std::size_t n) {
                  return gltfWith(skin + R"("skins":)" + list(times(n, R"({"joints":[0]},)")) +
                                  R"(,"nodes":[{},{"mesh":0,"skin":0}])");
                }},
               {"nodes with one skin", 2'000,
                [&](std::size_t n) {
                  return gltfWith(skin + R"("skins":[{"joints":[0]}],"nodes":)" +
                                  list("{}," + times(n, R"({"mesh":0,"skin":0},)")));
                }}},
              [](const std::string& file) {
                std::vector<std::byte> bytes(bytesOf(file).begin(), bytesOf(file).end());
                return messageOf(parseBody(std::move(bytes), "f"));
              });
}

TEST_CASE("SWC of nasty shapes grows in proportion") {
  const auto sample = [](std::size_t id, std::size_t parent) {
    return of(id) + " 0 " + of(id) + " 0 0 1 " + (id == parent ? "-1" : of(parent)) + "\n";
  };
  checkGrowth(
      {{"a chain", 10'000,
        [&](std::size_t n) { return times(n, [&](std::size_t i) { return sample(i + 1, i ? i : 1); }); }},
       {"a star", 10'000,
        [&](std::size_t n) { return times(n, [&](std::size_t i) { return sample(i + 1, 1); }); }},
       {"ids that meet in one place of a hash table", 20'000,
        [&](std::size_t n) {
          // Libstdc++'s.
          const std::size_t buckets = n > 62'233 ? 126'271 : n > 30'727 ? 62'233 : 30'727;
          return times(n, [&](std::size_t i) {
            return of((i + 1) * buckets) + " 0 " + of(i) + " 0 0 1 " + (i ? of(i * buckets) : "-1") + "\n";
          });
        }},
       {"samples without radii", 10'000,
        [](std::size_t n) {
          return times(n, [n](std::size_t i) {
            return of(i + 1) + " 0 " + of(i) + " 0 0 " + (i + 1 == n ? "1 " : "0 ") + (i ? of(i) : "-1") +
                   "\n";
          });
        }},
       {"roots", 10'000,
        [](std::size_t n) { return times(n, [](std::size_t i) { return of(i) + " 0 0 0 0 1 -1\n"; }); }}},
      [](const std::string& file) {
        const auto samples = parseSwc(file, "f");
        if (samples) (void)centrelinesOfSwc(*samples, "f", VesselKind::artery);
        return messageOf(samples);
      });
}

TEST_CASE("curves of 3D Slicer grow in proportion") {
  const auto curve = [](const std::string& points, const std::string& radii) {
    return R"({"markups":[{"type":"Curve","controlPoints":[)" + points +
           R"(],"measurements":[{"name":"Radius","controlPointValues":[)" + radii + "]}]}]}";
  };
  const auto list = [](std::size_t n, const auto& item) {
    return times(n, [&](std::size_t i) { return (i > 0 ? "," : "") + item(i); });
  };
  checkGrowth(
      {{"control points", 3000,
        [&](std::size_t n) {
          return curve(list(n, [](std::size_t i) { return R"({"position":[0,0,)" + of(i) + "]}"; }),
                       list(n, [&](std::size_t i) { return std::string(i + 1 == n ? "1" : "0"); }));
        }},
       {"empty points", 20'000,
        [&](std::size_t n) { return curve(list(n, [](std::size_t) { return std::string("{}"); }), "1"); }},
       {"curves", 2000,
        [&](std::size_t n) {
          const std::string one =
              R"({"type":"Curve","controlPoints":[{"position":[0,0,1]},{"position":[0,0,2]}],)"
              R"("measurements":[{"name":"r","controlPointValues":[1,1]}]})";
          return R"({"markups":[)" + list(n, [&](std::size_t) { return one; }) + "]}";
        }}},
      [](const std::string& file) { return messageOf(parseMarkups(file, "f", VesselKind::artery)); });
}

TEST_CASE("combs of branches and who is whose neighbour in them grow in proportion") {
  // Along x, one tooth every step [mm]; the host is 5 mm thick.
  const auto comb = [](std::size_t teeth, double step) {
    std::string text = "1 2 -20 0 0 5 -1\n";
    const auto id = [](std::size_t tooth) { return of(4 * tooth + 2); };
    for (std::size_t i = 0; i < teeth; ++i) {
      const std::string x = std::to_string(step * double(i));
      text += id(i) + " 2 " + x + " 0 0 5 " + (i ? id(i - 1) : "1") + "\n";
      for (std::size_t k = 1; k < 4; ++k)
        text += of(4 * i + 2 + k) + " 2 " + x + " " + of(20 * k) + " 0 1 " + of(4 * i + 1 + k) + "\n";
    }
    return text + of(4 * teeth + 2) + " 2 " + std::to_string(step * double(teeth) + 20) + " 0 0 5 " +
           id(teeth - 1) + "\n";
  };
  checkGrowth({{"teeth", 200, [&](std::size_t n) { return comb(n, 0.1); }},
               {"teeth at almost one place", 300, [&](std::size_t n) { return comb(n, 1e-3); }}},
              [](const std::string& file) -> std::string {
                const auto samples = parseSwc(file, "f");
                REQUIRE(samples.ok());
                const auto made = networkOfCentrelines(centrelinesOfSwc(*samples, "f", VesselKind::artery));
                if (made) CHECK(NetworkTubes(made->network).neighbours().pairCount() > 200);
                return messageOf(made);
              });
}

TEST_CASE("OBJ of nasty shapes grows in proportion") {
  const auto star = [](std::size_t corners) {
    return times(corners, [&](std::size_t i) {
      const double angle = 2 * kPi * double(i) / double(corners), radius = i % 2 ? 0.5 : 1;
      return "v " + std::to_string(radius * std::cos(angle)) + " " +
             std::to_string(radius * std::sin(angle)) + " 0\n";
    });
  };
  const auto face = [](std::size_t corners) {
    return "f" + times(corners, [](std::size_t i) { return " " + of(i + 1); }) + "\n";
  };
  checkGrowth(
      {{"one polygon", 200, [&](std::size_t n) { return star(n) + face(n); }},
       {"polygons that turn inward", 20, [&](std::size_t n) { return star(512) + times(n, face(512)); }},
       {"polygons whose corners are one", 40,
        [&](std::size_t n) { return "v 0 0 0\n" + times(n, "f" + times(512, " 1") + "\n"); }},
       {"triangles", 20'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + times(n, "f 1 2 3\n"); }},
       {"objects", 10'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + times(n, "o a\nf 1 2 3\n"); }},
       {"groups in turn", 20'000,
        [](std::size_t n) {
          return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + times(n, "g a\nf 1 2 3\ng b\nf 1 2 3\n");
        }},
       {"groups", 10'000,
        [](std::size_t n) {
          return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" +
                 times(n, [](std::size_t i) { return "g a" + of(i) + "\nf 1 2 3\n"; });
        }},
       {"one line of many", 100'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl a" + times(n, "\\\n"); }},
       {"lines of two", 20'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + times(n, "f 1\\\r\n2 3\r\n"); }},
       {"objects without faces", 20'000,
        [](std::size_t n) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + times(n, "g a\n"); }},
       {"vertices", 20'000, [](std::size_t n) { return times(n, "v 0 0 0\n") + "f 1 2 3\n"; }}},
      [](const std::string& file) { return messageOf(parseObj(file, "f")); });
}

TEST_CASE("STL of nasty shapes grows in proportion") {
  const auto facet = [](std::size_t i) {
    return "facet normal 0 0 0 outer loop vertex " + of(i) + " 0 0 vertex 1 0 0 vertex 0 1 " + of(i) +
           " endloop endfacet\n";
  };
  checkGrowth({{"facets", 3'000, [&](std::size_t n) { return "solid a\n" + times(n, facet) + "endsolid\n"; }},
               {"solids of one name that are numbered by others", 3'000,
                [&](std::size_t n) {
                  return times(n, [&](std::size_t i) {
                    return "solid f " + of(i) + "\n" + facet(i) + "endsolid\nsolid\n" + facet(i) +
                           "endsolid\n";
                  });
                }},
               {"solids", 3'000,
                [&](std::size_t n) {
                  return times(n, [&](std::size_t i) { return "solid a\n" + facet(i) + "endsolid\n"; });
                }},
               {"binary facets", 5'000,
                [](std::size_t n) {
                  std::string file(84 + 50 * n, '\0');
                  const auto count = std::uint32_t(n);
                  std::memcpy(file.data() + 80, &count, 4);
                  for (std::size_t i = 0; i < n; ++i)
                    for (int k = 0; k < 9; ++k) {
                      const float x = float((i * 9 + std::size_t(k)) % 1000);
                      std::memcpy(file.data() + 84 + 50 * i + 12 + 4 * std::size_t(k), &x, 4);
                    }
                  return file;
                }}},
              [](const std::string& file) { return messageOf(parseStl(bytesOf(file), "f")); });
}

TEST_CASE("legacy VTK of nasty shapes grows in proportion") {
  const std::string head =
      "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 0 1 0 1 0 0\n";
  checkGrowth(
      {{"empty faces", 100'000,
        [&](std::size_t n) { return head + "POLYGONS " + of(n) + " " + of(n) + "\n" + times(n, "0\n"); }},
       {"triangles", 50'000,
        [&](std::size_t n) {
          return head + "POLYGONS " + of(n) + " " + of(4 * n) + "\n" + times(n, "3 0 1 2\n");
        }},
       {"arrays", 2'000,
        [&](std::size_t n) {
          return head + "POINT_DATA 3\nFIELD f " + of(n) + "\n" +
                 times(n, [](std::size_t i) { return 'a' + of(i) + " 1 3 int\n1 1 1\n"; });
        }}},
      [](const std::string& file) { return messageOf(parseVtkSurface(bytesOf(file), "f")); });
}

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

TEST_CASE("BVH and joint maps of nasty shapes grow in proportion") {
  const auto motion = [](std::size_t joints, std::size_t frames) {
    return "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n" +
           times(joints, "JOINT b\n{\nOFFSET 0 0 0\n}\n") + "}\nMOTION\nFrames: " + of(frames) +
           "\nFrame Time: 0.01\n" + times(frames, "0\n");
  };
  const auto rows = [](std::size_t n, const std::string& end) {
    return "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 2 Xrotation Yrotation\n}\nMOTION\nFrames: " + of(n) +
           "\nFrame Time: 0.01\n" + times(n, "0\n0\n") + end;
  };
  checkGrowth(
      {{"frames", 10'000, [&](std::size_t n) { return motion(1, n); }},
       {"frames of two rows", 10'000, [&](std::size_t n) { return rows(n, {}); }},
       {"rows behind the last frame", 20'000, [&](std::size_t n) { return rows(3, times(n, "0 0\n")); }},
       {"a long row", 50'000, [&](std::size_t n) { return rows(3, times(n, "0 ")); }},
       {"frames of joints without channels", 5'000, [&](std::size_t n) { return motion(4000, n); }}},
      [](const std::string& file) { return messageOf(parseBvh(file, "f")); });
  checkGrowth({{"pairs", 10'000,
                [](std::size_t n) { return times(n, [](std::size_t i) { return of(i) + "=\n"; }); }}},
              [](const std::string& file) { return messageOf(parseJointMap(file, "f")); });
}

TEST_CASE("scenes and rules of nasty shapes grow in proportion") {
  checkGrowth(
      {{"networks", 10'000, [](std::size_t n) { return R"({"networks":)" + list(times(n, "\"\",")) + "}"; }},
       {"numbers", 50'000,
        [](std::size_t n) { return R"({"camera":{"position":)" + list(times(n, "0,")) + "}}"; }}},
      [](const std::string& file) { return messageOf(parseScene(file, "folder", "f")); });
  checkGrowth({{"letters", 30'000,
                [](std::size_t n) {
                  return "system a\naxiom S\n" +
                         times(n, [](std::size_t i) { return "draw a" + of(i) + "\n"; });
                }},
               {"brackets", 20'000,
                [](std::size_t n) { return "system a\naxiom S\ndraw S\nS -> F " + times(n, "[S]") + "\n"; }}},
              [](const std::string& file) { return messageOf(parseGrowthRules(file, "f")); });
  const auto rules = parseGrowthRules("system a\naxiom S\ndraw S\n", "f");
  REQUIRE(rules.ok());
  checkGrowth({{"regions", 10'000,
                [](std::size_t n) {
                  return "region,system,joints,vessels,kinds,thinnest_mm,thickest_mm,bed_mm,surface\n" +
                         times(n, "a,-,,,,,,,\n");
                }}},
              [&](const std::string& file) { return messageOf(parseRegions(file, "f", *rules)); });
}

TEST_CASE("networks of nasty shapes grow in proportion") {
  const auto point = [](float x) {
    const float p[] = {x, 0, 0, 0.1f};
    return std::string(reinterpret_cast<const char*>(p), sizeof p);
  };
  const std::string meta = chunk("META", std::string("\0\0\x80\x3f", 4));
  const auto vessels = [&](std::size_t n, const std::string& points) {
    const std::string name(4096, 'a');
    return chunk("VESL",
                 leb(n) + std::string(1, '\0') + leb(0) + leb(4096) + name + leb(0) + leb(0) + points +
                     times(n - 1, std::string(1, '\0') + leb(4096) + leb(0) + leb(0) + leb(0) + points));
  };
  checkGrowth(
      {{"names that share 4096 letters", 2'000,
        [&](std::size_t n) {
          return vasaOf(meta + vessels(n, leb(4)) +
                        chunk("PNTS", times(4 * n, [&](std::size_t i) { return point(float(i)); })));
        }},
       {"vessels without points", 20'000,
        [&](std::size_t n) {
          return vasaOf(meta + chunk("VESL", leb(n) + times(n, std::string(6, '\0'))) + chunk("PNTS", ""));
        }},
       {"nodes without vessels", 20'000,
        [&](std::size_t n) {
          return vasaOf(meta + chunk("VESL", leb(0)) +
                        chunk("NODE", leb(n) + times(n, std::string("\0\1\0", 3))) + chunk("PNTS", ""));
        }}},
      [](const std::string& file) { return messageOf(decodeNetwork(bytesOf(file), "f")); });
}
