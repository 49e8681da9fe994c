// A ball falls for a second, as far as gravity says, and is drawn where it arrives.
#include <cmath>
#include <iostream>

#include "engine/simulation/world.h"
#include "renderer/frame/frame_renderer.h"
#include "renderer/view/projection.h"

int main() {
  carom::World world(carom::WorldSettings{});
  carom::BodyDescription ball;
  ball.solid = world.addSolid(carom::Solid::ball(0.5));
  ball.X_WB.position = carom::Vec3(0.0, 0.0, 10.0);
  world.addBody(ball);
  if (!world.start().empty()) return 1;
  for (int step = 0; step < 240; ++step) world.step();
  const double height_m = world.states()[0].X_WB.position.z();
  std::cout << "after " << world.time() << " s at " << height_m << " m\n";
  if (std::abs(height_m - (10.0 - 0.5 * 9.81)) > 1e-9) return 1;

  carom::renderer::FrameRenderer pictures({64, 64}, world.solids());
  const carom::renderer::Instance red{0, world.states()[0].X_WB, {1.0f, 0.0f, 0.0f}, false};
  const carom::renderer::Camera camera{{0.0, -5.0, height_m}, {0.0, 0.0, height_m}, 40.0};
  const carom::renderer::Image& image = pictures.draw({&red, 1}, camera);
  const std::uint8_t* middle = image.pixel(32, 32);
  return middle[0] > 2 * middle[1] ? 0 : 1;
}
