#pragma once
// Where in the picture a difference lies: on which bodies, from what the two records say is behind each
// pixel. Tested in tests/demos/compare/cause_test.cpp.

#include <string>

#include "demos/cause/cause_facts.h"
#include "demos/cause/motion_record.h"
#include "renderer/image/raster.h"

namespace carom::demos {

struct ComparedPictures {
  const renderer::Raster& actual;
  const renderer::Raster& golden;
  int tolerance = 2;
};

struct RecordedPicture {
  const MotionRecord& record;
  const RecordedShot& shot;
  std::string scene = {};  ///< What the frame's file says of it: name and hash. Empty: nothing.
};
struct RecordedPictures {
  RecordedPicture actual;
  RecordedPicture golden;
};

/// Adds the bodies under the pixels beyond the tolerance, and a sentence about them.
void addPictureEvidence(const ComparedPictures& pictures, const RecordedPictures& records, Cause& cause);

}  // namespace carom::demos
