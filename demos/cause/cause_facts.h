#pragma once
// A cause as plain values: what text, JSON, JUnit and the report are made of.

#include <string>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom::demos {

/// One thing that is not as it was.
struct Change {
  std::string part;  ///< "body", "world", "engine", "camera", "light", "material", "mesh", "preset",
                     ///< "shader", "encoder", "renderer", "scene", "moment"
  std::string name;  ///< The body, water, camera or source file that changed.
  std::string text;  ///< In words: "crate[3] starts 0.05 m away from where it was".
};

struct MovedBody {
  std::string name;
  double distance_m = 0.0;  ///< At the frame, of the centre of mass.
  double turn_degrees = 0.0;
  double since_s = 0.0;              ///< The first recorded moment at which it differs; < 0: not known.
  std::vector<Vec3> golden, actual;  ///< The centre of mass up to the frame.
};

struct BodyPixels {
  std::string name;
  long long pixels = 0;  ///< Beyond the tolerance, and on this body then or now.
};

struct Cause {
  std::string headline;  ///< One line; empty: not known.
  std::vector<Change> changes;
  double since_s = -1.0;           ///< The states differ from here on; < 0: they do not, or it is not known.
  std::string first_event;         ///< "0.413 s: cube and floor 1.20 N s, was 1.35 N s"
  std::vector<MovedBody> moved;    ///< Farthest first.
  std::vector<BodyPixels> pixels;  ///< Most first.
  std::string evidence;            ///< "the difference lies on crate[3] and what is around it"

  bool known() const { return !headline.empty(); }
};

}  // namespace carom::demos
