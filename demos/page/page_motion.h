#pragma once
// The bodies' motion as a page holds it: poses, velocities and modes of every frame, rounded to quanta that
// follow from the size of the smallest body that moves, in columns (byte_stream.h), so that a body at rest
// costs next to nothing. Read by web/recording.js. Tested in tests/demos/page/page_motion_test.cpp.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "demos/page/byte_stream.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {

/// The steps of the numbers. Powers of two: rounding is to the nearest, and nothing else is lost.
struct PageQuanta {
  double length_m = 0.0;        ///< Of positions: at most 1e-4 of the smallest moving body's radius off.
  double contact_m = 0.0;       ///< Of what is drawn at contacts: at most 4e-3 of that radius off.
  double quaternion = 0x1p-15;  ///< Of each of the four numbers: rotations are at most 6.2e-5 rad off.
  double speed_mps = 0.0;       ///< Of each component.
  double spin_radps = 0x1p-10;
};
/// Where no body moves, those of a body of 1 m.
PageQuanta pageQuanta(const World& world);

class PageMotion {
 public:
  /// `world` must outlive this.
  PageMotion(const World& world, const PageQuanta& quanta);

  /// Frames in order of time.
  void add(std::span<const BodyState> states);
  int frames() const { return frames_; }
  /// Of each body a 1 when it moves; its columns of poses (3 and 4 numbers) and, of one that moves, of
  /// velocities (3 and 3), each of one number or of one a frame; the modes as runs.
  void write(ByteStream& out) const;

 private:
  static constexpr std::size_t kColumns = 13;
  struct Track {
    bool moves = false;
    std::array<std::vector<std::int64_t>, kColumns> columns;
    std::vector<std::int64_t> modes;
  };
  std::array<std::int64_t, kColumns> rounded(const BodyState& state, const Track& track) const;

  const World& world_;
  PageQuanta quanta_;
  std::vector<Track> tracks_;
  int frames_ = 0;
};

}  // namespace carom::demos
