"""Chains, nets, a wrecking ball and pendulums: joints made of geometry alone."""

import math

from mesh_shapes import link, plate, rod, torus
from suite_checks import all_sides, ends, every, linked, on_time, pairs_linked, sides, work_only
from suite_fixture import Fixture, about, body, box, floor, mesh, product, turn

RING, TUBE = 0.4, 0.1
LENGTH, WIDTH, THICKNESS = 1.5, 1.0, 0.190211
INSIDE = LENGTH / 2 - THICKNESS  # Of a link, from its middle to the inside of a bend.
LINK = {"link": link(LENGTH, WIDTH, THICKNESS)}
# The tube is a polygon: its inside is a little farther out than that of the round one.
FARTHEST = 2 * (INSIDE + 0.05 * THICKNESS)

FLAT, ACROSS, UP, UP_ACROSS = [1, 0, 0, 0], about((0, 0, 1), 90), about((1, 0, 0), 90), [0.5, 0.5, 0.5, 0.5]
DOWN, DOWN_TURNED = about((0, 1, 0), 90), product(about((0, 1, 0), 90), about((1, 0, 0), 90))


def rings():
    for count in (3, 5, 10):
        names = [f"ring {k}" for k in range(count)]
        bodies = [body(n, mesh("ring"), (0, 0, 1.5 - 0.55 * k), static=k == 0,
                       rotation=about((1, 0, 0), 90) if k % 2 == 0 else about((0, 1, 0), 90)) for k, n in enumerate(names)]
        yield Fixture(f"chain/{count}-links", bodies, 5, "hangs: no ring leaves another",
                      linked(names, 2 * (RING - 0.9 * TUBE)), meshes={"ring": torus(RING, TUBE, 20, 10)}, energy=1e-2,
                      note="a torus of 0.4 and 0.1 m, 400 triangles; 5 s of its 10", short=count == 3, limit_s=60)


def net(count, **rest):
    """Rows of level links, joined along both by upright ones; the rim is fixed."""
    bodies, pairs, n = [], [], count - 2
    name = lambda kind, i, j: f"{kind} {i} {j}"
    place = lambda i, j: (1.65 * i, 1.6 * j, 0)
    for i in range(n + 2):
        for j in range(n + 2):
            rim_i, rim_j = i in (0, n + 1), j in (0, n + 1)
            if rim_i and rim_j:
                continue
            bodies.append(body(name("node", i, j), mesh("link"), place(i, j), rotation=ACROSS, static=rim_i or rim_j))
            for di, dj, kind, rotation in ((1, 0, "along", UP), (0, 1, "across", UP_ACROSS)):
                k, l = i + di, j + dj
                corner = k in (0, n + 1) and l in (0, n + 1)
                if k > n + 1 or l > n + 1 or corner or (di and rim_j) or (dj and rim_i):
                    continue
                a, b = place(i, j), place(k, l)
                bodies.append(body(name(kind, i, j), mesh("link"), [(p + q) / 2 for p, q in zip(a, b)], rotation=rotation))
                pairs += [(name("node", i, j), name(kind, i, j)), (name(kind, i, j), name("node", k, l))]
    return bodies, pairs


def nets():
    for count, seconds, limit in ((4, 4, 60), (8, 1, 60), (16, 0.1, 60), (32, 0.02, 60)):
        bodies, pairs = net(count)
        yield Fixture(f"chain-net/{count}x{count}", bodies, seconds, "sags: no link leaves another",
                      pairs_linked(pairs, FARTHEST), meshes=LINK, energy=1e-2, limit_s=limit,
                      fps=10 if seconds >= 1 else 100, note=f"{len(bodies)} links; {seconds:g} s of its 1 s" if seconds < 1 else f"{len(bodies)} links")
    bodies, pairs = net(8)
    ball = body("ball", {"sphere": {"radius": 1.5}}, (1.65 * 3.5, 1.6 * 3.5, 3), density=1000)
    yield Fixture("chain-net/8x8-ball", bodies + [ball], 1.5, "catches a ball", every(
        pairs_linked(pairs, FARTHEST), sides("ball", 2, -8)), meshes=LINK, energy=1e-2, fps=10, note="8 by 8 in place of 16 by 16")
    bodies, pairs = net(4)
    for name, scale in (("0.1", 0.1), ("0.01", 0.01)):
        small = [{**b, "position": [scale * x for x in b["position"]], "shape": mesh("link", scale=scale)} for b in bodies]
        yield Fixture(f"chain-net/4x4-scale-{name}", small, 1, "sags at its scale: no link leaves another",
                      pairs_linked(pairs, scale * FARTHEST), meshes=LINK, energy=1e-2, fps=20, rate=100 if scale > 0.05 else 400,
                      note="4 by 4 in place of 16 by 16")


def slanted(k, count, step, degrees):
    return (count - k) * step * math.cos(math.radians(degrees)), 0, (count - k) * step * math.sin(math.radians(degrees))


