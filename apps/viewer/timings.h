#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "render/renderer.h"
#include "scene/frame.h"

namespace vasa::viewer {

/// A short memory of numbers, the newest last.
class History {
 public:
  void add(float value) {
    values_[next_] = value;
    next_ = (next_ + 1) % values_.size();
    count_ = std::min(count_ + 1, values_.size());
  }
  std::size_t count() const { return count_; }
  /// @param i  0: the oldest of count()
  float at(std::size_t i) const { return values_[(next_ + values_.size() - count_ + i) % values_.size()]; }
  float median() const;

 private:
  std::array<float, 120> values_{};
  std::size_t next_ = 0, count_ = 0;
};

/// What frames cost lately, by stage, under the names of `vasa profile`.
class Timings {
 public:
  struct Stage {
    std::string name;  ///< "detect_ms"
    History history;
  };
  void addShape(const FrameReport& report, double ms);
  void addPicture(const FrameTimes& times, double ms);
  /// Declaring panels, drawing them around the picture, handing both to the window.
  void addWindow(double declare, double draw, double present);
  /// A picture shown on the window, so long after the one before while things moved.
  void addShown(double ms) { shown_.add(float(ms)); }

  void addEdit(double ms) { edit_.add(float(ms)); }  ///< from an edit to the picture that shows it

  const std::vector<Stage>& stages() const { return stages_; }
  const History& shape() const { return shape_; }      ///< [ms] of a whole shape, on its own thread
  const History& picture() const { return picture_; }  ///< [ms] of drawing it
  const History& shown() const { return shown_; }      ///< [ms] between pictures
  const History& edit() const { return edit_; }
  void clear() { *this = {}; }

 private:
  void add(const char* name, double ms);

  std::vector<Stage> stages_;
  History shape_, picture_, shown_, edit_;
};

}  // namespace vasa::viewer
