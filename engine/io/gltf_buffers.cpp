#include "io/gltf_buffers.h"

#include <cctype>
#include <map>

#include "core/atomic_file.h"
#include "io/base64.h"
#include "io/gltf_container.h"

namespace vasa::gltf {
namespace {

using Bytes = std::vector<std::byte>;
using BytesView = std::span<const std::byte>;
constexpr std::size_t kGlbPadding = 3;  // the BIN chunk may be this much longer than its buffer

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percentDecoded(const JsonView& uri) {
  const std::string& text = uri.text();
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
    if (high < 0 || low < 0) uri.fail("has a % that is not followed by two hexadecimal digits");
    out += char(high * 16 + low);
    i += 2;
  }
  return out;
}

// RFC 3986: a letter, then letters, digits, "+", "-", "."; then a colon.
bool hasScheme(const std::string& uri) {
  if (uri.empty() || !std::isalpha(static_cast<unsigned char>(uri[0]))) return false;
  for (const char c : uri) {
    if (c == ':') return true;
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.') return false;
  }
  return false;
}

bool isBase64(std::string_view text) {
  if (text.size() % 4 != 0) return false;
  if (text.ends_with("=="))
    text.remove_suffix(2);
  else if (text.ends_with("="))
    text.remove_suffix(1);
  for (const char c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '/') return false;
  return true;
}

Bytes decodeDataUri(const JsonView& uri) {
  const std::string& text = uri.text();
  const std::size_t comma = text.find(',');
  const std::string header = text.substr(0, comma);
  if (header != "data:application/octet-stream;base64" && header != "data:application/gltf-buffer;base64")
    uri.fail("data of type \"" + header.substr(0, 60) + "\" must be data:application/octet-stream;base64");
  if (comma == std::string::npos) uri.fail("is not valid base64 data");
  const std::string_view payload = std::string_view(text).substr(comma + 1);
  auto bytes = isBase64(payload) ? decodeBase64(payload) : std::nullopt;
  if (!bytes) uri.fail("is not valid base64 data");
  return std::move(*bytes);
}

bool isInside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() || end->empty();
}

class Loader {
 public:
  Loader(std::optional<BytesView> binary, const std::filesystem::path& folder)
      : binary_(binary), home_(std::filesystem::weakly_canonical(folder.empty() ? "." : folder)) {}

  Buffers run(const JsonView& root) {
    for (const JsonView& buffer : root.items("buffers")) out_.bytes.push_back(load(buffer));
    return std::move(out_);
  }

 private:
  BytesView load(const JsonView& buffer) {
    const std::size_t length = std::size_t(buffer.at("byteLength").integer(1, kMaximumFileBytes));
    BytesView bytes;
    if (const auto uri = buffer.find("uri")) {
      const UriTarget target = classifyUri(*uri);
      if (target.kind == UriTarget::Kind::elsewhere) return {};
      bytes = target.kind == UriTarget::Kind::data ? out_.read.emplace_back(decodeDataUri(*uri))
                                                   : beside(*uri, target.path);
    } else if (out_.bytes.empty() && binary_) {
      bytes = *binary_;
      if (length + kGlbPadding < bytes.size())
        buffer.at("byteLength")
            .fail("is " + std::to_string(length) + ", but the BIN chunk has " + std::to_string(bytes.size()) +
                  " bytes");
    } else {
      return {};
    }
    if (bytes.size() < length)
      buffer.at("byteLength")
          .fail("is " + std::to_string(length) + ", but there are only " + std::to_string(bytes.size()) +
                " bytes");
    return bytes.first(length);
  }

  // However many buffers name it, a file is read once.
  BytesView beside(const JsonView& uri, const std::string& relative) {
    const auto known = byName_.find(relative);
    if (known != byName_.end()) return known->second;
    const std::filesystem::path file = std::filesystem::weakly_canonical(home_ / relative);
    if (!isInside(file, home_))
      uri.fail("\"" + relative + "\" leaves the asset's folder", "keep all files of the asset in one folder");
    auto [found, fresh] = byFile_.try_emplace(file);
    if (fresh) found->second = read(uri, file);
    return byName_[relative] = found->second;
  }
  BytesView read(const JsonView& uri, const std::filesystem::path& file) {
    // What the asset names and lacks is the asset's fault; what is there and cannot be read is the disk's.
    std::error_code ignored;
    const auto status = std::filesystem::status(file, ignored);
    const std::string name = '"' + file.filename().string() + '"';
    if (!std::filesystem::exists(status))
      uri.fail(name + " is missing", "keep all files of the asset in one folder");
    if (!std::filesystem::is_regular_file(status)) uri.fail(name + " is not a regular file");
    auto bytes = readFile(file, kMaximumFileBytes);
    if (!bytes) throw Error{bytes.error().fault, uri.place() + ": " + bytes.error().message};
    out_.bytesBeside += bytes->size();
    if (out_.bytesBeside > kMaximumFileBytes)
      uri.fail("all buffers together hold more than " + std::to_string(kMaximumFileBytes) + " bytes",
               "split or reduce the asset");
    return out_.read.emplace_back(std::move(*bytes));
  }

  std::optional<BytesView> binary_;
  std::filesystem::path home_;
  std::map<std::string, BytesView> byName_;
  std::map<std::filesystem::path, BytesView> byFile_;
  Buffers out_;
};

}  // namespace

UriTarget classifyUri(const JsonView& uri) {
  const std::string& text = uri.text();
  if (text.starts_with("data:")) return {UriTarget::Kind::data, ""};
  if (text.empty()) uri.fail("must not be empty");
  if (hasScheme(text)) return {UriTarget::Kind::elsewhere, ""};
  const std::string path = percentDecoded(uri);
  if (path.find('\0') != std::string::npos) uri.fail("contains a zero byte");
  const std::string remedy = "keep all files of the asset in one folder and name them relative to it";
  if (path[0] == '/' || path[0] == '\\') uri.fail("\"" + path + "\" is absolute", remedy);
  for (const auto& part : std::filesystem::path(path))
    if (part == "..") uri.fail("\"" + path + "\" climbs out with ..", remedy);
  return {UriTarget::Kind::relative, path};
}

Buffers loadBuffers(const JsonView& root, std::optional<BytesView> binary,
                    const std::filesystem::path& folder) {
  return Loader(binary, folder).run(root);
}

}  // namespace vasa::gltf
