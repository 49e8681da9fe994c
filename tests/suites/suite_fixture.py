"""A fixture: its scene, the meshes it needs and what must come out of it; and how a run of it went."""

import csv
import json
import math
import os
import resource
import subprocess
import time
from dataclasses import dataclass, field

from mesh_shapes import write_obj

DENSITY = 1000


@dataclass
class Fixture:
    name: str
    bodies: list
    seconds: float
    expect: str                                  # In words.
    check: object                                # A function of the run: what is wrong, or None.
    meshes: dict = field(default_factory=dict)   # Name to (points, faces).
    rate: float = 100
    friction: float = 0.0
    gravity: float = 9.8
    note: str = ""                               # How ours is another than the original.
    limit_s: float = 60                          # Of CPU.
    fps: float = 20
    energy: float | None = 1e-3                  # Largest growth, of the largest kinetic energy and m g r; None: moved.
    short: bool = False                          # Belongs to the few that the tests run.

    def scene(self):
        material = {"staticFriction": self.friction, "restitution": 0, "density": DENSITY}
        bodies = []
        for b in self.bodies:
            own = {k: b[k] for k in ("density", "staticFriction") if k in b}
            body = {k: v for k, v in b.items() if k not in own}
            body.setdefault("material", {**material, **own})
            bodies.append(body)
        return {"format": 1, "description": self.name, "gravity": [0, 0, -self.gravity], "rate": self.rate,
                "duration": self.seconds, "bodies": bodies, "cameras": {"main": {"fit": True}}}

    def write(self, folder):
        for name, mesh in self.meshes.items():
            write_obj(folder / "meshes" / f"{name}.obj", mesh)
        path = folder / f"{self.name.replace('/', '-')}.json"
        path.write_text(json.dumps(self.scene(), indent=1))
        return path


def body(name, shape, position, **rest):
    return {"name": name, "shape": shape, "position": list(position), **rest}


def box(*size):
    return {"box": list(size)}


def mesh(name, **rest):
    return {"mesh": {"file": f"meshes/{name}.obj", **rest}}


def hull(points):
    return {"hull": {"points": [list(p) for p in points]}}


def turn(axis, degrees):
    return {"axis": list(axis), "degrees": degrees}


def product(p, q):
    """Of two quaternions w, x, y, z: first q, then p."""
    a, b, c, d = p
    e, f, g, h = q
    return [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e]


def about(axis, degrees):
    half = math.radians(degrees) / 2
    return [math.cos(half)] + [math.sin(half) * x for x in axis]


def floor(size=10.0, **rest):
    """What is a plane of no thickness in the originals has one of a metre here, below."""
    return body("floor", box(size, size, 1), (0, 0, -0.5), static=True, **rest)


