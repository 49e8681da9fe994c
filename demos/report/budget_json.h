#pragma once
// A budget's result for programs: one JSON object, which is also what `--baseline` reads; one CSV row a
// frame. Tested in tests/demos/report/budget_json_test.cpp.

#include "demos/budget/budget_baseline.h"
#include "demos/format/json.h"

namespace carom::demos {

Json budgetJson(const BudgetResult& result, const BaselineComparison* comparison);
std::string budgetCsv(const BudgetResult& result);

}  // namespace carom::demos
