#pragma once
#include <string>
#include <vector>

#include "math/types.h"
#include "support/shared_data.h"

namespace vasa::test {

/// Makes a file in the folder. @return its path
std::string writeInto(const TemporaryFolder& folder, const char* name, const std::string& text);

/// A place as three numbers between two words.
std::string wordsOf(const char* word, vec3 p, const char* end);

/// A vein along the spine and an artery down to the knee, in metres (.swc).
std::string personVessels();

/// How far each sample of the vessels goes between two frames of walk [m]. @param told  gets what was warned
/// of
std::vector<float> waysOf(const TemporaryFolder& folder, const std::string& body, const std::string& network,
                          std::string& told);

}  // namespace vasa::test
