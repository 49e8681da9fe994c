#!/usr/bin/env python3
"""Makes the scenes of games, machines and large heaps in assets/scenes/, and their meshes, the same bytes on every
run.

Usage: python3 assets/make_showpieces.py        (needs nothing but Python 3)
"""

import math
import random

from make_scenes import CONCRETE, PLANKS, SAND, BLUE, FOLDER, GRAVITY, GREEN, ORANGE, PINK, RED, SKY, SLATE, YELLOW, FLOOR
from make_scenes import body, floor, main_camera, moving_camera, turn, write
from make_mechanisms import mesh
from make_theory import DARK_OAK, OAK, SLATE_FLOOR, part

CANDY = [RED, ORANGE, YELLOW, GREEN, SKY, BLUE, PINK]


def billiard_break():
    """A rack that is its own mirror image; no friction, so that nothing but impacts acts."""
    radius, long, wide, gap = 0.25, 10.0, 5.4, 0.03
    pitch = 2 * radius + gap
    bodies = [floor(), body("bed", {"box": [long + 0.9, wide + 0.9, 0.4]}, [0, 0, 0.2], static=True, material="cloth",
                            color="#2f7d5b")]
    for name, size, place in (("long cushion", [long + 0.9, 0.45, 0.32], [0, wide / 2 + 0.225, 0.56]),
                              ("short cushion", [0.45, wide, 0.32], [long / 2 + 0.225, 0, 0.56])):
        for side in (-1, 1):
            bodies.append(body(f"{name} {'near' if side < 0 else 'far'}", {"box": size},
                               [side * place[0], side * place[1], place[2]], static=True, material="rubber",
                               color="#7a4a2b"))
    z = 0.4 + radius + 0.0004
    colors = [YELLOW, BLUE, RED, PINK, ORANGE, GREEN, "#8c2d2d", "#222831"]
    number, names = 0, {}
    for row in range(5):
        for k in range(row + 1):
            y = (k - row / 2) * pitch
            number += 1
            names[row, k] = f"ball {number}"
            mirrored = min(k, row - k)
            bodies.append(body(f"ball {number}", {"sphere": {"radius": radius}},
                               [1.4 + row * pitch * math.sqrt(3) / 2 * 1.0002, y, z], material="ivory",
                               color=colors[(row * 3 + mirrored) % len(colors)]))
    speed = 15.0
    bodies.append(body("cue ball", {"sphere": {"radius": radius}}, [-3.4, 0, z], linearVelocity=[speed, 0, 0],
                       material="ivory", color="#f7f3e8"))
    kinetic = 0.5 * 1700 * 4 / 3 * math.pi * radius ** 3 * speed ** 2
    outer, other = names[4, 0], names[4, 4]
    write("billiard-break",
          "A break that hits the rack in its middle: rack and cue ball are their own mirror image, and without friction "
          "they stay so for some time: what begins as the last bit of a number grows with every impact.",
          "a break on a table without friction, mirror-symmetric for a while",
          {"floor": SLATE_FLOOR, "cloth": {"staticFriction": 0}, "rubber": {"staticFriction": 0, "restitution": 0.85, "surface": "rubber"},
           "ivory": {"staticFriction": 0, "restitution": 0.95, "density": 1700}},
          bodies, main_camera([-1.4, -9.3, 7.6], [0.1, -0.25, 0.3], 38), 6, FOLDER, group="showpieces",
          lookFor="The upper half of the table is the mirror image of the lower one until rounding has grown visible.",
          caption=f"{outer} and {other}: mirror images within {{=abs([{outer}.x]-[{other}.x])+abs([{outer}.y]+[{other}.y]):9}} m"
                  "   energy left {=100*kinetic/E0:1} %",
          set={"E0": kinetic})


