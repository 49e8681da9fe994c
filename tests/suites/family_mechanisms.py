"""Mechanisms driven by what is moved or pushed, with play between their parts; and heaps of concave bodies that are
stirred. The originals' parts are known as meshes only: ours do the same work by own outlines."""

import math

from mesh_shapes import arms, bolt, bumpy, gear, nut, plate, revolved, rod
from suite_checks import all_sides, ends, every, follows, on_time, reaches, turns, work_only
from suite_fixture import Fixture, about, body, box, floor, hull, mesh, product, turn

AXLE = ["x", "y", "z", "turnX", "turnY"]
PLANE = ["y", "turnX", "turnZ"]
UPRIGHT_Z = about((1, 0, 0), 90)  # The outline's x stays, its y becomes z.


def gears():
    wheel = {"gear": gear(12, 2.05 / 12, 0.3, 0.3)}
    rate = math.radians(100)
    driver = body("gear 0", mesh("gear"), (0, 0, 0), kinematic=True, angularVelocity=[0, 0, -rate], density=1)
    driven = lambda k: body(f"gear {k}", mesh("gear"), (2.05 * k, 0, 0), locked=AXLE, density=1,
                            **({"rotation": turn((0, 0, 1), 15)} if k % 2 else {}))
    pushed = body("gear 0", mesh("gear"), (0, 0, 0), locked=AXLE, torque=[0, 0, -1], density=1)
    for name, count, seconds in (("single", 2, 2), ("chain", 5, 2)):
        others = [driven(k) for k in range(1, count)]
        rates = [turns(f"gear {k}", 2, rate if k % 2 else -rate, 0.01) for k in range(1, count)]
        yield Fixture(f"gears/{name}-kinematic", [driver] + others, seconds, "each turns at the driver's rate, within 1 %",
                      every(*rates, on_time), energy=None, meshes=wheel, note="own involute gears of 12 teeth",
                      short=name == "single")

        def together(run, count=count):
            late = range(len(run.frames()) // 2, len(run.frames()))
            spins = [abs(sum(run.spin(f"gear {k}", f)[2] for f in late)) for k in range(count)]
            off = max(abs(s / spins[0] - 1) for s in spins[1:])
            return None if off < 0.02 else f"rates differ by {off:.3g}"

        yield Fixture(f"gears/{name}", [pushed] + others, seconds, "pushed by a torque, all turn alike, within 2 %",
                      every(together, work_only()), energy=None, meshes=wheel, note="own involute gears of 12 teeth")


def piston():
    radius, length, play = 0.15, 0.5, 0.002
    rate = 2 * math.pi
    pin = lambda r, tall, place=(0, 0, 0): {"shape": {"cylinder": {"radius": r, "length": tall, "sides": 24}}, "position": list(place)}
    # The second pin, behind, has no use but that the crank turns about its axle, where its centre of mass is.
    crank = {"compound": [pin(0.2, 0.05, (0, 0, -0.09)), pin(0.05, 0.16, (0, radius, 0.0)), pin(0.05, 0.16, (0, -radius, -0.2))]}
    head = {"compound": [{"shape": box(0.28, 0.15, 0.28), "position": [0, 0.185, 0]}, pin(0.05, 0.16),
                         {"shape": box(0.2, 0.3, 0.02), "position": [0, 0, -0.1]}, {"shape": box(0.2, 0.3, 0.02), "position": [0, 0, 0.1]}]}
    bar = rod(length, 0.1, 0.05 + play, 0.1, 24)
    def height(t):
        a = rate * t
        return radius * math.cos(a) + math.sqrt(length**2 - (radius * math.sin(a))**2)
    bodies = [
        body("crank", crank, (0, 0, 0), rotation=UPRIGHT_Z, kinematic=True, angularVelocity=[0, -rate, 0]),
        body("rod", mesh("rod"), (0, 0, radius + length / 2), rotation=product(UPRIGHT_Z, about((0, 0, 1), 90))),
        body("head", head, (0, 0, radius + length), rotation=UPRIGHT_Z)]
    for k, x in enumerate((-1, 1)):
        bodies.append(body(f"wall {k}", box(0.05, 0.4, 0.75), (x * (0.14 + 0.025 + play), 0, 0.85), static=True))
    yield Fixture("mechanisms/piston", bodies, 3, "goes up and down as crank and rod say, within play", every(
        follows("head", 2, height, 0.012), on_time, work_only()), energy=None, meshes={"rod": bar}, rate=240,
        limit_s=90, note="own parts, play of 2 mm; 3 s of its 5")


def punching_press():
    """A knee of two rods between a fixed pin and a punch: pushed straight, it presses the punch down."""
    length, play = 0.5, 0.003
    bar = rod(length, 0.1, 0.05 + play, 0.08, 24)
    disc = lambda r, tall, z: {"shape": {"cylinder": {"radius": r, "length": tall, "sides": 24}}, "position": [0, 0, z]}
    knee = {"compound": [disc(0.05, 0.3, 0), disc(0.09, 0.03, 0.165), disc(0.09, 0.03, -0.165)]}
    punch = {"compound": [disc(0.05, 0.3, 0), disc(0.09, 0.03, 0.165), disc(0.09, 0.03, -0.165),
                          {"shape": box(0.16, 0.3, 0.04), "position": [0, -0.2, -0.2]}]}
    bend = math.radians(40)
    x, z = length * math.sin(bend), length * math.cos(bend)
    for name, clear in (("punching-press", 0.003), ("punching-press-loose", 0.01)):
        bar = rod(length, 0.1, 0.05 + clear, 0.08, 24)
        side = lambda high: product(UPRIGHT_Z, about((0, 0, 1), 90 + (1 if high else -1) * math.degrees(bend)))
        bodies = [
            body("fixed", knee, (0, 0, 1), rotation=UPRIGHT_Z, static=True),
            body("knee", knee, (x, 0, 1 - z), rotation=UPRIGHT_Z, locked=PLANE, force=[-200, 0, 0]),
            body("punch", punch, (0, 0, 1 - 2 * z), rotation=UPRIGHT_Z, locked=["x", "y", "turnX", "turnY", "turnZ"]),
            body("rod 1", mesh("rod"), (x / 2, -0.06, 1 - z / 2), rotation=side(True), locked=PLANE),
            body("rod 2", mesh("rod"), (x / 2, 0.06, 1 - 1.5 * z), rotation=side(False), locked=PLANE)]
        lowest = 1 - 2 * length
        yield Fixture(f"mechanisms/{name}", bodies, 1, "the knee straightens and the punch goes down by what two rods allow", every(
            reaches("punch", 2, lowest - 4 * clear - 0.01, lowest + 0.02), work_only()),
            energy=None, meshes={"rod": bar}, rate=240, gravity=0, fps=120, limit_s=60, note=f"own knee of two rods, play of {1000 * clear:g} mm")


def cam():
    """What turns a curved wheel lifts a rod in a guide, and lets it rest."""
    radius, off, rate = 0.3, 0.12, math.radians(50)
    wheel = {"cylinder": {"radius": radius, "length": 0.2, "sides": 96}}
    bodies = [
        dict(name="wheel", shape=wheel, kinematic={"interpolation": "linear", "keyframes": [
            {"time": t / 4, "position": [off * math.sin(rate * t / 4), 0, off * math.cos(rate * t / 4)],
             "rotation": product(about((0, 1, 0), math.degrees(rate * t / 4)), UPRIGHT_Z)} for t in range(30)]}),
        body("piston", box(0.5, 0.15, 0.6), (0, 0, off + radius + 0.3012), locked=["x", "y", "turnX", "turnY", "turnZ"])]
    yield Fixture("mechanisms/intermittent-motion", bodies, 7, "the rod goes up and down with the wheel, within a step of its keys",
                  every(follows("piston", 2, lambda t: off * math.cos(rate * t) + radius + 0.3, 0.004), on_time), energy=None,
                  rate=240, note="a round cam with its axle 12 cm off, keys every 0.25 s")


def lewis():
    """A wedge that is drawn up spreads two legs in a dovetail, and they lift the block."""
    block = plate([(-0.6, -0.6), (0.6, -0.6), (0.6, 0.3), (0.22, 0.3), (0.36, -0.3), (-0.36, -0.3), (-0.22, 0.3), (-0.6, 0.3)], 0.6)
    centre = [(x, y, z) for y in (-0.25, 0.25) for x, z in ((-0.17, -0.28), (0.17, -0.28), (0.03, 0.32), (-0.03, 0.32))]
    leg = lambda s: hull([(s * x, y, z) for y in (-0.25, 0.25) for x, z in ((0.186, -0.28), (0.33, -0.28), (0.2, 0.28), (0.055, 0.28))])
    bodies = [floor(), body("block", mesh("block"), (0, 0, 0.6012), rotation=UPRIGHT_Z),
              body("centre", hull(centre), (0, 0, 0.62), kinematic=True, linearVelocity=[0, 0, 0.5]),
              body("left", leg(-1), (0, 0, 0.5925)), body("right", leg(1), (0, 0, 0.5925))]
    yield Fixture("mechanisms/lewis", bodies, 2, "the block goes up with the wedge", every(
        ends("block", 2, 0.6 + 0.5 * 2 - 0.25), on_time, work_only()), energy=None, friction=0.3, rate=240, limit_s=60,
        meshes={"block": block}, note="own dovetail; two legs, not four")


def screws():
    root, crest, pitch, clear = 0.4, 0.5, 0.5, 0.02
    screw = bolt(root, crest, pitch, 4, 24, 0.1, (0.8, 0.3))
    fixed = nut(crest + clear, root + clear, pitch, 1.5, 24, 0.95)
    lead = pitch / (2 * math.pi)
    for name, seconds in (("bolt", 2), ("screw", 2)):
        def wound(run):
            fallen = run.place("screw", 0)[2] - run.place("screw")[2]
            spins = [run.spin("screw", f)[2] for f in run.frames()]
            turned = sum(a + b for a, b in zip(spins, spins[1:])) / (2 * run.fixture.fps)
            if fallen < 0.3:
                return f"sinks by {fallen:.3g} m only"
            off = abs(fallen - abs(turned * lead))
            return None if off < 0.1 * pitch else f"sinks {fallen:.4g} m while it turns by {turned:.4g} rad: {off:.3g} m off its thread"
        yield Fixture(f"mechanisms/{name}", [
            body("nut", mesh("nut"), (0, 0, 0), static=True),
            body("screw", mesh("screw"), (0, 0, 2.15), rotation=about((1, 0, 0), 180))],
            seconds, "sinks and turns as its thread says", wound, rate=240, limit_s=120, meshes={"nut": fixed, "screw": screw},
            note="own thread of 0.5 m a turn, play of 2 cm; 2 s of its 5")


def heaps():
    pot = revolved([(0.05, -0.02), (1.6, -0.02), (1.6, 1.3), (1.55, 1.3), (1.55, 0.03), (0.05, 0.03)], 32)
    blade = body("blade", box(2.4, 0.05, 0.5), (0, 0, 0.31), kinematic=True, angularVelocity=[0, 0, math.radians(200)])
    lump = {"lump": bumpy(5, 0.2, 12, 24)}
    for count, seconds in ((1, 2), (10, 2), (25, 1), (100, 0.5)):
        per = 9
        lumps = [body(f"lump {k}", mesh("lump"), (1.2 * math.cos(2.4 * k) * math.sqrt((k % per + 0.5) / per),
                                                 1.2 * math.sin(2.4 * k) * math.sqrt((k % per + 0.5) / per),
                                                 0.8 + 0.45 * (k // per) + 0.01 * (k % per))) for k in range(count)]
        lumps = spaced(lumps, 0.42)
        yield Fixture(f"blender/{count}", [body("pot", mesh("pot"), (0, 0, 0), static=True), blade] + lumps, seconds,
                      "stirred by a blade, none gets through pot or blade", all_sides(2, 0.0),
                      energy=None, meshes={**lump, "pot": pot}, rate=200, limit_s=60,
                      note=f"own lumps of 528 triangles in place of Suzannes; {seconds:g} s of its 5")
    eight = {"octopus": arms(8, 0.3, 1.5, 0.22, 0.2)}
    yield Fixture("octopus/draped", [
        floor(), body("bar", {"cylinder": {"radius": 0.2, "length": 4}}, (0, 0, 1), rotation=turn((0, 1, 0), 90), static=True)] + [
        body(f"octopus {k}", mesh("octopus"), (0.3 * k, 0.1 * k, 2 + 0.6 * k), rotation=turn((0, 0, 1), 10 * k)) for k in range(4)],
        4, "fall over a bar; none goes through it or another", all_sides(2, 0.05), friction=0.3, meshes=eight, energy=5e-3, limit_s=60,
        note="flat own octopuses: rigid, they do not drape")
    knives = [body(f"knife {k}", hull([(x, y, z) for y in (-1.5, 1.5) for x, z in ((-0.05, 0), (0.05, 0), (0, 0.6))]),
                   (0.7 * k - 1.4, 0, 0), static=True) for k in range(5)]
    yield Fixture("octopus/knives", [floor()] + knives + [body("octopus", mesh("octopus"), (0.1, 0.1, 1.5), rotation=turn((1, 2, 0), 20))],
                  3, "falls on edges and stays above or between them", all_sides(2, 0.05), friction=0.3, meshes=eight, limit_s=60,
                  energy=5e-3, note="own knives and octopus")


def spaced(bodies, apart):
    """Each as high above those before it as keeps them apart."""
    for k, b in enumerate(bodies):
        x, y, z = b["position"]
        for other in bodies[:k]:
            p, q, r = other["position"]
            flat = math.hypot(x - p, y - q)
            if flat < apart:
                z = max(z, r + math.sqrt(apart**2 - flat**2))
        b["position"] = [x, y, z]
    return bodies


def fixtures():
    for family in (gears, piston, punching_press, cam, lewis, screws, heaps):
        yield from family()
