"""Features against features, Erleben's degenerate cases, free rotation, thin walls at high speed, many coplanar
triangles, scripted bodies: what tests one thing each."""

import math

from suite_checks import all_sides, ends, every, follows, keeps_energy, on_time, rests, sides, stays, turns, work_only
from suite_fixture import Fixture, about, body, box, floor, hull, mesh, product, turn
from mesh_shapes import bumpy, gear, plate, revolved, rectangle

PYRAMID = [(-0.5, -0.5, 0.0), (0.5, -0.5, 0.0), (0.0, 0.5, 0.0), (0.0, 0.0, 0.8)]
CROSSED = [(-0.5, 0, 0.35), (0.5, 0, 0.35), (0, -0.5, -0.35), (0, 0.5, -0.35)]  # Edges along x above, y below.
SPIKE = [(-0.25, -0.25, 0), (0.25, -0.25, 0), (0.25, 0.25, 0), (-0.25, 0.25, 0), (0, 0, 2)]
WEDGE = [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0), (0, -0.5, 2), (0, 0.5, 2)]
UPSIDE_DOWN = turn((1, 0, 0), 180)


def on_top(run):
    """While it is right above the other, it is above it."""
    for f in run.frames():
        x, y, z = run.place("upper", f)
        if math.hypot(x, y) < 0.05 and z < run.place("lower")[2] + 0.1:
            return f"upper is within lower at {run.time(f):.2f} s"
    return None


def pair(name, upper, lower, gap, seconds=2.5, **rest):
    """One falls on another that is fixed."""
    return Fixture(f"unit-tests/{name}", [
        body("lower", lower[0], (0, 0, 0), static=True, **lower[1]),
        body("upper", upper[0], (0, 0, gap), **upper[1])], seconds, "touches, then tips off; never passes", on_top, **rest)


def features():
    down = {"rotation": UPSIDE_DOWN}
    quarter = {"rotation": turn((0, 0, 1), 90)}
    cube, tumbled = box(1, 1, 1), {"rotation": product(about((0, 1, 0), 50), about((0, 0, 1), 45))}
    yield pair("vertex-face", (hull(PYRAMID), down), (cube, {}), 1.5, short=True)
    yield pair("face-vertex", (cube, {}), (hull(PYRAMID), {}), 1.4)
    yield pair("edge-edge", (hull(CROSSED), {}), (hull(CROSSED), {}), 0.9, short=True)
    yield pair("edge-edge-parallel", (hull(CROSSED), quarter), (hull(CROSSED), {}), 0.9)
    yield pair("vertex-vertex", (hull(PYRAMID), down), (hull(PYRAMID), {}), 1.75)
    yield Fixture("unit-tests/tet-corner", [floor(), body("upper", cube, (0, 0, 1.5), **tumbled)], 5,
                  "falls on a corner, ends on a face", every(rests(), ends("upper", 2, 0.5, 0.502)), friction=0.5)
    yield Fixture("unit-tests/5-cubes", [floor()] + [body(f"cube {k}", cube, (0, 0, 1 + 2 * k)) for k in range(5)], 10,
                  "all five rest in a stack", every(rests(), *(ends(f"cube {k}", 2, 0.5 + k, 0.51 + k) for k in range(5))),
                  short=True)
    yield Fixture("unit-tests/cube-falling-on-edge", [
        floor(), body("wide", box(2, 1, 1), (0, 0, 2), rotation=turn((0, 1, 0), 30)),
        body("cube", cube, (0, 0, 4), rotation=turn((0, 1, 0), -30))], 10,
        "fall on edges, slide apart without friction; none sinks", all_sides(2, 0.45, 5))
    yield Fixture("unit-tests/large-mass-ratio", [
        floor(20), body("small", cube, (0, 0, 0.6)), body("large", box(10, 10, 10), (0, 0, 6.5))], 10,
        "a cube of 10 m rests on one of 1 m", every(rests(speed=1e-3), ends("large", 2, 5.99, 6.02)))


