// The order of additions of every sum that the state depends on, ours and Eigen's: a version of Eigen that
// adds in another one is found here and not by a hash that differs.

#include "engine/foundation/dot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "engine/foundation/frames.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Of magnitudes far apart, so that another order gives other bits.
class Values {
 public:
  explicit Values(unsigned seed) : random_(seed) {}
  template <class Dense>
  Dense of() {
    return Dense::NullaryExpr([this] {
      return std::ldexp(1.0 - 2.0 * std::generate_canonical<double, 53>(random_), exponent_(random_));
    });
  }

 private:
  std::mt19937_64 random_;
  std::uniform_int_distribution<int> exponent_{-3, 3};
};

double halves3(double x, double y, double z) {
  return x + (y + z);
}
double halves3(const Vec3& a, const Vec3& b) {
  return halves3(a[0] * b[0], a[1] * b[1], a[2] * b[2]);
}
double halves6(const Vec6& a, const Vec6& b) {
  return halves3(a.head<3>(), b.head<3>()) + halves3(a.tail<3>(), b.tail<3>());
}

/// The law holds for a thousand draws, and would be seen to be broken: `other` gives other bits for many.
void expectOrder(const std::function<void(Values&, double& is, double& law, double& other)>& draw) {
  Values values(7);
  int told_apart = 0;
  for (int i = 0; i < 1000; ++i) {
    double is = 0.0, law = 0.0, other = 0.0;
    draw(values, is, law, other);
    ASSERT_EQ(is, law) << "draw " << i;
    if (law != other) ++told_apart;
  }
  EXPECT_GT(told_apart, 100);
}

TEST(Dot, AddsThreeTheLastTwoFirst) {
  expectOrder([](Values& values, double& is, double& law, double& other) {
    const auto a = values.of<Vec3>(), b = values.of<Vec3>();
    is = dot(a, b);
    law = halves3(a, b);
    other = (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
  });
}

TEST(Dot, AddsSixByHalves) {
  expectOrder([](Values& values, double& is, double& law, double& other) {
    const auto a = values.of<Vec6>(), b = values.of<Vec6>();
    is = dot(a, b);
    law = halves6(a, b);
    other = 0.0;
    for (int k = 0; k < 6; ++k) other += a[k] * b[k];
  });
}

TEST(Dot, AddsListsFromTheFirstOn) {
  expectOrder([](Values& values, double& is, double& law, double& other) {
    const auto a = values.of<Vec3>(), b = values.of<Vec3>();
    is = dot(std::span<const double>(a.data(), 3), std::span<const double>(b.data(), 3));
    law = (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
    other = halves3(a, b);
  });
}

TEST(Dot, TakesExpressionsAndTwoComponents) {
  const Vec3 a(1, 2, 3), b(4, 5, 6);
  EXPECT_EQ(dot(a + b, crossMatrix(a) * b), 0.0);
  EXPECT_EQ(dot(a.head<2>(), b.head<2>()), 14.0);
  EXPECT_EQ(dot(std::vector<double>{}, std::vector<double>{}), 0.0);
}

TEST(EigensSums, OfNormsAreByHalves) {
  expectOrder([](Values& values, double& is, double& law, double& other) {
    const auto a = values.of<Vec3>();
    is = a.squaredNorm();
    law = halves3(a, a);
    other = (a[0] * a[0] + a[1] * a[1]) + a[2] * a[2];
    ASSERT_EQ(a.norm(), std::sqrt(law));
    ASSERT_EQ(a.normalized(), Vec3(a / std::sqrt(law)));
  });
}

TEST(EigensSums, OfMatricesTimesVectorsAreByHalves) {
  expectOrder([](Values& values, double& is, double& law, double& other) {
    const auto m = values.of<Mat3>(), n = values.of<Mat3>();
    const auto v = values.of<Vec3>();
    const Vec3 product = m * v, turned_back = m.transpose() * v;
    const Mat3 matrices = m * n;
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(product[i], halves3(m.row(i).transpose(), v));
      ASSERT_EQ(turned_back[i], halves3(m.col(i), v));
      for (int j = 0; j < 3; ++j) ASSERT_EQ(matrices(i, j), halves3(m.row(i).transpose(), n.col(j)));
    }
    is = product[0];
    law = halves3(m.row(0).transpose(), v);
    other = (m(0, 0) * v[0] + m(0, 1) * v[1]) + m(0, 2) * v[2];
  });
}

TEST(EigensSums, OfSixRowsAreByHalves) {
  expectOrder([](Values& values, double& is, double& law, double& other) {
    const auto m = values.of<Mat6>();
    const auto v = values.of<Vec6>();
    const Vec6 product = m * v;
    for (int i = 0; i < 6; ++i) ASSERT_EQ(product[i], halves6(m.row(i).transpose(), v));
    is = product[0];
    law = halves6(m.row(0).transpose(), v);
    other = 0.0;
    for (int k = 0; k < 6; ++k) other += m(0, k) * v[k];
  });
}

TEST(EigensSums, OfTurnsAreThoseOfTheirFormulas) {
  oracle::Random random(3);
  Values values(9);
  for (int i = 0; i < 1000; ++i) {
    const Quat q = random.pose(1).rotation, p = random.pose(1).rotation;
    const auto v = values.of<Vec3>();
    const Vec3 twice = 2.0 * q.vec().cross(v);
    ASSERT_EQ(q * v, Vec3(v + q.w() * twice + q.vec().cross(twice)));
    ASSERT_EQ((q * p).w(), q.w() * p.w() - q.x() * p.x() - q.y() * p.y() - q.z() * p.z());
    ASSERT_EQ((q * p).x(), q.w() * p.x() + q.x() * p.w() + q.y() * p.z() - q.z() * p.y());
    ASSERT_EQ(q.norm(), std::sqrt((q.x() * q.x() + q.y() * q.y()) + (q.z() * q.z() + q.w() * q.w())));
    ASSERT_EQ(q.toRotationMatrix()(0, 1), 2.0 * q.y() * q.x() - 2.0 * q.z() * q.w());
    const auto u = values.of<Vec3>();
    ASSERT_EQ(u.cross(v)[0], u[1] * v[2] - u[2] * v[1]);
  }
}

}  // namespace
}  // namespace carom
