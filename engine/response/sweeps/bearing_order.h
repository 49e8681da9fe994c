#pragma once
// Which of the bodies that touch bears which. Mostly the lower one bears the upper; where what is between
// them presses the upper one down, it bears the lower: what hangs, link by link, hangs on what is above it.
// Tested in tests/engine/response/sweeps/bearing_order_test.cpp.

#include <span>
#include <utility>
#include <vector>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// The moving bodies of some rows, each after those that bear it; where bodies bear each other all round, the
/// lowest of them comes first.
class BearingOrder {
 public:
  /// `up`: away from what bears, of any length above zero. What other rows left in this does not matter.
  void find(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies, const Vec3& up);
  /// In their order.
  std::span<const int> bodies() const { return bodies_; }
  /// The place in the order of a body that the rows refer to; -1: it cannot move.
  int placeOf(int body) const { return places_[static_cast<std::size_t>(body)]; }
  /// The end of a row that gives way to the other; -1: neither moves.
  int borneBy(const ContactRow& row) const {
    if (placeOf(row.a) == placeOf(row.b)) return -1;
    return placeOf(row.b) > placeOf(row.a) ? row.b : row.a;
  }

 private:
  using Places = std::pair<int, int>;  ///< By height: of the lower body, then of the upper.
  struct Lifted {                      // two bodies, and what the steep rows between them do
    Places places;
    double up = 0.0;  ///< To the upper one: the sum of their normals along `up`.
  };

  void sortByHeight(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies, const Vec3& up);
  bool joinsMoving(const ContactRow& row) const { return placeOf(row.a) >= 0 && placeOf(row.b) >= 0; }
  Lifted liftedBy(const ContactRow& row, const Vec3& up) const;
  void findHanging(std::span<const ContactRow> rows, const Vec3& up);
  std::size_t hangingPlace(const Places& places) const;
  Places bearingOf(const ContactRow& row) const;
  void listBorne(std::span<const ContactRow> rows);
  void putBearersFirst();

  std::vector<int> bodies_;
  std::vector<int> places_;      // one a body
  std::vector<Lifted> hanging_;  // ascending; those of which the upper one bears the lower
  // Scratch. By height: of each body the rows on what bears it, and where those that it bears are listed.
  std::vector<int> bearers_, begins_, borne_, by_height_;
};

}  // namespace carom
