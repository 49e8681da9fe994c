#pragma once
// The time that the shutter is open before each frame's own, as the angle of a turning shutter: 180 degrees
// are half of a frame. The moments of a frame's exposures are frames of a finer clock, on the paths that the
// world has proven. Tested in tests/demos/render/shutter_test.cpp.

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom::demos {

class Shutter {
 public:
  /// Closed at once where `degrees` is 0 or a frame has one exposure.
  Shutter(double degrees, int exposures)
      : exposures_(exposures),
        per_frame_(degrees > 0.0 && exposures > 1 ? static_cast<int>(std::lround(360.0 * exposures / degrees))
                                                  : 1) {}

  bool isOpen() const { return per_frame_ > 1; }
  /// Frames of the finer clock in one of the usual one.
  int perFrame() const { return per_frame_; }

  /// Those of the finer clock that a frame's exposures show, the last at the frame's own time; none before
  /// the start.
  std::vector<int> moments(int frame) const {
    std::vector<int> moments;
    for (int i = exposures_ - 1; i >= 0; --i) moments.push_back(std::max(0, frame * per_frame_ - i));
    return moments;
  }

 private:
  int exposures_;
  int per_frame_;
};

}  // namespace carom::demos
