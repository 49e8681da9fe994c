#include "tests/explore/worlds/hanging_worlds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "demos/asset/asset_path.h"
#include "tests/explore/random_shapes.h"

namespace carom::explore {
namespace {

using demos::Body;
using demos::CapsuleShape;
using demos::CompoundShape;
using demos::HullShape;
using demos::Shape;
using oracle::Random;

constexpr double kThinnestBar_m = 1.2 * kSmallestShape_m;

enum class LinkKind { kBoxes, kCapsules, kLinkMesh, kRingMesh };

// A ring about a hole: two bars along x, joined by two sides along z, which lie in the plane of x and z. What
// is a mesh lies within these boxes where it meets others.
struct Link {
  LinkKind kind = LinkKind::kBoxes;
  double height = 0.0;     ///< Outer, along z, metres.
  double hole_wide = 0.0;  ///< Along x.
  double bar = 0.0;        ///< Of each bar, along z.
  double side = 0.0;       ///< Of each side, along x.
  double thick = 0.0;      ///< Along y.

  double hole() const { return height - 2.0 * bar; }
  double width() const { return hole_wide + 2.0 * side; }
};

Shape meshOf(const char* name, double fit_m) {
  HullShape mesh;
  mesh.file = demos::findBeside("explored.json", name).value();
  mesh.as_hull = false;
  mesh.fit_m = fit_m;
  return {mesh, {}};
}

/// Of half-turns about the axes through the middle of a link, what maps its mesh onto it: the link's mesh is
/// long along x and flat along z, the ring's flat along z.
Quat turnOf(LinkKind kind) {
  if (kind == LinkKind::kLinkMesh) return Quat(0.5, -0.5, -0.5, -0.5);
  if (kind == LinkKind::kRingMesh) return oracle::turned(Vec3::UnitX(), 0.5 * std::numbers::pi);
  return Quat::Identity();
}

CompoundShape ringOf(const Link& link) {
  CompoundShape ring;
  const double up = 0.5 * (link.height - link.bar), aside = 0.5 * (link.hole_wide + link.side);
  for (const double sign : {-1.0, 1.0}) {
    if (link.kind == LinkKind::kCapsules) {
      const double r = 0.5 * link.bar;
      ring.parts.push_back({{CapsuleShape{r, 2.0 * aside}, {}},
                            {oracle::turned(Vec3::UnitY(), 0.5 * std::numbers::pi), {0, 0, sign * up}}});
      ring.parts.push_back({{CapsuleShape{r, 2.0 * up}, {}}, {Quat::Identity(), {sign * aside, 0, 0}}});
    } else {
      ring.parts.push_back(
          {boxOf({link.hole_wide, link.thick, link.bar}), {Quat::Identity(), {0, 0, sign * up}}});
      ring.parts.push_back(
          {boxOf({link.side, link.thick, link.height}), {Quat::Identity(), {sign * aside, 0, 0}}});
    }
  }
  return ring;
}

// Rows of links from the hook down; the planes of each row are across those of the one before. In a net the
// rows that are `wide` are one link that holds all columns, the others a link for each column.
struct Row {
  Link link;
  bool wide = false;
  double z = 0.0;                                         ///< Of the middle, metres.
  double room = std::numeric_limits<double>::infinity();  ///< To every other link, metres.

  void keepWithin(double gap) { room = std::min(room, gap); }
};

class HangingMaker {
 public:
  explicit HangingMaker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ull + 19) {}

  ExploredWorld make() {
    constexpr double kRates[] = {20, 20, 30, 60, 120, 240};
    world_.family = "hanging";
    world_.scene.rate_hz = kRates[random_.integer(0, 5)];
    steps_ = random_.integer(10, 50);
    material_ = anyMaterial(random_);
    chooseLinks();
    chooseRows();
    hangRows();
    support_ = random_.integer(0, 5);
    for (std::size_t i = 0; i < rows_.size(); ++i) addRow(i);
    loadLast();
    chooseGravity();
    setMoving();
    return world_.lasting(steps_);
  }

 private:
  std::vector<Body>& bodies() { return world_.scene.bodies; }

  void chooseLinks() {
    constexpr LinkKind kKinds[] = {LinkKind::kBoxes, LinkKind::kBoxes, LinkKind::kCapsules,
                                   LinkKind::kLinkMesh, LinkKind::kRingMesh};
    kind_ = kKinds[random_.integer(0, 4)];
    size_ = std::max(kind_ == LinkKind::kBoxes ? 1e-3 : 2e-3, random_.logUniform(1e-3, 1.0));
    bar_ = random_.logUniform(0.04, 0.12) * size_;
    thickest_ = isMesh() ? 0.175 * size_ : std::max(2.0 * kThinnestBar_m, 1.3 * bar_);
    varied_ = oneIn(random_, 2);
    chosen_ = drawn();
  }
  bool isMesh() const { return kind_ == LinkKind::kLinkMesh || kind_ == LinkKind::kRingMesh; }
  double drawnBar() { return std::max(kThinnestBar_m, bar_ * random_.uniform(0.7, 1.3)); }

