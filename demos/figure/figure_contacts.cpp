#include "demos/figure/figure_contacts.h"

#include <array>

#include "demos/asset/asset_path.h"
#include "demos/format/formatted.h"
#include "demos/language/scene_choice.h"
#include "demos/language/scene_file.h"
#include "demos/overlay/overlay_frame.h"
#include "demos/overlay/v_region_shape.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr int kBodyA = 1, kBodyB = 2;  // Of the scenes: the floor is body 0.
constexpr double kShownGap_m = 0.14;   // The figure shows the first step with less.
constexpr int kMostSteps = 720;
constexpr double kDistance = 0.98;  // Of the scene's camera.

/// What a figure says, beside its numbers.
struct ContactWords {
  const char* scene;
  ContactState state;
  const char* title;
  const char* rule;
  const char* a;  // Names of the features.
  const char* b;
};
constexpr std::array<ContactWords, 4> kWords = {{
    {"contact-vertex-face", ContactState::kVertexFace, "Figure 2. Vertex–face collision",
     "The common state: the normal n is that of the face F; P lies under the vertex V, halfway across the "
     "gap.",
     "F", "V"},
    {"contact-vertex-vertex", ContactState::kVertexVertex, "Figure 3. Vertex–vertex collision",
     "The two vertices P1 and P2 make the normal n of a plane; P is halfway between them.", "P1", "P2"},
    {"contact-vertex-edge", ContactState::kVertexEdge, "Figure 4. Vertex–edge collision",
     "X is the point of edge E closest to vertex V; n runs along X and V.", "E", "V"},
    {"contact-edge-edge", ContactState::kEdgeEdge, "Figure 5. Edge–edge collision",
     "n is the product of the edges' directions e1 and e2, turned outwards by the faces at E1.", "E1", "E2"},
}};

const ContactWords& wordsOf(int number) {
  REQUIRE(number >= 2 && number <= 5, number);
  return kWords[static_cast<std::size_t>(number - 2)];
}

void drawFeature(renderer::OverlayPainter& painter, const std::vector<Vec3>& corners,
                 const renderer::Color& color, const PageSize& size) {
  if (corners.size() > 2) painter.area(corners, {color, 0.25});
  if (corners.size() > 1) painter.line(corners, {{color}, 2.0 * size.line_px()}, corners.size() > 2);
  if (corners.size() == 1) painter.dot(corners[0], 3.0 * size.line_px(), {color});
}

std::vector<Vec3> featureInWorld(const ConvexPart& part, const Pose& X_W, Feature feature) {
  std::vector<Vec3> corners = featureCorners(part.core, feature);
  for (Vec3& c : corners) c = X_W * c;
  return corners;
}

// The plane that the contact is converted to: a square about the point, across the normal.
void drawContactPlane(renderer::OverlayPainter& painter, const ContactPoint& contact, const PageSize& size) {
  constexpr double kHalf_m = 0.24;
  const TangentBasis plane = tangentBasis(contact.n_W);
  std::vector<Vec3> corners;
  for (const Vec2& c : {Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)})
    corners.push_back(contact.p_W + kHalf_m * (c.x() * plane.t1 + c.y() * plane.t2));
  painter.area(corners, {figure_color::kPurple, 0.14});
  painter.line(corners, {{figure_color::kPurple, 0.8}, 0.6 * size.line_px()}, true);
}

// e1 and e2 of figure 5: from the witness points along the edges.
void drawEdgeDirections(renderer::OverlayPainter& painter, const ContactFigure& figure,
                        const PageSize& size) {
  const auto draw = [&](const ConvexPart& part, const Pose& X_W, Feature feature, const Vec3& p_W,
                        const char* name, const renderer::Color& color) {
    const Vec3 tip = p_W + kFigureNormal_m * (X_W.rotation * part.core.edge(feature.index).direction);
    painter.arrow(p_W, tip, {{color}, 1.6 * size.line_px(), 0.0, 0.7});
    painter.label(tip, name, {1.1 * size.em(), {color}, renderer::Align::kLeft, true, 0.9});
  };
  const ClosestFeatures& c = figure.closest;
  draw(*figure.part_a, figure.X_WA, c.features.a, c.p_A_W, "e1", figure_color::kBlue);
  draw(*figure.part_b, figure.X_WB, c.features.b, c.p_B_W, "e2", figure_color::kOrange);
}

/// What a figure has drawn: corners of the two features, the tip of the normal.
struct ContactMarks {
  const std::vector<Vec3>& a;
  const std::vector<Vec3>& b;
  Vec3 tip_W;
};

