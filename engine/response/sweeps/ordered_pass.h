#pragma once
// A pass over contact rows from the supports on. Every body is brought to the bounds of all its rows with
// those that bear it, which stay as they are: so a tower is opened from its foot to its top in one pass, and
// a chain from its hook to its end, where sweeps that move both bodies of a row carry a correction on by one
// body each. What is wedged from the other side as well stays unsolved. For velocities that are paths only:
// the impulses do not act back. Tested in tests/engine/response/sweeps/ordered_pass_test.cpp.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/response/sweeps/bearing_order.h"
#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// The order in which the bodies of some rows are brought to them. A body's level is above those of all that
/// bear it, so that bodies of one level share no row and are worked on side by side; the bits are those of
/// one thread.
class UpwardPass {
 public:
  /// Of bodies, by index; kept for its room. What other rows left in it does not matter.
  struct Scratch {
    BearingOrder order;
    std::vector<int> level;
  };

  /// `up`: away from the supports, of any length. Null, or without a row on what cannot move: nothing is
  /// above anything else, and no body is brought to anything; together they would be led away.
  void order(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies, const Vec3& up,
             Scratch& scratch);
  /// Raises the separating speeds of these rows to their `lowest_speed`, without friction, the rows' impulses
  /// being as they were. Without a crew the caller works alone.
  void make(std::span<const ContactRow> rows, std::span<ImpulseBody> bodies, Crew* crew) const;

 private:
  struct Borne {  // a body that rows bear
    int body = -1;
    int level = 0;
    std::size_t begin = 0;  // of its rows
    std::size_t end = 0;
  };
  struct Level {
    std::size_t begin = 0;  // of its bodies
    std::size_t end = 0;
    std::size_t rows = 0;
  };
  void placeRows(std::span<const ContactRow> rows, const BearingOrder& order);
  void findLevels(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies, Scratch& scratch);

  std::vector<Borne> borne_;       // by level, then in the order of bearing
  std::vector<std::size_t> rows_;  // indices, those of a body together
  std::vector<Level> levels_;
};

}  // namespace carom
