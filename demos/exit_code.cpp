#include "demos/exit_code.h"

#include <csignal>

#include "engine/foundation/contract.h"
#include "renderer/frame_renderer.h"

namespace carom::demos {
namespace {

Failure failure(ExitCode code, const std::string& line) {
  return {static_cast<int>(code), line, false};
}

}  // namespace

Failure failureOf(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const UsageError& error) {
    return failure(ExitCode::kUsage, std::string(error.what()) + "; see carom --help");
  } catch (const InputError& error) {
    return failure(ExitCode::kBadInput, error.what());
  } catch (const CannotWrite& error) {
    return failure(ExitCode::kCannotWrite, error.what());
  } catch (const SimulationInvalid& error) {
    return failure(ExitCode::kInvalid, error.what());
  } catch (const renderer::NoRenderer& error) {
    return failure(ExitCode::kNoRenderer, error.what());
  } catch (const ProcessFailure& error) {
    return error.failure;
  } catch (const PipeClosed& error) {
    return {static_cast<int>(ExitCode::kSignal) + SIGPIPE, error.what(), false};
  } catch (const Interrupted& interrupted) {
    return {static_cast<int>(ExitCode::kSignal) + interrupted.signal,
            "interrupted; what has been written is whole", false};
  } catch (const std::exception& error) {
    return {static_cast<int>(ExitCode::kSignal) + SIGABRT, error.what(), true};
  }
}

}  // namespace carom::demos