void nameContact(renderer::OverlayPainter& painter, const ContactFigure& figure, const ContactMarks& marks,
                 const PageSize& size) {
  const ContactWords& words = wordsOf(figure.number);
  const ClosestFeatures& closest = figure.closest;
  const auto name = [&](const Vec3& p_W, const char* text, const renderer::Color& color) {
    painter.label(p_W, text, {1.2 * size.em(), {color}, renderer::Align::kLeft, true, 0.9});
  };
  name(marks.tip_W, "n", figure_color::kRed);
  name(figure.contact.p_W, "P", figure_color::kRed);
  name(marks.b.size() == 1 ? marks.b[0] : Vec3(0.5 * (marks.b[0] + closest.p_B_W)), words.b,
       figure_color::kOrange);
  name(marks.a.size() == 1 ? marks.a[0] : Vec3(0.5 * (marks.a[0] + closest.p_A_W)), words.a,
       figure_color::kBlue);
  if (words.state == ContactState::kVertexEdge) {
    painter.dot(closest.p_A_W, 2.0 * size.line_px(), {figure_color::kBlue});
    name(closest.p_A_W, "X", figure_color::kBlue);
  }
}

}  // namespace

ContactFigure contactFigure(int number, const PageSize& size) {
  const ContactWords& words = wordsOf(number);
  const Scene scene = readSceneFile(findScene(words.scene));
  ContactFigure figure{number, words.scene, makeSceneWorld(scene, std::nullopt), {}, {}, {}, {}, {}, {}, {}};
  World& world = figure.scene.world;
  const auto part = [&](int body) {
    const int solid = world.bodies()[static_cast<std::size_t>(body)].solid;
    return &world.solids()[static_cast<std::size_t>(solid)].parts()[0];
  };
  figure.part_a = part(kBodyA);
  figure.part_b = part(kBodyB);
  FeaturePair tracked;
  for (int step = 0; step < kMostSteps; ++step) {
    figure.X_WA = world.states()[kBodyA].X_WB;
    figure.X_WB = world.states()[kBodyB].X_WB;
    figure.closest = closestFeatures(*figure.part_a, figure.X_WA, *figure.part_b, figure.X_WB, tracked);
    if (figure.closest.distance_m < kShownGap_m) break;
    world.step();
  }
  REQUIRE(contactStateOf(figure.closest.features) == words.state, words.scene, figure.closest.distance_m);
  figure.contact = contactPoint(figure.closest, *figure.part_a, figure.X_WA, *figure.part_b, figure.X_WB);
  const renderer::Camera camera = chosenCamera(scene, "").camera;
  figure.camera = camera;
  figure.camera.target = figure.contact.p_W;
  figure.camera.eye = figure.contact.p_W + kDistance * (camera.eye - camera.target);
  figure.camera = aboveCaption(figure.camera, size);
  return figure;
}

renderer::Image drawContactFigure(const ContactFigure& figure, const PageSize& size) {
  const ContactWords& words = wordsOf(figure.number);
  const auto solid = [&](int body) {
    const int index = figure.scene.world.bodies()[static_cast<std::size_t>(body)].solid;
    return &figure.scene.world.solids()[static_cast<std::size_t>(index)];
  };
  const std::array<renderer::PictureSolid, 2> solids = {
      renderer::PictureSolid{solid(kBodyA), figure.X_WA, figure_color::kStone},
      renderer::PictureSolid{solid(kBodyB), figure.X_WB, figure_color::kSand}};
  const renderer::SolidPicture picture =
      renderer::castSolids(solids, figure.camera, size.width, size.height, figure_color::kPaper);
  renderer::Canvas canvas(picture.image);
  renderer::OverlayPainter painter(canvas, figure.camera, picture.depth);
  drawEdges(painter, solids, size);

  const ClosestFeatures& closest = figure.closest;
  const std::vector<Vec3> a = featureInWorld(*figure.part_a, figure.X_WA, closest.features.a);
  const std::vector<Vec3> b = featureInWorld(*figure.part_b, figure.X_WB, closest.features.b);
  drawFeature(painter, a, figure_color::kBlue, size);
  drawFeature(painter, b, figure_color::kOrange, size);
  drawContactPlane(painter, figure.contact, size);
  if (words.state == ContactState::kEdgeEdge) drawEdgeDirections(painter, figure, size);
  painter.line(closest.p_A_W, closest.p_B_W, {{figure_color::kInk}, 0.8 * size.line_px(), 4.0});
  const Vec3 tip = figure.contact.p_W + kFigureNormal_m * figure.contact.n_W;
  painter.setLift(1.0);  // the normal is shown over the body that it enters
  painter.arrow(figure.contact.p_W, tip, {{figure_color::kRed}, 2.0 * size.line_px(), 0.0, 0.8});
  painter.dot(figure.contact.p_W, 2.4 * size.line_px(), {figure_color::kRed});
  nameContact(painter, figure, {a, b, tip}, size);
  painter.setLift(0.0);
  writeCaption(canvas,
               {words.title,
                {words.rule, "From a run of " + figure.scene_name + ": " +
                                 formatted("t = %.4f s, ", figure.scene.world.time()) + "d = " +
                                 lengthText(closest.distance_m) + ", P = " + vectorText(figure.contact.p_W) +
                                 ", n = " + vectorText(figure.contact.n_W) + "."}},
               size);
  return canvas.image();
}

}  // namespace carom::demos
