#include "renderer/mesh/face_light.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "engine/solid/convex_hull.h"
#include "renderer/view/solid_extent.h"

namespace carom::renderer {
namespace {

const Camera kCamera{Vec3(4.0, -9.0, 5.0), Vec3(0.0, 0.0, 1.0), 40.0};
const Vec3 kToLight = Vec3(0.5, -0.4, 0.8).normalized();

ShadedBody body(const Solid& solid, const Quat& turned, const Vec3& p_W) {
  const Pose X_EB{turned, p_W - kCamera.eye};
  const Extent extent = solidExtent(solid);
  return {&solid, X_EB, {{turned, X_EB * extent.center}, extent.half}};
}

std::vector<FaceLight> lightOn(const std::vector<ShadedBody>& bodies) {
  std::vector<ShadowCaster> casters;
  for (const ShadedBody& b : bodies) casters.push_back(b.bounds);
  return faceLights(fitShadow({kCamera, 16.0 / 9.0, kToLight, 1024}, casters), kToLight, bodies);
}

// Whether the ray from p towards the light meets the convex body, by its faces' planes.
bool blocks(const ShadedBody& caster, const Vec3& p_E) {
  const ConvexPolyhedron& core = caster.solid->parts().front().core;
  const Vec3 p = caster.X_EB.inverse() * p_E, ray = caster.X_EB.rotation.conjugate() * kToLight;
  double in = 0.0, out = 1e9;
  for (int f = 0; f < core.faceCount(); ++f) {
    const double above = core.plane(f).signedDistance(p), rise = core.plane(f).normal.dot(ray);
    if (rise < 0.0)
      in = std::max(in, -above / rise);
    else if (rise > 0.0)
      out = std::min(out, -above / rise);
    else if (above > 0.0)
      return false;
  }
  return in < out;
}

Vec3 pointOn(const ShadedBody& of, int face, std::mt19937& random) {
  const ConvexPolyhedron& core = of.solid->parts().front().core;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Vec3 sum = Vec3::Zero();
  double whole = 0.0;
  for (const int v : core.faceVertices(face)) {
    const double weight = -std::log(1.0 - share(random));
    sum += weight * core.vertex(v);
    whole += weight;
  }
  return of.X_EB * Vec3(sum / whole);
}

bool has(FaceMask faces, int face) {
  return (faces >> face & 1) != 0;
}

class FaceLightTest : public testing::Test {
 protected:
  FaceLightTest() {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i)
      points.push_back(0.4 * Vec3(normal(random), normal(random), normal(random)).normalized());
    hull_ = Solid::polyhedron(convexHull(points).polyhedron);
  }
  std::vector<ShadedBody> scattered(unsigned seed, int count) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-2.0, 2.0);
    std::vector<ShadedBody> bodies;
    for (int i = 0; i < count; ++i) {
      const Quat turned(Eigen::AngleAxisd(place(random), Vec3(1.0, 2.0, place(random)).normalized()));
      bodies.push_back(
          body(i % 2 == 0 ? box_ : hull_, turned, Vec3(place(random), place(random), 2.5 + place(random))));
    }
    return bodies;
  }

  Solid box_ = Solid::box(Vec3(0.6, 0.5, 0.7));
  Solid hull_ = Solid::box(Vec3(1.0, 1.0, 1.0));
};

TEST_F(FaceLightTest, EveryFaceThatTheEyeSeesHasOneLightAndNoOtherHasAny) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<ShadedBody> bodies = scattered(seed, 12);
    const std::vector<FaceLight> lights = lightOn(bodies);
    ASSERT_EQ(lights.size(), bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const FaceLight& light = lights[i];
      EXPECT_EQ(light.sunlit & light.turned, 0u);
      EXPECT_EQ(light.shadowed & (light.sunlit | light.turned), 0u);
      const ConvexPolyhedron& core = bodies[i].solid->parts().front().core;
      for (int f = 0; f < core.faceCount(); ++f) {
        const Vec3 p_E = bodies[i].X_EB * core.vertex(core.faceVertices(f)[0]);
        const bool seen = (bodies[i].X_EB.rotation * core.plane(f).normal).dot(p_E) < 0.0;
        EXPECT_EQ(has(light.sunlit | light.turned | light.shadowed, f), seen) << seed << " " << i << " " << f;
      }
    }
  }
}

