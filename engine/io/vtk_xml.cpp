#include "io/vtk_xml.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/text_file.h"
#include "io/base64.h"
#include "io/read_limits.h"
#include "io/words.h"

namespace vasa::vtk {
namespace {

using tinyxml2::XMLElement;

constexpr std::int64_t kMostItems = 1 << 26;
constexpr const char* kExportAgain = "; write the file again";

// Memory that the parsed XML takes [bytes], rather too much than too little.
std::size_t xmlMemory(std::string_view text) {
  constexpr std::size_t kANode = 128, kAnAttribute = 80;
  std::size_t memory = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '<' && text[i + 1] != '/') memory += kANode;
    if (text[i] == '>' && text[i + 1] != '<') memory += kANode;
    if (text[i] == '=') memory += kAnAttribute;
  }
  return memory;
}

std::vector<double> asciiNumbers(std::string_view text, const std::string& place) {
  std::vector<double> values;
  values.reserve(text.size() / 2 + 1);
  for (std::string_view word = nextWord(text, " \t\r\n"); !word.empty(); word = nextWord(text, " \t\r\n"))
    if (!parseNumber(word, values.emplace_back()))
      breaks(place, "value " + std::to_string(values.size() - 1) + " is no finite number: '" +
                        std::string(word.substr(0, 40)) + "'; mend it (0 is a radius that is not known)");
  return values;
}

}  // namespace

std::string_view attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value ? value : "";
}

const XMLElement* arrayNamed(const XMLElement* parent, std::string_view name, const char* element) {
  if (!parent) return nullptr;
  for (const XMLElement* e = parent->FirstChildElement(element); e; e = e->NextSiblingElement(element))
    if (attribute(*e, "Name") == name) return e;
  return nullptr;
}

std::int64_t countOf(const XMLElement& piece, const char* name, const std::string& place) {
  std::int64_t value = 0;
  const std::string_view text = attribute(piece, name);
  if (!text.empty() && !parseInteger(text, value)) breaks(place + "/" + name, "must be a whole number");
  if (value < 0 || value > kMostItems)
    breaks(place + "/" + name, "must lie between 0 and " + std::to_string(kMostItems));
  return value;
}

XmlFile::XmlFile(std::span<const std::byte> bytes) : mostContent_(partOfMemory(bytes.size(), 6, 16)) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (const auto other = otherContent(text)) breaks("/", other->text());
  std::string xml(takeAppended(text));
  if (const std::size_t memory = xmlMemory(xml), most = partOfMemory(bytes.size(), 10, 24); memory > most)
    breaks("/", "the XML " + beyondMemory(memory, most) + "; split or reduce it");
  if (document_.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS)
    breaks("line " + std::to_string(document_.ErrorLineNum()),
           std::string("is not valid XML: ") + document_.ErrorName());
}

const XMLElement& XmlFile::data(const char* kind) {
  const XMLElement* root = document_.RootElement();
  if (!root || std::strcmp(root->Name(), "VTKFile") != 0) breaks("/", "is no VTK XML file");
  readEncoding(*root);
  const XMLElement* data = root->FirstChildElement(kind);
  if (!data)
    breaks("/VTKFile", "holds " + std::string(attribute(*root, "type")) + ", not " + kind +
                           "; extract its surface or lines and save them as .vtp");
  return *data;
}

// Appended data may be raw bytes, which no XML parser takes: cut out before it sees the file.
std::string XmlFile::takeAppended(std::string_view text) {
  const std::size_t tag = text.rfind("<AppendedData");
  if (tag == text.npos) return std::string(text);
  const std::size_t start = text.find('_', tag), stop = text.rfind("</AppendedData>");
  if (start == text.npos || stop == text.npos || stop <= start)
    breaks("/VTKFile/AppendedData", "is cut short");
  appendedRaw_ = text.substr(tag, start - tag).find("raw") != text.npos;
  appended_ = text.substr(start + 1, stop - start - 1);
  return std::string(text.substr(0, start)) + std::string(text.substr(stop));
}

void XmlFile::readEncoding(const XMLElement& root) {
  encoding_.bigEndian = attribute(root, "byte_order") == "BigEndian";
  encoding_.wideHeader = attribute(root, "header_type") == "UInt64";
  const std::string_view compressor = attribute(root, "compressor");
  encoding_.zlib = compressor == "vtkZLibDataCompressor";
  if (!compressor.empty() && !encoding_.zlib)
    breaks("/VTKFile/compressor",
           "is " + std::string(compressor) + "; save the file with zlib or without compression");
}

