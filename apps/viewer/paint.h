#pragma once
#include <vector>

#include "viewer/document.h"
#include "viewer/pose_worker.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// The colours of all spans in a pose, made anew when the pose or the wish is another.
class KeptColours {
 public:
  const std::vector<std::uint32_t>& of(const Document& document, std::shared_ptr<const PosedBody> body,
                                       atlas::Colouring colouring);

 private:
  std::shared_ptr<const PosedBody> body_;
  atlas::Colouring colouring_ = atlas::Colouring::kind;
  std::vector<std::uint32_t> colours_;
};

/// Which vessels can be seen, one a vessel: their kind is shown, and nothing else is singled out.
std::vector<char> shownVessels(const Document& document, const ViewState& state);

/// Colours of the network's spans for Renderer::setSweepColours(): what the colouring says, contacts, the
/// route that is measured and the chosen vessels over it, what is not shown not at all; empty where all are
/// as their kinds are.
/// @param plain  keeps what the colouring says
std::vector<std::uint32_t> coloursOf(const Document& document, std::shared_ptr<const PosedBody> body,
                                     const ViewState& state, KeptColours& plain);

}  // namespace vasa::viewer