  // A ring of boxes or capsules.
  Link drawnRing() {
    Link link;
    link.height = size_ * random_.uniform(0.8, 1.3);
    link.bar = drawnBar();
    link.side = drawnBar();
    link.thick = drawnBar();
    link.hole_wide = thickest_ * random_.uniform(1.2, 3.5);
    if (kind_ != LinkKind::kCapsules) return link;
    link.kind = LinkKind::kCapsules;
    link.bar = link.side = link.thick = std::max(2.0 * kThinnestBar_m, link.bar);
    return link;
  }
  Link drawn() {
    // Boxes around the shipped meshes' ends: of tubes of 0.03 and 0.07 m about circles of 0.08 and 0.4 m,
    // within which corners of bars as thick as `thickest_` have room.
    if (kind_ == LinkKind::kLinkMesh) return scaled({kind_, 0.3522, 0.1, 0.064, 0.06, 0.06}, size_ / 0.3522);
    if (kind_ == LinkKind::kRingMesh) return scaled({kind_, 0.94, 0.6, 0.157, 0.17, 0.1463}, size_ / 0.94);
    return drawnRing();
  }
  static Link scaled(Link link, double by) {
    for (double* length : {&link.height, &link.hole_wide, &link.bar, &link.side, &link.thick}) *length *= by;
    return link;
  }
  Row drawnRow() { return {varied_ ? drawn() : chosen_}; }
  Row drawnWideRow() {
    Row row{drawnRing(), true};
    row.link.hole_wide = columns_ > 1 ? columns_ * pitch_ : row.link.hole_wide;
    return row;
  }

  // A chain of 2 to 15 links, or two or three beside each other that are joined at their ends, and once more
  // between: a loop or a net.
  void chooseRows() {
    columns_ = oneIn(random_, 3) ? random_.integer(2, 3) : 1;
    const int storeys = columns_ > 1 && oneIn(random_, 3) ? 2 : 1;
    std::vector<Row> rows;
    const int most = columns_ == 1 ? random_.integer(0, 12) : 2 * random_.integer(0, storeys > 1 ? 0 : 2) + 1;
    for (int i = 0; i < storeys * most; ++i) rows.push_back(drawnRow());
    double widest = 0.0;
    for (const Row& row : rows) widest = std::max(widest, row.link.width());
    pitch_ = widest * random_.uniform(1.1, 1.5);
    rows_.push_back(drawnWideRow());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows_.push_back(rows[i]);
      if (columns_ > 1 && i + 1 == rows.size() / 2 && storeys > 1) rows_.push_back(drawnWideRow());
    }
    rows_.push_back(drawnWideRow());
    for (Row& row : rows_) row.wide = row.wide && columns_ > 1;
  }

