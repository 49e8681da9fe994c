#!/usr/bin/env python3
"""Makes the scenes that stand beside a closed form in assets/scenes/, and their meshes, the same bytes on every run.

Usage: python3 assets/make_theory.py        (needs nothing but Python 3)

Each function below is one scene; what theory says of it opens the file and stands in its caption, and is tested in
tests/demos/scene/theory_scenes_test.cpp.
"""

import math

from make_scenes import BLUE, FOLDER, GRAVITY, GREEN, ORANGE, PINK, RED, SKY, SLATE, YELLOW, FLOOR
from make_scenes import body, floor, main_camera, turn, write
from make_mechanisms import mesh, revolved, write_mesh

SLATE_FLOOR = {**FLOOR, "color": "#7f8a94"}
OAK, DARK_OAK = "#c49a6c", "#8a6038"


def part(shape, position=(0, 0, 0), rotation=None):
    placed = {"shape": shape, "position": list(position)}
    if rotation:
        placed["rotation"] = rotation
    return placed


def loop_the_loop():
    """Beads at the bottom of three rings, with 0.85, 0.97 and 1.03 of the speed that takes them round."""
    inner, bead, sides = 1.0, 0.15, 144
    way = inner * math.cos(math.pi / sides) - bead - 0.0005
    needed = math.sqrt(5 * GRAVITY * way)
    write_mesh("drum.obj", *revolved([(inner, -0.2), (inner + 0.05, -0.2), (inner + 0.05, 0.2), (inner, 0.2)], sides))
    high = 1.35
    bodies = [floor()]
    for k, (factor, color) in enumerate(((0.85, RED), (0.97, ORANGE), (1.03, GREEN))):
        x = 2.45 * (k - 1)
        bodies.append(body(f"ring {factor}", mesh("drum.obj"), [x, 0, high], rotation=turn([1, 0, 0], 90), static=True,
                           material="steel", color="#aab4bd"))
        bodies.append(body(f"stand {factor}", {"box": [0.5, 0.3, 0.27]}, [x, 0, 0.136], static=True, material="wood",
                           color=DARK_OAK))
        bodies.append(body(f"bead {factor}", {"sphere": {"radius": bead}}, [x, 0, high - way], locked=["y"],
                           linearVelocity=[factor * needed, 0, 0], material="steel", color=color))
    kinetic = 2500 * 4 / 3 * math.pi * bead ** 3 / 2 * needed ** 2 * (0.85 ** 2 + 0.97 ** 2 + 1.03 ** 2)
    potential = 3 * 2500 * 4 / 3 * math.pi * bead ** 3 * GRAVITY * (high - way)
    write("loop-the-loop",
          "A bead that slides without friction goes round a ring of radius R if it has v^2 = 5 g R at the bottom (R to "
          "its middle). With 0.85 and 0.97 of that speed it leaves the ring before the top, with 1.03 it never does. "
          "Beads and rings are elastic, so the sum of energies stays.",
          "beads with a little too little and with enough speed to go round a ring",
          {"floor": SLATE_FLOOR, "wood": {"staticFriction": 0.5, "surface": "wood"},
           "steel": {"staticFriction": 0, "restitution": 1, "density": 2500, "surface": "steel"}},
          bodies, main_camera([0.9, -8.6, 2.2], [0, 0, 1.02], 28), 6, FOLDER,
          group="accuracy beside theory",
          lookFor="The red and the orange bead fall from the ring before its top, the green one goes round for ever.",
          caption="needed: v = √(5gR) = {=sqrt(5*g*R)} m/s; they have 0.85, 0.97, 1.03 of it   "
                  "energy kept: {=100*energy/E0:4} %",
          set={"g": GRAVITY, "R": way, "E0": kinetic + potential})


