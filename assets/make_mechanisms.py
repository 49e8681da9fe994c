#!/usr/bin/env python3
"""Makes the scenes of mechanisms and hollow bodies in assets/scenes/ and their meshes in assets/meshes/, the same
bytes on every run.

Usage: python3 assets/make_mechanisms.py        (needs nothing but Python 3)

Each function below is one scene with its meshes; what theory says of it opens the file, and is tested in
tests/demos/scene/mechanism_scenes_test.cpp.
"""

import math

from make_scenes import BLUE, FOLDER, GRAVITY, GREEN, ORANGE, PINK, RED, SKY, SLATE, STEEL, YELLOW, FLOOR
from make_scenes import CONCRETE, PLANKS
from make_scenes import body, floor, main_camera, moving_camera, turn, write
from mesh_shapes import bolt, circle, extruded, involute_gear, nut, plate, revolved, stadium_link, torus

MESHES = FOLDER.parent / "meshes"


def write_mesh(name, points, faces):
    """OBJ with all digits of a double: faces that are flat stay flat."""
    lines = ["# Carom, own work, public domain (CC0)"]
    lines += ["v " + " ".join(repr(x + 0.0) for x in p) for p in points]
    lines += ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    (MESHES / name).write_text("\n".join(lines) + "\n")


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
          {"floor": PLANKS, "rubber": {"staticFriction": friction, "density": 800, "surface": "wood"}},
          bodies, moving_camera(34, (0, [0.5, -2.0, 1.5], [0.02, -0.02, 0.27]), (3.5, [0.9, -2.3, 1.35], [0.16, 0.05, 0.2])), 3.5, FOLDER,
          group="sliding and resting",
          lookFor="Green blocks ride along for ever, red ones slide off: the limit lies between 0.97 and 1.03.",
          caption="μg/ω² = {=0.25*9.81/2^2:3} m holds   from the axis: {=sqrt([at 0.97 of the "
                  "radius.x]^2+[at 0.97 of the radius.y]^2):3} and {=sqrt([at 1.03 of the radius.x]^2+[at "
                  "1.03 of the radius.y]^2):3} m")


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
          {"floor": FLOOR, "steel": {"staticFriction": 0.1, "density": 7800, "surface": "steel"}},
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
          {"floor": PLANKS, "wood": {"staticFriction": 0.3, "restitution": 0.3, "rollingResistance": 0.004, "density": 700, "surface": "marble"}},
          bodies, moving_camera(37, (0, [0.7, -1.75, 3.0], [0, 0, 1.35]), (3.4, [0.7, -1.6, 2.9], [0, 0, 1.2]),
                                (5.2, [0.75, -1.75, 1.5], [0, 0, 0.45]), (6.8, [0.6, -1.35, 1.3], [0, 0, 0.25])), 6.8, FOLDER,
          group="meshes",
          lookFor="Each round is lower than the one before, until the spout.",
          caption="marbles at {body:marble 1.speed:2}, {body:marble 2.speed:2}, {body:marble 3.speed:2} m/s")


