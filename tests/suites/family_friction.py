"""Inclines, arches, houses of cards, what rolls, turntables; fracture and piles."""

import math

from suite_checks import all_sides, ends, every, rests, sides, speeds_up, stays
from suite_fixture import Fixture, about, body, box, floor, hull, mesh, product, turn
from mesh_shapes import bumpy, cells, revolved

GRAVITY = 9.8
CARD = 0.01


def incline(name, degrees, friction, seconds, rate=100, **rest):
    """A cube at the rest gap over a slope along x."""
    a = math.radians(degrees)
    along, up = (math.cos(a), 0, -math.sin(a)), (math.sin(a), 0, math.cos(a))
    acceleration = GRAVITY * (math.sin(a) - friction * math.cos(a))
    length = max(10.0, acceleration * seconds**2 + 4)
    place = [0.501 * u for u in up]
    slope = [(length / 2 - 2) * t - 0.5 * u for t, u in zip(along, up)]
    sticks = math.tan(a) <= friction
    check = every(stays(within=1e-3), rests(speed=1e-6)) if sticks else speeds_up("cube", along, acceleration)
    return Fixture(f"friction/{name}", [
        body("slope", box(length, 10, 1), slope, static=True, rotation=turn((0, 1, 0), degrees)),
        body("cube", box(1, 1, 1), place, rotation=turn((0, 1, 0), degrees))], seconds,
        f"{'sticks' if sticks else 'slides'}, mu {friction:g} at {degrees:g} degrees", check, friction=friction, rate=rate, **rest)


def inclines():
    for degrees in (15, 20, 25, 30, 45, 85):
        yield incline(f"incline-plane-{degrees}", degrees, 0.4, 3, short=degrees in (20, 25))
    for friction in (0.49, 0.5, 1.0):
        # tan 26.565 degrees is 0.49999, 2e-5 below the friction that holds it.
        yield incline(f"slope-test-mu-{friction:g}", 26.565, friction, 10, rate=40, short=friction == 0.5,
                      note="10 s of its 25")

    yield Fixture("friction/sliding", [
        body("floor", box(20, 10, 1), (5, 0, -0.5), static=True),
        body("cube", box(1, 1, 1), (-3, 0, 0.501), linearVelocity=[10, 0, 0])], 2.5, "tips over its edge, slides and comes to rest",
        every(rests(), sides("cube", 2, 0.49, 0.9)), friction=1.0, short=True,
        note="at mu 1 a cube tips")


def catenary_stones(count, half_span, height, thickness, gap):
    """Stones between two catenaries, their joints across the middle line, each cut back by half of the gap."""
    scale = bisect(lambda a: a * (math.cosh(half_span / a) - 1) - height, 1e-2 * half_span, 1e3 * half_span)
    total = 2 * scale * math.sinh(half_span / scale)
    stones = []
    for k in range(count):
        corners = []
        for end, cut in ((k, gap / 2), (k + 1, -gap / 2)):
            s = total * end / count - total / 2 + (cut if 0 < end < count else 0)
            x = scale * math.asinh(s / scale)
            z = height - scale * (math.cosh(x / scale) - 1)
            slope = math.atan(-math.sinh(x / scale))
            out = (-math.sin(slope), math.cos(slope))
            if end in (0, count):
                out = (math.copysign(1.0, out[0]), 0.0)  # Feet are level.
            for side in (-0.5, 0.5):
                for y in (-thickness / 2, thickness / 2):
                    corners.append((x + side * thickness * out[0], y, z + side * thickness * out[1]))
        stones.append(corners)
    return stones


def bisect(f, low, high):
    for _ in range(200):
        middle = 0.5 * (low + high)
        if (f(low) > 0) == (f(middle) > 0):
            low = middle
        else:
            high = middle
    return middle


def arches():
    # Thin enough for the first stone to be wider than its joint leans.
    for count, thick, gap, seconds, limit in ((25, 12, 0.1, 20, 60), (101, 5, 0.1, 20, 60), (501, 2, 25 / 501, 2, 30),
                                              (951, 1, 25 / 951, 1, 30)):
        stones = catenary_stones(count, 45, 60, thick, gap)
        bodies = [body("floor", box(200, 200, 1), (0, 0, -0.502), static=True)]
        bodies += [body(f"stone {k}", hull(c), (0, 0, 0)) for k, c in enumerate(stones)]
        middle = f"stone {count // 2}"
        settled = every(rests(speed=2e-2), stays(middle, within=12)) if seconds == 20 else stays(middle, within=12)
        yield Fixture(f"arch/{count}-stones", bodies, seconds, "closes its gaps and stands" if seconds == 20 else "closes its gaps, nothing passes",
                      settled, friction=0.5, limit_s=limit, fps=2, energy=1e-2,
                      note=f"own catenary of 90 by 60 m, gaps {gap:.3g} m" + ("" if seconds == 20 else f", {seconds} s of its 20"))


