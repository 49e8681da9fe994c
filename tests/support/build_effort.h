#pragma once
// How much a test looks at: builds without optimisation are tens of times slower and look at less.

namespace carom {

template <typename Number>
constexpr Number inThisBuild([[maybe_unused]] Number optimised, [[maybe_unused]] Number otherwise) {
#ifdef __OPTIMIZE__
  return optimised;
#else
  return otherwise;
#endif
}

}  // namespace carom
