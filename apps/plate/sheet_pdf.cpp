#include <fmt/format.h>
#include <zlib.h>

#include <map>

#include "core/atomic_file.h"
#include "plate/sheet.h"

// PDF 1.5 (ISO 32000-1): a page of numbered objects, a table of where each begins, and a trailer. Texts are
// in the faces' own glyph numbers (Identity-H), so that any letter of theirs can be set; /ToUnicode tells
// readers which letters they are.
namespace vasa::plate {
namespace {

constexpr float kPoint = 72 / 25.4f;  // points a millimetre

std::string deflated(std::span<const std::uint8_t> bytes) {
  uLongf size = compressBound(uLong(bytes.size()));
  std::string out(size, '\0');
  compress2(reinterpret_cast<Bytef*>(out.data()), &size, bytes.data(), uLong(bytes.size()), 9);
  out.resize(size);
  return out;
}
std::string deflated(std::string_view text) {
  return deflated(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

// "title" as the text string of a document's properties: UTF-16 in hexadecimal.
std::string textString(std::string_view utf8) {
  std::string out = "<FEFF";
  for (const char32_t code : codePoints(utf8))
    out += fmt::format("{:04X}", code < 0x10000 ? unsigned(code) : 0xFFFD);
  return out + ">";
}

class PdfWriter {
 public:
  explicit PdfWriter(const Typesetter& type) : type_(type) {}

  Result<std::vector<std::byte>> write(const Sheet& sheet) {
    // From the upper left corner in millimetres, y down, as sheets have it; letters are turned back.
    content_ = fmt::format("{0:.5f} 0 0 {1:.5f} 0 {2:.3f} cm\n", kPoint, -kPoint, sheet.size.y * kPoint);
    (*this)(SheetBox{vec2(0), sheet.size, sheet.paper});
    for (const SheetItem& item : sheet.items) std::visit(*this, item);
    std::string fonts;
    for (const bool bold : {false, true}) {
      const auto font = addFont(bold);
      if (!font) return font.error();
      fonts += fmt::format("/F{} {} 0 R ", int(bold), *font);
    }
    const int content = addStream("/Filter /FlateDecode", deflated(content_));
    const int pages = int(objects_.size()) + 2;
    const int page =
        add(fmt::format("<< /Type /Page /Parent {} 0 R /MediaBox [0 0 {:.3f} {:.3f}] /Contents {} 0 R "
                        "/Resources << /Font << {}>> /XObject << {}>> >> >>",
                        pages, sheet.size.x * kPoint, sheet.size.y * kPoint, content, fonts, pictures_));
    add(fmt::format("<< /Type /Pages /Kids [{} 0 R] /Count 1 >>", page));
    const int catalogue = add(fmt::format("<< /Type /Catalog /Pages {} 0 R >>", pages));
    const int info = add(fmt::format("<< /Title {} /Producer (vasa) >>", textString(sheet.title)));
    return assembled(catalogue, info);
  }

  void operator()(const SheetPicture& picture) {
    std::string rgb;
    rgb.reserve(picture.image->rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < picture.image->rgba.size(); i += 4)
      rgb.append(reinterpret_cast<const char*>(&picture.image->rgba[i]), 3);
    const int image =
        addStream(fmt::format("/Type /XObject /Subtype /Image /Width {} /Height {} /ColorSpace /DeviceRGB "
                              "/BitsPerComponent 8 /Filter /FlateDecode",
                              picture.image->width, picture.image->height),
                  deflated(rgb));
    pictures_ += fmt::format("/P{0} {0} 0 R ", image);
    content_ += fmt::format("q {:.4f} 0 0 {:.4f} {:.4f} {:.4f} cm /P{} Do Q\n", picture.size.x,
                            -picture.size.y, picture.at.x, picture.at.y + picture.size.y, image);
  }
  void operator()(const SheetLine& line) {
    content_ += fmt::format("{:.4f} {:.4f} {:.4f} RG {:.4f} w 1 J 1 j ", line.colour.x, line.colour.y,
                            line.colour.z, line.width);
    for (std::size_t i = 0; i < line.points.size(); ++i)
      content_ += fmt::format("{:.4f} {:.4f} {} ", line.points[i].x, line.points[i].y, i ? 'l' : 'm');
    content_ += "S\n";
  }
  void operator()(const SheetDisc& disc) {
    // A line of no length with round ends.
    (*this)(SheetLine{{disc.centre, disc.centre}, 2 * disc.radius, disc.colour, {}, {}});
  }
  void operator()(const SheetBox& box) {
    content_ +=
        fmt::format("{:.4f} {:.4f} {:.4f} rg {:.4f} {:.4f} {:.4f} {:.4f} re f\n", box.colour.x, box.colour.y,
                    box.colour.z, box.low.x, box.low.y, box.high.x - box.low.x, box.high.y - box.low.y);
  }
  void operator()(const SheetText& text) {
    const float width = type_.widthOf(text.text, text.size, text.bold);
    const float left = text.at.x - (text.align == Lettering::Align::left     ? 0
                                    : text.align == Lettering::Align::centre ? 0.5f * width
                                                                             : width);
    content_ +=
        fmt::format("{:.4f} {:.4f} {:.4f} rg BT /F{} {:.4f} Tf 1 0 0 -1 {:.4f} {:.4f} Tm <", text.colour.x,
                    text.colour.y, text.colour.z, int(text.bold), text.size, left, text.at.y);
    for (const char32_t code : codePoints(text.text)) {
      const auto glyph = type_.face(text.bold).glyphOf(code);
      used_[text.bold].try_emplace(glyph.number, code, glyph.advance);
      content_ += fmt::format("{:04X}", glyph.number);
    }
    content_ += "> Tj ET\n";
  }

 private:
  struct Used {
    char32_t code;
    float advance;  // thousandths of an em, which Typesetter measures in
    Used(char32_t c, float a) : code(c), advance(a) {}
  };

  int add(std::string object) {
    objects_.push_back(std::move(object));
    return int(objects_.size());
  }
  int addStream(const std::string& keys, const std::string& data) {
    return add(fmt::format("<< {} /Length {} >>\nstream\n", keys, data.size()) + data + "\nendstream");
  }

  Result<int> addFont(bool bold) {
    const auto bytes = readFile(type_.face(bold).file());
    if (!bytes) return bytes.error();
    const auto raw = std::span(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size());
    const int file = addStream(fmt::format("/Filter /FlateDecode /Length1 {}", raw.size()), deflated(raw));
    const char* name = bold ? "DejaVuSans-Bold" : "DejaVuSans";
    const int descriptor = add(fmt::format(
        "<< /Type /FontDescriptor /FontName /{} /Flags 32 /FontBBox [-1070 -415 1681 1175] /ItalicAngle 0 "
        "/Ascent 928 /Descent -236 /CapHeight 729 /StemV {} /FontFile2 {} 0 R >>",
        name, bold ? 140 : 80, file));
    std::string widths, letters;
    for (const auto& [glyph, used] : used_[bold]) {
      widths += fmt::format("{} [{:.0f}] ", glyph, used.advance);
      letters += fmt::format("1 beginbfchar\n<{:04X}> <{:04X}>\nendbfchar\n", glyph, unsigned(used.code));
    }
    const int known = addStream("/Filter /FlateDecode",
                                deflated("/CIDInit /ProcSet findresource begin 12 dict begin begincmap\n"
                                         "/CMapName /Letters def /CMapType 2 def\n"
                                         "1 begincodespacerange <0000> <FFFF> endcodespacerange\n" +
                                         letters + "endcmap end end\n"));
    const int inner = add(fmt::format(
        "<< /Type /Font /Subtype /CIDFontType2 /BaseFont /{} /CIDSystemInfo << /Registry (Adobe) /Ordering "
        "(Identity) /Supplement 0 >> /FontDescriptor {} 0 R /DW 600 /W [{}] /CIDToGIDMap /Identity >>",
        name, descriptor, widths));
    return add(fmt::format(
        "<< /Type /Font /Subtype /Type0 /BaseFont /{} /Encoding /Identity-H /DescendantFonts [{} 0 R] "
        "/ToUnicode {} 0 R >>",
        name, inner, known));
  }

  std::vector<std::byte> assembled(int catalogue, int info) const {
    std::string out = "%PDF-1.5\n%\xE2\xE3\xCF\xD3\n", table;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      table += fmt::format("{:010} 00000 n \n", out.size());
      out += fmt::format("{} 0 obj\n", i + 1) + objects_[i] + "\nendobj\n";
    }
    const std::size_t start = out.size(), count = objects_.size() + 1;
    out += fmt::format(
        "xref\n0 {}\n0000000000 65535 f \n{}trailer\n<< /Size {} /Root {} 0 R /Info {} 0 R >>\nstartxref\n{}\n%%EOF\n",
        count, table, count, catalogue, info, start);
    const auto bytes = std::as_bytes(std::span(out));
    return {bytes.begin(), bytes.end()};
  }

  const Typesetter& type_;
  std::string content_, pictures_;
  std::vector<std::string> objects_;
  std::map<std::uint32_t, Used> used_[2];
};

}  // namespace

Result<std::vector<std::byte>> sheetPdf(const Sheet& sheet, const Typesetter& type) {
  return PdfWriter(type).write(sheet);
}

}  // namespace vasa::plate
