#include "atlas/scene_look.h"

#include <utility>

namespace vasa::atlas {
namespace {

constexpr std::pair<std::optional<float> OpacityChoice::*, float Look::*> kOpacities[] = {
    {&OpacityChoice::arteries, &Look::arteryOpacity},      {&OpacityChoice::veins, &Look::veinOpacity},
    {&OpacityChoice::bones, &Look::boneOpacity},           {&OpacityChoice::heart, &Look::heartOpacity},
    {&OpacityChoice::organs, &Look::otherOpacity},         {&OpacityChoice::skin, &Look::skinOpacity},
    {&OpacityChoice::capillaries, &Look::capillaryOpacity}};

}  // namespace

Look lookOf(const LookChoice& choice) {
  Look look = lookNamed(choice.preset).value_or(Look{});
  apply(choice, look);
  return look;
}

void apply(const LookChoice& choice, Look& look) {
  if (choice.background) look.background = *choice.background;
  look.drawSkin &= choice.skin;
  look.drawBones &= choice.bones;
  look.drawOther &= choice.organs;
  look.drawHeart &= choice.heart.value_or(choice.organs);
  look.drawArteries &= choice.arteries;
  look.drawVeins &= choice.veins;
  for (const auto& [chosen, opacity] : kOpacities)
    if (choice.opacity.*chosen) look.*opacity = *(choice.opacity.*chosen);
}

LookChoice choiceOf(const Look& look, const std::string& preset) {
  const Look usual = lookNamed(preset).value_or(Look{});
  LookChoice choice;
  choice.preset = preset;
  if (look.background != usual.background) choice.background = look.background;
  choice.skin = look.drawSkin;
  choice.bones = look.drawBones;
  choice.organs = look.drawOther;
  if (look.drawHeart != look.drawOther) choice.heart = look.drawHeart;
  choice.arteries = look.drawArteries;
  choice.veins = look.drawVeins;
  for (const auto& [chosen, opacity] : kOpacities)
    if (look.*opacity != usual.*opacity) choice.opacity.*chosen = look.*opacity;
  return choice;
}

}  // namespace vasa::atlas
