#pragma once
// Figure 1 of the paper: V-regions of a face, an edge and a vertex, with points around the solid sorted by
// the feature that V-Clip finds closest to them. Tested in tests/demos/figure/figures_test.cpp.

#include <array>
#include <vector>

#include "demos/figure/figure_page.h"
#include "engine/closest_features/pair/feature.h"

namespace carom::demos {

struct RegionFigure {
  Solid solid = Solid::box({1.3, 1.0, 0.9});
  renderer::Camera camera;
  std::array<Feature, 3> features;  ///< A face, an edge and a vertex.
  double reach_m = 0.6;             ///< How far the regions are shown.
  struct Sample {
    Vec3 p_W;
    std::size_t feature = 0;  ///< Whose region V-Clip puts it into, of `features`.
  };
  std::vector<Sample> samples;
};
RegionFigure regionFigure(const PageSize& size);
renderer::Color regionColor(std::size_t feature);
renderer::Image drawRegionFigure(const RegionFigure& figure, const PageSize& size);

}  // namespace carom::demos
