// stress tunnelling | sweeps | collisions | tiles | landings | pile | energy: what Carom promises of contact,
// asked often. Without options each runs at the size of its bar (from minutes to an hour); small sizes take
// seconds. Exit code 0 when every bar is met, 1 when one is missed, 2 for options it does not understand.

#include "tests/bench/stress/stress.h"

#include <CLI/CLI.hpp>
#include <map>

int main(int argc, char** argv) {
  using namespace carom::bench;
  CLI::App app{"Stress runs of collision and contact: counts against their bars."};
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();

  TunnellingRun tunnelling;
  CLI::App* shots =
      app.add_subcommand("tunnelling", "shots at walls, boxes, posts and cages: how many come through");
  shots->add_option("--trials", tunnelling.trials)->check(CLI::Range(1L, 1000000000L));
  shots->add_option("--first", tunnelling.first, "number of the first trial")
      ->check(CLI::Range(0L, 1000000000000L));
  shots->add_option("--seed", tunnelling.seed);
  shots->add_option("--threads", tunnelling.threads)->check(CLI::Range(1, 256));

  SweepRun sweep;
  CLI::App* sweeps =
      app.add_subcommand("sweeps", "times of impact of hulls turning by up to 360 degrees a step");
  sweeps->add_option("--sweeps", sweep.sweeps)->check(CLI::Range(1L, 1000000000L));
  sweeps->add_option("--first", sweep.first, "number of the first sweep")
      ->check(CLI::Range(0L, 1000000000000L));
  sweeps->add_option("--seed", sweep.seed);
  sweeps->add_option("--threads", sweep.threads)->check(CLI::Range(1, 256));

  CollisionRun collision;
  CLI::App* collisions = app.add_subcommand("collisions", "random collisions: energy, momentum, approach");
  collisions->add_option("--collisions", collision.collisions)->check(CLI::Range(1L, 1000000000L));
  collisions->add_option("--seed", collision.seed);
  collisions->add_option("--threads", collision.threads)->check(CLI::Range(1, 256));

  TilesRun tile;
  CLI::App* tiles = app.add_subcommand("tiles", "bodies gliding over floors of ten thousand flush tiles");
  tiles->add_option("--glides", tile.glides)->check(CLI::Range(1L, 1000000000L));
  tiles->add_option("--first", tile.first, "number of the first glide")
      ->check(CLI::Range(0L, 1000000000000L));
  tiles->add_option("--seed", tile.seed);
  tiles->add_option("--threads", tile.threads)->check(CLI::Range(1, 256));

  LandingsRun landing;
  CLI::App* landings =
      app.add_subcommand("landings", "thin boxes landing without restitution: energy gained");
  landings->add_option("--landings", landing.landings)->check(CLI::Range(1L, 1000000000L));
  landings->add_option("--first", landing.first, "number of the first landing")
      ->check(CLI::Range(0L, 1000000000000L));
  landings->add_option("--aspect", landing.largest_aspect, "the largest")->check(CLI::Range(1.0, 10000.0));
  landings->add_option("--seed", landing.seed);
  landings->add_option("--threads", landing.threads)->check(CLI::Range(1, 256));

  PileRun pile;
  pile.kinds = {PileOf::kHulls, PileOf::kBoxes};
  pile.frictions = {0.5, 0.1, 0.0};
  const std::map<std::string, PileOf> kinds{{"hulls", PileOf::kHulls}, {"boxes", PileOf::kBoxes}};
  CLI::App* piles = app.add_subcommand("pile", "bodies dropped into a bin: overlap, stalls, rest, ms a step");
  piles->add_option("--of", pile.kinds, "hulls, boxes")
      ->transform(CLI::CheckedTransformer(kinds))
      ->default_str("both");
  piles->add_option("--bodies", pile.bodies, "0: 1000 hulls, 5000 boxes")->check(CLI::Range(0, 100000));
  piles->add_option("--friction", pile.frictions)->check(CLI::Range(0.0, 10.0));
  piles->add_option("--seconds", pile.seconds)->check(CLI::Range(0.1, 3600.0));
  piles->add_option("--rate", pile.rate_hz, "steps a second")->check(CLI::Range(10.0, 10000.0));
  piles->add_option("--oracle-every", pile.oracle_every, "steps")->check(CLI::Range(1, 1000000));
  piles->add_option("--seed", pile.seed);
  piles->add_option("--threads", pile.threads, "that step")->check(CLI::Range(1, 256));
  piles->add_option("--peer-steps", pile.peer_steps, "of the settled heap; 0: no comparison")
      ->check(CLI::Range(0, 100000));

  EnergyRun energy;
  CLI::App* energies = app.add_subcommand("energy", "SimBenchmark's elastic scenes");
  energies->add_option("--share", energy.share, "of their whole lengths")->check(CLI::Range(0.001, 1.0));

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  bool met = true;
  if (shots->parsed()) met = runTunnelling(tunnelling);
  if (sweeps->parsed()) met = runSweeps(sweep);
  if (collisions->parsed()) met = runCollisions(collision);
  if (tiles->parsed()) met = runTiles(tile);
  if (landings->parsed()) met = runLandings(landing);
  if (piles->parsed()) met = runPiles(pile);
  if (energies->parsed()) met = runEnergy(energy);
  return met ? 0 : 1;
}
