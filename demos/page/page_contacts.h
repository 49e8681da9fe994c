#pragma once
// What the engine knew of contacts in each frame, as a page holds it: contact points with normals, impulses,
// the nearest pairs with their distances, and the closest features of the nearest pair with their V-regions
// (paper §2, figs. 1-10). The answers are those of the overlays of `carom render` (demos/overlay). A frame's
// numbers are differences from the same pair's in the frame before, so that what lies still costs little.
// Read by web/contacts.js. Tested in tests/demos/page/page_contacts_test.cpp.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "demos/overlay/shown_contacts.h"
#include "demos/page/page_motion.h"

namespace carom::demos {

class PageContacts {
 public:
  struct Choice {
    double length_quantum_m = 1e-3;
    bool recorded = false;  ///< Poses only: there are no impulses to show.
    int frames = 1;         ///< Of the whole run, which shares kMostPoints.
  };
  /// Watches the world of `scene`, which must outlive this and be watched by nobody else, unless `recorded`.
  PageContacts(SceneWorld& scene, const Choice& choice);
  ~PageContacts();
  PageContacts(const PageContacts&) = delete;
  PageContacts& operator=(const PageContacts&) = delete;

  /// Frames in order of time.
  void add(std::span<const BodyState> states, int frame, double time_s);
  /// The regions, then frame by frame contacts, impulses, distances and the nearest pair's regions.
  void write(ByteStream& out) const;
  /// Contact points and pairs that no frame had room for.
  std::int64_t leftOut() const { return left_out_; }

  /// Contact points that a page holds; a frame has its share, and at least kFewestPoints, the nearest first.
  static constexpr int kMostPoints = 400000;
  static constexpr int kFewestPoints = 64;
  static constexpr int kMostDistances = 96;

 private:
  using Row = std::vector<std::int64_t>;
  using Pair = std::pair<int, int>;
  /// The rows of the pairs in the frame before, by their bodies and how many there were of these.
  using Former = std::map<std::tuple<int, int, int>, Row>;
  using Point = std::array<std::int64_t, 3>;

  Point rounded(const Vec3& p) const;
  void addPairs(const std::vector<std::pair<Pair, Row>>& rows, Former& former);
  void addContacts(const OverlayFrame& frame);
  void addImpulses(const OverlayFrame& frame);
  void addDistances(const OverlayFrame& frame);
  void addClosest(const OverlayFrame& frame);
  int regionOf(const NearPair& pair, bool of_a, double radius_m);

  SceneWorld& scene_;
  Choice choice_;
  BodyFocus focus_;
  StepView step_;
  ByteStream frames_;
  Former contacts_, impulses_, distances_;
  std::map<std::tuple<const ConvexPart*, int, int, int>, int> known_;  // regions by part, feature and size
  std::vector<ByteStream> regions_;
  std::int64_t left_out_ = 0;
};

}  // namespace carom::demos
