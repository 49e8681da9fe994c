#include "demos/system/exit_code.h"

#include <csignal>
#include <new>
#include <system_error>

#include "demos/format/printable.h"
#include "engine/foundation/contract.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {
namespace {

Failure failure(ExitCode code, const std::string& line) {
  return {static_cast<int>(code), printable(line), false};
}

Failure bug(const std::string& line) {
  return {static_cast<int>(ExitCode::kSignal) + SIGABRT, printable(line), true};
}

/// What the standard library throws where a thread or another resource of the system is refused.
bool isRefusal(const std::system_error& error) {
  for (const std::errc refusal : {std::errc::resource_unavailable_try_again, std::errc::not_enough_memory,
                                  std::errc::too_many_files_open, std::errc::too_many_files_open_in_system})
    if (error.code() == refusal) return true;
  return false;
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
  } catch (const OutOfResources& error) {
    return failure(ExitCode::kCannotWrite, error.what());
  } catch (const renderer::NoImageMemory& error) {
    return failure(ExitCode::kCannotWrite, error.what());
  } catch (const std::bad_alloc&) {
    return failure(ExitCode::kCannotWrite, "out of memory: the system gives no more");
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
  } catch (const std::system_error& error) {
    if (!isRefusal(error)) return bug(error.what());
    const bool is_thread = error.code() == std::errc::resource_unavailable_try_again;
    return failure(ExitCode::kCannotWrite, std::string("the system gives no more ") +
                                               (is_thread ? "threads: " : "memory or files: ") +
                                               error.what());
  } catch (const std::exception& error) {
    return bug(error.what());
  }
}

}  // namespace carom::demos