def linked_rings():
    ring, tube = 0.4, 0.07
    write_mesh("ring.obj", *torus(ring, tube, 16, 8))
    write_mesh("fine-ring.obj", *torus(ring, tube, 40, 12))
    inner, top = ring - tube, 1.62
    # The lower ring's inside goes round the upper one's tube: its middle is so far from that of the tube.
    length = inner - tube
    sliding = 2 * math.pi * math.sqrt(length / GRAVITY)
    rolling = sliding * math.sqrt(1 + (ring**2 + 0.75 * tube**2) / inner**2)
    lean, hung = math.radians(40), length - 0.006
    bodies = [floor()]
    for name, x, metal in (("", -0.62, "brass"), ("greased ", 0.62, "grease")):
        bodies += [body(f"{name}upper ring", mesh("fine-ring.obj"), [x, 0, top], rotation=turn([0, 1, 0], 90), static=True,
                        material="steel"),
                   body(f"{name}lower ring", mesh("fine-ring.obj"),
                        [x + hung * math.sin(lean), 0, top - ring - hung * math.cos(lean)],
                        rotation=turn([1, 0, 0], 90), material=metal)]
    write("linked-rings",
          "Rings hang in others, which are fixed, and are let go at 40 degrees. The inside of each, of radius r, goes round the tube "
          "of the other, of radius a, so that its middle swings about the tube's on a circle of L = r - a. Greased it slides and "
          f"never turns: 2 pi sqrt(L / g) = {sliding:.3f} s for small swings. Held by friction it rolls: sqrt(1 + k^2 / r^2) times as "
          f"long, {rolling:.3f} s, where k is its radius of gyration. None ever leaves the other: rings that are linked stay so.",
          "rings hang and swing in others: one rolls, the greased one slides and is faster",
          {"floor": {"staticFriction": 0.6, "ground": "planks"},
           "steel": {"staticFriction": 1, "density": 7800, "surface": "steel", "color": "#aeb4bb"},
           "brass": {"staticFriction": 0.7, "density": 8500, "surface": "steel", "color": "#e0a93e"},
           "grease": {"staticFriction": 0, "density": 7800, "surface": "steel", "color": "#4f93c4"}},
          bodies, main_camera([1.5, -3.2, 1.95], [0.02, 0, 1.26], 34), 4, FOLDER,
          group="meshes", light={"like": "studio-dark", "exposure": 1.7},
          lookFor="The brass ring rolls and takes 1.6 times as long as the blue one, which never turns.",
          caption="rolls: T ≥ {=Tr:2} s, out by {=1000*([lower ring.x]+0.62):0} mm   slides: T ≥ {=Ts:2} s, "
                  "out by {=1000*([greased lower ring.x]-0.62):0} mm   t = {=time:2} s",
          set={"Tr": rolling, "Ts": sliding})


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


def nut_on_a_bolt():
    pitch, root, crest, play, bare = 0.5, 0.4, 0.5, 0.02, 0.2
    write_mesh("bolt.obj", *bolt(root, crest, pitch, 4, 24, bare, (1.0, 0.35)))
    write_mesh("nut.obj", *nut(crest + play, root + play, pitch, 1.5, 24, 0.95))
    base = 0.35
    start = base + bare + 0.6 * pitch + 3 * pitch  # its tooth in the middle of the bolt's groove
    bodies = [floor(),
              body("bolt", mesh("bolt.obj"), [0, 0, base], static=True, material="oiled", color=STEEL),
              body("nut", mesh("nut.obj"), [0, 0, start], material="painted", color=ORANGE)]
    write("nut-on-a-bolt",
          "A nut turns down a bolt by its weight, held by nothing but the threads: 0.5 m a turn, without friction. It "
          "turns by its fall over p, the pitch over 2 pi, within the play of the threads, and gains speed by less than "
          "g / (1 + (k / p)^2), where k is its radius of gyration: the threads are of flat facets, and bumping over their "
          "edges takes some of it. Then it lies down on the head.",
          "a nut turns down a bolt by its weight, held by the threads alone",
          {"floor": CONCRETE, "oiled": {"staticFriction": 0, "density": 7800, "surface": "steel"},
           "painted": {"staticFriction": 0, "density": 7800}},
          bodies, main_camera([2.7, -4.6, 3.3], [0, 0, 1.42], 38), 7, FOLDER,
          group="machines",
          lookFor="Nothing but the thread holds the nut: it turns as it sinks, faster and faster.",
          caption="sinking at ω·0.5 m/2π = {=[nut.spin]*0.5/(2*pi):3} m/s   measured {=-[nut.vz]:3} m/s   fallen {=2.35-[nut.z]:2} m")


