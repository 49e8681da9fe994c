#pragma once
// Questions to V-Clip from outside the program (paper §2): two mesh files at two poses, answered with the
// closest features, the distance or depth, the witness points and the normal. A file's meshes are taken
// together, as one convex hull that stands where the file puts it. Tested in
// tests/demos/command/distance_query_test.cpp.

#include <map>
#include <optional>
#include <string>

#include "demos/format/json.h"
#include "engine/closest_features/vclip.h"

namespace carom::demos {

struct DistanceQuery {
  std::string a;  ///< Mesh files; a relative path starts at the working directory.
  std::string b;
  Pose X_WA;
  Pose X_WB;
};

/// The pose of "x,y,z" or "x,y,z,qw,qx,qy,qz". Throws UsageError that begins with `option`.
Pose poseFromText(const std::string& text, const std::string& option);

/// From {"a": file, "b": file, "poseA": pose, "poseB": pose}, a pose being {"position": [x, y, z],
/// "rotation": [w, x, y, z]} and identity where left out. Throws InputError with the place of what is wrong.
DistanceQuery readDistanceQuery(const Json& json);

/// Reads each mesh file once, also one that cannot be read.
class HullStore {
 public:
  /// The hull of all meshes of the file. Throws InputError with the reason why there is none.
  const ConvexPart& hullOf(const std::string& file);

 private:
  struct Entry {
    ConvexPart part;
    std::optional<std::string> refusal;  ///< None: `part` is the hull.
  };
  static Entry load(const std::string& file);
  std::map<std::string, Entry> entries_;
};

/// Answers queries one after the other.
class DistanceAnswers {
 public:
  enum class Start { kTracked, kCold };
  /// `kTracked` begins a query of the same two files as the one before where that one ended.
  explicit DistanceAnswers(Start start) : start_(start) {}

  /// The answer as INTERFACE.md prints it; throws InputError when there is none.
  Json answer(const DistanceQuery& query);

 private:
  Start start_;
  HullStore hulls_;
  std::string last_a_, last_b_;
  PairMemory memory_;
};

}  // namespace carom::demos
