// `carom figures`: the paper's ten figures as PNG files, drawn from the engine.
#include "demos/command/command.h"

#include <iostream>

#include "demos/figure/figures.h"
#include "demos/format/formatted.h"
#include "demos/system/atomic_file.h"
#include "demos/system/build_info.h"
#include "demos/system/interrupt.h"
#include "renderer/image/png.h"

namespace carom::demos {

ExitCode figures(const FiguresOptions& options) {
  catchInterrupts();
  const PageSize size{options.width, options.height};
  for (int number = 1; number <= kFigures; ++number) {
    throwIfInterrupted();
    const std::string name = formatted("figure_%02d.png", number);
    const renderer::PngText text = {{"Software", "carom " + programVersion()}, {"Title", figureName(number)}};
    AtomicFile file(options.output / name);
    file.write(renderer::encodePng(drawFigure(number, size), text));
    file.commit();
    std::cout << (options.output / name).string() << "  " << figureName(number) << '\n';
  }
  return ExitCode::kOk;
}

}  // namespace carom::demos
