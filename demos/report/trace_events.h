#pragma once
// The quickest replay as Chrome trace events (the "Trace Event Format"), which Perfetto and chrome://tracing
// open: frames with their phases inside, and counters of contacts, pairs and the frame's time. Tested in
// tests/demos/report/trace_events_test.cpp.

#include <string>

#include "demos/budget/budget_result.h"

namespace carom::demos {

std::string traceText(const BudgetResult& result);

}  // namespace carom::demos