def key_in_a_lock():
    """A bolt with a notch over the key's axle; a plate with a keyhole before it."""
    reach, thick, low, notch = 0.3, 0.05, 0.22, (-0.25, -0.02)
    throw = math.sqrt(reach**2 + thick**2 / 4 - low**2) - notch[1]
    bar = [(-0.7, low), (notch[0], low), (notch[0], 0.37), (notch[1], 0.37), (notch[1], low), (0.7, low), (0.7, 0.5), (-0.7, 0.5)]
    write_mesh("lock-bolt.obj", *plate(bar, 0.16))
    hole = [(x, z) for x, z in circle(24, 0.075, (0, 0), 0.5) if z > -0.06 or abs(x) > 0.045]
    at = min(range(len(hole)), key=lambda i: math.dist(hole[i], (-0.05, -0.06)))
    hole = hole[:at + 1] + [(-0.045, -0.33), (0.045, -0.33)] + hole[at + 1:]
    frame = [(-0.75, -0.5), (0.75, -0.5), (0.75, 0.62), (-0.75, 0.62)]
    write_mesh("lock-plate.obj", *plate(frame, 0.06, [hole]))
    upright = turn([1, 0, 0], 90)
    axle = 0.55
    shaft = {"cylinder": {"radius": 0.05, "length": 1.1}}
    key = {"compound": [
        {"shape": shaft, "position": [0, 0.47, 0], "rotation": turn([1, 0, 0], 90)},
        {"shape": {"box": [thick, 0.14, reach - 0.02]}, "position": [0, 0, -(reach + 0.02) / 2]},
        {"shape": mesh("ring.obj", scale=0.5), "position": [0, 1.22, 0], "rotation": turn([0, 1, 0], 90)}]}
    quarter = [turn([0, 1, 0], 90 * k) for k in range(5)]
    path = [{"time": 0, "position": [0, 1.0, axle], "rotation": quarter[0]},
            {"time": 1.5, "position": [0, 0, axle], "rotation": quarter[0]}]
    path += [{"time": 1.5 + 1.25 * k, "position": [0, 0, axle], "rotation": quarter[k]} for k in range(1, 5)]
    path.append({"time": 8, "position": [0, 1.0, axle], "rotation": quarter[4]})
    bodies = [floor(),
              body("plate", mesh("lock-plate.obj"), [0, 0.3, axle], rotation=upright, static=True, material="brass", color=STEEL),
              "The key goes in, turns once, and comes out.",
              {"name": "key", "shape": key, "kinematic": {"interpolation": "linear", "keyframes": path}, "material": "brass",
               "color": YELLOW},
              body("bolt", mesh("lock-bolt.obj"), [0, 0, axle + 0.0012], rotation=upright, material="brass", color=ORANGE)]
    for name, x in (("left", -0.55), ("right", 0.55)):
        bodies.append(body(f"{name} rail", {"box": [0.22, 0.3, 0.1]}, [x, 0, axle + low - 0.05], static=True, material="brass",
                           color=SLATE))
    bodies.append(body("stop", {"box": [0.1, 0.3, 0.3]}, [0.7 + throw + 0.004 + 0.05, 0, axle + 0.36], static=True, material="brass",
                       color=SLATE))
    write("key-in-a-lock",
          "A key goes through the hole of a plate, turns once and comes out again. Its bit comes into the notch of a bolt "
          f"and throws it by sqrt(R^2 + b^2 / 4 - h^2) - x = {throw:.4f} m, where R is the reach and b the thickness of the "
          "bit, h the height of the bolt over the axle and x where the notch's wall was; a stop keeps it within 4 mm of that.",
          "a key turns in a lock and throws its bolt",
          {"floor": CONCRETE, "brass": {"staticFriction": 0.3, "density": 8500, "surface": "steel"}},
          bodies, moving_camera(38, (0, [-1.5, 2.6, 1.5], [0.05, 0.5, 0.6]), (1.3, [-1.5, 2.3, 1.45], [0.05, 0.4, 0.6]),
                                (2.6, [-1.15, -1.9, 1.5], [0.1, 0.1, 0.6]), (6.2, [-0.6, -2.0, 1.4], [0.14, 0.1, 0.6]),
                                (8, [-1.6, 2.3, 1.5], [0.1, 0.4, 0.6])), 8, FOLDER,
          group="machines",
          lookFor="The bit takes the bolt along by its notch while the key turns past it.",
          caption="√(R² + b²/4 − h²) − x = {=throw:3} m   the bolt has gone {body:bolt.moved:3} m", set={"throw": throw})


def main():
    MESHES.mkdir(exist_ok=True)
    for scene in (turntable, gears, ball_in_a_bowl, marble_in_a_funnel, linked_rings, chain, nut_on_a_bolt, key_in_a_lock):
        scene()


if __name__ == "__main__":
    main()
