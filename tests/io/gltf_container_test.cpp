#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

/// Reads a file that must be refused and returns the message, which must begin with the file's name.
std::string refusal(const std::filesystem::path& path, Fault fault = Fault::badInput) {
  const auto result = checkGltf(path);
  REQUIRE(!result.ok());
  CHECK(result.error().fault == fault);
  CHECK(result.error().message.starts_with(path.string() + ": "));
  return result.error().message;
}

bool has(const std::string& text, const char* part) {
  const bool found = text.find(part) != std::string::npos;
  if (!found) MESSAGE(text);
  return found;
}

std::string withWord(std::string glb, std::size_t at, std::uint32_t word) {
  std::memcpy(glb.data() + at, &word, 4);
  return glb;
}

/// The triangle with its buffer in a file of the given URI.
std::string textNaming(const std::string& uri) {
  GltfBuilder file = triangleFile();
  file.document["buffers"] = {{{"uri", uri}}};
  return file.text();
}

std::string triangleBytes() {
  const GltfBuilder file = triangleFile();
  return {file.binary.begin(), file.binary.end()};
}

}  // namespace

TEST_CASE("a triangle is read from a GLB, a data URI and a file beside the glTF") {
  const TemporaryFolder folder;
  GltfBuilder file = triangleFile();
  CHECK(readGltfElements(writeBytes(folder.path() / "a.glb", file.glb())).ok());
  file.document["buffers"][0]["uri"] = file.dataUri();
  CHECK(readGltfElements(writeBytes(folder.path() / "a.gltf", file.text())).ok());
  std::filesystem::create_directory(folder.path() / "data");
  writeBytes(folder.path() / "data/a b.bin", triangleBytes() + "and more");
  const auto elements = readGltfElements(writeBytes(folder.path() / "b.gltf", textNaming("data/a%20b.bin")));
  REQUIRE(elements.ok());
  REQUIRE(elements->size() == 1);
  CHECK((*elements)[0].name == "triangle");
  CHECK((*elements)[0].mesh.positions == std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK((*elements)[0].mesh.triangles == std::vector<uvec3>{{0, 1, 2}});
}

TEST_CASE("a GLB whose header or chunks lie is refused with the byte") {
  const TemporaryFolder folder;
  const std::string good = triangleFile().glb();
  const auto message = [&](const std::string& bytes) {
    return refusal(writeBytes(folder.path() / "a.glb", bytes));
  };
  CHECK(has(message(""), "GLB byte 0: the file ends inside the 12-byte header"));
  CHECK(has(message(good.substr(0, 11)), "GLB byte 11"));
  CHECK(has(message(withWord(good, 0, 0)), "does not begin with \"glTF\""));
  CHECK(has(message(withWord(good, 4, 1)), "GLB byte 4: container version 1 must be 2"));
  CHECK(has(message(withWord(good, 8, 0)), "GLB byte 8: length 0 has no room"));
  CHECK(has(message(withWord(good, 8, 0xffffffff)), "GLB byte 8: length 4294967295 is more than"));
  CHECK(has(message(withWord(good, 8, std::uint32_t(good.size() - 4))), "reaches past the end"));
  CHECK(has(message(withWord(good, 12, 0xfffffffc)), "GLB byte 12: chunk of 4294967292 bytes reaches past"));
  CHECK(has(message(withWord(good, 12, 3)), "must be a multiple of 4"));
  CHECK(has(message(withWord(good, 12, 0)), "the JSON chunk is empty"));
  CHECK(has(message(withWord(good, 16, 0x004E4942)), "the first chunk must be JSON"));
  const std::string twice = good + good.substr(12);
  CHECK(has(message(withWord(twice, 8, std::uint32_t(twice.size()))), "a second JSON chunk"));
  CHECK(has(message(good.substr(0, good.size() - 4)), "is more than the file's"));
}

TEST_CASE("JSON that is broken, too deep or no JSON is refused") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    return refusal(writeBytes(folder.path() / "a.gltf", text));
  };
  const std::string open(40000, '['), close(40000, ']');
  CHECK(has(message(open + close), "JSON byte 64: nested more than 64 deep"));
  CHECK(has(message(R"({"asset":{"version":"2.0"},"extras":)" + open + close + "}"),
            "nested more than 64 deep"));
  // Brackets in strings do not count.
  CHECK(checkGltf(writeBytes(folder.path() / "b.gltf",
                             R"({"asset":{"version":"2.0","generator":"\"[[)" + open + R"("}})"))
            .ok());
  CHECK(has(message(""), "JSON: parse error at line 1"));
  CHECK(has(message("{\"asset\":"), "JSON: parse error at line 1"));
  CHECK(has(message("[]"), "/: must be an object, is array"));
  CHECK(has(message("{\"asset\":\"\xff\"}"), "JSON: parse error"));
  CHECK(has(message("\xEF\xBB\xBF{}"), "byte order mark"));
  CHECK(has(message("{}"), "/: must have the property asset"));
}