def wrecking_ball():
    count, step = 14, 0.9
    lift = 11.0
    chain, names = [], []
    for k in range(count):
        x, y, z = slanted(k, count, step, 30)
        rotation = about((0, 1, 0), -30) if k % 2 == 0 else product(about((0, 1, 0), -30), about((1, 0, 0), 90))
        if k < count - 1:
            chain.append(body(f"link {k}", mesh("link"), (x, y, z + lift), rotation=rotation, static=k == 0, density=7680))
            names.append(f"link {k}")
        else:
            parts = [{"shape": mesh("link")}, {"shape": {"sphere": {"radius": 1.0}}, "position": [-1.6, 0, 0]}]
            chain.append(body("ball", {"compound": parts}, (x, y, z + lift), rotation=rotation, density=7680))
    wall = [body(f"brick {i} {j} {k}", box(0.5, 0.5, 0.5), (13.5 + 0.501 * i, 0.501 * (j - 6.5), 0.2512 + 0.501 * k))
            for i in range(2) for j in range(14) for k in range(20)]
    yield Fixture("wrecking-ball", [floor(100)] + chain + wall, 2.5, "swings and breaks the wall; no link leaves another",
                  every(linked(names, FARTHEST), all_sides(2, 0.0)), meshes=LINK, friction=0.5, energy=1e-2, fps=20, limit_s=150,
                  note=f"{len(chain) + len(wall) + 1} bodies; own wall of 560 bricks")


def anchor():
    pitch = 0.789473684
    names = [f"link {k}" for k in range(8)]
    bodies = [body("spool", mesh("link"), (0, 0, pitch), rotation=DOWN, kinematic=True, angularVelocity=[math.radians(-100), 0, 0])]
    bodies += [body(n, mesh("link"), (0, 0, -pitch * k), rotation=DOWN_TURNED if k % 2 == 0 else DOWN, density=7680)
               for k, n in enumerate(names)]
    flukes = plate([(-0.1, 0.8), (-0.1, -0.6), (-0.9, -0.1), (-1.0, -0.4), (0, -1.1), (1.0, -0.4), (0.9, -0.1), (0.1, -0.6), (0.1, 0.8)], 0.19)
    parts = [{"shape": mesh("link")}, {"shape": mesh("flukes"), "position": [1.4, 0, 0], "rotation": turn((0, 0, 1), 90)}]
    bodies.append(body("anchor", {"compound": parts}, (0, 0, -pitch * 8), rotation=DOWN_TURNED, density=7680))
    yield Fixture("anchor", bodies, 3, "is wound up by a turning link; no link leaves another", every(
        linked(["spool"] + names + ["anchor"], FARTHEST), on_time, work_only()), meshes={**LINK, "flukes": flukes}, energy=None,
        limit_s=90, note="eight links, not 21; the spool is a link; 3 s of its 25")


def pendulums():
    arm, pin = rod(4, 0.3, 0.13, 0.12, 24), {"cylinder": {"radius": 0.12, "length": 0.6, "sides": 24}}
    upright = about((1, 0, 0), 90)
    cap = lambda y: {"shape": {"cylinder": {"radius": 0.25, "length": 0.06, "sides": 24}}, "position": [0, 0, y]}
    held = {"compound": [{"shape": pin}, cap(0.34), cap(-0.34)]}
    reach = lambda a, b, far: linked([a, b], far)
    yield Fixture("pendulum/pendulum", [
        body("pin", held, (0, 0, 2), rotation=upright, static=True), body("arm", mesh("arm"), (-1.9999, 0, 2), rotation=upright)], 5,
        "swings on its pin and does not leave it", reach("pin", "arm", 2.05), meshes={"arm": arm}, energy=1e-2,
        note="own arm of 4 m, play of 1 cm", short=True, limit_s=60)
    loose = body("pin 2", held, (-4, 0.075, 2), rotation=upright)
    yield Fixture("pendulum/double-pendulum", [
        body("pin", held, (0, 0, 2), rotation=upright, static=True), body("arm", mesh("arm"), (-2, 0, 2), rotation=upright),
        loose, body("arm 2", mesh("arm"), (-6, 0.15, 2), rotation=upright)], 3, "neither arm leaves its pin", every(
            reach("pin", "arm", 2.05), reach("arm", "pin 2", 2.4), reach("pin 2", "arm 2", 2.4)), meshes={"arm": arm}, energy=1e-2,
        note="3 s of its 10", limit_s=90)


def lengths():
    """The scalability family: a line of links between two fixed ones."""
    for count, seconds in ((3, 2), (25, 1), (101, 0.25)):
        pitch = 1.0
        names = [f"link {k}" for k in range(count)]
        bodies = [body(n, mesh("link"), (pitch * k, 0, 0), rotation=FLAT if k % 2 == 0 else UP, static=k in (0, count - 1))
                  for k, n in enumerate(names)]
        yield Fixture(f"chain-line/length-{count}", bodies, seconds, "sags between its ends: no link leaves another",
                      linked(names, FARTHEST), meshes=LINK, energy=1e-2, limit_s=60, fps=20,
                      note=f"links of 440 triangles; {seconds:g} s")


def fixtures():
    for family in (rings, nets, wrecking_ball, anchor, pendulums, lengths):
        yield from family()
