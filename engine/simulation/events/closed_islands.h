#pragma once
// Momentum of bodies that only meet each other. Contact leads paths beside their momenta, so that gaps stay
// open while bodies turn, and a momentum that goes along another line has another moment: what nothing from
// outside acts on would lose its angular momentum, or gain some. It is given back as a rotation of all of
// them together, about their common centre of mass, which changes no speed at which any two of them meet.
// What loads push has the angular momentum and the energy that these gave it on the paths that bodies took.
// What it would have more energy than that comes out of what the bodies move beside that rotation, so that
// loads which cancel each other move nothing as a whole; where there is less, no rotation is given back.
// Internal to the simulation floor. Tested in tests/engine/simulation/events/closed_islands_test.cpp.

#include <span>
#include <vector>

#include "engine/modes/islands.h"
#include "engine/simulation/bodies/flight_plan.h"

namespace carom {

class ClosedIslands {
 public:
  /// Nobody has met another in this substep.
  void begin(std::size_t bodies);
  /// Contacts act between these, or may have.
  void meet(int a, int b, const std::vector<Body>& bodies);
  /// Who else acts on this one is not known.
  void leaveOpen(int body) { note(body, true); }
  /// At the end of the substep, while bodies still have the poses and velocities that it began with.
  void measure(const std::vector<Body>& bodies, const FlightPlanner& planner);
  /// Once measured: whether it has met others, and none of its island what stands.
  bool isClosed(int body) const;
  /// Takes over what a body has to pay for lifts, J, where nothing holds its island; else false. It counts
  /// where what loads have done is not known.
  bool owe(int body, double energy_J);
  /// When they have those of its end.
  void restore(std::vector<Body>& bodies, const FlightPlanner& planner);

 private:
  struct Island {
    bool open = false;    ///< It has met something else than itself.
    bool loaded = false;  ///< Something else acts on it than gravity.
    bool untold = false;  ///< What that gives its angular momentum is not known.
    double owed_J = 0.0;  ///< For lifts, where it is not known what loads have done.
    double mass_kg = 0.0;
    Vec3 center = Vec3::Zero();  ///< Of mass, m; and how it moves, m/s.
    Vec3 velocity = Vec3::Zero();
    Vec3 angular_momentum = Vec3::Zero();  ///< About it, kg m^2/s.
    double terms = 0.0;                    ///< The sum of what it is rounded by.
    // Of the substep's beginning.
    Vec3 kept = Vec3::Zero();  ///< The angular momentum, and what loads gave since.
    double kept_J = 0.0;  ///< The energy of all motion relative to the centre, and what loads gave since.
    double energy_terms = 0.0;      ///< The sum of what this, with that of the end, is rounded by.
    Vec3 begun = Vec3::Zero();      ///< The centre.
    Vec3 force = Vec3::Zero();      ///< Of all loads, N.
    Vec3 place_sum = Vec3::Zero();  ///< Of the centre, as Body::place_sum.
    // At the end, with the change of angular velocity that brings it back, and what is left of the motion
    // beside that of all together.
    Mat3 tensor = Mat3::Zero();  ///< kg m^2 about the centre, world frame.
    double energy_J = 0.0;       ///< Of all motion relative to the centre.
    Vec3 spin = Vec3::Zero();
    Vec3 spin_change = Vec3::Zero();
    double share = 1.0;
  };

  void note(int body, bool open);
  const Island& islandOf(int body) const { return islands_[static_cast<std::size_t>(together_.of(body))]; }
  Island& islandOf(int body) { return islands_[static_cast<std::size_t>(together_.of(body))]; }
  void findCenters(const std::vector<Body>& bodies);
  void findMomenta(const std::vector<Body>& bodies);
  void findMoments(const std::vector<Body>& bodies, const FlightPlanner& planner);
  void followLoads(const std::vector<Body>& bodies, const FlightPlanner& planner);
  static double excessOf(const Island& island);
  static void balance(Island& island);

  Islands together_;
  std::vector<Island> islands_;         ///< By the name of the island.
  std::vector<int> met_;                ///< Bodies, each once.
  std::vector<unsigned char> is_open_;  ///< By body: it has met what does not move, or nothing.
  std::vector<unsigned char> has_met_;
};

}  // namespace carom