def erleben():
    crack = plate([(-3, -1), (3, -1), (3, 1), (0.3, 1), (0.0, -0.6), (-0.3, 1), (-3, 1)], 4)
    hole = plate(rectangle(6, 6), 1, [rectangle(0.3, 0.3)])
    upright = {"rotation": turn((1, 0, 0), 90)}
    spike, wedge, ground = hull(SPIKE), hull(WEDGE), floor()
    still = lambda name, shape, z, **rest: body(name, shape, (0, 0, z), static=True, **rest)
    first = lambda shape, gap, **rest: body("upper", shape, (0, 0, 4 + gap), rotation=UPSIDE_DOWN, **rest)
    tip = every(on_top)
    yield Fixture("erleben/spikes", [still("lower", spike, 0), first(spike, 0.0001)], 1.25,
                  "tip on tip: never one in the other", tip)
    yield Fixture("erleben/wedges", [still("lower", wedge, 0), first(wedge, 0.0001)], 1.25, "edge on edge", tip)
    yield Fixture("erleben/spike-and-wedge", [still("lower", wedge, 0), first(spike, 0.0001)], 1.25, "tip on edge", tip)
    for name, shape in (("spike", spike), ("wedge", wedge)):
        yield Fixture(f"erleben/sliding-{name}", [
            ground, body("upper", shape, (-4.5, 0, 2.0012), rotation=UPSIDE_DOWN, linearVelocity=[9, 0, 0])], 0.9,
            "slides on its tip without snagging on an edge", every(
                follows("upper", 0, lambda t: 9 * t - 4.5, 1e-3), sides("upper", 2, 1.99, 2.01)), gravity=0, short=True)
    yield Fixture("erleben/spike-in-hole", [
        still("block", mesh("hole"), -0.5), body("upper", spike, (0.05, 0.02, 2.3), rotation=UPSIDE_DOWN)], 2,
        "stands in the hole, neither through nor out", every(sides("upper", 2, 0.7, 2.4), ends("upper", 2, 0.75, 0.85)), friction=0.3,
        meshes={"hole": hole}, note="own hole of 0.3 m in a plate of 1 m")
    for name, shape, force in (("spike", spike, 1), ("wedge", wedge, 10)):
        yield Fixture(f"erleben/{name}-in-crack", [
            still("block", mesh("crack"), -1, **upright), body("upper", shape, (0, 0, 2.001), rotation=UPSIDE_DOWN,
                                                               linearVelocity=[1, 0, 0], force=[force, 0, 0])], 2,
            "goes into the crack and stays above its bottom", sides("upper", 2, 0.3), energy=None,
            meshes={"crack": crack}, note="own crack, 1.6 m deep", friction=0.0)
    yield Fixture("erleben/cliff-edges", [
        still("cliff", box(4, 4, 1), -0.5), body("upper", box(1, 1, 1), (2.1, 0, 0.55))], 2.5,
        "tips over the cliff's edge, past it and down", ends("upper", 2, most=-3))
    tiles = [still(f"tile {i} {j}", box(1, 1, 1), -0.5) for i in range(6) for j in range(2)]
    for k, t in enumerate(tiles):
        t["position"] = [-2.5 + k // 2, -0.5 + k % 2, -0.5]
    yield Fixture("erleben/internal-edges", tiles + [
        body("upper", box(0.5, 0.5, 0.5), (-2.5, 0.1, 0.2508), linearVelocity=[2, 0, 0])], 2,
        "slides over the seams at its speed", every(follows("upper", 0, lambda t: 2 * t - 2.5, 1e-4), sides("upper", 2, 0.25, 0.252)),
        note="twelve boxes side by side, not one with split faces")


def rotation():
    wing = plate([(-1.0, 0.35), (-0.9, 0.25), (-0.35, 0.12), (-0.3, -0.3), (0.3, -0.3), (0.35, 0.12), (0.9, 0.25), (1.0, 0.35),
                  (0.9, 0.5), (0.3, 0.3), (-0.3, 0.3), (-0.9, 0.5)], 0.2)
    free = lambda name, shape, spin, seconds, check, expect, **rest: Fixture(
        f"rotation/{name}", [body("body", shape, (0, 0, 0), angularVelocity=spin, **rest.pop("of", {}))], seconds, expect,
        check, gravity=0, **rest)

    def flips(run):
        axis = [run.rotated("body", (0, 1, 0), f)[2] for f in run.frames()]
        turned = sum(1 for a, b in zip(axis, axis[1:]) if a * b < 0)
        return None if turned >= 2 and max(axis) > 0.9 > -0.9 > min(axis) else f"turned over {turned} times"

    ball = lambda a, b, c: hull([(a * x, b * y, c * z) for x, y, z in round_points(12, 24)])
    yield free("dzhanibekov", mesh("wing-nut"), [0, 0, 3 * math.pi], 20, every(keeps_energy(1e-9), flips),
               "turns over again and again, energy stays", meshes={"wing-nut": wing}, fps=60,
               of={"rotation": product(about((0, 1, 0), -3), about((1, 0, 0), 90))}, short=True,
               note="three times the spin, twice the time")
    for axis, spin in (("major", [math.pi, 0, 0]), ("intermediate", [0, math.pi, 0]), ("minor", [0, 0, math.pi])):
        yield free(f"rotating-ellipsoid-{axis}", ball(1, 0.5, 0.25), spin, 10, keeps_energy(1e-9), "energy stays")
    yield free("rotating-sphere", ball(0.5, 0.5, 0.5), [0, 0, math.pi], 10, keeps_energy(1e-9), "energy stays")
    yield free("rotating-cube", box(1, 1, 1), [0, 0, 2 * math.pi], 10,
               every(keeps_energy(1e-9), turns("body", 2, 2 * math.pi, 1e-9)), "turns at its rate for ever")
    wheel = gear(12, 0.17, 0.3)

    def spins_up(run):
        ratio = run.spin("body")[2] / run.spin("body", len(run.frames()) // 2)[2]
        expected = run.time() / run.time(len(run.frames()) // 2)
        return None if abs(ratio / expected - 1) < 1e-9 else f"spin grows {ratio / expected:.8f} times as theory says"

    yield Fixture("rotation/torque-test", [body("body", mesh("gear"), (0, 0, 0), torque=[0, 0, 90], density=1)], 5,
                  "spin grows in proportion to time", every(spins_up, work_only()), gravity=0, energy=None,
                  meshes={"gear": wheel})


def round_points(rings, sides):
    yield (0, 0, 1)
    yield (0, 0, -1)
    for i in range(1, rings):
        for k in range(sides):
            t, p = math.pi * i / rings, 2 * math.pi * k / sides
            yield (math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t))


def tunnels():
    wall = 0.02
    cube = body("cube", box(1, 1, 1), (0, -4.5, 0), linearVelocity=[0, 100, 0])
    free = {**cube, "locked": ["turnX", "turnY", "turnZ"]}
    side = lambda name, size, place: body(name, box(*size), place, static=True)
    off = 0.5 + wall / 2
    lanes = {
        "2-walls": (0.001, ((0, 0, -1), (0, 0, 1))), "2-walls-8K": (0.001, ((0, 0, -1), (0, 0, 1))),
        "3-walls": (0.0001, ((-1, 0, 0), (1, 0, 0), (0, 0, -1))),
        "4-walls": (0.0001, ((-1, 0, 0), (1, 0, 0), (0, 0, -1), (0, 0, 1)))}
    yield Fixture("unit-tests/tunneling", [
        side("wall", (wall, 10, 10), (0, 0, 0)),
        body("cube", box(1, 1, 1), (-5, 0, 0), linearVelocity=[1000, 0, 0], rotation=product(
            about((0, 0, 1), 53), product(about((0, 1, 0), 247), about((1, 0, 0), 32))))], 1,
        "stops at the wall or bounces off at 1000 m/s", sides("cube", 0, most=-0.4), gravity=0,
        note="walls are 2 cm thick", short=True)
    for name, (clear, walls) in lanes.items():
        bodies = []
        for k, w in enumerate(walls):
            size = [wall if w[i] else (10 if i == 1 else 1.1) for i in range(3)]
            bodies.append(side(f"wall {k}", size, [w[i] * (off + clear) for i in range(3)]))
        if name == "2-walls-8K":
            bodies = [side(f"wall {k} tile {j}", (10, 0.5, wall), (0, -4.75 + 0.5 * j, w[2] * (off + clear)))
                      for k, w in enumerate(walls) for j in range(20)]
        yield Fixture(f"tunnel/{name}", bodies + [free], 0.09,
                      f"glides between walls {1000 * clear:g} mm away at 100 m/s", every(
                          follows("cube", 1, lambda t: 100 * t - 4.5, 1e-4), sides("cube", 0, -0.01, 0.01), sides("cube", 2, -0.01, 0.01)),
                      gravity=0, note="walls are 2 cm thick" + (", tiles in place of triangles" if "8K" in name else ""))


def planes():
    cube = body("cube", box(1, 1, 1), (0, 0, 1))
    rest = every(rests(), ends("cube", 2, 0.5, 0.502))
    for name, parts in (("two-triangles", 1), ("8K-triangles", 20)):
        size = 10 / parts
        tiles = [body(f"tile {i} {j}", box(size, size, 1), (size * (i + 0.5) - 5, size * (j + 0.5) - 5, -0.5), static=True)
                 for i in range(parts) for j in range(parts)]
        yield Fixture(f"tessellated-plane/{name}", tiles + [cube], 2.5, "rests flat on it", rest,
                      note="tiles of a metre's thickness in place of triangles")
    yield Fixture("tessellated-plane/two-triangles-tet", [floor(), body("cube", hull(PYRAMID), (0, 0, 1))], 2.5,
                  "rests flat on it", rests())


def scripted():
    quick = [0, 0, math.radians(200)]
    bat = body("bat", box(0.5, 4, 0.5), (0, 0, 0), kinematic=True, angularVelocity=quick)
    yield Fixture("bat", [bat, body("cube", box(0.25, 0.25, 0.25), (1.5, 0.2, 1.0))], 5, "is struck and flies off",
                  every(work_only(), on_time), energy=None, note="driven at its rate, not by its inertia")
    yield Fixture("lever-arm", [
        floor(), body("pivot", hull([(-0.2, -0.5, 0), (0.2, -0.5, 0), (-0.2, 0.5, 0), (0.2, 0.5, 0), (0, -0.5, 0.5), (0, 0.5, 0.5)]),
                      (0, 0, 0), static=True), body("arm", box(6, 1, 0.1), (0, 0, 0.552)),
        body("light", box(0.5, 0.5, 0.5), (2.5, 0, 0.86)), body("heavy", box(1, 1, 1), (-2.5, 0, 3))], 5,
        "the heavy one falls on one end, the light one is thrown", every(all_sides(2, 0.04, 50), rests("heavy", speed=0.1)),
        friction=0.5, note="own lengths")
    yield Fixture("spinning-cube/over-plane", [
        floor(), body("cube", box(1, 1, 1), (0, 0, 0.51), angularVelocity=[0, 0, 2000], density=1)], 2.5,
        "spins on at 2000 rad/s on the plane", every(turns("cube", 2, 2000, 1e-3), sides("cube", 2, 0.49, 0.52)))
    yield Fixture("spinning-cube/free", [
        body("cube", box(1, 1, 1), (0, 0, 0), angularVelocity=[0, 0, 100])], 2.5, "spins on",
        turns("cube", 2, 100, 1e-9), gravity=0)
    path = {"interpolation": "linear", "repeats": False, "keyframes": [
        {"time": 0, "position": [0, 0, 1.5]}, {"time": 0.01, "position": [0, 0, 2.5]}, {"time": 0.02, "position": [0, 0, 3.5]}]}
    yield Fixture("examples/kinematically-scripted", [
        floor(), body("ceiling", box(10, 10, 1), (0, 0, 11.5), static=True),
        body("cube", box(1, 1, 1), (0, 0, 6), linearVelocity=[0, 0, -10]), {"name": "script", "shape": box(1, 1, 1), "kinematic": path}],
        3, "struck by a cube that moves at 100 m/s, stays under the ceiling", all_sides(2, 0.3, 10.8), energy=None)
    corner = plate([(-1, -1), (1, -1), (1, -0.4), (-0.4, -0.4), (-0.4, 1), (-1, 1)], 1)
    yield Fixture("examples/concave", [
        floor(), body("corner", mesh("corner"), (0, 0, 2.2), rotation=turn((1, 0, 0), 90)),
        body("L", mesh("corner"), (0.3, 0, 4.6), rotation=turn((1, 0, 0), 90))], 5, "the one comes to lie in or on the other",
        every(rests(), all_sides(2, 0.2, 5)), friction=0.5, meshes={"corner": corner}, short=True)
    two = [{"shape": box(0.6, 0.6, 0.6), "position": [-0.35, 0, 0]}, {"shape": box(0.6, 0.6, 0.6), "position": [0.35, 0, 0]}]
    yield Fixture("examples/split-components", [
        floor(), body("one", {"compound": two}, (-2, 0, 1), rotation=turn((0, 1, 0), 45), angularVelocity=[0, 7.85, 0]),
        body("apart 1", box(0.6, 0.6, 0.6), (1.65, 0, 1.2)), body("apart 2", box(0.6, 0.6, 0.6), (2.35, 0, 1.2))], 5,
        "one body of two cubes stays one, two apart do not hold together", every(all_sides(2, 0.25, 3)))
    yield Fixture("minimum-separation/cube-falling-on-edge", [
        floor(), body("cube", box(1, 1, 1), (0, 0, 2), rotation=turn((0, 1, 0), 30))], 5, "rests at the engine's own gap",
        every(rests(), ends("cube", 2, 0.5002, 0.502)), note="the separation is the engine's 1 mm, not 5 cm", friction=0.3)
    shapes = {f"lump {k}": bumpy(k, 0.09) for k in range(1, 6)}
    hopper = revolved([(0.1, -0.05), (0.12, -0.05), (0.42, 0.3), (0.4, 0.3)], 24)
    lid = body("lid", box(0.6, 0.6, 0.02), (0, 0, 0.62), locked=["x", "y", "turnX", "turnY", "turnZ"], force=[0, 0, -100])
    yield Fixture("minimum-separation/packing", [
        floor(2), body("hopper", mesh("hopper"), (0, 0, 0.06), static=True), lid] + [
        body(f"lump {k}", mesh(f"lump {k}"), (0.18 * math.cos(k * 1.257), 0.18 * math.sin(k * 1.257), 0.36)) for k in range(1, 6)],
        2, "a lid presses lumps into a hopper; none gets through", all_sides(2, 0.0, 0.8), energy=None,
        meshes={**shapes, "hopper": hopper}, note="own lumps of 288 triangles and hopper", friction=0.3, rate=200)


def fixtures():
    for family in (features, erleben, rotation, tunnels, planes, scripted):
        yield from family()