TEST_CASE("what is no regular file is refused as an I/O fault, without hanging") {
  const TemporaryFolder folder;
  refusal(folder.path() / "absent.glb", Fault::io);
  refusal(folder.path(), Fault::io);
  const auto pipe = folder.path() / "pipe.glb";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(has(refusal(pipe, Fault::io), "is not a regular file"));
  // What a file names and is not there is the file's fault.
  writeBytes(folder.path() / "a.gltf", textNaming("pipe.glb"));
  CHECK(has(refusal(folder.path() / "a.gltf", Fault::badInput),
            "/buffers/0/uri: \"pipe.glb\" is not a regular file"));
  writeBytes(folder.path() / "b.gltf", textNaming("absent.bin"));
  CHECK(has(refusal(folder.path() / "b.gltf", Fault::badInput), "/buffers/0/uri: \"absent.bin\" is missing"));
}

TEST_CASE("nothing outside the asset's folder is read") {
  const TemporaryFolder folder;
  const auto inner = folder.path() / "inner";
  std::filesystem::create_directory(inner);
  writeBytes(folder.path() / "secret.bin", triangleBytes());
  const auto message = [&](const std::string& uri) {
    return refusal(writeBytes(inner / "a.gltf", textNaming(uri)));
  };
  CHECK(has(message("../secret.bin"), "/buffers/0/uri: \"../secret.bin\" climbs out with .."));
  CHECK(has(message("x/../../secret.bin"), "climbs out"));
  CHECK(has(message("%2e%2E/secret.bin"), "climbs out"));
  CHECK(has(message((folder.path() / "secret.bin").string()), "is absolute"));
  CHECK(has(message("%2Fetc/passwd"), "is absolute"));
  CHECK(has(message("a%00.bin"), "contains a zero byte"));
  CHECK(has(message("a%2"), "two hexadecimal digits"));
  CHECK(has(message(""), "must not be empty"));
  std::filesystem::create_symlink(folder.path() / "secret.bin", inner / "link.bin");
  CHECK(has(message("link.bin"), "leaves the asset's folder"));
  std::filesystem::create_directory_symlink(folder.path(), inner / "up");
  CHECK(has(message("up/secret.bin"), "leaves the asset's folder"));
  // A link within the folder stays inside.
  writeBytes(inner / "real.bin", triangleBytes());
  std::filesystem::create_symlink("real.bin", inner / "alias.bin");
  CHECK(readGltfElements(writeBytes(inner / "a.gltf", textNaming("alias.bin"))).ok());
}

TEST_CASE("data that is elsewhere or nowhere may be described but not used") {
  const TemporaryFolder folder;
  for (const char* uri : {"http://example.com/a.bin", "file:///etc/passwd"}) {
    const auto path = writeBytes(folder.path() / "a.gltf", textNaming(uri));
    CHECK(checkGltf(path).ok());
    const auto elements = readGltfElements(path);
    REQUIRE(!elements.ok());
    CHECK(has(elements.error().message,
              "/buffers/0: its data is needed, but it is not in the file or beside it"));
  }
}

TEST_CASE("data URIs and buffer lengths must agree with the document") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& uri) {
    return refusal(writeBytes(folder.path() / "a.gltf", textNaming(uri)));
  };
  CHECK(has(message("data:application/octet-stream;base64,AAA"), "is not valid base64"));
  CHECK(has(message("data:application/octet-stream;base64,A*AA"), "is not valid base64"));
  CHECK(has(message("data:application/octet-stream;base64,AAAA"),
            "byteLength: is 36, but there are only 3 bytes"));
  CHECK(has(message("data:image/png;base64,AAAA"), "must be data:application/octet-stream;base64"));
  CHECK(has(message("data:application/octet-stream,AAAA"), "must be data:application/octet-stream;base64"));
  writeBytes(folder.path() / "short.bin", "abc");
  CHECK(has(message("short.bin"), "byteLength: is 36, but there are only 3 bytes"));
  GltfBuilder file = triangleFile();
  file.document["buffers"] = {{{"byteLength", 36}}};
  const std::string text = file.document.dump();
  file.binary.clear();
  file.document = nlohmann::json::parse(text);
  CHECK(has(refusal(writeBytes(folder.path() / "b.glb", file.glb())), "the GLB has no BIN chunk"));
}
