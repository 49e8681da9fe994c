#pragma once
// The scalar product in one order of additions: Eigen's `a.dot(b)` adds in another one from version to
// version, and the state would have other bits. A sum is taken by halves in all of them: x + (y + z), (x + y)
// + (z + w). tests/architecture/own_sums_test.cpp forbids Eigen's product in the engine;
// tests/engine/foundation/dot_test.cpp holds this one, and the other sums of Eigen that the state depends on,
// to their orders.

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace carom {

/// Of two vectors of one length, which is known to the compiler: by halves.
template <class A, class B>
double dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  static_assert(A::IsVectorAtCompileTime && A::SizeAtCompileTime != Eigen::Dynamic);
  return a.cwiseProduct(b).sum();
}

/// Of lists of one length: one by one, from the first on.
inline double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace carom
