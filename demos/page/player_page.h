#pragma once
// A page that plays a scene's run in a browser: one HTML file that needs nothing else and asks nobody for
// anything. It holds the shapes, the motion and what the engine knew of contacts, packed, with a player
// (web/) that draws them by WebGL 2 and is the same for all pages. The same run gives the same bytes. Tested
// in tests/demos/page/player_page_test.cpp, and in a browser by
// tests/demos/page/page_browser_test.cpp.

#include <span>
#include <string>
#include <vector>

#include "demos/format/json.h"
#include "demos/language/scene_choice.h"
#include "demos/page/page_contacts.h"
#include "demos/page/page_motion.h"
#include "demos/page/page_pictures.h"
#include "demos/page/page_shapes.h"
#include "demos/scene/camera_path.h"
#include "demos/scene/scene.h"
#include "demos/scene/scene_caption.h"

namespace carom::demos {

struct PageChoice {
  double fps = 60.0;
  int frames = 1;
  bool recorded = false;  ///< The motion comes from a recording, which holds no impulses.
  std::string command;    ///< What makes the page, for whoever reads it.
  std::string index;      ///< A link back to where the page is listed, relative to it; empty: none.
};

/// Moving bodies times frames that a page takes.
inline constexpr double kMostPagePoses = 2e6;

class PlayerPage {
 public:
  /// Both must outlive this; the world is watched unless `recorded`. Throws UsageError for more poses than
  /// kMostPagePoses.
  PlayerPage(const Scene& scene, SceneWorld& made, PageChoice choice);

  /// Frames from 0 in order.
  void add(int frame, std::span<const BodyState> states);
  /// The page; all frames must have been added.
  std::string html() const;

 private:
  struct CameraTrack {
    std::string name;
    CameraPath path;
    bool moves = false;
    std::vector<renderer::Camera> frames;
  };
  void writeCameras(ByteStream& out) const;
  Json factsJson() const;
  Json bodiesJson() const;
  Json camerasJson() const;
  Json sceneJson() const;

  const Scene& scene_;
  SceneWorld& made_;
  PageChoice choice_;
  PageQuanta quanta_;
  PagePictures pictures_;
  PageShapes shapes_;
  std::optional<PageGround> ground_;
  PageMotion motion_;
  PageContacts contacts_;
  SceneCaption caption_;
  std::vector<std::string> captions_;  // Of the frames; none without a caption.
  std::vector<CameraTrack> cameras_;
};

/// The scene's own cameras, the one that is taken first in front, and one that shows everything.
std::vector<NamedCamera> pageCameras(const Scene& scene);

}  // namespace carom::demos