def flips(moments, spin):
    """Half the period of a torque-free body between flips about its middle axis, by Runge and Kutta."""
    def rates(w):
        a, b, c = moments
        return ((b - c) / a * w[1] * w[2], (c - a) / b * w[2] * w[0], (a - b) / c * w[0] * w[1])

    w, dt, t, crossed = list(spin), 1e-4, 0.0, []
    while len(crossed) < 2 and t < 100:
        before = w[1]
        k1 = rates(w)
        k2 = rates([x + dt / 2 * k for x, k in zip(w, k1)])
        k3 = rates([x + dt / 2 * k for x, k in zip(w, k2)])
        k4 = rates([x + dt * k for x, k in zip(w, k3)])
        w = [x + dt / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(w, k1, k2, k3, k4)]
        t += dt
        if before * w[1] <= 0:
            crossed.append(t)
    return crossed


def dzhanibekov():
    """A T-shaped handle and a book that spin about their middle axes, without weight."""
    bar, stem = [1.5, 0.22, 0.22], [0.22, 0.22, 0.75]
    density, spin, tilt = 7800, 7.0, 0.02
    masses = [density * math.prod(bar), density * math.prod(stem)]
    drop = (stem[2] + bar[2]) / 2
    below = masses[1] * drop / sum(masses)  # the centre of mass under the bar's middle

    def moments(size, mass, z):
        x, y, h = size
        return [mass * ((y * y + h * h) / 12 + z * z), mass * ((x * x + h * h) / 12 + z * z), mass * (x * x + y * y) / 12]

    both = [moments(bar, masses[0], below), moments(stem, masses[1], drop - below)]
    about = [a + b for a, b in zip(*both)]  # x along the bar, z along the stem
    a, c, b = sorted(about)
    order = sorted(range(3), key=lambda k: about[k])
    assert order[1] == 2, "the stem is the middle axis"
    first, second = flips((about[order[0]], about[2], about[order[2]]),
                          (spin * math.sin(tilt) if order[0] == 0 else 0.0, spin * math.cos(tilt),
                           spin * math.sin(tilt) if order[2] == 0 else 0.0))
    handle = {"compound": [part({"box": bar}), part({"box": stem}, [0, 0, -drop])]}
    w = [spin * math.sin(tilt), 0, spin * math.cos(tilt)]
    energy = 0.5 * (about[0] * w[0] ** 2 + about[2] * w[2] ** 2)
    bodies = [floor(), body("handle", handle, [0, 0, 1.62 + below], angularVelocity=w, material="steel", color=ORANGE)]
    write("dzhanibekov",
          "Without weight a body that spins about its middle axis turns over, again and again, at equal times "
          "(Dzhanibekov's handle). Euler's equations, solved apart from the engine, say when: the stem crosses the "
          f"level at {first:.3f} s and then every {second - first:.3f} s. Energy stays.",
          "a T-shaped handle that spins without weight turns over at regular times",
          {"floor": SLATE_FLOOR, "steel": {"staticFriction": 0.3, "density": density, "surface": "steel"}},
          bodies, main_camera([1.3, -4.8, 2.2], [0, 0, 1.33], 29), 3 * (second - first) + first + 0.3, FOLDER,
          gravity=[0, 0, 0], group="accuracy beside theory",
          lookFor="The stem points down, turns over within a moment, points up, and comes back: always "
                  "after the same time.",
          caption="flips at {=t1:2} s and every {=T:2} s (Euler)   t = {=time:2} s, stem {=180-[handle.tilt]:0}° from up   "
                  "energy {=100*energy/E0:4} %",
          set={"t1": first, "T": second - first, "E0": energy})


