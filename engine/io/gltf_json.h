#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vasa::gltf {

/// A value of the glTF document together with its place, so that every check can say where it failed.
/// Accessors throw BrokenRule where the document is not what they ask for.
class JsonView {
 public:
  explicit JsonView(const nlohmann::json& value, std::string place = "")
      : value_(&value), place_(std::move(place)) {}

  const std::string& place() const { return place_; }
  [[noreturn]] void fail(const std::string& rule, const std::string& remedy = "") const;

  /// Members of an object.
  std::optional<JsonView> find(const char* key) const;
  JsonView at(const char* key) const;
  bool has(const char* key) const { return find(key).has_value(); }
  std::vector<std::pair<std::string, JsonView>> members() const;

  /// Elements of an array; items(key) is empty where the member is absent.
  std::vector<JsonView> items() const;
  std::vector<JsonView> items(const char* key) const;
  std::size_t size() const;
  JsonView first() const;  ///< of an array that is not empty

  void mustBeObject() const;
  const std::string& text() const;
  bool boolean() const;
  double number() const;                                            ///< finite
  std::vector<double> numbers(std::size_t count) const;             ///< exactly count of them
  std::int64_t integer(std::int64_t low, std::int64_t high) const;  ///< 3.0 counts as 3
  /// An index into a top-level array that has count elements.
  std::uint32_t index(std::size_t count, const char* array) const;

 private:
  const nlohmann::json* value_;
  std::string place_;
};

/// How many elements a top-level array has; 0 where it is absent.
std::size_t countOf(const JsonView& root, const char* array);

/// Numbers such as 3.0 become 3: some exporters write integers so, and glTF allows it.
void normaliseIntegers(nlohmann::json& value);

}  // namespace vasa::gltf
