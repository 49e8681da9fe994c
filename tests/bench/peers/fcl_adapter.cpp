// FCL with libccd: convex polytopes, the signed distance with the nearest points, at the default tolerance of
// 1e-6. The only file that names FCL. Built as a shared library with nothing exported but its entry, because
// FCL needs Eigen with its vector types and our engine is built without. Debian builds FCL with its
// assertions on; one that fails aborts, and that is caught and told as a failed query.

#include <cmath>
#include <csetjmp>
#include <csignal>

#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/distance.h>

#include "tests/bench/peers/library.h"

namespace carom::bench {

__attribute__((visibility("default"))) Library fclLibrary();

namespace {

using Transforms = std::vector<fcl::Transform3d, Eigen::aligned_allocator<fcl::Transform3d>>;

fcl::Convexd convexOf(const Hull& hull) {
  const auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const auto& v : hull.vertices) vertices->emplace_back(v[0], v[1], v[2]);
  const auto faces = std::make_shared<std::vector<int>>();
  for (const std::vector<int>& loop : hull.faces) {
    faces->push_back(static_cast<int>(loop.size()));
    faces->insert(faces->end(), loop.begin(), loop.end());
  }
  return fcl::Convexd(vertices, static_cast<int>(hull.faces.size()), faces);
}

fcl::Transform3d transformOf(const PlainPose& X) {
  const auto& q = X.rotation_wxyz;
  fcl::Transform3d T = fcl::Transform3d::Identity();
  T.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  T.translation() = fcl::Vector3d(X.position[0], X.position[1], X.position[2]);
  return T;
}

sigjmp_buf before_query;
volatile std::sig_atomic_t querying = 0;

void leaveQuery(int) {
  if (querying != 0) siglongjmp(before_query, 1);
}

class FclPair : public PairQuery {
 public:
  FclPair(const Hull& a, const Hull& b) : a_(convexOf(a)), b_(convexOf(b)) {}

  void setPoses(std::span<const PosePair> poses) override {
    X_WA_.clear();
    X_WB_.clear();
    for (const PosePair& pair : poses) {
      X_WA_.push_back(transformOf(pair.X_WA));
      X_WB_.push_back(transformOf(pair.X_WB));
    }
  }
  void forget() override {}
  double ask(std::size_t i) override {
    if (sigsetjmp(before_query, 0) != 0) {
      querying = 0;
      return std::nan("");
    }
    querying = 1;
    const double answer = signedDistance(i);
    querying = 0;
    return answer;
  }

 private:
  double signedDistance(std::size_t i) {
    try {
      fcl::DistanceResultd result;
      fcl::distance(&a_, X_WA_[i], &b_, X_WB_[i], request_, result);
      return result.min_distance;
    } catch (const std::exception&) {
      return std::nan("");
    }
  }

  fcl::Convexd a_, b_;
  fcl::DistanceRequestd request_{/*enable_nearest_points_=*/true, /*enable_signed_distance=*/true};
  Transforms X_WA_, X_WB_;
};

}  // namespace

Library fclLibrary() {
  std::signal(SIGABRT, leaveQuery);
  return {"fcl+ccd", Gives::kDistance, 1e-6, [](const Hull& a, const Hull& b) -> std::unique_ptr<PairQuery> {
            return std::make_unique<FclPair>(a, b);
          }};
}

}  // namespace carom::bench
