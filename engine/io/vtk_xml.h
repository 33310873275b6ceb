#pragma once
#include <tinyxml2.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/vtk_rule.h"
#include "io/vtp_data.h"

// Files of VTK's XML kinds below what they describe: elements, and arrays of numbers in every encoding.
namespace vasa::vtk {

/// Empty where there is none.
std::string_view attribute(const tinyxml2::XMLElement& element, const char* name);
/// Elements of arrays that hold anything but numbers.
inline constexpr const char* kNoNumbers = "Array";
/// Null where there is none.
const tinyxml2::XMLElement* arrayNamed(const tinyxml2::XMLElement* parent, std::string_view name,
                                       const char* element = "DataArray");
/// An attribute that says how many there are; 0 without it. Breaks a rule where it is no number up to 2^26.
std::int64_t countOf(const tinyxml2::XMLElement& piece, const char* name, const std::string& place);

/// What a file of so many bytes may hold. Points, lines and names take 16, 100 and 80 bytes of memory.
struct Amounts {
  explicit Amounts(std::size_t bytes)
      : points(bytes / 4 + 500'000),
        lines(bytes / 16 + 100'000),
        corners(bytes / 2 + 1'000'000),
        names(bytes / 16 + 100'000),
        cellNumbers(bytes + 4'000'000) {}
  std::size_t points, lines, corners, names, cellNumbers;

  static void check(const std::string& place, const char* things, std::size_t found, std::size_t most) {
    if (found > most)
      breaks(place, std::string("all ") + things + " up to this are " + std::to_string(found) +
                        ", more than the " + std::to_string(most) +
                        " accepted for a file of this size; split or reduce it");
  }
};

/// The numbers of an array: as its bytes, or as the text gave them.
class Numbers {
 public:
  Numbers(std::vector<std::byte> content, vtp::Scalar scalar, bool bigEndian)
      : content_(std::move(content)), scalar_(scalar), bigEndian_(bigEndian) {}
  explicit Numbers(std::vector<double> values) : values_(std::move(values)) {}
  std::size_t size() const {
    return content_.empty() ? values_.size() : content_.size() / vtp::sizeOf(scalar_);
  }
  double operator[](std::size_t i) const {
    return content_.empty() ? values_[i]
                            : vtp::numberAt(content_.data() + i * vtp::sizeOf(scalar_), scalar_, bigEndian_);
  }

 private:
  std::vector<std::byte> content_;
  std::vector<double> values_;
  vtp::Scalar scalar_ = vtp::Scalar::float64;
  bool bigEndian_ = false;
};

/// A file of which the XML has been read. What breaks a rule throws BrokenRule: XML that is not well formed
/// or takes more memory than ten times the file and 24 MiB; data cut short, not decodable or, unpacked and
/// all together, more than six times the file and 16 MiB.
class XmlFile {
 public:
  /// @param bytes  must outlive this
  explicit XmlFile(std::span<const std::byte> bytes);

  /// Its one element of this kind; breaks a rule where it holds something else.
  const tinyxml2::XMLElement& data(const char* kind);
  const tinyxml2::XMLElement& polyData() { return data("PolyData"); }
  /// An array's numbers, of any type.
  Numbers numbers(const tinyxml2::XMLElement& array, const std::string& place);
  /// The bytes of VTK's arrays of text.
  Numbers letters(const tinyxml2::XMLElement& array, const std::string& place);

 private:
  std::string takeAppended(std::string_view text);
  void readEncoding(const tinyxml2::XMLElement& root);
  std::vector<std::byte> bytesOf(const tinyxml2::XMLElement& array, const std::string& place);
  std::vector<std::byte> block(std::string_view text, const std::string& place);
  std::vector<std::byte> unpacked(std::span<const std::byte> bytes, const std::string& place);
  std::vector<std::byte> appendedBlock(const tinyxml2::XMLElement& array, const std::string& place);
  std::string_view firstBlock(std::string_view text) const;
  void charge(std::size_t bytes, const std::string& place);

  tinyxml2::XMLDocument document_;
  vtp::Encoding encoding_;
  std::string_view appended_;
  bool appendedRaw_ = false;
  std::size_t mostContent_, contentRead_ = 0;  // [bytes]
};

}  // namespace vasa::vtk