  // Each hangs in the one above with some slack, and knows how far it is from its neighbours.
  void hangRows() {
    const auto bar = [this](std::size_t i) { return i < rows_.size() ? rows_[i].link.bar : 0.0; };
    std::vector<double> free;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      free.push_back(rows_[i].link.hole() - bar(i - 1) - bar(i + 1));
    double above = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const bool last = i + 1 == rows_.size();
      const double slack = last ? 0.0 : random_.logUniform(3e-3, 0.45) * std::min(free[i], free[i + 1]);
      if (!last) join(rows_[i], rows_[i + 1], slack);
      if (i > 0 && !last) {
        rows_[i - 1].keepWithin(free[i] - above - slack);
        rows_[i + 1].keepWithin(free[i] - above - slack);
      }
      if (columns_ > 1 && !rows_[i].wide) rows_[i].keepWithin(pitch_ - rows_[i].link.width());
      above = slack;
    }
  }
  void join(Row& upper, Row& lower, double slack) const {
    const Link &a = upper.link, &b = lower.link;
    lower.z = upper.z - 0.5 * (a.height + b.height) + a.bar + b.bar + slack;
    const double span = (columns_ - 1) * pitch_;
    const double beside = std::min(a.hole_wide - (upper.wide ? span : 0.0) - b.thick,
                                   b.hole_wide - (lower.wide ? span : 0.0) - a.thick);
    for (Row* row : {&upper, &lower}) row->keepWithin(std::min(slack, 0.5 * beside));
  }

  void addRow(std::size_t i) {
    const Row& row = rows_[i];
    const Quat across = oracle::turned(Vec3::UnitZ(), i % 2 == 0 ? 0.0 : 0.5 * std::numbers::pi);
    const int count = row.wide ? 1 : columns_;
    for (int k = 0; k < count; ++k)
      addLink(row, {across, {(k - 0.5 * (count - 1)) * pitch_, 0, row.z}}, i == 0 && support_ > 0);
  }
  void addLink(const Row& row, const Pose& X, bool is_static) {
    const Link& link = row.link;
    Shape shape{ringOf(link), {}};
    if (link.kind == LinkKind::kLinkMesh)
      shape = meshOf("meshes/link.obj", 0.3415873888 / 0.3522 * link.height);
    if (link.kind == LinkKind::kRingMesh)
      shape = meshOf("meshes/ring.obj", 0.9293431345 / 0.94 * link.height);
    Body& body = addBody(world_.scene, std::move(shape), X, material_);
    body.X_WS.rotation = body.X_WS.rotation * turnOf(link.kind);
    body.is_static = is_static;
    if (is_static && support_ > 3) {  // a bar in place of a ring
      body.shape = boxOf({link.width(), link.thick, link.bar});
      body.X_WS.position.z() -= 0.5 * (link.height - link.bar);
    }
    if (oneIn(random_, 4)) body.material.density_kgpm3 *= random_.logUniform(0.2, 5.0);
    if (!is_static) displace(body, row);
  }
  // By less than half of its room.
  void displace(Body& body, const Row& row) {
    const double shift = 0.2 * row.room * random_.uniform(0.0, 1.0);
    body.X_WS.position += shift * random_.direction();
    const double most = 0.2 * row.room / std::hypot(row.link.height, row.link.width(), row.link.thick);
    const double turn = most * random_.uniform(0.0, 1.0);
    body.X_WS.rotation = oracle::turned(random_.direction(), turn) * body.X_WS.rotation;
  }

  // The last ring has as much mass as many links, with a weight below it or without.
  void loadLast() {
    Body& body = bodies().back();
    const Link& link = rows_.back().link;
    double volume = 2.0 * link.thick * (link.bar * link.hole_wide + link.side * link.height);
    const double links = random_.logUniform(1.0, 1000.0), mass_kg = links * material_.density_kgpm3 * volume;
    if (!oneIn(random_, 3)) {
      const double side = size_ * random_.uniform(0.3, 2.0), deep = side * random_.uniform(0.3, 1.0);
      const bool ball = oneIn(random_, 3);
      const Shape weight = ball ? Shape{demos::SphereShape{0.5 * side}, {}} : boxOf({side, deep, side});
      std::get<CompoundShape>(body.shape.form)
          .parts.push_back({weight, {Quat::Identity(), {0, 0, -0.5 * (link.height + side)}}});
      volume += ball ? std::numbers::pi / 6.0 * side * side * side : side * deep * side;
    }
    body.mass_kg = std::min(mass_kg, 0.5 * demos::kLargestDensity_kgpm3 * volume);
  }

  // What hangs on nothing may have no weight.
  void chooseGravity() {
    const double g = oneIn(random_, 4) ? random_.logUniform(1.0, 100.0) : 9.81;
    const Vec3 aslant = oneIn(random_, 4) ? Vec3(0.8 * random_.direction()) : Vec3(Vec3::Zero());
    world_.scene.gravity = g * (aslant - Vec3::UnitZ()).normalized();
    if (support_ == 0 && oneIn(random_, 2)) world_.scene.gravity = Vec3::Zero();
    speed_ = random_.logUniform(0.1, 5.0) * std::sqrt(g * size_);
  }
  // At rest; swinging about the hook as one; the load thrown; or each for itself.
  void setMoving() {
    const int kind = random_.integer(0, 3);
    const double length = size_ - rows_.back().z;
    const Vec3 spin = speed_ / length * random_.direction();
    for (Body& body : bodies()) {
      if (body.is_static || kind == 0) continue;
      if (kind == 1) {
        body.angular_velocity = spin;
        body.linear_velocity = spin.cross(body.X_WS.position);
      }
      if (kind == 3) {
        const Vec3 towards = random_.direction();
        body.linear_velocity = 0.3 * speed_ * random_.uniform(0.0, 1.0) * towards;
        const Vec3 axis = random_.direction();
        body.angular_velocity = 0.3 * speed_ / size_ * random_.uniform(0.0, 1.0) * axis;
      }
    }
    if (kind == 2) bodies().back().linear_velocity = speed_ * random_.direction();
  }

  Random random_;
  ExploredWorld world_;
  LinkKind kind_ = LinkKind::kBoxes;
  double size_ = 0.1;      ///< Of a link, about, metres.
  double bar_ = 0.01;      ///< Its thickness, about.
  double thickest_ = 0.0;  ///< No bar is thicker.
  bool varied_ = false;    ///< Whether links differ.
  Link chosen_;
  std::vector<Row> rows_;
  int columns_ = 1;
  double pitch_ = 0.0;  ///< Of columns, metres.
  int support_ = 0;     ///< 0: none; up to 3: the first ring is static; else a bar in its place.
  double speed_ = 0.0;  ///< m/s.
  int steps_ = 0;
  Material material_;
};

}  // namespace

ExploredWorld hangingWorld(std::uint64_t seed) {
  return HangingMaker(seed).make();
}

}  // namespace carom::explore
