#include "io/png.h"

#include <png.h>

#include <cassert>
#include <cmath>
#include <cstring>

#include "core/atomic_file.h"

// libpng reports errors by longjmp, which must not pass over C++ objects: the functions between setjmp and
// libpng's calls own nothing, everything they use is made outside.
namespace vasa {
namespace {

constexpr const char* kCommentKey = "Comment";

void append(png_structp png, png_bytep data, png_size_t size) {
  auto& bytes = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
  const std::size_t at = bytes.size();
  bytes.resize(at + size);
  std::memcpy(bytes.data() + at, data, size);
}

void flushNothing(png_structp) {}

void remember(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

bool encodeRows(png_structp png, png_infop info, const Image& image, const PngOptions& options) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_compression_level(png, options.compression);
  png_set_filter(png, 0, PNG_FILTER_SUB);
  png_set_IHDR(png, info, image.width, image.height, 8,
               options.alpha ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (options.dotsPerInch > 0) {
    const auto perMetre = png_uint_32(std::lround(options.dotsPerInch / 0.0254f));
    png_set_pHYs(png, info, perMetre, perMetre, PNG_RESOLUTION_METER);
  }
  if (!options.comment.empty()) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(kCommentKey);
    text.text = const_cast<char*>(options.comment.c_str());
    png_set_text(png, info, &text, 1);
  }
  png_write_info(png, info);
  if (!options.alpha) png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (std::uint32_t y = 0; y < image.height; ++y)
    png_write_row(png, image.rgba.data() + std::size_t(y) * image.width * 4);
  png_write_end(png, info);
  return true;
}

}  // namespace

Result<std::vector<std::byte>> encodePng(const Image& image, PngOptions options) {
  assert(image.rgba.size() == std::size_t(image.width) * image.height * 4);
  std::string message;
  std::vector<std::byte> bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, remember, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  bool done = false;
  if (info) {
    png_set_write_fn(png, &bytes, append, flushNothing);
    done = encodeRows(png, info, image, options);
  }
  png_destroy_write_struct(&png, &info);
  if (!done)
    return Error{Fault::failed, "cannot encode a PNG: " + (message.empty() ? "out of memory" : message)};
  return bytes;
}

Result<void> writePng(const std::filesystem::path& path, const Image& image, PngOptions options) {
  const auto bytes = encodePng(image, options);
  if (!bytes) return bytes.error();
  return writeFileAtomically(path, *bytes);
}

Result<Image> decodePng(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::uint64_t kMaximumPixels = 1ull << 28;
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()))
    return badInput(name + ": is not a readable PNG: " + header.message);
  if (std::uint64_t(header.width) * header.height > kMaximumPixels) {
    png_image_free(&header);
    return badInput(name + ": the picture is too large; scale it down");
  }
  header.format = PNG_FORMAT_RGBA;
  Image image{header.width, header.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(header))};
  if (!png_image_finish_read(&header, nullptr, image.rgba.data(), 0, nullptr))
    return badInput(name + ": is not a readable PNG: " + header.message);
  return image;
}

Result<Image> readPng(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  return decodePng(*bytes, path.string());
}

Result<std::string> readPngComment(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type and checksum around a chunk's data
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::uint32_t((*bytes)[at + i]);
    return std::size_t(value);
  };
  if (bytes->size() < kSignature ||
      png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes->data()), 0, kSignature) != 0)
    return badInput(path.string() + ": is not a PNG");
  std::string comment;
  for (std::size_t at = kSignature; at + kFrame <= bytes->size();) {
    const std::size_t length = number(at);
    if (length > bytes->size() - at - kFrame) break;
    const std::string_view data(reinterpret_cast<const char*>(bytes->data()) + at + 8, length);
    if (std::memcmp(bytes->data() + at + 4, "tEXt", 4) == 0 && data.starts_with(kCommentKey) &&
        data.size() > std::strlen(kCommentKey))
      comment = data.substr(std::strlen(kCommentKey) + 1);
    if (std::memcmp(bytes->data() + at + 4, "IEND", 4) == 0) return comment;
    at += kFrame + length;
  }
  return badInput(path.string() + ": the PNG is cut off; make it again");
}

}  // namespace vasa