class Run:
    """What came out: rows of bodies by name, the audit's, and the facts that simulate prints."""

    def __init__(self, folder, fixture, facts, cpu_s):
        self.fixture, self.facts, self.cpu_s = fixture, facts, cpu_s
        stem = fixture.name.replace("/", "-")
        self.states = {}
        with open(folder / f"{stem}.csv", newline="") as file:
            for row in csv.DictReader(file):
                self.states.setdefault(row["body"], []).append(
                    {k: float(v) for k, v in row.items() if k not in ("body", "mode")})
        with open(folder / f"{stem}.steps.csv", newline="") as file:
            self.audit = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]

        # Rows have centres of mass: where those are in the frames in which shapes are written.
        self.centres = {}
        for b in fixture.bodies:
            s = self.states[b["name"]][0]
            given = b.get("position") or [s["px"], s["py"], s["pz"]]
            off = [s["px"] - given[0], s["py"] - given[1], s["pz"] - given[2]]
            self.centres[b["name"]] = self.rotated(b["name"], off, 0, back=True)

    def centre(self, name, frame=-1):
        """Of mass."""
        s = self.states[name][frame]
        return s["px"], s["py"], s["pz"]

    def place(self, name, frame=-1):
        """Of the origin of the shape's frame."""
        s = self.states[name][frame]
        c = self.rotated(name, self.centres[name], frame)
        return s["px"] - c[0], s["py"] - c[1], s["pz"] - c[2]

    def velocity(self, name, frame=-1):
        s = self.states[name][frame]
        return s["vx"], s["vy"], s["vz"]

    def spin(self, name, frame=-1):
        s = self.states[name][frame]
        return s["wx"], s["wy"], s["wz"]

    def rotated(self, name, vector, frame=-1, back=False):
        s = self.states[name][frame]
        w, x, y, z = s["qw"], s["qx"], s["qy"], s["qz"]
        w = -w if back else w
        u, v = (x, y, z), vector
        c = [u[1] * v[2] - u[2] * v[1] + w * v[0], u[2] * v[0] - u[0] * v[2] + w * v[1], u[0] * v[1] - u[1] * v[0] + w * v[2]]
        return tuple(v[i] + 2 * (u[(i + 1) % 3] * c[(i + 2) % 3] - u[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3))

    def time(self, frame=-1):
        return next(iter(self.states.values()))[frame]["time_s"]

    def frames(self):
        return range(len(next(iter(self.states.values()))))

    def moving(self):
        """The names of the bodies that physics moves; copies of a repeated body as they are called."""
        kept = {b["name"] for b in self.fixture.bodies if not b.get("static") and not b.get("kinematic")}
        return [n for n in self.states if n.split("[")[0] in kept or n in kept]

    def energy_growth(self):
        """How far the energy rises above the lowest so far, over the largest kinetic energy so far; where hardly
        anything moves, over a hundredth of what is fallen by and a millionth of the height over the origin."""
        lowest, kinetic, worst = math.inf, 0.0, 0.0
        spread = max(a["potential_J"] for a in self.audit) - min(a["potential_J"] for a in self.audit)
        for a in self.audit:
            energy = a["kinetic_J"] + a["potential_J"]
            kinetic = max(kinetic, a["kinetic_J"])
            worst = max(worst, (energy - lowest) / max(kinetic, 0.01 * spread, 1e-6 * abs(a["potential_J"]), 1e-12))
            lowest = min(lowest, energy)
        return worst

    def steps(self):
        return int(self.facts["steps"])

    def frozen(self):
        """Body-steps that were frozen, over those of all bodies that move."""
        return self.facts.get("stopped_bodies", 0) / max(1, self.steps() * max(1, len(self.moving())))


def simulate(program, fixture, folder):
    """The facts and what it cost; or a text that says why there are none."""
    path = fixture.write(folder)
    stem = fixture.name.replace("/", "-")
    command = [str(program), "simulate", str(path), "--csv", str(folder / f"{stem}.csv"), "--fps", str(fixture.fps),
               "--audit", str(folder / f"{stem}.steps.csv"), "--threads", "1", "--progress", "json"]

    def bounded():
        os.nice(10)
        resource.setrlimit(resource.RLIMIT_CPU, (int(fixture.limit_s) + 1, int(fixture.limit_s) + 2))

    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, preexec_fn=bounded)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    lines = done.stderr.strip().splitlines()
    if done.returncode < 0 or done.returncode in (152, 137):
        reached = [json.loads(l) for l in lines if l.startswith("{") and l.endswith("}")]
        step = reached[-1].get("step", reached[-1].get("done", "?")) if reached else 0
        return f"over its {fixture.limit_s:g} s of CPU, at step {step} of {fixture.seconds * fixture.rate:.0f}", cpu
    if done.returncode != 0:
        told = [l for l in lines if not l.startswith("{")]
        return f"exit code {done.returncode}: {told[-1] if told else ''}", cpu
    facts = {}
    for word in done.stdout.split():
        key, equals, value = word.partition("=")
        if equals:
            facts[key] = float(value) if value not in ("inf", "nan") else math.inf
    return Run(folder, fixture, facts, cpu), cpu


def judged(run):
    """What is wrong with the run, or None: what holds of every fixture, then its own."""
    if not run.facts["smallest_gap_m"] > 0:
        return f"a gap of {run.facts['smallest_gap_m']:.3g} m"
    if run.fixture.energy is not None and run.energy_growth() > run.fixture.energy:
        return f"energy grows by {run.energy_growth():.2g} of the largest so far"
    return run.fixture.check(run)
