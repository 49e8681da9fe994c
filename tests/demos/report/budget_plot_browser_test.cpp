// A budget's picture in headless Chromium. Needs Debian's chromium; without it the test is skipped.
#include <gtest/gtest.h>

#include "demos/report/budget_plot.h"
#include "tests/demos/budget/budget_samples.h"
#include "tests/demos/support/chromium.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

// Every word of a budget's picture can be read: none leaves the picture, none lies over another.
TEST(PlotInChromium, HasRoomForEveryWord) {
  if (!hasChromium()) GTEST_SKIP() << kNoChromium;
  const TemporaryFolder folder;
  BudgetPlot plot;
  plot.title = "carom budget sliding, 160x90, realtime, CPU time";
  plot.frames = sampleReplay(120, [](FrameCost& f) {
                  for (double& phase_ms : f.phase_ms) phase_ms *= 1.012345;
                }).frames;
  plot.budget_ms = 16.7;
  plot.other_ms.assign(120, 12.0);
  plot.other = "/a/folder/of/builds/before/the/change/carom --preset fast";
  plot.notes = {"within: p99 10 ms, budget 16.7 ms, 6.7 ms (40 %) to spare"};
  const fs::path page = folder.file("plot.html", plotPage(plot));
  EXPECT_EQ(notesOf(page, R"js(
    const texts = [...document.querySelectorAll("svg text")], boxes = texts.map(text => text.getBBox());
    const all = document.querySelector("svg").viewBox.baseVal;
    boxes.forEach((a, i) => {
      if (a.x < 0 || a.y < 0 || a.x + a.width > all.width || a.y + a.height > all.height)
        notes.push("outside: " + texts[i].textContent);
      boxes.forEach((b, k) => {
        const across = Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x);
        // A line's box has room above and below its letters.
        const down = Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y);
        if (i < k && across > 0 && down > 0.25 * a.height) notes.push(texts[i].textContent + " over " + texts[k].textContent);
      });
    });
    notes.push("texts " + (texts.length > 20));
  )js"),
            std::vector<std::string>{"texts true"});
  EXPECT_EQ(consoleOf(page), "");
}

}  // namespace
}  // namespace carom::demos
