#include "look_options.h"

#include <sstream>

#include "render/look.h"

namespace vasa::cli {

const char* const kLookHelp =
    "atlas (white page), clinical (dark) or xray (translucent); default: the scene's, else atlas";
const char* const kHideHelp = "Leave out skin, bones, organs, arteries, veins (a list with commas)";

Result<void> chooseLook(LookChoice& choice, const std::string& preset, const std::string& hidden) {
  if (!preset.empty()) choice.preset = preset;
  if (!lookNamed(choice.preset))
    return Error{Fault::usage, "--look " + choice.preset + ": choose atlas, clinical or xray"};
  std::stringstream words(hidden);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "skin")
      choice.skin = false;
    else if (word == "bones")
      choice.bones = false;
    else if (word == "organs")
      choice.organs = false;
    else if (word == "arteries")
      choice.arteries = false;
    else if (word == "veins")
      choice.veins = false;
    else
      return Error{Fault::usage, "--hide " + word + ": choose from skin, bones, organs, arteries, veins"};
  }
  return {};
}

}  // namespace vasa::cli
