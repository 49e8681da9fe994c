#pragma once
// Pictures of polyhedra on paper: flat faces by ray casting, four rays a pixel, for diagrams; with the depth
// that lets an OverlayPainter draw their edges, hidden ones dashed. Needs no GL. Tested in
// tests/renderer/drawing/solid_picture_test.cpp.

#include <span>

#include "engine/solid/solid.h"
#include "renderer/image/image.h"
#include "renderer/image/surface_image.h"
#include "renderer/view/projection.h"
#include "renderer/view/view.h"

namespace carom::renderer {

/// A solid of polyhedral parts without rounding.
struct PictureSolid {
  const Solid* solid = nullptr;
  Pose X_WB;
  Color color;
};

struct SolidPicture {
  Image image;
  DepthImage depth;  ///< Of the nearest of a pixel's rays.
};

/// Cost: the pixels of each part's bounding box times its faces.
SolidPicture castSolids(std::span<const PictureSolid> solids, const Camera& camera, int width, int height,
                        const Color& background);

}  // namespace carom::renderer
