#include "demos/figure/figure_regions.h"

#include "demos/overlay/v_region_shape.h"
#include "engine/closest_features/vclip.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr int kSamplesASide = 15;  // Of the lattice that is asked for.
constexpr double kClearance = 0.04;

// The feature that reaches farthest along a direction: the lowest-dimensional one whose corners all do.
Feature faceAlong(const ConvexPolyhedron& p, const Vec3& direction) {
  int best = 0;
  for (int f = 1; f < p.faceCount(); ++f)
    if (p.plane(f).normal.dot(direction) > p.plane(best).normal.dot(direction)) best = f;
  return faceFeature(best);
}
Feature edgeAlong(const ConvexPolyhedron& p, const Vec3& direction) {
  const auto reach = [&](int e) {
    return (p.vertex(p.edge(e).tail) + p.vertex(p.edge(e).head)).dot(direction);
  };
  int best = 0;
  for (int e = 1; e < p.edgeCount(); ++e)
    if (reach(e) > reach(best)) best = e;
  return edgeFeature(best);
}

void sortSamples(RegionFigure& figure) {
  const ConvexPart& body = figure.solid.parts()[0];
  const ConvexPart point{ConvexPolyhedron::point(Vec3::Zero()), 0.0};
  const double half = body.core.radius() + figure.reach_m;
  for (int i = 0; i < kSamplesASide * kSamplesASide * kSamplesASide; ++i) {
    const Vec3 cell(i % kSamplesASide, i / kSamplesASide % kSamplesASide,
                    i / (kSamplesASide * kSamplesASide));
    const Vec3 p_W = half * (2.0 / (kSamplesASide - 1) * cell - Vec3::Ones());
    FeaturePair cold;
    const ClosestFeatures closest = closestFeatures(body, Pose{}, point, {Quat::Identity(), p_W}, cold);
    if (closest.distance_m < kClearance || closest.distance_m > figure.reach_m) continue;
    for (std::size_t f = 0; f < figure.features.size(); ++f)
      if (closest.features.a == figure.features[f]) figure.samples.push_back({p_W, f});
  }
}

// Where a region's name stands: at its far end.
Vec3 shapeMiddle(const ConvexPolyhedron& p, Feature feature, double reach_m) {
  const std::vector<Vec3> corners = featureCorners(p, feature);
  Vec3 middle = Vec3::Zero(), outward = Vec3::Zero();
  for (const Vec3& c : corners) middle += c / static_cast<double>(corners.size());
  if (feature.kind == FeatureKind::kFace) outward = p.plane(feature.index).normal;
  if (feature.kind == FeatureKind::kEdge)
    outward = p.plane(p.edge(feature.index).left).normal + p.plane(p.edge(feature.index).right).normal;
  if (feature.kind == FeatureKind::kVertex)
    for (const Spoke& spoke : p.spokes(feature.index)) outward -= spoke.direction;
  return middle + 1.02 * reach_m * outward.normalized();
}

}  // namespace

renderer::Color regionColor(std::size_t feature) {
  constexpr std::array<renderer::Color, 3> kColors = {figure_color::kBlue, figure_color::kGreen,
                                                      figure_color::kOrange};
  return kColors[feature];
}

RegionFigure regionFigure(const PageSize& size) {
  RegionFigure figure;
  const ConvexPolyhedron& core = figure.solid.parts()[0].core;
  figure.camera = aboveCaption({{2.7, -4.9, 2.3}, {0.05, 0.0, 0.0}, 33.0}, size);
  figure.features = {faceAlong(core, Vec3::UnitZ()), edgeAlong(core, Vec3(1.0, 0.0, -0.9)),
                     vertexFeature(core.support(Vec3(-1.0, -1.0, -1.0)))};
  sortSamples(figure);
  return figure;
}

renderer::Image drawRegionFigure(const RegionFigure& figure, const PageSize& size) {
  const std::array<renderer::PictureSolid, 1> solids = {
      renderer::PictureSolid{&figure.solid, Pose{}, figure_color::kStone}};
  const renderer::SolidPicture picture =
      renderer::castSolids(solids, figure.camera, size.width, size.height, figure_color::kPaper);
  renderer::Canvas canvas(picture.image);
  renderer::OverlayPainter painter(canvas, figure.camera, picture.depth);
  drawEdges(painter, solids, size);
  const ConvexPolyhedron& core = figure.solid.parts()[0].core;
  constexpr std::array<const char*, 3> kNames = {"V-region of face ", "V-region of edge ",
                                                 "V-region of vertex "};
  for (std::size_t f = 0; f < figure.features.size(); ++f) {
    const renderer::Color color = regionColor(f);
    const RegionShape shape = regionShape(core, figure.features[f], figure.reach_m);
    for (const std::vector<Vec3>& side : shape.sides) {
      painter.area(side, {color, 0.16});
      painter.line(side, {{color}, 0.6 * size.line_px()}, true);
    }
    for (const std::vector<Vec3>& rim : shape.rims) painter.line(rim, {{color}, 0.6 * size.line_px()});
    const std::vector<Vec3> corners = featureCorners(core, figure.features[f]);
    if (corners.size() > 2) painter.area(corners, {color, 0.35});
    if (corners.size() > 1) painter.line(corners, {{color}, 2.0 * size.line_px()}, corners.size() > 2);
    if (corners.size() == 1) painter.dot(corners[0], 2.5 * size.line_px(), {color});
  }
  for (const RegionFigure::Sample& sample : figure.samples)
    painter.dot(sample.p_W, 1.0 * size.line_px(), {regionColor(sample.feature)});
  for (std::size_t f = 0; f < figure.features.size(); ++f) {
    const Feature feature = figure.features[f];
    Vec3 far = shapeMiddle(core, feature, figure.reach_m);
    painter.label(far, kNames[f] + std::to_string(feature.index),
                  {size.em(), {regionColor(f)}, renderer::Align::kLeft, true, 0.9});
  }
  writeCaption(
      canvas,
      {"Figure 1. V-regions",
       {"The V-region of a feature holds the points that no other feature of the solid is closer to. Its "
        "planes",
        "stand on the feature's borders: on a face's edges, along the normals of the faces at an edge.",
        std::to_string(figure.samples.size()) +
            " points of a lattice, each coloured by the feature that V-Clip finds closest to it."}},
      size);
  return canvas.image();
}

}  // namespace carom::demos