def steady_top():
    """Two tops without friction, started as they precess steadily: the slow of the two solutions."""
    sides, wide, thick, tip, low, tilt = 8, 0.6, 0.18, 0.03, 0.5, 25.0
    rim = [[wide * math.cos(2 * math.pi * k / sides), wide * math.sin(2 * math.pi * k / sides), z]
           for k in range(sides) for z in (-thick / 2, thick / 2)]
    stem, middle = low - thick / 2, (low + thick / 2) / 2
    top = {"compound": [part({"hull": {"points": rim}}), part({"capsule": {"radius": tip, "length": stem}}, [0, 0, -middle]),
                        part({"capsule": {"radius": tip, "length": stem}}, [0, 0, middle])]}
    disc = sides / 2 * wide ** 2 * math.sin(2 * math.pi / sides) * thick  # volumes stand for masses
    rod = math.pi * tip ** 2 * (stem + 4 / 3 * tip)
    i3 = disc * wide ** 2 / 6 * (2 + math.cos(2 * math.pi / sides)) + rod * tip ** 2
    i1 = (disc * (wide ** 2 / 12 * (2 + math.cos(2 * math.pi / sides)) + thick ** 2 / 12)
          + 2 * rod * (stem ** 2 / 12 + middle ** 2))
    a = math.radians(tilt)
    bodies, turning = [floor()], {}
    for name, x, spin, color in (("slow", -0.95, 14.0, ORANGE), ("fast", 0.95, 24.0, SKY)):
        half = i3 * spin / (2 * i1 * math.cos(a))
        turning[name] = half - math.sqrt(half ** 2 - (disc + 2 * rod) * GRAVITY * low / (i1 * math.cos(a)))
        along = spin - turning[name] * math.cos(a)
        bodies.append(body(f"{name} top", top, [x, 0, low * math.cos(a) + tip + 0.0003], rotation=turn([0, 1, 0], tilt),
                           angularVelocity=[along * math.sin(a), 0, turning[name] + along * math.cos(a)],
                           material="brass", color=color))

    def measured(name):
        return f"{{=[{name} top.wz]-sqrt([{name} top.wx]^2+[{name} top.wy]^2)/tan([{name} top.tilt]):3}}"

    write("steady-top",
          "Two tops on ice, at 14 and 24 rad/s about their axes, started as they precess steadily: the rate W solves "
          "I1 W^2 cos a - I3 w W + m g l = 0, and the tilt a stays. The faster top goes round more slowly.",
          "two tops precess steadily, the faster one more slowly",
          {"floor": SLATE_FLOOR | {"staticFriction": 0}, "brass": {"staticFriction": 0, "density": 8500}},
          bodies, main_camera([0.35, -4.3, 2.35], [0, 0, 0.52], 31), 8, FOLDER, 480, group="accuracy beside theory",
          lookFor="Both keep their tilt; the top that spins faster takes longer to go round.",
          caption=f"precession: theory {{=W1:3}} and {{=W2:3}} rad/s   measured {measured('slow')} and {measured('fast')}"
                  "   tilt 25°, {body:slow top.tilt:2}°",
          set={"W1": turning["slow"], "W2": turning["fast"]})


def track_of(points, thick, half_wide):
    """Quads under a way of points, for something that slides on it."""
    parts = []
    for (x0, z0), (x1, z1) in zip(points, points[1:]):
        long = math.hypot(x1 - x0, z1 - z0)
        down = ((z1 - z0) / long * thick, -(x1 - x0) / long * thick)
        quad = [[x + f * down[0], y, z + f * down[1]] for y in (-half_wide, half_wide) for f in (0, 1)
                for x, z in ((x0, z0), (x1, z1))]
        parts.append(part({"hull": {"points": quad}}))
    return parts


def under(points, radius):
    """The way that a ball's lowest point takes while its middle goes along the points."""
    below = []
    for k, (x, z) in enumerate(points):
        (x0, z0), (x1, z1) = points[max(k - 1, 0)], points[min(k + 1, len(points) - 1)]
        long = math.hypot(x1 - x0, z1 - z0)
        below.append((x + radius * (z1 - z0) / long, z - radius * (x1 - x0) / long))
    return below


