// ODE: convex geoms and dCollide. It tells touching from apart and gives contacts with depths; of parts that
// are apart it gives no distance, so it does less than the others. Only the ode_*.cpp of this folder name
// ODE.

#include <algorithm>
#include <cmath>

#include <ode/ode.h>

#include "tests/bench/peers/library.h"

namespace carom::bench {

Library odeLibrary();

namespace {

constexpr int kMostContacts = 16;

struct OdePose {
  dQuaternion rotation;
  dVector3 position;
};

OdePose odePose(const PlainPose& X) {
  OdePose pose;
  for (std::size_t i = 0; i < 4; ++i) pose.rotation[i] = static_cast<dReal>(X.rotation_wxyz[i]);
  dNormalize4(pose.rotation);
  for (std::size_t i = 0; i < 3; ++i) pose.position[i] = static_cast<dReal>(X.position[i]);
  return pose;
}

// A convex geom and the arrays that it refers to.
class OdeConvex {
 public:
  explicit OdeConvex(const Hull& hull) {
    for (const auto& v : hull.vertices)
      for (double x : v) points_.push_back(static_cast<dReal>(x));
    for (const std::vector<int>& loop : hull.faces) {
      polygons_.push_back(static_cast<unsigned>(loop.size()));
      for (int v : loop) polygons_.push_back(static_cast<unsigned>(v));
      addPlane(hull, loop);
    }
    geom_ = dCreateConvex(nullptr, planes_.data(), static_cast<unsigned>(hull.faces.size()), points_.data(),
                          static_cast<unsigned>(hull.vertices.size()), polygons_.data());
  }
  ~OdeConvex() { dGeomDestroy(geom_); }
  OdeConvex(const OdeConvex&) = delete;
  OdeConvex& operator=(const OdeConvex&) = delete;

  dGeomID at(const OdePose& X) {
    dGeomSetPosition(geom_, X.position[0], X.position[1], X.position[2]);
    dGeomSetQuaternion(geom_, X.rotation);
    return geom_;
  }

 private:
  // Newell's normal of the loop, and its offset at the first corner.
  void addPlane(const Hull& hull, const std::vector<int>& loop) {
    std::array<double, 3> n{0, 0, 0};
    const auto& base = hull.vertices[static_cast<std::size_t>(loop[0])];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const auto& p = hull.vertices[static_cast<std::size_t>(loop[i])];
      const auto& q = hull.vertices[static_cast<std::size_t>(loop[i + 1])];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t y = (k + 1) % 3, z = (k + 2) % 3;
        n[k] += (p[y] - base[y]) * (q[z] - base[z]) - (p[z] - base[z]) * (q[y] - base[y]);
      }
    }
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double offset = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      planes_.push_back(static_cast<dReal>(n[k] / length));
      offset += n[k] / length * base[k];
    }
    planes_.push_back(static_cast<dReal>(offset));
  }

  std::vector<dReal> points_, planes_;
  std::vector<unsigned> polygons_;
  dGeomID geom_ = nullptr;
};

class OdePair : public PairQuery {
 public:
  OdePair(const Hull& a, const Hull& b) : a_(a), b_(b) {}

  void setPoses(std::span<const PosePair> poses) override {
    X_WA_.clear();
    X_WB_.clear();
    for (const PosePair& pair : poses) {
      X_WA_.push_back(odePose(pair.X_WA));
      X_WB_.push_back(odePose(pair.X_WB));
    }
  }
  void forget() override {}
  double ask(std::size_t i) override {
    dContactGeom contacts[kMostContacts];
    const int n = dCollide(a_.at(X_WA_[i]), b_.at(X_WB_[i]), kMostContacts, contacts, sizeof(dContactGeom));
    if (n == 0) return kApart;
    double depth_m = 0.0;
    for (int k = 0; k < n; ++k) depth_m = std::max(depth_m, double(contacts[k].depth));
    return -depth_m;
  }

 private:
  OdeConvex a_, b_;
  std::vector<OdePose> X_WA_, X_WB_;
};

}  // namespace

Library odeLibrary() {
  dInitODE2(0);
  return {"ode", Gives::kContact, sizeof(dReal) == sizeof(double) ? 1e-6 : 1e-4,
          [](const Hull& a, const Hull& b) -> std::unique_ptr<PairQuery> {
            return std::make_unique<OdePair>(a, b);
          }};
}

}  // namespace carom::bench
