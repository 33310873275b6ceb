#pragma once
#include <vector>

#include "viewer/document.h"
#include "viewer/pose_worker.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// Which vessels can be seen, one a vessel: their kind is shown, and nothing else is singled out.
std::vector<char> shownVessels(const Document& document, const ViewState& state);

/// Colours of the network's spans for Renderer::setSweepColours(): the chosen vessel, the route that is
/// measured, contacts; empty where all are as their kinds are.
std::vector<std::uint32_t> coloursOf(const Document& document, const PosedBody& body, const ViewState& state);

}  // namespace vasa::viewer
