#pragma once
// A budget's result for people: the table of phases, the histogram, the slowest frames, the verdict. Tested
// in tests/demos/report/budget_report_test.cpp.

#include "demos/budget/budget_baseline.h"

namespace carom::demos {

std::string budgetReport(const BudgetResult& result, const BaselineComparison* comparison);

}  // namespace carom::demos