def brachistochrone():
    """Three beads without friction, from one height to one place: straight, along a cycloid, along a deeper curve."""
    a, bead, pieces = 4.0, 0.3, 96
    width, drop = math.pi * a, 2 * a
    ways = {"straight": [(0.0, 0.0), (width, -drop)],
            "cycloid": [(a * (t - math.sin(t)), -a * (1 - math.cos(t))) for t in
                        (math.pi * k / pieces for k in range(pieces + 1))],
            "deep": [(width * (1 - math.cos(t) ** (2 / 3)), -drop * math.sin(t) ** (2 / 3)) for t in
                     (math.pi / 2 * k / pieces for k in range(pieces + 1))]}
    times = {name: 0.0 for name in ways}
    for name, way in ways.items():  # exact on each straight piece
        speed = 0.0
        for (x0, z0), (x1, z1) in zip(way, way[1:]):
            after = math.sqrt(-2 * GRAVITY * z1)
            times[name] += 2 * math.hypot(x1 - x0, z1 - z0) / (speed + after)
            speed = after
    bodies, top = [floor()], drop + bead + 0.6
    for lane, (name, color) in enumerate((("straight", RED), ("cycloid", GREEN), ("deep", BLUE))):
        y, x = 1.5 * (1 - lane), -width / 2
        bodies.append(body(f"{name} track", {"compound": track_of(under(ways[name], bead + 0.0005), 0.2, 0.5)}, [x, y, top],
                           static=True, material="steel", color="#c9d0d6"))
        bodies.append(body(f"{name} end", {"compound": [
            part({"box": [2.2, 1, 0.2]}, [1.1, 0, -bead - 0.1005]), part({"box": [0.3, 1, 0.9]}, [2.2, 0, -bead + 0.45])]},
            [width / 2, y, bead + 0.6], static=True, material="rubber", color="#5b5f66"))
        bodies.append(body(name, {"sphere": {"radius": bead}}, [x, y, top], locked=["y"], material="bead", color=color))
    write("brachistochrone",
          "Without friction the quickest way down is no straight line but a cycloid: T = pi sqrt(a/g), here "
          f"{times['cycloid']:.3f} s, against {times['straight']:.3f} s straight and {times['deep']:.3f} s along a "
          "deeper curve, which is steeper at first and longer.",
          "beads race down a straight line, a cycloid and a deeper curve; the cycloid wins",
          {"floor": SLATE_FLOOR, "steel": {"staticFriction": 0, "restitution": 1, "surface": "steel"}, "rubber": {"staticFriction": 0.9, "surface": "rubber"},
           "bead": {"staticFriction": 0, "density": 2500}},
          bodies, main_camera([7.0, -20.5, 8.8], [0.75, 0, 3.6], 33), 3.4, FOLDER, group="accuracy beside theory",
          lookFor="The green bead on the cycloid arrives first, though its way is longer than the red one's.",
          caption="theory: straight {=t1:2} s, cycloid π√(a/g) = {=t2:2} s, deeper {=t3:2} s   t = {=time:2} s   "
                  "gone: {=min(100, 50+100*[straight.x]/w):0}, {=min(100, 50+100*[cycloid.x]/w):0}, "
                  "{=min(100, 50+100*[deep.x]/w):0} %",
          set={"t1": times["straight"], "t2": times["cycloid"], "t3": times["deep"], "w": width})


def stand(name, y, high):
    return body(name, {"hull": {"points": [[sx, sy, 0] for sx in (-0.35, 0.35) for sy in (-0.3, 0.3)]
                                + [[0, sy, high] for sy in (-0.3, 0.3)]}},
                [0, y, 0], static=True, material="concrete", color="#9a9c9e")


