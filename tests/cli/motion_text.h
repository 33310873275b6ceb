#pragma once
#include <string>
#include <vector>

namespace vasa::test {

/// Frames of a skeleton with CMU's names, standing, the left arm raised sideways by so many degrees.
inline std::string armMotion(const std::vector<std::string>& angles) {
  const auto joint = [](const std::string& name, const std::string& offset, const std::string& inside) {
    return "JOINT " + name + "\n{\nOFFSET " + offset + "\nCHANNELS 3 Zrotation Yrotation Xrotation\n" +
           inside + "}\n";
  };
  const std::string end = "End Site\n{\nOFFSET 0 0 1\n}\n";
  std::string text =
      "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n";
  for (const std::string& side : {std::string("Left"), std::string("Right")}) {
    const std::string out = side == "Left" ? "" : "-";
    text += joint(side + "UpLeg", out + "1.5 -1 0",
                  joint(side + "Leg", "0 -7 0", joint(side + "Foot", "0 -7 0", end)));
    text += joint(side + "Arm", out + "3 8 0",
                  joint(side + "ForeArm", out + "5 0 0", joint(side + "Hand", out + "4 0 0", end)));
  }
  text += "}\nMOTION\nFrames: " + std::to_string(angles.size()) + "\nFrame Time: 0.04\n";
  for (const std::string& angle : angles) {
    text += "0 15 0";
    for (int value = 0; value < 39; ++value) text += value == 12 ? " " + angle : " 0";
    text += "\n";
  }
  return text;
}

/// Two frames: arms hanging, then the left one raised.
inline std::string motionText() { return armMotion({"-80", "40"}); }

}  // namespace vasa::test
