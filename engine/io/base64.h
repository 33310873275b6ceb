#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vasa {

/// Base64, also where several padded runs follow one another, blanks between them; nothing where it is none.
/// @param atMost  [bytes] to decode, from the first
std::optional<std::vector<std::byte>> decodeBase64(std::string_view text,
                                                   std::size_t atMost = ~std::size_t(0));
std::string encodeBase64(std::span<const std::byte> bytes);

}  // namespace vasa