def house(levels, lean=65.0, wide=1.1):
    """Tents of two cards 2.5 m long, joined by level cards, as the originals set them."""
    half, cards = 1.25, []
    rise = 2 * 1.20830308488593
    card = lambda x, z, degrees: body(f"card {len(cards)}", box(2 * half, 1.25, CARD), (x, 0, z),
                                      rotation=turn((0, 1, 0), -degrees), density=50)
    for level in range(levels):
        tents = levels - level
        for t in range(tents):
            x = 2 * wide * (t - (tents - 1) / 2)
            z = rise * (level + 0.5)
            cards.append(card(x - wide / 2, z, lean))
            cards.append(card(x + wide / 2, z, -lean))
        for t in range(tents - 1):
            cards.append(card(2 * wide * (t - (tents - 2) / 2), rise * (level + 1), -1))
    return cards


def card_houses():
    for levels, name, friction in ((1, "card-tent", 0.5), (2, "2-levels", 0.5), (3, "3-levels", 0.5), (4, "4-levels", 0.5)):
        top = 2 * 1.20830308488593 * levels
        yield Fixture(f"card-house/{name}", [floor(20)] + house(levels), 5, "every card rests", every(
            rests(), stays(within=0.4), all_sides(2, -0.01, top)), friction=friction, note="cards are 1 cm thick")
    falling = [body(f"block {k}", box(1, 1, 1), p, density=7680) for k, p in enumerate(((0.2, 0.2, 12), (0.5, 0.3, 15)))]
    yield Fixture("card-house/3-levels-falling-blocks", [floor(20)] + house(3) + falling, 5,
                  "is crushed; nothing passes", all_sides(2, -0.01), friction=0.9, note="cards are 1 cm thick", energy=1e-2)


def rolling():
    cone = hull([(0, 0, 0.1)] + [(0.05 * math.cos(a), 0.05 * math.sin(a), 0) for a in (2 * math.pi * k / 24 for k in range(24))])
    tilt = 90 + math.degrees(math.atan(0.05 / 0.1))
    lying = 0.1 * math.sin(math.atan(0.5))  # Of the apex over the lowest line's height: none; of the base's middle.
    yield Fixture("rolling/cone", [
        floor(2), body("cone", cone, (0, 0, 0.047), rotation=turn((1, 0, 0), tilt), linearVelocity=[1, 0, 0])], 5,
        "rolls about its tip and stays on the ground", every(sides("cone", 2, 0.0, 0.08)), friction=0.5, rate=100)
    circles = [(0.5 + math.cos(a), math.sin(a), 0) for a in (2 * math.pi * k / 48 for k in range(48))]
    circles += [(-0.5 + math.cos(a), 0, math.sin(a)) for a in (2 * math.pi * k / 48 for k in range(48))]
    oloid = hull([(0.05 * x, 0.05 * y, 0.05 * z) for x, y, z in circles])
    yield Fixture("rolling/oloid", [
        floor(4), body("oloid", oloid, (-0.45, 0, 0.051), linearVelocity=[0.5, 0, 0], force=[0.5, 0, 0])], 2,
        "tumbles along the ground, on it", every(sides("oloid", 2, 0.015, 0.08), ends("oloid", 0, -0.4)), friction=0.2, energy=None)
    yield Fixture("spolling/coin", [
        floor(1), body("coin", {"cylinder": {"radius": 0.01213, "length": 0.00175}}, (0, 0, 0.0127),
                       rotation=turn((1, 0, 0), 85), angularVelocity=[0, 0, math.radians(900)], density=8900)], 2.5,
        "spins down and lies flat", every(rests(), ends("coin", 2, 0.0008, 0.0011)), friction=0.2, rate=1000,
        note="a step of 1 ms, not 0.1 ms; twice its time")