Numbers XmlFile::numbers(const XMLElement& array, const std::string& place) {
  const auto scalar = vtp::scalarNamed(attribute(array, "type"));
  if (!scalar) breaks(place + "/type", "is not a number type that VTK has");
  if (attribute(array, "format") == "ascii")
    return Numbers(asciiNumbers(array.GetText() ? array.GetText() : "", place));
  std::vector<std::byte> content = bytesOf(array, place);
  if (content.size() % vtp::sizeOf(*scalar) != 0) breaks(place, "is no whole number of values");
  return Numbers(std::move(content), *scalar, encoding_.bigEndian);
}

Numbers XmlFile::letters(const XMLElement& array, const std::string& place) {
  return attribute(array, "format") == "ascii"
             ? Numbers(asciiNumbers(array.GetText() ? array.GetText() : "", place))
             : Numbers(bytesOf(array, place), vtp::Scalar::uint8, false);
}

std::vector<std::byte> XmlFile::bytesOf(const XMLElement& array, const std::string& place) {
  const std::string_view format = attribute(array, "format");
  if (format == "appended") return appendedBlock(array, place);
  if (format != "binary") breaks(place + "/format", "must be ascii, binary or appended");
  return XmlFile::block(array.GetText() ? array.GetText() : "", place);
}

std::vector<std::byte> XmlFile::block(std::string_view text, const std::string& place) {
  XmlFile::charge(text.size() / 4 * 3, place);
  const auto bytes = decodeBase64(text);
  if (!bytes) breaks(place, std::string("is not base64") + kExportAgain);
  return XmlFile::unpacked(*bytes, place);
}
// Arrays may share their data, so it counts as often as it is read.
void XmlFile::charge(std::size_t bytes, const std::string& place) {
  contentRead_ += bytes;
  if (contentRead_ > mostContent_)
    breaks(place, "all data up to this " + beyondMemory(contentRead_, mostContent_) + "; split or reduce it");
}
std::vector<std::byte> XmlFile::unpacked(std::span<const std::byte> bytes, const std::string& place) {
  std::string fault;
  const auto size = vtp::contentBytes(bytes, encoding_, fault);
  if (!size) breaks(place, fault + kExportAgain);
  XmlFile::charge(*size, place);
  auto content = vtp::unpack(bytes, encoding_, fault);
  if (!content) breaks(place, fault + kExportAgain);
  return std::move(*content);
}
std::vector<std::byte> XmlFile::appendedBlock(const XMLElement& array, const std::string& place) {
  std::int64_t offset = -1;
  if (!parseInteger(attribute(array, "offset"), offset) || offset < 0 ||
      std::size_t(offset) > appended_.size())
    breaks(place + "/offset", "must lie inside the appended data");
  const std::string_view from = appended_.substr(std::size_t(offset));
  if (appendedRaw_) return unpacked(std::as_bytes(std::span(from)), place);
  return XmlFile::block(firstBlock(from), place);
}
// Blocks of base64 follow one another without a mark: as much of it as the block needs, read from its own
// header.
std::string_view XmlFile::firstBlock(std::string_view text) const {
  const std::size_t word = encoding_.wideHeader ? 8 : 4;
  const auto lengths = [&](std::size_t count) -> std::vector<double> {
    const auto bytes = decodeBase64(text.substr(0, std::min(text.size(), (count * word + 2) / 3 * 4)));
    if (!bytes || bytes->size() < count * word) return {};
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(vtp::numberAt(bytes->data() + i * word,
                                     encoding_.wideHeader ? vtp::Scalar::uint64 : vtp::Scalar::uint32,
                                     encoding_.bigEndian));
    return values;
  };
  const auto letters = [](double bytes) { return std::ceil(bytes / 3) * 4; };
  double length = 0;
  if (const auto first = lengths(1); first.empty() || first[0] > double(text.size()))
    return text;
  else if (!encoding_.zlib)
    length = letters(double(word) + first[0]);
  else if (const auto all = lengths(3 + std::size_t(first[0])); !all.empty()) {
    double packed = 0;
    for (std::size_t i = 3; i < all.size(); ++i) packed += all[i];
    length = letters(double(all.size() * word)) + letters(packed);
  }
  return length > 0 && length < double(text.size()) ? text.substr(0, std::size_t(length)) : text;
}

}  // namespace vasa::vtk
