// physics [ROW...] | --all | --list: the table of closed forms, Carom beside Bullet and ODE on the same
// descriptions. Without rows it runs all but the long ones. Exit code 0 when every goal of ours is met, 1
// when one is missed, 2 for what it does not understand.

#include "tests/bench/physics/physics.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

namespace carom::bench {

namespace {

std::vector<Row> allRows() {
  std::vector<Row> rows;
  for (const auto& part : {impactRows(), frictionRows(), tippingRows(), pileRows(), speedRows()})
    rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

std::vector<Row> chosenRows(const std::vector<std::string>& names, bool long_ones) {
  const std::vector<Row> rows = allRows();
  std::vector<Row> chosen;
  for (const Row& row : rows)
    if (names.empty() ? long_ones || !row.is_long : std::ranges::count(names, row.name) > 0)
      chosen.push_back(row);
  for (const std::string& name : names)
    if (std::ranges::none_of(rows, [&](const Row& row) { return row.name == name; }))
      throw CLI::ValidationError("no row \"" + name + "\"; --list names them all");
  return chosen;
}

// Columns of one width, but for a longer text: names and figures are ASCII.
bool printTable(const std::vector<Row>& rows) {
  constexpr int kName = 20, kFigure = 28, kGoal = 19;
  const std::vector<physics::Simulator> all = simulators();
  std::printf("%-*s", kName, "row");
  for (const physics::Simulator& simulator : all) std::printf("  %-*s", kFigure, simulator.name);
  std::printf("  %-*s  %-6s  closed form\n", kGoal, "goal", "ours");
  int met = 0;
  for (const Row& row : rows) {
    std::printf("%-*s", kName, row.name.c_str());
    bool ours = false;
    for (const physics::Simulator& simulator : all) {
      const Figure figure = row.measure(simulator);
      if (&simulator == &all.front()) ours = figure.met;
      std::printf("  %-*s", kFigure, figure.text.c_str());
      std::fflush(stdout);
    }
    std::printf("  %-*s  %-6s  %s: %s\n", kGoal, row.goal.c_str(), ours ? "met" : "MISSED",
                row.measured.c_str(), row.closed_form.c_str());
    met += ours;
  }
  std::printf("%d of %zu goals met\n", met, rows.size());
  return met == static_cast<int>(rows.size());
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  using namespace carom::bench;
  CLI::App app{"Closed forms of rigid-body physics: Carom, Bullet and ODE on the same descriptions."};
  std::vector<std::string> names;
  bool list = false, all = false;
  app.add_option("rows", names, "rows to run; none: all but the long ones");
  app.add_flag("--list", list, "name the rows and what they measure");
  app.add_flag("--all", all, "the long rows, too");
  try {
    app.parse(argc, argv);
    const std::vector<Row> rows = chosenRows(names, all || list);
    if (!list) return printTable(rows) ? 0 : 1;
    for (const Row& row : rows)
      std::printf("%-20s %s%s\n", row.name.c_str(), row.measured.c_str(), row.is_long ? " (long)" : "");
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
}
