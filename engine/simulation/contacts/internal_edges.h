#pragma once
// Contacts with internal edges: those of a surface that several solids make together, of tiles that lie side
// by side, of the parts of a compound body. The closest features of a box on one tile and of the next tile
// are two edges, those of what slides on an edge of its own a face beside that and the tile's edge, and the
// way between them is oblique: a contact along it would brake the body, push it aside and lift it (ghost
// collisions). On the union of the tiles it is no contact: its direction is not in the
// normal cone of the union, as the surface goes on below the box. What is tested is what makes it harmless,
// so that tiles need not be flush: the box is held on a face beside the edge, and held there it passes the
// edge at or above the window's floor (paper §2.3). Tested in tests/physics/friction/flush_tiles_test.cpp.

#include "engine/simulation/contacts/pair_table.h"

namespace carom {

/// A pair of shapes at some instant.
struct PlacedPair {
  const ShapePair& pair;
  const ClosestFeatures& closest;
  Pose X_WA;
  Pose X_WB;
};

/// Whether `other`, another contact of one of its bodies, makes `contact`, which is at edges or oblique to
/// it, one with an internal edge over the next `dt_s`.
bool passesEdge(const PlacedPair& contact, const PlacedPair& other, double dt_s,
                const std::vector<Body>& bodies, const std::vector<Shape>& shapes);

/// Of each body that moves, the lasting contacts that may hold it where it passes an internal edge, as it
/// lies at the end of the last step. A body in a crowd has many contacts, and of each all others are asked:
/// what answers most of them is kept together.
class BearingContacts {
 public:
  /// Those of the `active` bodies. Cost O(their pairs).
  void find(const PairTable& table, const PairedWorld& world, std::span<const int> active);
  /// Whether the contact of a pair with an active body is one with an internal edge.
  bool isInternal(int index, const PairTable& table, const PairedWorld& world) const;

 private:
  struct Bearing {
    int pair = -1;
    int held = -1;           ///< The body that is borne.
    double highest_m = 0.0;  ///< Over what bears it, a point can be said to lie on it.
    Vec3 up_W = Vec3::Zero();
    Vec3 p_W = Vec3::Zero();  ///< The closest point of what bears it.
  };

  void findOf(int body, const PairTable& table, const PairedWorld& world);

  std::vector<std::vector<Bearing>> of_body_;  ///< Those of what does not move with the body that it bears.
};

}  // namespace carom
