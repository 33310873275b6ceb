#pragma once

namespace vasa {

/// The letters of panels and of pictures with words: Debian's fonts-dejavu-core.
inline constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

}  // namespace vasa