def seesaw():
    """Beams that turn about their middles: 10 kg at 1.3 m against 20 kg, and 21 kg, at 0.65 m; and a jump."""
    high, long, thick, size = 0.75, 3.2, 0.1, 0.36
    hinge = {"locked": ["x", "y", "z", "turnX", "turnZ"]}
    bodies = [floor()]
    for name, y, heavy, color in (("even", 1.35, 20, GREEN), ("uneven", 0.1, 21, ORANGE)):
        z = high + thick / 2 + size / 2 + 0.0002
        bodies.append(stand(f"{name} stand", y, high - thick / 2 - 0.006))
        bodies.append(body(f"{name} beam", {"box": [long, 0.5, thick]}, [0, y, high], material="wood", color=OAK, **hinge))
        bodies.append(body(f"{name} light", {"box": [size, size, size]}, [1.3, y, z], material="wood", mass=10, color=SKY))
        bodies.append(body(f"{name} heavy", {"box": [size, size, size]}, [-0.65, y, z], material="wood", mass=heavy,
                           color=color))
    y, degrees = -1.35, 22.0
    a, up = math.radians(degrees), thick / 2 + size / 2 + 0.0005
    bodies.append(stand("jump stand", y, high - thick / 2 - 0.03))
    bodies.append(body("jump beam", {"box": [long, 0.5, thick]}, [0, y, high], rotation=turn([0, 1, 0], degrees),
                       material="wood", color=OAK, **hinge))
    bodies.append(body("jumper", {"box": [size, size, size]},
                       [1.3 * math.cos(a) + up * math.sin(a), y, high - 1.3 * math.sin(a) + up * math.cos(a)],
                       rotation=turn([0, 1, 0], degrees), material="wood", mass=10, color=PINK))
    bodies.append(body("weight", {"box": [0.45, 0.45, 0.45]}, [-1.2, y, 2.9], material="wood", mass=24, color=SLATE))
    write("seesaw",
          "The law of the lever: 10 kg at 1.3 m hold 20 kg at 0.65 m, on a beam that turns about its middle; 21 kg tip "
          "it. On the third beam a weight that falls makes another one jump.",
          "beams in balance, just out of it, and far from it",
          {"floor": FLOOR, "concrete": {"staticFriction": 0.5, "surface": "concrete"}, "wood": {"staticFriction": 0.6, "density": 500, "surface": "wood"}},
          bodies, main_camera([1.7, -6.8, 3.2], [0.1, 0, 0.9], 34), 4, FOLDER, group="machines",
          lookFor="The far beam stays level, the middle one, 5 % out of balance, tips, the near one throws "
                  "its load up.",
          caption="10 kg · 1.30 m = 20 kg · 0.65 m: tilt {body:even beam.tilt:3}°   21 kg: {body:uneven beam.tilt:1}°   "
                  "the jumper: {body:jumper.z:2} m")


def archimedes():
    """Five rafts of one size and five densities, let go a little above where they float."""
    long, high, water = 1.1, 0.5, 1.0
    floats = ((150, YELLOW, "cork"), (350, ORANGE, "pine"), (550, RED, "oak"), (750, PINK, "ash"), (920, SKY, "ice"))
    bodies = [floor(), body("plinth", {"box": [8.6, 2.6, 0.2]}, [0, 0, 0.1], static=True, material="concrete",
                            color="#8d9196")]
    materials = {"floor": FLOOR, "concrete": {"staticFriction": 0.5, "surface": "concrete"}}
    shown = []
    for k, (density, color, name) in enumerate(floats):
        draft = density / 1000 * high
        x = 1.6 * (k - 2)
        materials[name] = {"staticFriction": 0.4, "density": density}
        bodies.append(body(name, {"box": [long, long, high]}, [x, 0, 0.2 + water + high / 2 - draft + 0.22], material=name,
                           color=color))
        shown.append((name, draft))
    surface = 0.2 + water
    measured = ", ".join(f"{{={surface + high / 2}-[{name}.z]:3}}" for name, _ in shown)
    theory = ", ".join(f"{draft:.3f}" for _, draft in shown)
    write("archimedes",
          "Blocks of one size, 15 % to 92 % as dense as water, are let go above where they float, bob and come to rest "
          "at Archimedes' drafts: density over that of water times their height of 0.5 m.",
          "five blocks bob and come to rest at Archimedes' drafts",
          materials, bodies, main_camera([1.2, -8.8, 3.6], [0, 0, 0.62], 33), 6, FOLDER, 120, group="air and water",
          lookFor="Each block comes to rest with just the part of its height under water that its density says.",
          caption=f"draft = ρ/ρw · h: {theory} m   measured {measured}",
          air={}, fluids=[{"name": "tank", "box": {"min": [-4.2, -1.2, 0.2], "max": [4.2, 1.2, surface]}, "addedMass": 0.5,
                           "linearDrag": 0.7, "color": "#6cc2d6"}])


def main():
    for scene in (loop_the_loop, dzhanibekov, steady_top, brachistochrone, seesaw, archimedes):
        scene()


if __name__ == "__main__":
    main()
