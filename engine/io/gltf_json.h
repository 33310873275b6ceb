#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vasa::gltf {

/// A value of the glTF document together with the document, so that every check can say where it failed.
/// Accessors throw BrokenRule where the document is not what they ask for. Two pointers: views are made by
/// the million.
class JsonView {
 public:
  explicit JsonView(const nlohmann::json& document) : JsonView(document, document) {}

  /// A JSON pointer such as "/accessors/3/byteOffset"; looked for in the whole document.
  std::string place() const;
  [[noreturn]] void fail(const std::string& rule, const std::string& remedy = "") const;

  /// Members of an object.
  std::optional<JsonView> find(std::string_view key) const;
  JsonView at(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  std::vector<std::pair<std::string_view, JsonView>> members() const;

  /// Elements of an array; items(key) is empty where the member is absent.
  std::vector<JsonView> items() const;
  std::vector<JsonView> items(std::string_view key) const;
  std::size_t size() const;
  JsonView first() const;  ///< of an array that is not empty

  void mustBeObject() const;
  bool isObject() const;
  const std::string& text() const;
  bool boolean() const;
  double number() const;                                            ///< finite
  std::vector<double> numbers(std::size_t count) const;             ///< exactly count of them
  std::int64_t integer(std::int64_t low, std::int64_t high) const;  ///< 3.0 counts as 3
  /// An index into a top-level array that has count elements.
  std::uint32_t index(std::size_t count, const char* array) const;

 private:
  JsonView(const nlohmann::json& value, const nlohmann::json& document)
      : value_(&value), document_(&document) {}

  const nlohmann::json* value_;
  const nlohmann::json* document_;
};

/// How many elements a top-level array has; 0 where it is absent.
std::size_t countOf(const JsonView& root, const char* array);

/// Whether a document names an extension among those that it uses.
bool uses(const JsonView& root, std::string_view extension);

}  // namespace vasa::gltf
