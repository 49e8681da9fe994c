#pragma once
// The ten figures of the paper, drawn from the running engine: every number in them is an answer of it.
// Tested in tests/demos/figure/figures_test.cpp.

#include "demos/figure/figure_page.h"

namespace carom::demos {

inline constexpr int kFigures = 10;

/// `number`: 1 to kFigures. The same bytes each time.
renderer::Image drawFigure(int number, const PageSize& size);
/// "V-regions": for lists.
const char* figureName(int number);

}  // namespace carom::demos