def hourglass():
    """Between two panes again; four slats and two walls."""
    neck, slope, half, ball = 0.3, 52.0, 1.55, 0.1
    a = math.radians(slope)
    long = (half - neck) / math.cos(a)
    rise = (half - neck) * math.tan(a)
    middle = 0.35 + 1.25 + rise
    bodies = [floor(), body("back", {"box": [2 * half + 0.5, 0.1, 2 * middle]}, [0, 0.25, middle], static=True,
                            material="wood", color="#33424f"),
              body("base", {"box": [2 * half + 0.5, 0.4, 0.35]}, [0, 0, 0.175], static=True, material="wood", color=DARK_OAK)]
    thick = 0.1
    for up in (1, -1):
        for side in (-1, 1):
            name = f"{'upper' if up > 0 else 'lower'} {'left' if side < 0 else 'right'}"
            x = neck + long / 2 * math.cos(a) + thick / 2 * math.sin(a)
            z = long / 2 * math.sin(a) - thick / 2 * math.cos(a)
            bodies.append(body(f"{name} slat", {"box": [long, 0.4, thick]}, [side * x, 0, middle + up * z],
                               rotation=turn([0, 1, 0], -side * up * slope), static=True, material="glass", color="#b9d4dc"))
    for side in (-1, 1):
        bodies.append(body(f"{'left' if side < 0 else 'right'} wall", {"box": [0.1, 0.4, 2 * middle - 0.35]},
                           [side * (half + 0.06), 0, middle + 0.175], static=True, material="glass", color="#b9d4dc"))
    count, placed, z, row = 140, 0, middle + 0.5, 0
    rng = random.Random(3)
    while placed < count:
        reach = min(half - 0.02, neck + (z - middle) / math.tan(a)) - ball / math.sin(a) - 0.03
        fit = max(1, int(2 * reach / 0.216))
        for k in range(min(fit, count - placed)):
            bodies.append(body(f"grain {placed + 1}", {"sphere": {"radius": ball}},
                               [(k - (fit - 1) / 2) * 0.216 + rng.uniform(-0.004, 0.004), 0, z], locked=["y"], material="sand",
                               color=CANDY[row // 3 % 7]))
            placed += 1
        row += 1
        z += 0.213
    write("hourglass",
          "Grains run through a neck of six radii at one rate however many lie above it, unlike water: arches that "
          "form and break over the neck carry what is higher up (Beverloo).",
          f"{count} grains run through the neck of an hourglass at one rate",
          {"floor": SLATE_FLOOR, "wood": {"staticFriction": 0.4, "surface": "wood"}, "glass": {"staticFriction": 0.1},
           "sand": {"staticFriction": 0.2, "density": 2500}},
          bodies, main_camera([0.5, -11.6, 3.4], [0, 0, 2.75], 30), 8, FOLDER, 240, group="many contacts",
          lookFor="The level above sinks evenly; now and then an arch forms over the neck and breaks.",
          caption="140 grains, a neck of six radii: the rate does not depend on the height above   t = {=time:1} s")


def double_cone():
    """Two cones base to base on rails that part and rise."""
    radius, half, sides = 0.55, 1.15, 96
    spread, rise = math.radians(17), math.radians(3.2)
    rail, long = 0.05, 4.6
    points = [[0, -half, 0], [0, half, 0]] + [[radius * math.cos(2 * math.pi * k / sides), 0, radius * math.sin(2 * math.pi * k / sides)]
                                              for k in range(sides)]
    bodies = [floor()]
    high, narrow = 0.75, 0.12
    for side in (-1, 1):
        direction = (math.cos(spread) * math.cos(rise), side * math.sin(spread) * math.cos(rise), math.sin(rise))
        start = (-2.2, side * narrow, high)
        centre = [s + long / 2 * d for s, d in zip(start, direction)]
        # A capsule lies along z: turned about the axis across both.
        axis = [-direction[1], direction[0], 0]
        bodies.append(body(f"{'near' if side < 0 else 'far'} rail", {"capsule": {"radius": rail, "length": long}}, centre,
                           rotation=turn(axis, math.degrees(math.acos(direction[2]))), static=True, material="steel",
                           color="#aeb6be"))
        for share in (0.02, 0.98):
            foot = [s + share * long * d for s, d in zip(start, direction)]
            bodies.append(body(f"{'near' if side < 0 else 'far'} post {1 if share < 0.5 else 2}",
                               {"box": [0.16, 0.16, foot[2] - rail - 0.004]}, [foot[0], foot[1], (foot[2] - rail - 0.004) / 2],
                               static=True, material="wood", color=DARK_OAK))
    start = -1.35
    # Where the cones' surface is on the rails: their half distance there is y; the surface r (1 - y / half) from the axis.
    y = narrow + (start + 2.2) * math.tan(spread)
    z = high + (start + 2.2) / math.cos(spread) * math.tan(rise) + rail + radius * (1 - y / half) + 0.03
    bodies.append(body("double cone", {"hull": {"points": points}}, [start, 0, z], material="wood", color=ORANGE))
    write("double-cone",
          "Two cones base to base roll up two rails: the rails part faster than they rise, so while the rails climb the "
          "axle sinks. It goes if tan(rise) < tan(half the angle between the rails) tan(half the cone's angle).",
          "a double cone rolls uphill on rails that part",
          {"floor": SLATE_FLOOR, "steel": {"staticFriction": 0.8, "surface": "steel"}, "wood": {"staticFriction": 0.8, "density": 600, "surface": "wood"}},
          bodies, main_camera([1.2, -5.6, 2.4], [0.05, 0, 0.8], 36), 4, FOLDER, 480, group="accuracy beside theory",
          lookFor="The rails rise to the right, the cone rolls to the right, and its axle sinks.",
          caption="tan(rise) = {=tan(3.2):3} < {=tan(17)*0.55/1.15:3} = tan φ tan β: it rolls up   axle "
                  "{=1000*([double cone.z]-z0):0} mm",
          set={"z0": z})


def domino_spiral():
    """Two arms from one push in the middle."""
    high, wide, thick, pitch = 0.5, 0.25, 0.08, 0.235
    bodies = [floor()]
    arms = 62
    inner, per_turn = 0.75, 1.15
    for arm in range(2):
        angle, r = 0.0, inner
        for k in range(arms):
            r = inner + per_turn * angle / (2 * math.pi)
            a = angle + math.pi * arm
            heading = a + math.pi / 2 - math.atan2(per_turn / (2 * math.pi), r)
            extra = {}
            if k == 0:
                rate = 1.8
                d = [math.cos(heading), math.sin(heading)]
                extra = {"linearVelocity": [rate * high / 2 * d[0], rate * high / 2 * d[1], rate * thick / 2],
                         "angularVelocity": [-rate * d[1], rate * d[0], 0]}
            bodies.append(body(f"arm {arm + 1}, domino {k + 1}", {"box": [thick, wide, high]},
                               [r * math.cos(a), r * math.sin(a), high / 2 + 0.0001],
                               rotation=turn([0, 0, 1], math.degrees(heading)), material="wood",
                               color=(CANDY if arm == 0 else CANDY[::-1])[k // 3 % 7], **extra))
            angle += pitch / math.hypot(r, per_turn / (2 * math.pi))
    write("domino-spiral",
          f"Two spirals of {arms} dominoes fall from the inside out; both arms are the same, turned by half a turn, and "
          "so are their waves.",
          f"two spirals of {arms} dominoes fall from the inside out",
          {"floor": PLANKS, "wood": {"staticFriction": 0.3, "dynamicFriction": 0.25, "density": 700, "surface": "wood"}},
          bodies, {"main": {"keyframes": [
              {"time": 0, "eye": [1.6, -4.2, 2.6], "target": [0, 0.1, 0.2]},
              {"time": 5.5, "eye": [2.2, -6.6, 5.6], "target": [0.1, -0.15, 0.1]}], "fovDegrees": 38}}, 6, FOLDER, 240,
          group="showpieces", lookFor="Both waves run at one steady speed and reach the ends together.",
          caption="two arms of 62: tops are {=abs([arm 1, domino 31.z]-[arm 2, domino 31.z]):6} m apart in height")


def bowling():
    """Ten pins of stacked cones, and a ball."""
    def pin():
        return {"compound": [part({"cone": {"radius": 0.11, "topRadius": 0.2, "height": 0.42, "sides": 24}}, [0, 0, 0.21]),
                             part({"cone": {"radius": 0.2, "topRadius": 0.085, "height": 0.45, "sides": 24}}, [0, 0, 0.645]),
                             part({"cone": {"radius": 0.085, "topRadius": 0.1, "height": 0.2, "sides": 24}}, [0, 0, 0.97]),
                             part({"sphere": {"radius": 0.125}}, [0, 0, 1.12])]}
    lane, gap = 0.12, 0.0005
    bodies = [floor(), body("lane", {"box": [13, 3.6, lane]}, [-2.4, 0, lane / 2 + 0.0005], static=True, material="wood",
                            color="#d8b27c")]
    number = 0
    for row in range(4):
        for k in range(row + 1):
            number += 1
            bodies.append(body(f"pin {number}", pin(), [1.0 + row * 0.66, (k - row / 2) * 0.76, lane + 0.0005 + gap],
                               material="pin", color="#f4f0e6"))
    radius, speed = 0.36, 7.5
    bodies.append(body("ball", {"sphere": {"radius": radius}}, [-5.2, 0.42, lane + 0.0005 + radius + gap],
                       linearVelocity=[speed, -0.42, 0], angularVelocity=[0.42 / radius, speed / radius, 0], material="ball",
                       color="#26437c"))
    write("bowling",
          "A ball rolls into ten pins, a little beside the middle. What falls falls by impacts from pin to pin.",
          "a bowling ball rolls into ten pins",
          {"floor": CONCRETE, "wood": {"staticFriction": 0.25, "surface": "wood"}, "pin": {"staticFriction": 0.4, "restitution": 0.35, "density": 650},
           "ball": {"staticFriction": 0.3, "restitution": 0.1, "density": 1300}},
          bodies, {"main": {"keyframes": [
              {"time": 0, "eye": [-4.6, -2.9, 2.3], "target": [0.6, 0, 0.5]},
              {"time": 1.1, "eye": [-2.0, -3.0, 1.9], "target": [1.7, 0, 0.6]},
              {"time": 3.4, "eye": [-1.6, -3.6, 2.5], "target": [2.1, 0, 0.35]}], "fovDegrees": 38}}, 3.4, FOLDER, 240,
          group="showpieces", lookFor="The pins in the rear corners are felled by other pins, not by the ball.",
          caption="ball at {body:ball.speed:2} m/s")


def tin_cans():
    """Cups upside down, in a pyramid of four rows."""
    bodies = [floor(), body("shelf", {"box": [3.6, 1.2, 0.9]}, [0, 0, 0.45], static=True, material="wood", color=OAK)]
    high, wide, gap = 0.45, 0.74, 0.0006
    z = 0.9 + gap
    for row in range(4):
        n = 4 - row
        bodies.append(body(f"row {row + 1}", mesh("cup.obj"), [-(n - 1) / 2 * wide, 0, z + high], rotation=turn([1, 0, 0], 180),
                           material="steel", color=[CANDY[(row * 2 + k) % 7] for k in range(n)],
                           repeat={"count": [n, 1, 1], "step": [wide, 0, 0]}))
        z += high + gap
    flight, speed = 0.7, 7.0
    bodies.append(body("ball", {"sphere": {"radius": 0.2}}, [-0.25, -speed * flight - 0.3, 1.5], linearVelocity=[0, speed, GRAVITY * flight / 2],
                       material={"staticFriction": 0.4, "restitution": 0.3, "density": 5000}, color="#26437c"))
    write("tin-cans",
          "Ten cups, upside down in a pyramid, and a ball. The cups are hollow meshes: they tumble, roll round on their "
          "rims and can come to stand over each other.",
          "a ball is thrown into a pyramid of ten hollow cups",
          {"floor": PLANKS, "wood": {"staticFriction": 0.5, "surface": "wood"}, "steel": {"staticFriction": 0.3, "restitution": 0.3, "density": 900, "surface": "steel"}},
          bodies, main_camera([2.3, -5.6, 2.9], [0.05, 0.2, 1.35], 34), 3.5, FOLDER, 240, group="meshes",
          lookFor="Cups roll in circles on their rims, as hollow cones do.",
          caption="ten hollow cups   the ball: {body:ball.speed:2} m/s")


def ring_toss():
    """Rings thrown at a post, one after the other."""
    bodies = [floor(), body("stand", {"box": [0.9, 0.9, 0.12]}, [0, 0, 0.0605], static=True, material="wood", color=DARK_OAK),
              body("post", {"capsule": {"radius": 0.09, "length": 1.15}}, [0, 0, 0.12 + 0.62], static=True, material="wood",
                   color=OAK)]
    for k, color in enumerate((RED, SKY, ORANGE, GREEN, PINK)):
        flight = 0.6 + 0.38 * k
        start, goal = [-2.6, 1.1 * (k - 2), 0.6], 1.45
        bodies.append(body(f"ring {k + 1}", mesh("ring.obj"), start, rotation=turn([0, 0, 1], 40 * k),
                           linearVelocity=[-start[0] / flight, -start[1] / flight,
                                           (goal - start[2]) / flight + GRAVITY * flight / 2],
                           angularVelocity=[0, 0, 4], material="rubber", color=color))
    write("ring-toss",
          "Five rings are thrown at once, at five heights, so that they come down over the post one after the other: a "
          "ring is a mesh with a hole, and the post goes through it.",
          "five rings come down over a post, one after the other",
          {"floor": SAND, "wood": {"staticFriction": 0.4, "surface": "wood"}, "rubber": {"staticFriction": 0.5, "restitution": 0.1, "density": 1100, "surface": "rubber"}},
          bodies, moving_camera(44, (0, [0.6, -4.6, 1.7], [-1.2, 0, 0.95]), (1.0, [1.0, -4.4, 2.0], [-0.7, 0, 1.5]),
                                (2.2, [0.9, -3.6, 2.0], [-0.1, 0, 1.0]), (3.3, [0.8, -2.6, 1.5], [0, 0, 0.45])), 3.4, FOLDER, 240, group="meshes",
          lookFor="The rings stay on the post: what goes through a hole is never lost to it.",
          caption="rings over the post: the last one flies {=0.6+4*0.38:2} s   t = {=time:2} s")


def roller_conveyor():
    """Driven rollers carry crates to a chute."""
    radius, pitch, spin, count = 0.14, 0.36, 8.0, 17
    bodies = [floor()]
    high = 1.25
    for k in range(count):
        bodies.append(body(f"roller {k + 1}", {"capsule": {"radius": radius, "length": 1.2}}, [(k - count / 2) * pitch, 0, high],
                           rotation=turn([1, 0, 0], -90), kinematic=True, angularVelocity=[0, spin, 0], material="rubber",
                           color=("#4d5964", "#5b6772")[k % 2]))
    length = count * pitch
    for side in (-1, 1):
        bodies.append(body(f"{'near' if side < 0 else 'far'} frame", {"box": [length + 0.1, 0.1, 0.34]},
                           [-pitch / 2, side * 0.83, high], static=True, material="steel", color="#e0a43a"))
        for x in (-length / 2 + 0.25, length / 2 - 0.6):
            bodies.append(body(f"{'near' if side < 0 else 'far'} leg at {x:.1f}", {"box": [0.16, 0.1, high - 0.18]},
                               [x, side * 0.83, (high - 0.18) / 2 + 0.0005], static=True, material="steel", color="#b98528"))
    colors = [ORANGE, SKY, GREEN, YELLOW, PINK, RED, BLUE, "#f7f3e8"]
    for k in range(8):
        bodies.append(body(f"crate {k + 1}", {"box": [0.62, 0.7, 0.5]}, [-length / 2 + 0.35, 0.05 * (k % 3 - 1), high + radius + 0.3 + 1.3 * k * (k + 9) / 9],
                           rotation=turn([0, 0, 1], 7 * (k % 4 - 1.5)), material="cardboard", color=colors[k]))
    write("roller-conveyor",
          "Rollers of radius r that turn at w carry what lies on them at w r: crates that fall on them slip until they "
          "have that speed, ride along without slipping, and drop at the end.",
          "driven rollers carry crates along and drop them on a heap",
          {"floor": FLOOR, "rubber": {"staticFriction": 0.5, "surface": "rubber"}, "steel": {"staticFriction": 0.1, "surface": "steel"},
           "cardboard": {"staticFriction": 0.5, "density": 200, "surface": "cardboard"}},
          bodies, main_camera([2.0, -8.2, 3.6], [0.55, 0, 1.15], 36), 8, FOLDER, 240, group="machines",
          lookFor="Each crate slips for a moment, then rides at the speed of the rollers' surface.",
          caption="ωr = {=w*r:3} m/s   measured: first crate {body:crate 1.vx:3} m/s, second {body:crate 2.vx:3} m/s",
          set={"w": spin, "r": radius})


def catapult():
    """A weight falls on the lower end of a beam; the ball on the upper one flies into a wall of boxes."""
    high, long, thick, degrees = 1.6, 3.6, 0.12, 24.0
    pivot, a = -3.4, math.radians(degrees)

    def on_beam(u, v):
        return [pivot + u * math.cos(a) + v * math.sin(a), 0, high - u * math.sin(a) + v * math.cos(a)]

    prop = on_beam(-1.3, -thick / 2 - 0.02)
    bodies = [floor(),
              body("stand", {"hull": {"points": [[sx, sy, 0] for sx in (-0.5, 0.5) for sy in (-0.35, 0.35)]
                                      + [[0, sy, high - 0.1] for sy in (-0.35, 0.35)]}}, [pivot, 0, 0], static=True,
                   material="concrete", color="#8d9196"),
              body("prop", {"box": [0.14, 0.5, prop[2] - 0.05]}, [prop[0], 0, (prop[2] - 0.05) / 2], static=True,
                   material="wood", color=DARK_OAK),
              body("beam", {"compound": [part({"box": [long, 0.6, thick]}),
                                         part({"box": [0.08, 0.6, 0.2]}, [-long / 2 + 0.04, 0, 0.16]),
                                         part({"box": [0.08, 0.6, 0.2]}, [-long / 2 + 0.56, 0, 0.16])]},
                   [pivot, 0, high], rotation=turn([0, 1, 0], degrees), material="wood", color=OAK,
                   locked=["x", "y", "z", "turnX", "turnZ"]),
              body("shot", {"sphere": {"radius": 0.2}}, on_beam(-long / 2 + 0.3, thick / 2 + 0.202), material="marble", color=RED)]
    fall = on_beam(1.35, 0)
    bodies.append(body("weight", {"box": [0.6, 0.6, 0.6]}, [fall[0], 0, 3.9], rotation=turn([0, 1, 0], degrees),
                       material="steel", color=SLATE, mass=1500))
    colors = [YELLOW, ORANGE, SKY, GREEN]
    for row in range(7):
        for k in range(3):
            bodies.append(body(f"row {row + 1}, box {k + 1}", {"box": [0.42, 0.6, 0.34]},
                               [1.55, (k - 1) * 0.61 + (0.1 if row % 2 else -0.1), 0.17 + 0.0003 + row * 0.3403],
                               material="cardboard", color=colors[(row + k) % 4]))
    write("catapult",
          "A weight of 1500 kg falls on one end of a beam that turns about its middle and throws the ball on the other "
          "end into a wall of boxes.",
          "a falling weight throws a ball over a beam into a wall",
          {"floor": CONCRETE, "concrete": {"staticFriction": 0.6, "surface": "concrete"}, "wood": {"staticFriction": 0.5, "density": 500, "surface": "wood"},
           "marble": {"staticFriction": 0.4, "density": 3500, "surface": "marble"}, "steel": {"staticFriction": 0.5, "density": 7800, "surface": "steel"},
           "cardboard": {"staticFriction": 0.5, "density": 100}},
          bodies, main_camera([-0.4, -9.4, 3.3], [-1.15, 0, 2.1], 38), 2.8, FOLDER, 240, group="machines",
          lookFor="The weight falls on the far end; what the ball gets of it takes it right into the wall.",
          caption="the ball: {body:shot.speed:1} m/s, {body:shot.z:1} m high")


def raft_in_waves():
    """A raft of logs with crates on it, in a sea."""
    bodies = [body("bottom of the sea", {"box": [60, 60, 1]}, [0, 0, -3.5], static=True, material="floor")]
    parts = [part({"capsule": {"radius": 0.2, "length": 2.8}}, [0, 0.41 * (k - 2.5), 0], turn([0, 1, 0], 90)) for k in range(6)]
    parts += [part({"box": [0.16, 2.4, 0.1]}, [x, 0, 0.22]) for x in (-1.1, 1.1)]
    parts += [part({"box": [3.0, 2.3, 0.06]}, [0, 0, 0.3])]
    parts += [part({"box": [3.0, 0.06, 0.14]}, [0, y, 0.4]) for y in (-1.12, 1.12)]
    bodies.append(body("raft", {"compound": parts}, [0, 0, 0.12], material="wood", color=OAK))
    for row in range(3):
        for k in range(3 - row):
            for j in range(2):
                bodies.append(body(f"crate {row + 1}.{k + 1}.{j + 1}", {"box": [0.5, 0.5, 0.5]},
                                   [0.56 * (k - (2 - row) / 2), 0.6 * (j - 0.5), 0.12 + 0.331 + 0.25 + row * 0.5008], material="cardboard",
                                   color=CANDY[(row * 3 + k * 2 + j) % 7]))
    write("raft",
          "A raft of six logs carries twelve crates through waves; the crates hold on by friction alone until a wave "
          "is too steep for it.",
          "a raft with a pile of crates rides in waves",
          {"floor": FLOOR, "wood": {"staticFriction": 0.5, "density": 500, "surface": "wood"}, "cardboard": {"staticFriction": 0.35, "density": 180, "surface": "cardboard"}},
          bodies, main_camera([3.6, -6.0, 2.9], [0.1, 0, 0.35], 36), 8, FOLDER, 120, group="air and water",
          lookFor="The raft follows the slope of the water, and the pile leans, shifts and begins to slide.",
          caption="wave steepness up to {=360*0.16/5.2+360*0.05/2.3:0}°, friction holds 19° in the pile, 22° on the deck   raft at {body:raft.tilt:1}°", air={},
          fluids=[{"name": "sea", "level": 0, "addedMass": 0.4, "linearDrag": 0.15, "color": "#5fb0b8",
                   "waves": [{"amplitude": 0.16, "wavelength": 5.2, "direction": [1, 0.35]},
                             {"amplitude": 0.05, "wavelength": 2.3, "direction": [0.5, 1], "phaseDegrees": 60}]}])


def iceberg():
    """A tall hull of ice that is let go upright, and three floes."""
    rng = random.Random(11)
    points = []
    for k in range(34):
        u, a = rng.uniform(-1, 1), rng.uniform(0, 2 * math.pi)
        r = math.sqrt(1 - u * u)
        wide = 0.85 - 0.25 * u
        points.append([round(wide * r * math.cos(a), 3), round(0.95 * wide * r * math.sin(a), 3), round(1.9 * u, 3)])
    bodies = [body("bottom of the sea", {"box": [80, 80, 1]}, [0, 0, -5.5], static=True, material="floor"),
              body("iceberg", {"hull": {"points": points}}, [0, 0, -0.55], rotation=turn([1, 0.4, 0], 6), material="ice",
                   color="#e8f4fa")]
    for k, (x, y, size) in enumerate(((-2.7, 1.4, 1.2), (2.6, 1.9, 1.5), (2.4, -1.5, 1.0), (-2.3, -1.6, 0.8))):
        outline = [[size * rng.uniform(0.75, 1.0) * math.cos(a), size * rng.uniform(0.75, 1.0) * math.sin(a)] for a in
                   (2 * math.pi * i / 8 for i in range(8))]
        hull = [[round(px, 3), round(py, 3), z] for px, py in outline for z in (-0.16, 0.16)]
        bodies.append(body(f"floe {k + 1}", {"hull": {"points": hull}}, [x, y, 0.05], material="ice", color="#d7ebf4"))
    write("iceberg",
          "Ice floats with 917/1000 of it under water, however it lies; upright a tall iceberg is not stable, so it "
          "turns over, and the wash rocks the floes.",
          "a tall iceberg turns over and comes to rest on its side",
          {"floor": FLOOR, "ice": {"staticFriction": 0.05, "restitution": 0.1, "density": 917}},
          bodies, main_camera([3.2, -6.0, 2.7], [0, 0.1, -0.15], 37), 7, FOLDER, 120, group="air and water",
          lookFor="It hesitates upright, rolls over, overshoots, and rocks to rest on its broad side.",
          caption="under water: ρ ice / ρ water = 91.7 %   leaning {body:iceberg.tilt:0}°", air={},
          fluids=[{"name": "sea", "level": 0, "addedMass": 0.5, "linearDrag": 0.3, "color": "#6fb7d6",
                   "waves": [{"amplitude": 0.03, "wavelength": 4.0, "direction": [1, 0.3]}]}])


def avalanche(count=130):
    """Stones behind a gate on a slope; the gate is lifted."""
    slope, long, wide = 33.0, 15.0, 6.0
    a = math.radians(slope)
    s, c = math.sin(a), math.cos(a)
    toe = 3.0
    bodies = [floor(), body("slope", {"hull": {"points": [[toe, -wide / 2, 0], [toe, wide / 2, 0]] + [
        [toe - long * c, y, z] for y in (-wide / 2, wide / 2) for z in (0, long * s)]}}, [0, 0, 0], static=True, material="rock",
        color="#8a8f94")]
    along = lambda d, h, y: [toe - d * c + h * s, y, d * s + h * c]
    for side in (-1, 1):
        bodies.append(body(f"{'near' if side < 0 else 'far'} bank", {"box": [long, 0.3, 1.0]}, along(long / 2, 0.3, side * (wide / 2 + 0.16)),
                           rotation=turn([0, 1, 0], slope), static=True, material="rock", color="#767c82"))
    up = [s * 2.4, 0, c * 2.4]
    gate = along(9.2, 0.9, 0)
    bodies.append(body("gate", {"box": [0.2, wide - 0.06, 1.7]}, gate, material="steel", color="#c8622f", kinematic={"keyframes": [
        {"time": 0, "position": gate, "rotation": turn([0, 1, 0], slope)},
        {"time": 0.8, "position": gate, "rotation": turn([0, 1, 0], slope)},
        {"time": 1.1, "position": [g + u for g, u in zip(gate, up)], "rotation": turn([0, 1, 0], slope)}]}))
    del bodies[-1]["position"]
    rng = random.Random(4)
    shapes = [("gem", "meshes/gem.obj", 0.58), ("stone", "meshes/dodecahedron.ply", 0.56), ("rock", "meshes/icosahedron.off", 0.54)]
    number = 0
    for layer in range(20):
        for row in range(7):
            for k in range(8):
                if number >= count:
                    break
                name, file, fit = shapes[number % 3]
                d, h = 9.85 + 0.68 * row, 0.4 + 0.68 * layer
                bodies.append(body(f"{name} {number + 1}", {"hull": {"file": file, "fit": fit}},
                                   along(d + rng.uniform(-0.02, 0.02), h, (k - 3.5) * 0.7 + rng.uniform(-0.02, 0.02)),
                                   rotation=turn([rng.uniform(-1, 1), rng.uniform(-1, 1), 0.5], rng.uniform(0, 90)), material="stone",
                                   color=CANDY[number * 5 % 7]))
                number += 1
    write("avalanche",
          f"{count} stones lie behind a gate on a slope of {slope:.0f} degrees, steeper than their friction holds. The gate "
          "is lifted, and they come down, spread and stop.",
          f"{count} stones come down a slope when a gate is lifted",
          {"floor": FLOOR, "rock": {"staticFriction": 0.45}, "steel": {"staticFriction": 0.05, "surface": "steel"},
           "stone": {"staticFriction": 0.45, "restitution": 0.1, "density": 2400}},
          bodies, main_camera([11.0, -14.2, 8.4], [-1.7, 0, 1.9], 38), 5, FOLDER, 120, group="many contacts",
          lookFor="The front runs out on the floor, the tail still slides: the heap stops from the front backwards.",
          caption=f"{count} hulls   tan 33° = {{=tan(33):2}} against μ = 0.45")


def main():
    for scene in (billiard_break, hourglass, double_cone, domino_spiral, bowling, tin_cans, ring_toss,
                  roller_conveyor, catapult, raft_in_waves, iceberg, avalanche):
        scene()


if __name__ == "__main__":
    main()