TEST_F(FaceLightTest, NothingStandsBetweenASunlitFaceAndTheSun) {
  std::mt19937 random(4);
  int sunlit = 0, darkened = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const std::vector<ShadedBody> bodies = scattered(seed, 10);
    const std::vector<FaceLight> lights = lightOn(bodies);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const ConvexPolyhedron& core = bodies[i].solid->parts().front().core;
      for (int f = 0; f < core.faceCount(); ++f) {
        if ((bodies[i].X_EB.rotation * core.plane(f).normal).dot(kToLight) <= 0.0) continue;
        if (has(lights[i].sunlit, f)) ++sunlit;
        EXPECT_FALSE(has(lights[i].turned, f));
        for (std::size_t k = 0; k < bodies.size(); ++k)
          for (int sample = 0; k != i && sample < 10; ++sample)
            if (blocks(bodies[k], pointOn(bodies[i], f, random))) {
              ++darkened;
              EXPECT_FALSE(has(lights[i].sunlit, f)) << seed << " " << i << " " << f;
            }
      }
    }
  }
  EXPECT_GT(sunlit, 300);
  EXPECT_GT(darkened, 300);
}

// Sunlit ones are left to the shader, which knows their slant: both ways they get no light that is not
// theirs.
TEST_F(FaceLightTest, OnlyFacesTurnedFromTheSunAreCalledSo) {
  int turned = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<ShadedBody> bodies = scattered(seed, 12);
    const std::vector<FaceLight> lights = lightOn(bodies);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (int f = 0; f < bodies[i].solid->parts().front().core.faceCount(); ++f) {
        const double slant =
            (bodies[i].X_EB.rotation * bodies[i].solid->parts().front().core.plane(f).normal).dot(kToLight);
        if (has(lights[i].turned, f)) {
          EXPECT_LE(slant, 0.0);
        }
        if (has(lights[i].shadowed, f)) {
          EXPECT_GT(slant, 0.0);
        }
        if (has(lights[i].turned, f)) ++turned;
      }
  }
  EXPECT_GT(turned, 20);
}

TEST_F(FaceLightTest, BoxesInARowDarkenEachOthersSidesButNotTheirTops) {
  std::vector<ShadedBody> bodies;
  for (int i = 0; i < 5; ++i)
    bodies.push_back(body(box_, Quat::Identity(), Vec3(0.0, 0.7 * i, 0.35 + 1e-4 * (i % 2))));
  const std::vector<FaceLight> lights = lightOn(bodies);
  const ConvexPolyhedron& core = box_.parts().front().core;
  for (int f = 0; f < core.faceCount(); ++f)
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Vec3& n = core.plane(f).normal;
      if (n.z() > 0.5) {
        EXPECT_TRUE(has(lights[i].sunlit, f));
      }
      if (n.y() < -0.5) {
        EXPECT_EQ(has(lights[i].shadowed, f), i > 0) << i;  // The first has none before it.
      }
    }
}

TEST_F(FaceLightTest, WhatIsNotOneConvexPolyhedronIsLitAsAWhole) {
  const Solid ball = Solid::ball(0.3), rounded = Solid::roundedBox(Vec3(0.6, 0.6, 0.6), 0.05);
  EXPECT_FALSE(hasLitFaces(ball));
  EXPECT_FALSE(hasLitFaces(rounded));
  EXPECT_TRUE(hasLitFaces(box_));
  const std::vector<FaceLight> apart = lightOn(
      {body(ball, Quat::Identity(), Vec3::Zero()), body(ball, Quat::Identity(), Vec3(3.0, 3.0, 0.0))});
  EXPECT_EQ(apart[0].sunlit, kAllFaces);
  const Vec3 behind = -1.5 * kToLight;
  const std::vector<FaceLight> in_line =
      lightOn({body(ball, Quat::Identity(), behind), body(ball, Quat::Identity(), Vec3::Zero())});
  EXPECT_EQ(in_line[0].shadowed, kAllFaces);
  EXPECT_EQ(in_line[1].sunlit, kAllFaces);
}

TEST_F(FaceLightTest, WithoutAShadowToSeeAllIsSunlit) {
  const std::vector<ShadedBody> bodies = scattered(3, 8);
  for (const FaceLight& light : faceLights(ShadowView{}, kToLight, bodies)) {
    EXPECT_NE(light.sunlit, 0u);
    EXPECT_EQ(light.turned | light.shadowed, 0u);
  }
}

}  // namespace
}  // namespace carom::renderer
