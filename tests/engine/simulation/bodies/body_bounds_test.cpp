// Which shapes of a body could reach into bounds, against all of them tried one by one.

#include "engine/simulation/bodies/body_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace carom {
namespace {

class Rubble {
 public:
  explicit Rubble(int parts) : random_(static_cast<std::uint64_t>(parts)), solid_(scattered(parts)) {
    shapes_.push_back({0, &ball_.parts()[0], 0.5, 1.0});
    for (const ConvexPart& part : solid_.parts())
      shapes_.push_back({1, &part, part.core.radiusAbout(Vec3::Zero()), 1.0});
    bounds_.begin(2, shapes_);
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 within(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }

  // Of points within each shape, some are within the bounds.
  std::vector<int> tried(const Pose& X_WB, const Bounds& bounds_W) {
    std::vector<int> reaching;
    for (int i = 1; i < static_cast<int>(shapes_.size()); ++i) {
      const ConvexPolyhedron& core = shapes_[static_cast<std::size_t>(i)].part->core;
      bool reaches = false;
      for (int k = 0; k < 40 && !reaches; ++k) {
        Vec3 p = Vec3::Zero();
        double all = 0.0;
        for (int v = 0; v < core.vertexCount(); ++v) {
          const double share = k < core.vertexCount() ? (v == k ? 1.0 : 0.0) : between(0.0, 1.0);
          p += share * core.vertex(v);
          all += share;
        }
        const Vec3 p_W = X_WB * Vec3(p / all);
        reaches = bounds_W.overlaps({p_W, p_W});
      }
      if (reaches) reaching.push_back(i);
    }
    return reaching;
  }
  std::vector<int> found(const Pose& X_WB, const Bounds& bounds_W) const {
    std::vector<int> reaching;
    bounds_.findReaching(1, X_WB, bounds_W, reaching);
    return reaching;
  }

 private:
  Solid scattered(int parts) {
    std::vector<ConvexPart> all;
    for (int i = 0; i < parts; ++i)
      all.push_back({boxPolyhedron(Vec3::Constant(0.05) + within(0.02)).translated(within(1.0)), 0.0});
    return Solid(std::move(all));
  }

  std::mt19937_64 random_;
  Solid ball_ = Solid::ball(0.5);
  Solid solid_;
  std::vector<Shape> shapes_;
  BodyBounds bounds_;
};

TEST(BodyBounds, NoShapeThatReachesInIsMissed_AndFewOthersAreFound) {
  for (const int parts : {2, 10, 300}) {
    Rubble rubble(parts);
    std::size_t all_found = 0, all_tried = 0;
    for (int k = 0; k < 200; ++k) {
      const Quat R(Eigen::AngleAxisd(rubble.between(-3.0, 3.0), rubble.within(1.0).normalized()));
      const Pose X_WB{R, rubble.within(5.0)};
      const Vec3 middle = X_WB.position + rubble.within(1.0),
                 half = Vec3::Constant(0.06) + rubble.within(0.05);
      const Bounds bounds{middle - half, middle + half};
      const std::vector<int> found = rubble.found(X_WB, bounds), tried = rubble.tried(X_WB, bounds);
      EXPECT_TRUE(std::ranges::is_sorted(found));
      EXPECT_TRUE(std::ranges::includes(found, tried)) << parts << " parts, query " << k;
      all_found += found.size();
      all_tried += tried.size();
    }
    EXPECT_GT(all_tried, parts == 300 ? 20u : 0u);
    EXPECT_LT(all_found, 200u * static_cast<std::size_t>(parts) / 20u + 20u) << parts << " parts";
  }
}

}  // namespace
}  // namespace carom
