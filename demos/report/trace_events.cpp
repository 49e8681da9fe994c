#include "demos/report/trace_events.h"

#include <algorithm>

#include "demos/format/content_hash.h"
#include "demos/format/json.h"

namespace carom::demos {
namespace {

Json event(const char* kind, const std::string& name, double begin_us) {
  return Json::object({{"ph", kind}, {"name", name}, {"pid", 1}, {"tid", 1}, {"ts", begin_us}});
}

Json nameEvent(const char* what, const std::string& name) {
  Json named = event("M", what, 0.0);
  named.set("args", Json::object({{"name", name}}));
  return named;
}

Json counterEvent(const char* name, double begin_us, double value) {
  Json counter = event("C", name, begin_us);
  counter.set("args", Json::object({{name, value}}));
  return counter;
}

Json frameArguments(const FrameCost& frame, double budget_ms) {
  return Json::object({{"time_s", frame.time_s},
                       {"contacts", frame.contacts},
                       {"pairs", frame.pairs},
                       {"queries", frame.queries},
                       {"events", frame.events},
                       {"over_ms", std::max(frame.total_ms - budget_ms, 0.0)},
                       {"state", hexText(frame.state_hash)}});
}

Json sliceEvent(const PhaseSlice& slice, const Replay& replay, double budget_ms) {
  const bool whole = slice.phase == FramePhase::kOther;
  Json complete = event("X",
                        whole ? "frame " + std::to_string(slice.frame)
                              : kFramePhaseNames[static_cast<std::size_t>(slice.phase)],
                        slice.begin_us);
  complete.set("dur", slice.length_us);
  complete.set("cat", whole ? "frame" : "phase");
  if (whole)
    complete.set("args", frameArguments(replay.frames[static_cast<std::size_t>(slice.frame)], budget_ms));
  return complete;
}

}  // namespace

std::string traceText(const BudgetResult& result) {
  std::string trace;
  trace.append("{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n");
  trace.append(nameEvent("process_name", "carom budget " + result.subject.scene).text() + ",\n");
  trace.append(
      nameEvent("thread_name", "quickest of " + std::to_string(result.replays.size()) + " replays").text());
  for (const Replay& replay : result.replays)
    for (const PhaseSlice& slice : replay.slices) {
      trace.append(",\n" + sliceEvent(slice, replay, result.gate.budget_ms).text());
      if (slice.phase != FramePhase::kOther) continue;
      const FrameCost& frame = replay.frames[static_cast<std::size_t>(slice.frame)];
      trace.append(",\n" + counterEvent("contacts", slice.begin_us, frame.contacts).text());
      trace.append(",\n" + counterEvent("pairs", slice.begin_us, frame.pairs).text());
      trace.append(",\n" + counterEvent("frame ms", slice.begin_us, frame.total_ms).text());
    }
  trace.append("\n]}\n");
  return trace;
}

}  // namespace carom::demos
