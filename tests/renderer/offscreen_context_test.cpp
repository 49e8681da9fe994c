#include "renderer/offscreen_context.h"

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

// Mesa chooses its driver once a process, so the choice is made in a process of its own.
TEST(OffscreenContextDeathTest, SoftpipeIsRefusedInOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("GALLIUM_DRIVER", "softpipe", 1);
        try {
          createOffscreenContext(PixelPolicy::kFast);
        } catch (const NoRenderer& error) {
          const std::string message = error.what();
          std::exit(message.find("softpipe") != std::string::npos && message.find('\n') == std::string::npos
                        ? 6
                        : 1);
        }
        std::exit(0);
      },
      testing::ExitedWithCode(6), "");
}

}  // namespace
}  // namespace carom::renderer
