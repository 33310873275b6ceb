#pragma once
#include <string>

namespace vasa::test {

/// Two frames of a skeleton with CMU's names: standing, then the left arm raised sideways.
inline std::string motionText() {
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
  text += "}\nMOTION\nFrames: 2\nFrame Time: 0.04\n";
  for (int frame = 0; frame < 2; ++frame) {
    text += "0 15 0";
    for (int value = 0; value < 39; ++value) text += value == 12 ? (frame ? " 40" : " -80") : " 0";
    text += "\n";
  }
  return text;
}

}  // namespace vasa::test
