#include "core/name_words.h"

#include <doctest/doctest.h>

namespace {

std::string words(std::string_view name) {
  std::string all;
  for (const std::string& word : vasa::nameWords(name)) all += (all.empty() ? "" : " ") + word;
  return all;
}

}  // namespace

TEST_CASE("names are divided at marks, humps, capitals and digits") {
  CHECK(words("Superior_VenaCava2") == "superior vena cava 2");
  CHECK(words("LHip") == "l hip");
  CHECK(words("SVC.001") == "svc 001");
  CHECK(words("mixamorig:LeftUpLeg") == "mixamorig left up leg");
  CHECK(words("  Max  Diameter (mm)  ") == "max diameter mm");
  CHECK(words("l_clav-01b") == "l clav 01 b");
  CHECK(words("") == "");
  CHECK(words("._-") == "");
}

TEST_CASE("letters lose their accents, composed or followed by them") {
  CHECK(words("Artère") == "artere");
  CHECK(words("Arte\xcc\x80re") == "artere");
  CHECK(words("ARTE\xcc\x80RE") == "artere");
  CHECK(words("A\xcc\x81rvore") == "arvore");
  CHECK(words("Straße") == "strase");
  CHECK(words("Durchmesser in \xc2\xb5m") == "durchmesser in um");
  CHECK(words("\xce\xbcm") == "um");
  CHECK(words("a×b÷c") == "a b c");
  CHECK(words("tronc cœliaque, Œsophage") == "tronc celiaque esophage");
}

TEST_CASE("other alphabets, and UTF-8 that is cut off, only divide words") {
  CHECK(words("аорта aorta") == "aorta");
  CHECK(words("aorta\xc3") == "aorta");
  CHECK(words("a\xc3\x28"
              "b") == "a b");
  CHECK(words("vein\xcc") == "vein");
}

TEST_CASE("names tell the side in several languages, and by a letter at their end") {
  using vasa::NamedSide;
  using vasa::sideNamed;
  for (const char* name :
       {"Left femoral artery", "femoral.l", "Femoral.L.001", "ICA_L", "A. femoralis sinistra",
        "Arteria links", "artère fémorale gauche", "arteria femoral izquierda", "左総頸動脈", "Lt subclavian",
        "a. carotis int. sin.", "carotide sx"})
    CHECK_MESSAGE(sideNamed(name) == NamedSide::left, std::string(name));
  for (const char* name :
       {"RightFemoral", "femoral vv.r", "V. femoralis dextra", "artère rénale droite",
        "arteria renal derecha", "右内頸静脈", "rt renal vein", "V. jug. int. dext.", "carotide dx"})
    CHECK_MESSAGE(sideNamed(name) == NamedSide::right, std::string(name));
  for (const char* name : {"aorta", "L2 lumbar artery", "left branch of right hepatic artery", "cleft",
                           "upright", "", "r2d2", "sinus rectus"})
    CHECK_MESSAGE(sideNamed(name) == NamedSide::none, std::string(name));
}