def turntables():
    radius, thickness, reach, torque, spin = 2.0, 0.1, 1.5, 300.0, math.radians(45)
    mass = 1000 * math.pi * radius**2 * thickness * (math.sin(2 * math.pi / 32) / (2 * math.pi / 32))  # 32 sides
    side = 0.25
    for friction in (0.0, 0.1, 0.5, 1.0):
        inertia = 0.5 * mass * radius**2 + 1000 * side**3 * (side**2 / 6 + reach**2)
        alpha = torque / inertia

        def slips_at(mu):
            t = 0.0
            while math.hypot((spin + alpha * t)**2 * reach, alpha * reach) < mu * GRAVITY:
                t += 1e-3
            return t

        def check(run, mu=friction):
            expected = slips_at(mu)
            def slip(f):
                x, y, _ = run.place("block", f)
                u, v, _ = run.velocity("block", f)
                w = run.spin("table", f)[2]
                return math.hypot(u + w * y, v - w * x)
            if mu == 0:
                moved = math.dist(run.place("block"), (reach, 0, run.place("block")[2]))
                return None if moved < 1e-6 else f"is carried along by {moved:.3g} m without friction"
            first = next((run.time(f) for f in run.frames() if slip(f) > 0.003), math.inf)
            return None if abs(first - expected) < 0.2 + 0.01 * expected else \
                f"slips at {first:.2f} s, theory says {expected:.2f}"

        start = [0, spin * reach, 0] if friction else [0, 0, 0]
        yield Fixture(f"turntable/mu-{friction:g}", [
            body("table", {"cylinder": {"radius": radius, "length": thickness}}, (0, 0, 0), torque=[0, 0, torque],
                 angularVelocity=[0, 0, spin], locked=["x", "y", "z", "turnX", "turnY"]),
            body("block", box(side, side, side), (reach, 0, thickness / 2 + side / 2 + 0.0002), linearVelocity=start,
                 angularVelocity=[0, 0, spin if friction else 0])], 18,
            "is held until w^2 r reaches mu g" if friction else "is not carried along", check, friction=friction,
            rate=40, fps=40, energy=None, short=friction == 0.5, note="a rim of 2 m; the block starts with the table")


def fracture():
    for name, size, place, at, speed in (("cube", (2, 2, 2), 1.02, (0, -3.5, 1.0), 60), ("wall", (6, 0.5, 4), 2.02, (0, -2, 2), 120)):
        pieces = [body(f"piece {k}", hull(c), (0, 0, place), density=2500) for k, c in enumerate(cells(size, 100, 7))]
        ball = body("ball", {"sphere": {"radius": 0.25}}, at, linearVelocity=[0, speed, 0], density=7680)
        yield Fixture(f"fracture/{name}", [floor(60)] + pieces + [ball], 0.3, "a hundred pieces are struck apart; none sinks",
                      all_sides(2, 0.0), rate=1000, fps=100, friction=0.0, energy=1e-2, limit_s=120,
                      note=f"own Voronoi cells, {speed} m/s, 0.3 s of its 1 s, a step of 1 ms")


def piles():
    turns = [(359, 49, 352), (260, 64, 11), (83, 1, 62), (25, 217, 278), (82, 50, 47)]
    places = [(1.5, 0), (-1.5, 0), (0, -1.5), (0, 1.5), (0, 0)]
    rotated = lambda k: product(about((0, 1, 0), -turns[k][2]), product(about((0, 0, 1), turns[k][1]), about((1, 0, 0), turns[k][0])))
    cubes = lambda side, count, low: [body(f"cube {k}", box(side, side, side), (*places[k % 5], low + 2 * k), rotation=rotated(k % 5))
                                      for k in range(count)]
    yield Fixture("piles/plane", [floor(40)] + cubes(1, 5, 2), 10, "a pile, no cube below the plane", all_sides(2, 0.49))
    pit = revolved([(0.02, -4.05), (0.05, -4.15), (4.1, 0), (4.0, 0)], 32)
    yield Fixture("piles/cone", [body("pit", mesh("pit"), (0, 0, 0), static=True)] + cubes(0.25, 10, 1), 6,
                  "all ten end at the bottom of the pit", every(all_sides(2, -4.0), all_sides(0, -4, 4)),
                  meshes={"pit": pit}, note="own pit, walls 5 cm thick")
    lumps = {f"lump {k}": bumpy(20 + k, 0.3, 12, 24) for k in range(3)}
    yield Fixture("piles/cone-bunnies", [body("pit", mesh("pit"), (0, 0, 0), static=True)] + [
        body(f"lump {k}", mesh(f"lump {k % 3}"), (0.8 * math.cos(2.1 * k), 0.8 * math.sin(2.1 * k), -0.5 + 0.9 * k)) for k in range(8)],
        4, "all eight end at the bottom of the pit", every(all_sides(2, -4.1), all_sides(0, -4, 4)), friction=0.3,
        meshes={"pit": pit, **lumps}, note="dented balls of 528 triangles in place of bunnies")


def fixtures():
    for family in (inclines, arches, card_houses, rolling, turntables, fracture, piles):
        yield from family()
