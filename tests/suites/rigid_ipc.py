#!/usr/bin/env python3
"""The fixtures of Rigid IPC (Ferguson et al. 2021) as a suite: scenes written anew from their numbers, run by `carom
simulate`, and held against what must come out.

Usage: python3 tests/suites/rigid_ipc.py CAROM [--only NAME]... [--short] [--list] [-o FOLDER] [--json FILE]

Prints a line a fixture: ok or what is not as expected, CPU time of the whole run, of a step, the smallest gap, body-steps
that were frozen, and how ours is another than the original. Exit code 1 where something is not as expected.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[2] / "assets")]

import family_chains
import family_friction
import family_mechanisms
import family_units
from suite_fixture import Run, judged, simulate

# What is left out, and why. Bodies without volume (codimensional nets, cards in nets) are not counted.
LEFT_OUT = {
    "rolling/goemboec": "its 15 778 faces, 0.12 % concave, are known as a mesh only",
    "mechanisms/chain-pulley, scaled up": "138 parts of a roller chain with plays of 1e-5 m, known as meshes only",
    "mechanisms/expanding-lock-box": "eleven printed parts, known as meshes only",
    "gears/gear-box": "bevel teeth, known as a mesh only",
    "blender/200, 1000": "as blender/100, which is over its time as it stands",
    "chain-line/sub4 (64)": "links of 11 000 triangles need more than the 512 pieces that a body may have",
    "piles/armadillos": "scans, known as meshes only",
}


def all_fixtures():
    for family in (family_units, family_friction, family_chains, family_mechanisms):
        yield from family.fixtures()


def chosen(options):
    for fixture in all_fixtures():
        if options.short and not fixture.short:
            continue
        if options.only and not any(word in fixture.name for word in options.only):
            continue
        yield fixture


def run_one(program, fixture, folder):
    """A row of the table."""
    outcome, cpu = simulate(program, fixture, folder)
    row = {"fixture": fixture.name, "expected": fixture.expect, "note": fixture.note, "cpu_s": cpu}
    if not isinstance(outcome, Run):
        return {**row, "wrong": outcome}
    row |= {"wrong": judged(outcome), "ms_a_step": 1e3 * cpu / outcome.steps(), "smallest_gap_m": outcome.facts["smallest_gap_m"],
            "frozen": outcome.frozen(), "energy_growth": outcome.energy_growth() if fixture.energy is not None else None}
    return row


def told(row):
    figures = f"{row['cpu_s']:8.2f}"
    if "ms_a_step" in row:
        figures += f" {row['ms_a_step']:9.3f} {row['smallest_gap_m']:9.2g} {100 * row['frozen']:7.2f}"
    else:
        figures += f" {'':9} {'':9} {'':7}"
    verdict = "ok  " if not row["wrong"] else "NOT "
    words = row["expected"] if not row["wrong"] else f"{row['wrong']} (expected: {row['expected']})"
    return f"{verdict} {row['fixture']:40} {figures}  {words}" + (f"  [{row['note']}]" if row["note"] else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--only", action="append", help="fixtures whose name holds this")
    parser.add_argument("--short", action="store_true", help="the few that belong to the tests")
    parser.add_argument("--list", action="store_true", help="names, and what must come out")
    parser.add_argument("-o", "--out", type=Path, help="where scenes, meshes and results go; else they are removed")
    parser.add_argument("--json", type=Path, help="the table as JSON")
    options = parser.parse_args()
    fixtures = list(chosen(options))
    if not fixtures:
        parser.error("no fixture has such a name; --list tells them")
    if options.list:
        for fixture in fixtures:
            print(f"{fixture.name:40} {fixture.expect}" + (f"  [{fixture.note}]" if fixture.note else ""))
        return 0
    print(f"{'':4} {'fixture':40} {'CPU s':>8} {'ms a step':>9} {'gap m':>9} {'frozen%':>7}  what came out")
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.out or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for fixture in fixtures:
            rows.append(run_one(options.program.resolve(), fixture, folder))
            print(told(rows[-1]), flush=True)
    wrong = [r for r in rows if r["wrong"]]
    if not options.only and not options.short:
        for name, reason in LEFT_OUT.items():
            print(f"--   {name}: {reason}")
    print(f"{len(rows) - len(wrong)} of {len(rows)} fixtures as expected, {sum(r['cpu_s'] for r in rows):.0f} s of CPU")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
