#include "demos/figure/figures.h"

#include <array>

#include "demos/figure/figure_contacts.h"
#include "demos/figure/figure_distance.h"
#include "demos/figure/figure_manifold.h"
#include "demos/figure/figure_regions.h"
#include "demos/figure/figure_support.h"
#include "demos/figure/figure_window.h"
#include "engine/foundation/contract.h"

namespace carom::demos {

renderer::Image drawFigure(int number, const PageSize& size) {
  switch (number) {
    case 1:
      return drawRegionFigure(regionFigure(size), size);
    case 2:
    case 3:
    case 4:
    case 5:
      return drawContactFigure(contactFigure(number, size), size);
    case 6:
      return drawDistanceFigure(distanceFigure(), size);
    case 7:
      return drawWindowFigure(windowFigure(), size);
    case 8:
      return drawManifoldFigure(manifoldFigure(size), size);
    case 9:
      return drawSupportFigure(supportFigure(size), size);
    case 10:
      return drawSupportPlan(supportFigure(size), size);
    default:
      REQUIRE(number >= 1 && number <= kFigures, number);
      return {};
  }
}

const char* figureName(int number) {
  constexpr std::array<const char*, kFigures> kNames = {"V-regions",
                                                        "vertex-face",
                                                        "vertex-vertex",
                                                        "vertex-edge",
                                                        "edge-edge",
                                                        "distance over time",
                                                        "the collision window",
                                                        "multi-point collision",
                                                        "the support polygon",
                                                        "the support polygon, seen along gravity"};
  REQUIRE(number >= 1 && number <= kFigures, number);
  return kNames[static_cast<std::size_t>(number - 1)];
}

}  // namespace carom::demos
