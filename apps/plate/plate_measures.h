#pragma once

namespace vasa::plate {

// What a page's plan and its sheet agree on.
inline constexpr float kLine = 1.22f;      // from one line of a text to the next, in its ems
inline constexpr float kTitleStep = 2.2f;  // from one base line to the next, in a label's ems
inline constexpr float kTextGap = 1.2f;    // [mm] between a text and its line
inline constexpr float kStub = 2.0f;       // [mm] level part of a line, beside its text

}  // namespace vasa::plate
