#include <doctest/doctest.h>

#include "fuzz/growth.h"
#include "io/base64.h"
#include "io/gltf.h"

using namespace vasa;
using namespace vasa::test;

namespace {

constexpr float kTriangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

std::string gltfWith(const std::string& rest) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
         encodeBase64(std::as_bytes(std::span(kTriangle))) +
         R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],)" + rest + "}";
}
const std::string kAccessor = R"({"bufferView":0,"type":"VEC3","componentType":5126,"count":3})";
const std::string kAccessors = R"("accessors":[)" + kAccessor + "],";
const std::string kMesh = kAccessors + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)";

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
