#!/usr/bin/env python3
"""Makes the scenes of mechanisms and hollow bodies in assets/scenes/ and their meshes in assets/meshes/, the same
bytes on every run.

Usage: python3 assets/make_mechanisms.py        (needs nothing but Python 3)

Each function below is one scene with its meshes; what theory says of it opens the file, and is tested in
tests/demos/scene/mechanism_scenes_test.cpp.
"""

import math

from make_scenes import BLUE, FOLDER, GRAVITY, GREEN, ORANGE, PINK, RED, SKY, SLATE, STEEL, YELLOW, FLOOR
from make_scenes import body, floor, main_camera, turn, write

MESHES = FOLDER.parent / "meshes"


def write_mesh(name, points, faces):
    """OBJ with all digits of a double: faces that are flat stay flat."""
    lines = ["# Carom, own work, public domain (CC0)"]
    lines += ["v " + " ".join(repr(x + 0.0) for x in p) for p in points]
    lines += ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    (MESHES / name).write_text("\n".join(lines) + "\n")


def revolved(profile, sides):
    """A closed profile of (radius, z), counter-clockwise in that plane, turned about z. Radii are above 0."""
    points, faces = [], []
    m = len(profile)
    for k in range(sides):
        angle = 2 * math.pi * k / sides
        points += [[r * math.cos(angle), r * math.sin(angle), z] for r, z in profile]
    for k in range(sides):
        there = (k + 1) % sides
        for i in range(m):
            j = (i + 1) % m
            faces.append([k * m + i, there * m + i, there * m + j, k * m + j])
    return points, faces


