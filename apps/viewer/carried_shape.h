#pragma once
#include <memory>
#include <vector>

#include "scene/frame.h"
#include "viewer/document.h"

namespace vasa::viewer {

/// How far a document's vessels were moved aside from where their pose alone had them, and how much wider or
/// narrower they became: what a shape that was found for it tells of the next one, after an edit.
class CarriedShape {
 public:
  /// @param maker  of the document's scene, with a shape
  CarriedShape(std::shared_ptr<const Document> document, const FrameMaker& maker);

  /// Whether a document was made of the same base.
  bool suits(const Document& edited) const { return edited.base == document_->base; }
  /// The shape that a maker of an edited document's scene has, without anything aside, changed likewise:
  /// vessel by vessel, where one was drawn anew by shares of its length. What an edit has added stays as it
  /// is.
  std::vector<vec4> laidOn(const Document& edited, const FrameMaker& maker) const;

 private:
  std::shared_ptr<const Document> document_;
  std::vector<vec4>
      aside_;  // [m] in the space of what surrounds a point at rest; and of the radius, a factor
};

}  // namespace vasa::viewer
