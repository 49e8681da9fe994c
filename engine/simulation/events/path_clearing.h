#pragma once
// Leads paths apart, without an impulse, where they come to the floor while momenta do not: solvers left that
// over, or turning, which no straight path follows. Only paths change, by as little as lets the gaps open;
// momenta are what they were, and the next step solves them.
//
// What has been led apart in a step stays apart: all places that hang together by bodies are solved at once.
// A place that comes back although nothing else has led its bodies is brought back by turning, which closes a
// gap as the square of the time, however fast it opens: a body that turns by much, or has come back often,
// does not turn for the rest of the step, which takes no energy. Internal to the simulation floor. Tested by
// tests/explore/cases (squeezed-plate, paths-without-momenta, spinning-plate, spinning-needle) and through
// tests/physics/.

#include <span>
#include <vector>

#include "engine/contact/time_of_impact.h"
#include "engine/simulation/bodies/body.h"
#include "engine/simulation/contacts/pair_table.h"

namespace carom {

class PathClearing {
 public:
  void beginStep();

  /// Two bodies at the floor, as a search has found them, `rest_s` before the end of the step.
  /// `holds_turning`: they have come back so often that it is time to look whether turning brought them.
  void add(int pair, const TimeOfImpact& found, double rest_s, bool holds_turning, const PairTable& table,
           const std::vector<Body>& bodies);

  /// Adds to `members` who can be led and hangs together with them by places.
  void gather(std::vector<int>& members, double time_s, const std::vector<Body>& bodies);

  /// Mean velocities from `time_s` over the rest of the step by which the members of the last `gather` stay
  /// apart; where no such are found, those of the last place that was added.
  std::span<const ImpulseBody> solve(const std::vector<int>& members, double time_s, double rest_s,
                                     const std::vector<Body>& bodies);

  /// Whether the last `solve` gave a member another velocity than it had.
  bool isLed(std::size_t member) const {
    return paths_[member].velocity.linear != before_[member].velocity.linear ||
           paths_[member].velocity.angular != before_[member].velocity.angular;
  }

  /// If the last `solve` found no paths that keep all apart: who was not led, and presses the others
  /// together.
  std::span<const int> wedging() const { return wedging_; }

  /// The speed at which turning can bring two bodies together over the rest of a step, m/s: at most.
  static double turningSpeed(const ShapePair& pair, double time_s, double rest_s,
                             const std::vector<Body>& bodies, const std::vector<Shape>& shapes);

  /// Whether a body's path can be led.
  static bool canBeLed(const Body& body) { return body.moves() && body.travel != Travel::kHeld; }

 private:
  struct Place {
    int pair = -1;
    int body_a = -1;
    int body_b = -1;
    FeaturePair features;
    Vec3 n_W;
    Vec3 p_A_W;
    Vec3 p_B_W;
    double wanted_mps = 0.0;  ///< The speed at which it shall part.
    double slack_mps = 0.0;   ///< A place that parts slower by no more than this has been led apart.
    bool turned = false;      ///< Turning brought it back: only moving its bodies keeps it away.
    double led_s = 0.0;       ///< When its bodies were led apart last.
  };
  struct Row {
    Place* place = nullptr;
    int a = -1;  ///< In `paths_`.
    int b = -1;
    Vec3 r_a;
    Vec3 r_b;
    double response = 0.0;  ///< Of its speed to an impulse.
    double impulse = 0.0;
  };

  bool cameBack(const Place& place, double time_s, const std::vector<Body>& bodies) const;
  int addPath(int body, double time_s, double rest_s, const std::vector<Body>& bodies);
  int pathOf(int body, double time_s, double rest_s, const std::vector<Body>& bodies);
  void setPaths(const std::vector<int>& members, double time_s, double rest_s,
                const std::vector<Body>& bodies);
  void setRows(double time_s, double rest_s, const std::vector<Body>& bodies);
  void holdTurning(const Row& row);
  /// Whether all rows are apart.
  bool sweepRows();
  /// The same, at once, where the masses are too different for sweeps.
  bool pivotRows();
  void findWedging(std::size_t led);
  void push(const Row& row, double impulse);
  double partingOf(const Row& row) const;

  std::vector<Place> places_;                ///< Of this step.
  std::vector<std::vector<int>> places_of_;  ///< By body.
  int last_added_ = 0;
  std::vector<int> gathered_;  ///< Places that members of the last `gather` are at.
  std::vector<char> is_member_, is_gathered_;
  std::vector<ImpulseBody> paths_;
  std::vector<ImpulseBody> before_;  ///< The members' as they were.
  std::vector<int> path_of_;         ///< By body: its place in `paths_`; -1: none.
  std::vector<int> touched_;         ///< Bodies that have one.
  std::vector<Row> rows_;
  std::vector<int> wedging_;
};

}  // namespace carom
