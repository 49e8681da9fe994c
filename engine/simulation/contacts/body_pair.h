#pragma once
// Two bodies that could come near each other within a step, and what is known of their pieces: which of them
// are near, which are listed because they might come near, and for how much motion of the bodies against each
// other all the rest stays apart. Internal to the simulation floor. Tested through
// tests/engine/simulation/contacts/pair_table_test.cpp.

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/closest_features/vclip.h"
#include "engine/contact/collision_window.h"
#include "engine/contact/relative_motion.h"

namespace carom {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What pairs of bodies, and of their shapes, meet by.
struct MeetingTerms {
  CollisionWindow window;
  double collision_speed_mps = 0.0;  ///< Slower approaches are lasting contact; set for every step.
  double restitution = 0.0;

  /// No slow point higher than this can come to the rest gap within the step: where faces are cut off at this
  /// height, the cut holds nothing, and a corner that comes down slowly is held as the corner that it is.
  double lastingHeight(double step_s) const { return window.ceiling + collision_speed_mps * step_s; }
  /// What stays higher has neither contacts nor times of impact within the step.
  double contactHeight(double step_s) const { return std::max(window.manifold, lastingHeight(step_s)); }
};

/// A candidate that the step does not look at.
struct ApartPieces {
  IndexPair shapes;
  SeparatingAxis axis = {};  ///< Why.
  FeaturePair tracked = {};
  double gap_m = 0.0;  ///< Where the paths began that it was looked at for last, at least.
  bool stays = true;   ///< The axis parts them on these.
};

/// What lists of pieces are good for: within this motion since the bodies lay so, what is not on the list
/// keeps this gap, m.
struct ListedFor {
  RelativePose since;
  RelativeMotion motion;
  double gap_m = -kInfinity;
};

/// How near what is listed and apart was when the bodies lay so, m, at least.
struct RoomLeft {
  RelativePose since;
  double gap_m = -kInfinity;
};

/// Keeps its place in the table as long as the bodies are paired.
struct BodyPair : MeetingTerms {
  int body_a = -1;  ///< The lower one; none: the place is free.
  int body_b = -1;
  bool active = false;      ///< One of the bodies is.
  bool added = false;       ///< Within this step.
  bool to_measure = false;  ///< What is apart has changed, or has used up its room.
  double margin_m = 0.0;    ///< How much more than contacts need is looked at.
  ListedFor listed;
  RoomLeft room;
  double resting_gap_m = kInfinity;  ///< Of what is apart, while it is not active.
  std::vector<ApartPieces> apart;    ///< Ascending by shapes.
  std::vector<int> near;             ///< Places of the others.

  bool isFree() const { return body_a < 0; }
  std::size_t candidates() const { return apart.size() + near.size(); }
  /// What stays higher on the paths that are planned is hardly brought near by what contacts do to these;
  /// where it is, PairTable::bodiesThatMeetOthers says so.
  double safeHeight(double step_s) const { return contactHeight(step_s) + margin_m; }
  int other(int body) const { return body == body_a ? body_b : body_a; }
};

}  // namespace carom
