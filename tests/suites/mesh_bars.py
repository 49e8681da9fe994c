#!/usr/bin/env python3
"""What concave bodies may cost, and keep: pieces and time of decompositions, energy in a bowl over 20 s, CPU of a step of
rings, chain, net, a plate of 512 pieces at rest, and forty and two hundred random closed meshes dropped together.

Usage: python3 tests/suites/mesh_bars.py CAROM [-o FOLDER]

Prints a line a bar: met or missed, the figure, and what is wanted. Exit code 1 where one is missed.
"""

import argparse
import math
import random
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[2] / "assets")]

from family_chains import nets, rings
from mesh_shapes import bolt, bumpy, gear, grille, torus, write_obj
from suite_checks import all_sides, nothing
from suite_fixture import Fixture, Run, body, floor, mesh, simulate

ASSETS = Path(__file__).resolve().parents[2] / "assets"


def decomposed(program, path):
    """Pieces, and seconds of CPU of the whole check."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(program), "check", str(path)], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    found = re.search(r"in (\d+) convex piece", done.stdout)
    if not found:
        raise RuntimeError(done.stderr.strip())
    return int(found.group(1)), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def decomposition(program, folder):
    for name, shape, most in (("torus of 400 triangles", torus(0.4, 0.1, 20, 10), 170), ("gear", gear(18, 0.1, 0.16), 65),
                              ("thread of 2120 facets", bolt(0.8, 1.0, 0.25, 8, 32, 0.3), 512), ("nut", None, 512),
                              ("bolt", None, 512)):
        path = ASSETS / "meshes" / f"{name}.obj"
        if shape is not None:
            path = folder / f"{name.split()[0]}.obj"
            write_obj(path, shape)
        pieces, seconds = decomposed(program, path)
        yield f"decomposition/{name}", pieces <= most and seconds <= 2, f"{pieces} pieces, {seconds:.2f} s", f"{most} pieces, 2 s"


def run(program, folder, fixture):
    outcome, _ = simulate(program, fixture, folder)
    if not isinstance(outcome, Run):
        raise RuntimeError(outcome)
    return outcome


def step_cost(program, folder, fixture, wanted_ms):
    """CPU of a step, without reading and starting: that of a run of two lengths."""
    long = run(program, folder, fixture)
    fixture.seconds = 2 / fixture.fps
    short = run(program, folder, fixture)
    cost = 1e3 * max(0.0, long.cpu_s - short.cpu_s) / (long.steps() - short.steps())
    wrong = fixture.check(long) if fixture.check is not nothing else None
    gap = long.facts["smallest_gap_m"]
    return cost <= wanted_ms and gap > 0 and not wrong, f"{cost:.3f} ms a step, gap {gap:.2g} m{', ' + wrong if wrong else ''}", \
        f"{wanted_ms:g} ms"


def bowl(program, folder):
    steps = folder / "bowl.csv"
    subprocess.run([str(program), "simulate", "ball-in-a-bowl", "--duration", "20", "-q", "--audit", str(steps)], check=True,
                   capture_output=True)
    rows = [line.split(",") for line in steps.read_text().splitlines()[1:]]
    energies = [float(r[2]) + float(r[3]) for r in rows]
    off = (max(energies) - min(energies)) / max(float(r[2]) for r in rows)
    yield "energy/ball in a bowl, 20 s", off <= 1e-6, f"{off:.2g}", "1e-6"


def plate_at_rest():
    """A plate with holes, of as many pieces as a body may have, or nearly."""
    return Fixture("plate", [floor(4), body("plate", mesh("plate"), (0, 0, 0.0512))], 4, "", nothing, friction=0.5, rate=240,
                   meshes={"plate": grille(21, 0.03, 0.1)})


def dropped():
    shapes = {f"lump {k}": bumpy(100 + k, 0.25, 6 + k % 12, 12 + 2 * (k % 9)) for k in range(40)}
    bodies = [body(f"lump {k}", mesh(f"lump {k}"), (0.7 * (k % 4) - 1.05, 0.7 * (k // 4 % 3) - 0.7, 0.5 + 0.7 * (k // 12)))
              for k in range(40)]
    return Fixture("dropped", [floor(20)] + bodies, 3, "", all_sides(2, 0.0), friction=0.5, rate=60, meshes=shapes, energy=None,
                   limit_s=300)


def many_dropped():
    """Two hundred bodies of 54 pieces in the mean, turned at random."""
    chance = random.Random(1)
    shapes = {f"lump {k}": bumpy(300 + k, 0.25, 8, 14) for k in range(20)}
    bodies = [floor(20)]
    for k in range(200):
        place = (0.6 * (k % 6) - 1.5 + chance.uniform(-0.05, 0.05), 0.6 * (k // 6 % 6) - 1.5 + chance.uniform(-0.05, 0.05),
                 0.5 + 0.6 * (k // 36))
        turned = [chance.gauss(0, 1) for _ in range(4)]
        length = math.hypot(*turned)
        bodies.append(body(f"lump {k}", mesh(f"lump {k % 20}"), place, rotation=[x / length for x in turned]))
    return Fixture("many-dropped", bodies, 4, "", nothing, friction=0.5, rate=60, meshes=shapes, energy=None, limit_s=300)


def bars(program, folder):
    yield from decomposition(program, folder)
    yield from bowl(program, folder)
    chains = {f.name: f for f in rings()}
    yield ("step/two linked rings", *step_cost(program, folder, Fixture(
        "two-rings", chains["chain/3-links"].bodies[:2], 3, "", nothing, meshes=chains["chain/3-links"].meshes), 2))
    yield ("step/chain of ten", *step_cost(program, folder, chains["chain/10-links"], 5))
    yield ("step/net of 24 links", *step_cost(program, folder, next(nets()), 10))
    yield ("step/plate of many pieces at rest", *step_cost(program, folder, plate_at_rest(), 0.2))
    yield ("step/forty random meshes dropped, 60 Hz", *step_cost(program, folder, dropped(), 1e3 / 60))
    yield ("step/two hundred meshes dropped, 60 Hz", *step_cost(program, folder, many_dropped(), 1e3 / 60))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("-o", "--out", type=Path, help="where scenes and results go; else they are removed")
    options = parser.parse_args()
    missed = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.out or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for name, met, figure, wanted in bars(options.program.resolve(), folder):
            missed += not met
            print(f"{'met   ' if met else 'MISSED'} {name:42} {figure}  (wanted: {wanted})", flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
