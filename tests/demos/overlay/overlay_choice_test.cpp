#include "demos/overlay/overlay_choice.h"

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

TEST(OverlayChoice, NamesComeBackInOneOrder) {
  EXPECT_EQ(readOverlays("distance,closest").text(), "closest,distance");
  EXPECT_EQ(readOverlays("closest,distance,closest").text(), "closest,distance");
  EXPECT_FALSE(readOverlays("").any());
  for (const OverlayDescription& d : overlayDescriptions()) {
    const OverlayChoice choice = readOverlays(d.name);
    EXPECT_TRUE(choice.has(d.overlay)) << d.name;
    EXPECT_EQ(choice.text(), d.name);
  }
  EXPECT_EQ(overlayDescriptions().size(), kOverlays);
}

TEST(OverlayChoice, AMisspeltNameIsAnsweredWithTheNearest) {
  for (const char* list : {"closest,distanse", "distanse", "distanse,closest"}) {
    const std::string message = thrownMessage<UsageError>([&] { readOverlays(list); });
    EXPECT_NE(message.find("\"distanse\"; did you mean \"distance\"?"), std::string::npos) << message;
    EXPECT_NE(message.find("trails"), std::string::npos) << "and all that are accepted";
  }
  for (const char* list : {",", "closest,", ",closest"}) EXPECT_THROW(readOverlays(list), UsageError) << list;
}

TEST(OverlayChoice, ARecordingRefusesWhatItDoesNotHoldAndNamesAllOfIt) {
  EXPECT_NO_THROW(requireRecordable(readOverlays("closest,trails,statistics,support")));
  const std::string message =
      thrownMessage<UsageError>([] { requireRecordable(readOverlays("closest,impulses,pairs")); });
  EXPECT_NE(message.find("pairs, impulses would"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(OverlayChoice, HelpHasALineForEach) {
  const std::string help = overlayHelp();
  for (const OverlayDescription& d : overlayDescriptions())
    EXPECT_NE(help.find(std::string(d.name) + " "), std::string::npos) << d.name;
  EXPECT_EQ(std::count(help.begin(), help.end(), '\n'), static_cast<std::ptrdiff_t>(kOverlays));
}

}  // namespace
}  // namespace carom::demos
