#include "io/gltf_json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/gltf_rule.h"

namespace vasa::gltf {
namespace {

// RFC 6901: "~" and "/" inside a key are written "~0" and "~1".
std::string escaped(const std::string& key) {
  std::string out;
  for (const char c : key) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else
      out += c;
  }
  return out;
}

// The way from a value down to one of those inside it; at most 64 deep: checked before parsing.
bool findPlace(const nlohmann::json& from, const nlohmann::json* wanted, std::string& place) {
  if (&from == wanted) return true;
  const std::size_t length = place.size();
  std::size_t index = 0;
  if (from.is_structured())
    for (auto it = from.begin(); it != from.end(); ++it, ++index) {
      place.append("/").append(from.is_object() ? escaped(it.key()) : std::to_string(index));
      if (findPlace(*it, wanted, place)) return true;
      place.resize(length);
    }
  return false;
}

constexpr double kLargestExactInteger = 9007199254740992.0;  // 2^53

bool fitsFloat(double number) {
  return std::abs(number) <= double(std::numeric_limits<float>::max());  // false for a NaN too
}

bool isInteger(const nlohmann::json& value) {
  if (value.is_number_integer()) return true;
  if (!value.is_number_float()) return false;
  const double number = value.get<double>();
  return std::abs(number) <= kLargestExactInteger && number == std::floor(number);
}

}  // namespace

std::string JsonView::place() const {
  std::string place;
  findPlace(*document_, value_, place);
  return place.empty() ? "/" : place;
}

void JsonView::fail(const std::string& rule, const std::string& remedy) const {
  breaks(place(), rule, remedy.empty() ? kExportAgain : remedy);
}

void JsonView::mustBeObject() const {
  if (!value_->is_object()) fail(std::string("must be an object, is ") + value_->type_name());
}

bool JsonView::isObject() const { return value_->is_object(); }

std::optional<JsonView> JsonView::find(std::string_view key) const {
  mustBeObject();
  const auto it = value_->find(key);
  if (it == value_->end()) return std::nullopt;
  return JsonView(*it, *document_);
}

JsonView JsonView::at(std::string_view key) const {
  auto found = find(key);
  if (!found) fail("must have the property " + std::string(key));
  return *found;
}

std::vector<std::pair<std::string_view, JsonView>> JsonView::members() const {
  mustBeObject();
  std::vector<std::pair<std::string_view, JsonView>> out;
  for (auto it = value_->begin(); it != value_->end(); ++it)
    out.emplace_back(it.key(), JsonView(it.value(), *document_));
  return out;
}

std::size_t JsonView::size() const {
  if (!value_->is_array()) fail(std::string("must be an array, is ") + value_->type_name());
  return value_->size();
}

std::vector<JsonView> JsonView::items() const {
  const std::size_t count = size();
  std::vector<JsonView> out;
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) out.push_back(JsonView((*value_)[i], *document_));
  return out;
}

std::vector<JsonView> JsonView::items(std::string_view key) const {
  const auto array = find(key);
  return array ? array->items() : std::vector<JsonView>{};
}

const std::string& JsonView::text() const {
  if (!value_->is_string()) fail(std::string("must be a string, is ") + value_->type_name());
  return value_->get_ref<const std::string&>();
}

JsonView JsonView::first() const {
  if (size() == 0) fail("must not be empty");
  return JsonView((*value_)[0], *document_);
}

bool JsonView::boolean() const {
  if (!value_->is_boolean()) fail(std::string("must be true or false, is ") + value_->type_name());
  return value_->get<bool>();
}

double JsonView::number() const {
  if (!value_->is_number()) fail(std::string("must be a number, is ") + value_->type_name());
  const double number = value_->get<double>();
  if (!fitsFloat(number)) fail("must be a finite number, is " + value_->dump());
  return number;
}

std::vector<double> JsonView::numbers(std::size_t count) const {
  if (size() != count)
    fail("must hold " + std::to_string(count) + " numbers, holds " + std::to_string(value_->size()));
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& value = (*value_)[i];
    out[i] = value.is_number() && fitsFloat(value.get<double>()) ? value.get<double>()
                                                                 : JsonView(value, *document_).number();
  }
  return out;
}

std::int64_t JsonView::integer(std::int64_t low, std::int64_t high) const {
  if (!isInteger(*value_)) fail("must be an integer, is " + value_->dump().substr(0, 40));
  const double approximate = value_->get<double>();
  const std::int64_t exact = std::abs(approximate) <= kLargestExactInteger ? std::int64_t(approximate) : -1;
  if (std::abs(approximate) > kLargestExactInteger || exact < low || exact > high)
    fail("must be between " + std::to_string(low) + " and " + std::to_string(high) + ", is " +
         value_->dump());
  return exact;
}

std::uint32_t JsonView::index(std::size_t count, const char* array) const {
  if (!isInteger(*value_)) fail("must be an index, is " + value_->dump().substr(0, 40));
  const double number = value_->get<double>();
  if (number < 0 || number >= double(count))
    fail("refers to element " + value_->dump() + " of " + array + ", which has " + std::to_string(count));
  return std::uint32_t(number);
}

std::size_t countOf(const JsonView& root, const char* array) {
  const auto found = root.find(array);
  return found ? found->size() : 0;
}

bool uses(const JsonView& root, std::string_view extension) {
  for (const JsonView& name : root.items("extensionsUsed"))
    if (name.text() == extension) return true;
  return false;
}

}  // namespace vasa::gltf