def extruded(outline, height):
    """A closed outline in x and y, counter-clockwise, between -height / 2 and height / 2."""
    n = len(outline)
    points = [[x, y, z] for z in (-height / 2, height / 2) for x, y in outline]
    faces = [list(range(n - 1, -1, -1)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return points, faces


def circle(n, radius, centre=(0.0, 0.0), phase=0.0):
    return [(centre[0] + radius * math.cos(2 * math.pi * (k + phase) / n),
             centre[1] + radius * math.sin(2 * math.pi * (k + phase) / n)) for k in range(n)]


def torus(ring_radius, tube_radius, sides, tube_sides):
    return revolved(circle(tube_sides, tube_radius, (ring_radius, 0.0), 0.5), sides)


def mesh(name, **rest):
    return {"mesh": {"file": f"meshes/{name}", **rest}}


def turntable():
    spin, friction = 2.0, 0.25
    limit = friction * GRAVITY / spin**2
    write_mesh("disc.obj", *extruded(circle(64, 1.0), 0.1))
    bodies = [floor(),
              body("turntable", mesh("disc.obj"), [0, 0, 0.25], kinematic=True, angularVelocity=[0, 0, spin],
                   material="rubber", color="#c9c2b6")]
    for k, share in enumerate((0.6, 0.8, 0.97, 1.03, 1.2, 1.4)):
        angle = 2 * math.pi * k / 6
        r = share * limit
        bodies.append(body("stays" if share < 0.7 else f"at {share} of the radius",
                           {"box": [0.09, 0.09, 0.06]}, [r * math.cos(angle), r * math.sin(angle), 0.33006],
                           rotation=turn([0, 0, 1], math.degrees(angle)), material="rubber",
                           linearVelocity=[-spin * r * math.sin(angle), spin * r * math.cos(angle), 0],
                           angularVelocity=[0, 0, spin], color=GREEN if share < 1 else RED))
    write("turntable",
          "A turntable that turns at 2 rad/s, whatever stands on it. What is farther out than mu g / w^2 = 0.613 m is "
          "not held by friction (0.25) and slides off: the three red blocks at 1.03, 1.2 and 1.4 of that, not the "
          "green ones at 0.6, 0.8 and 0.97.",
          "on a turntable friction holds what is within mu g / w^2: green blocks ride, red ones slide off",
          {"floor": FLOOR, "rubber": {"staticFriction": friction, "density": 800}},
          bodies, main_camera([0.15, -2.4, 1.85], [0.05, -0.03, 0.16], 38), 3.5, FOLDER,
          group="sliding and resting",
          lookFor="Green blocks ride along for ever, red ones slide off: the limit lies between 0.97 and 1.03.",
          caption="μg/ω² = {=0.25*9.81/2^2:3} m holds   from the axis: {=sqrt([at 0.97 of the "
                  "radius.x]^2+[at 0.97 of the radius.y]^2):3} and {=sqrt([at 1.03 of the radius.x]^2+[at "
                  "1.03 of the radius.y]^2):3} m")


def involute_gear(teeth, module, backlash=0.02, addendum=0.8, dedendum=1.0, flank=4):
    """The outline of a spur gear, a tooth at angle 0; pressure angle 20 degrees."""
    pitch = module * teeth / 2
    base = pitch * math.cos(math.radians(20))
    root, tip = pitch - dedendum * module, pitch + addendum * module

    def involute(radius):
        alpha = math.acos(min(1.0, base / radius))
        return math.tan(alpha) - alpha

    def half_angle(radius):  # of a tooth
        return (1 - backlash) * math.pi / (2 * teeth) + involute(pitch) - involute(max(radius, base))

    low = max(base, root)
    radii = [low + (tip - low) * i / flank for i in range(flank + 1)]
    outline = []
    for k in range(teeth):
        middle = 2 * math.pi * k / teeth
        right = [(r, middle - half_angle(r)) for r in ([root] if root < low else []) + radii]
        left = [(r, middle + half_angle(r)) for r in reversed(([root] if root < low else []) + radii)]
        outline += [(r * math.cos(a), r * math.sin(a)) for r, a in right + left]
    return outline


def gears():
    module, thickness, spin = 0.1, 0.16, 1.5
    small, large = 18, 27
    write_mesh("gear-18.obj", *extruded(involute_gear(small, module), thickness))
    write_mesh("gear-27.obj", *extruded(involute_gear(large, module), thickness))
    apart = module * (small + large) / 2
    axle = {"locked": ["x", "y", "z", "turnX", "turnY"]}
    bodies = [floor(),
              "Turned at a constant rate; the others are free to turn about z only.",
              body("driver", mesh("gear-18.obj"), [-apart, 0, 0.3], kinematic=True, angularVelocity=[0, 0, spin],
                   material="steel", color=ORANGE),
              body("idler", mesh("gear-27.obj"), [0, 0, 0.3], material="steel", color=SKY, **axle),
              body("driven", mesh("gear-18.obj"), [apart, 0, 0.3], rotation=turn([0, 0, 1], 180 / small),
                   material="steel", color=GREEN, **axle)]
    write("gears",
          "A train of involute gears of 18, 27 and 18 teeth. The first is turned at 1.5 rad/s and drives the others "
          "through their teeth alone: the idler turns at -18/27 of that, the last at the rate of the first, within "
          "their play.",
          "gears of 18, 27 and 18 teeth: the first is turned, the others are driven by their teeth",
          {"floor": FLOOR, "steel": {"staticFriction": 0.1, "density": 7800}},
          bodies, main_camera([0.4, -3.9, 3.5], [0, -0.1, 0.2], 44), 5, FOLDER,
          group="machines",
          lookFor="The idler turns the other way, at 18/27 of the rate.",
          caption="ω = 1.5 rad/s, ×18/27 = {=1.5*18/27:3}   measured: idler {=-[idler.wz]:3}, last "
                  "{body:driven.wz:3} rad/s")


def bowl_profile(radius, wall, segments):
    """From the rim's inside down to a hole that is nearly none, and back up outside."""
    hole = 0.02
    first = math.asin(hole / radius)
    angles = [first + (math.pi / 2 - first) * i / segments for i in range(segments + 1)]
    inner = [(radius * math.sin(a), -radius * math.cos(a)) for a in angles]
    outer = [((radius + wall) * math.sin(a), -(radius + wall) * math.cos(a)) for a in angles]
    return outer + inner[::-1]


def ball_in_a_bowl():
    radius, ball, start = 1.0, 0.12, 55
    write_mesh("bowl.obj", *revolved(bowl_profile(radius, 0.08, 8), 32))
    a = math.radians(start)
    reach = radius * 0.98 - ball - 0.02
    mass = 2500 * 4 / 3 * math.pi * ball ** 3
    bodies = [floor(),
              body("bowl", mesh("bowl.obj"), [0, 0, 1.1], static=True, material="glass", color=STEEL),
              body("ball", {"sphere": {"radius": ball}}, [reach * math.sin(a), 0, 1.1 - reach * math.cos(a)],
                   linearVelocity=[0, 0.8, 0], material="glass", color=ORANGE)]
    write("ball-in-a-bowl",
          "A ball in a bowl without friction that bounces without loss: it loses no energy, and stays in the bowl.",
          "an elastic ball in a bowl without friction: its energy stays",
          {"floor": FLOOR, "glass": {"staticFriction": 0, "restitution": 1, "density": 2500}},
          bodies, main_camera([0.9, -1.9, 2.55], [0, 0, 0.72], 38), 6, FOLDER,
          group="accuracy beside theory",
          lookFor="It never rises higher than where it set out, and never loses a joule.",
          caption="energy kept to {=100*energy/E0:4} %",
          set={"E0": mass * (GRAVITY * (1.1 - reach * math.cos(a)) + 0.8 ** 2 / 2)})


def marble_in_a_funnel():
    """A cone of 40 degrees above a spout."""
    write_mesh("funnel.obj", *revolved([(0.12, -0.35), (0.16, -0.35), (0.16, -0.03), (1.05, 0.72), (1.0, 0.75), (0.12, 0.0)],
                                       32))
    write_mesh("cup.obj", *revolved([(0.02, 0.0), (0.3, 0.0), (0.34, 0.45), (0.3, 0.45), (0.265, 0.05), (0.02, 0.05)], 24))
    bodies = [floor(),
              body("funnel", mesh("funnel.obj"), [0, 0, 1.1], static=True, material="wood", color=STEEL),
              body("cup", mesh("cup.obj"), [0, 0, 0.0007], material="wood", color=BLUE)]
    for k, color in enumerate((ORANGE, GREEN, PINK)):
        angle = 2 * math.pi * k / 3
        r = 0.8 - 0.05 * k
        bodies.append(body(f"marble {k + 1}", {"sphere": {"radius": 0.06}},
                           [r * math.cos(angle), r * math.sin(angle), 1.1 + 0.75 * (r - 0.12) / 0.88 + 0.11],
                           linearVelocity=[-1.2 * math.sin(angle), 1.2 * math.cos(angle), 0], material="wood", color=color))
    write("marble-in-a-funnel",
          "Marbles roll round a funnel, lower and lower as they lose energy to friction and to small bounces, fall through its spout, "
          "and end in the cup that stands below it on the floor.",
          "marbles spiral down a funnel, and fall through its spout into a cup",
          {"floor": FLOOR, "wood": {"staticFriction": 0.3, "restitution": 0.3, "rollingResistance": 0.004, "density": 700}},
          bodies, main_camera([0.8, -1.9, 3.35], [0, 0.0, 0.98], 37), 6.8, FOLDER,
          group="meshes",
          lookFor="Each round is lower than the one before, until the spout.",
          caption="marbles at {body:marble 1.speed:2}, {body:marble 2.speed:2}, {body:marble 3.speed:2} m/s")


def linked_rings():
    ring, tube = 0.4, 0.07
    write_mesh("ring.obj", *torus(ring, tube, 16, 8))
    inner = ring - tube
    bodies = [floor(),
              body("upper ring", mesh("ring.obj"), [0, 0, 1.8], rotation=turn([1, 0, 0], 90), static=True,
                   material="brass", color=STEEL),
              body("lower ring", mesh("ring.obj"), [0.0, 0, 1.8 - 2 * inner + 0.06],
                   rotation=[0.5, 0.5, 0.5, 0.5], angularVelocity=[0, 5, 0], material="brass", color=ORANGE)]
    write("linked-rings",
          "One ring hangs in another, which is fixed; it swings, rolls in it and comes to rest below, and never leaves "
          "it: two rings that are linked stay so.",
          "a ring hangs and swings in another one",
          {"floor": FLOOR, "brass": {"staticFriction": 0.05, "restitution": 0.1, "density": 8500}},
          bodies, main_camera([1.1, -2.5, 1.75], [0, 0, 1.33], 38), 4, FOLDER,
          group="meshes",
          lookFor="The ring rolls in the other and never leaves it.",
          caption="what is linked stays linked   swing {body:lower ring.vx:2} m/s")


def stadium_link(half_length, radius, tube, tube_sides=6, bend=5):
    """A chain's link: two half circles about y, joined by straight pieces along x."""
    centres = []
    for sign in (1, -1):
        for i in range(bend + 1):
            angle = -math.pi / 2 + math.pi * i / bend
            direction = (sign * math.cos(angle), sign * math.sin(angle))
            centres.append(((sign * half_length + radius * direction[0], radius * direction[1]), direction))
    points, faces = [], []
    m, n = tube_sides, len(centres)
    for (x, y), (dx, dy) in centres:
        for i in range(m):
            angle = 2 * math.pi * (i + 0.5) / m
            out, up = tube * math.cos(angle), tube * math.sin(angle)
            points.append([x + out * dx, y + out * dy, up])
    for k in range(n):
        there = (k + 1) % n
        for i in range(m):
            j = (i + 1) % m
            faces.append([k * m + i, there * m + i, there * m + j, k * m + j])
    return points, faces


def chain():
    half, radius, tube = 0.07, 0.08, 0.03
    write_mesh("link.obj", *stadium_link(half, radius, tube))
    inside = half + radius - tube  # from the middle to the inside of a bend
    pitch = 2 * (inside - 0.004)
    top = 3.0
    bodies = [floor(), body("hook", {"capsule": {"radius": 0.035, "length": 0.5}}, [0, 0, top + inside - 0.037],
                            rotation=turn([0, 1, 0], 90), static=True, material="iron", color=SLATE)]
    for k in range(10):
        bodies.append(body(f"link {k + 1}", mesh("link.obj"), [0, 0, top - k * pitch],
                           rotation=turn([0, 1, 0], 90) if k % 2 == 0 else [0.5, -0.5, 0.5, 0.5],
                           material="iron", color=(ORANGE, SKY)[k % 2]))
    bodies.append(body("weight", {"sphere": {"radius": 0.12}}, [1.8, 0.05, top - 8 * pitch], linearVelocity=[-5, 0, 0.9],
                       material="iron", color=RED))
    write("chain",
          "A chain of ten links hangs on a hook; a ball strikes it from the side, and it swings: no link leaves "
          "another, and none is lost.",
          "a chain of ten links on a hook, struck by a ball",
          {"floor": FLOOR, "iron": {"staticFriction": 0.3, "restitution": 0.1, "density": 7800}},
          bodies, main_camera([1.9, -4.0, 1.95], [0.05, 0, 1.93], 38), 4, FOLDER,
          group="meshes",
          lookFor="No link leaves another, however hard the blow.")


def main():
    MESHES.mkdir(exist_ok=True)
    for scene in (turntable, gears, ball_in_a_bowl, marble_in_a_funnel, linked_rings, chain):
        scene()


if __name__ == "__main__":
    main()
