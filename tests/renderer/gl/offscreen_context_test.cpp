#include "renderer/gl/offscreen_context.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

TEST(OffscreenContext, SaysWhatItIs) {
  const std::unique_ptr<OffscreenContext> context = createOffscreenContext(PixelPolicy::kFast);
  EXPECT_NE(context->info().renderer.find("llvmpipe"), std::string::npos) << context->info().renderer;
  EXPECT_NE(context->info().version.find("Core Profile"), std::string::npos) << context->info().version;
  EXPECT_GE(context->info().max_samples, 1);
}

TEST(OffscreenContext, TwoContextsKeepTheirOwnState) {
  const std::unique_ptr<OffscreenContext> one = createOffscreenContext(PixelPolicy::kFast);
  const std::unique_ptr<OffscreenContext> other = createOffscreenContext(PixelPolicy::kFast);
  GLint alignment = 0;
  one->makeCurrent();
  one->gl().PixelStorei(GL_PACK_ALIGNMENT, 1);
  other->makeCurrent();
  other->gl().GetIntegerv(GL_PACK_ALIGNMENT, &alignment);
  EXPECT_EQ(alignment, 4);
  one->makeCurrent();
  one->gl().GetIntegerv(GL_PACK_ALIGNMENT, &alignment);
  EXPECT_EQ(alignment, 1);
}

/// Ends with 6 when no renderer is had with this driver, and why in one line that holds `part`; else with 0.
void refuse(const char* driver, const char* part) {
  setenv("GALLIUM_DRIVER", driver, 1);
  try {
    createOffscreenContext(PixelPolicy::kFast);
  } catch (const NoRenderer& error) {
    const std::string message = error.what();
    std::exit(message.find(part) != std::string::npos && message.find('\n') == std::string::npos ? 6 : 1);
  }
  std::exit(0);
}

// Mesa chooses its driver once a process, so the choice is made in a process of its own.
TEST(OffscreenContextDeathTest, SoftpipeIsRefusedInOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(refuse("softpipe", "softpipe"), testing::ExitedWithCode(6), "");
}

// Mesa itself would crash.
TEST(OffscreenContextDeathTest, AnUnknownDriverIsRefusedInOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(refuse("nonsense", "GALLIUM_DRIVER=nonsense"), testing::ExitedWithCode(6), "");
}

TEST(OffscreenContextDeathTest, AnEmptyDriverIsNone) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(refuse("", ""), testing::ExitedWithCode(0), "");
}

TEST(OffscreenContext, EglIsTheSameRenderer) {
  std::unique_ptr<OffscreenContext> egl;
  try {
    egl = createOffscreenContext(PixelPolicy::kFast, GlBackend::kEgl);
  } catch (const NoRenderer& error) {
    GTEST_SKIP() << error.what();
  }
  const std::unique_ptr<OffscreenContext> osmesa = createOffscreenContext(PixelPolicy::kFast);
  EXPECT_EQ(egl->info().renderer, osmesa->info().renderer);
  EXPECT_EQ(egl->info().max_samples, osmesa->info().max_samples);
}

}  // namespace
}  // namespace carom::renderer
