#pragma once
// What a folder of frames says of the world that they show, so that a later comparison can name what changed:
// the bodies as they start, the look, the sources of the program, a print of every step's state, and thinned
// out to fit kMostRecordBytes the motion, the collisions and the contacts. Lies as kRecordName beside the
// frames. Lengths in metres, impulses in N s; numbers have nine digits, motion is rounded to
// `length_quantum_m` and `kTurnQuantum`; the prints of the states tell what is exactly the same.
// Tested in tests/demos/cause/motion_record_test.cpp.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/simulation/world.h"
#include "renderer/image/color.h"
#include "renderer/image/png.h"
#include "renderer/view/projection.h"

namespace carom::demos {

inline constexpr char kRecordName[] = "states.carom";
inline constexpr std::size_t kMostRecordBytes = 50000;
/// Of a quaternion's component: a ten-thousandth of a body's radius at its surface.
inline constexpr double kTurnQuantum = 1e-4;

/// Named texts in a fixed order: "gravity" is "0 0 -9.81".
using Facts = std::vector<std::pair<std::string, std::string>>;

struct RecordedBody {
  std::string name;
  Facts motion;  ///< How it starts: position, rotation, velocities, whether it is static.
  Facts stuff;   ///< Friction, restitution, density, resistance, drag.
  Facts shape;   ///< A print of its geometry, its volume and its radius.
  Facts look;    ///< Colour and checker.
};

/// x, y, z and the quaternion's w, x, y, z in quanta.
using RoundedPose = std::array<long long, 7>;

/// Two bodies (indices) that touch, with the sum of their contacts' impulses.
struct RecordedTouch {
  int body_a = 0;
  int body_b = 0;
  double impulse_Ns = 0.0;
};
struct RecordedMoment {
  int step = 0;
  double time_s = 0.0;
  std::vector<RoundedPose> poses;  ///< Of all bodies.
  std::vector<RecordedTouch> touches;
};
struct RecordedStrike {
  int step = 0;  ///< In which it acted.
  double time_s = 0.0;
  int body_a = 0;
  int body_b = 0;
  double impulse_Ns = 0.0;
};
struct RecordedShot {
  std::string file;  ///< The frame's file within the folder.
  double time_s = 0.0;
  std::uint64_t state_hash = 0;
  renderer::Camera camera;
  std::vector<RoundedPose> poses;
  int width = 0;
  int height = 0;
  std::vector<std::int32_t> bodies;  ///< Behind each pixel, -1: none; empty: not known.
  std::uint64_t text_print = 0;      ///< Of what the frame's file says of itself; 0: not known.

  /// Whether it is of the frame whose file says this of itself: a later run may have drawn another one under
  /// the same name.
  bool isOf(const renderer::PngText& text) const;
};

/// Of all that a frame's file says of what it shows, but not of the program that drew it.
std::uint64_t textPrint(const renderer::PngText& text);
/// What it says under that key; empty: nothing.
std::string textOf(const renderer::PngText& text, std::string_view key);

struct MotionRecord {
  std::string scene;
  Facts world;    ///< Gravity, step rate, air, waters.
  Facts look;     ///< Size, light, preset, style, waters' colours, who draws.
  Facts sources;  ///< Each source file of the program, with a print of its text.
  double step_s = 0.0;
  double length_quantum_m = 1e-5;
  std::vector<RecordedBody> bodies;
  int print_stride = 1;               ///< Steps between two prints.
  std::vector<std::uint32_t> prints;  ///< Of the states after 0, stride, 2 stride ... steps.
  std::vector<RecordedMoment> moments;
  std::vector<RecordedStrike> strikes;
  std::vector<RecordedShot> shots;

  /// The shot of the file of that name which says this of itself; null where there is none.
  const RecordedShot* shotOf(const std::string& file, const renderer::PngText& text) const;
};

RoundedPose roundedPose(const Pose& X_WB, double length_quantum_m);
Vec3 positionOf(const RoundedPose& pose, double length_quantum_m);

/// The bytes of the record's file, thinned out until they are at most `most`, if that is possible at all.
std::vector<std::uint8_t> recordBytes(const MotionRecord& record, std::size_t most = kMostRecordBytes);

/// Throws InputError.
MotionRecord readRecord(const std::filesystem::path& path);

}  // namespace carom::demos
