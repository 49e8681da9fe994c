#!/usr/bin/env python3
"""Makes the scenes of many bodies in assets/scenes/, the same bytes on every run.

Usage: python3 assets/make_large.py        (needs nothing but Python 3)
"""

import math
import random

from make_scenes import BLUE, FOLDER, GREEN, ORANGE, PINK, PLANKS, RED, SAND, SKY, YELLOW
from make_scenes import body, floor, turn, write

CANDY = [RED, ORANGE, YELLOW, GREEN, SKY, BLUE, PINK]


def chain_reaction(rows=36):
    """Each domino stands before the gap of the two behind it, and fells both."""
    high, wide, thick = 0.5, 0.25, 0.08
    along, across = 0.26, 0.3
    bodies = [floor()]
    rate = 1.8
    push = {"linearVelocity": [rate * high / 2, 0, rate * thick / 2], "angularVelocity": [0, rate, 0]}
    for row in range(rows):
        count = row + 1
        bodies.append(body(f"row {count}", {"box": [thick, wide, high]},
                           [(row - rows / 2) * along, -row / 2 * across, high / 2 + 0.0001], material="wood",
                           color=CANDY[row // 2 % 7], **(push if row == 0 else {}),
                           **({"repeat": {"count": [1, count, 1], "step": [0, across, 0]}} if row else {})))
    total = rows * (rows + 1) // 2
    first, last = (0 - rows / 2) * along, (rows - 1 - rows / 2) * along
    write("chain-reaction",
          f"One push fells {total} dominoes: each stands before the gap of the two behind it and takes both along, so that row "
          "after row has one more. The front is straight, since all of a row are struck alike, and soon runs at one speed.",
          f"one push fells {total} dominoes, one more in every row",
          {"floor": PLANKS, "wood": {"staticFriction": 0.3, "dynamicFriction": 0.25, "density": 700, "surface": "wood"}},
          bodies, {"main": {"keyframes": [
              {"time": 0, "eye": [first - 2.6, -2.9, 1.9], "target": [first + 1.0, 0.1, 0.25], "fovDegrees": 38},
              {"time": 2.2, "eye": [first - 2.4, -5.4, 4.0], "target": [first + 3.4, 0.2, 0.1], "fovDegrees": 38},
              {"time": 4.6, "eye": [-2.6, -11.6, 7.0], "target": [0.5, -0.5, 0.0], "fovDegrees": 38}]}}, 5.4, FOLDER, 120, group="large",
          light={"direction": [-0.7, -0.6, 0.9]},
          lookFor="The front stays straight and keeps one speed, however wide it is; the last row falls on the floor at full length.",
          caption=f"1 + 2 + … + {rows} = {total} dominoes by one push   t = {{=time:1}} s")


def rockslide(count=220):
    """Stones behind a dam of planks on a mountain's flank; the dam is drawn aside, and a hamlet of crates stands below."""
    slope, long, wide = 35.0, 17.0, 9.0
    a = math.radians(slope)
    s, c = math.sin(a), math.cos(a)
    toe = 2.0
    bodies = [floor(), body("flank", {"hull": {"points": [[toe, -wide / 2, 0], [toe, wide / 2, 0]] + [
        [toe - long * c, y, z] for y in (-wide / 2, wide / 2) for z in (0, long * s)]}}, [0, 0, 0], static=True, material="rock")]
    along = lambda d, h, y: [toe - d * c + h * s, y, d * s + h * c]
    lean = turn([0, 1, 0], slope)
    for side in (-1, 1):
        bodies.append(body(f"{'near' if side < 0 else 'far'} ridge", {"box": [long, 0.5, 1.4]}, along(long / 2, 0.3, side * (wide / 2 + 0.26)),
                           rotation=lean, static=True, material="rock"))
    dam = along(10.4, 1.05, 0)
    away = [dam[0] + s * 3.2, 0, dam[2] + c * 3.2]
    bodies.append({"name": "dam", "shape": {"box": [0.25, wide - 0.1, 2.0]}, "material": "wood", "kinematic": {"keyframes": [
        {"time": 0, "position": dam, "rotation": lean}, {"time": 0.4, "position": dam, "rotation": lean},
        {"time": 0.7, "position": away, "rotation": lean}]}})
    # Boulders that stand fast and part the stream.
    for k, (d, y, fit) in enumerate(((6.6, -1.6, 1.9), (5.4, 1.9, 2.2), (3.2, -0.2, 1.7))):
        bodies.append(body(f"boulder {k + 1}", {"hull": {"file": "meshes/icosahedron.off", "fit": fit}}, along(d, 0.35, y),
                           rotation=turn([1, 2, k], 40 * k + 15), static=True, material="rock"))
    rng = random.Random(7)
    shapes = [("gem", "meshes/gem.obj", 0.56), ("stone", "meshes/dodecahedron.ply", 0.54), ("rock", "meshes/icosahedron.off", 0.52)]
    stones = ["#c9c3b8", "#a9bcc9", "#d9b58c", "#b7a7c4", "#9fb59a"]
    number = 0
    for layer in range(12):
        for row in range(8):
            for k in range(12):
                if number >= count:
                    break
                name, file, fit = shapes[number % 3]
                bodies.append(body(f"{name} {number + 1}", {"hull": {"file": file, "fit": fit}},
                                   along(11.0 + 0.66 * row + rng.uniform(-0.02, 0.02), 0.36 + 0.66 * layer,
                                         (k - 5.5) * 0.7 + rng.uniform(-0.02, 0.02)),
                                   rotation=turn([rng.uniform(-1, 1), rng.uniform(-1, 1), 0.5], rng.uniform(0, 90)),
                                   material="stone", color=stones[number * 3 % 5]))
                number += 1
    # Four huts: walls of two crates, a lid across.
    for k, (x, y) in enumerate(((3.7, -2.4), (4.3, 0.2), (3.5, 2.7))):
        for side in (-1, 1):
            bodies.append(body(f"hut {k + 1}, {'near' if side < 0 else 'far'} crate", {"box": [0.9, 0.7, 0.9]},
                               [x, y + 0.55 * side, 0.4509], material="wood", color=CANDY[2 * k]))
        bodies.append(body(f"hut {k + 1}, roof", {"box": [1.1, 2.0, 0.16]}, [x, y, 0.9829], material="wood", color=RED))
    write("rockslide",
          f"{count} stones lie behind a dam on a flank of {slope:.0f} degrees, steeper than their friction holds; the dam is drawn, and "
          "they come down between boulders, over three huts, and spread on the sand. The front stops first.",
          f"{count} stones come down a mountain's flank over boulders and huts",
          {"floor": SAND, "rock": {"staticFriction": 0.3, "surface": "concrete", "color": "#6a6763"},
           "wood": {"staticFriction": 0.4, "density": 500, "surface": "wood"},
           "stone": {"staticFriction": 0.35, "restitution": 0.1, "density": 2400, "surface": "marble"}},
          bodies, {"main": {"keyframes": [
              {"time": 0, "eye": [8.5, -10.5, 9.4], "target": [-7.2, 0, 6.3], "fovDegrees": 26},
              {"time": 1.4, "eye": [10.5, -10.5, 6.6], "target": [-3.4, 0, 3.6], "fovDegrees": 34},
              {"time": 3.4, "eye": [11.6, -8.6, 4.9], "target": [2.4, 0, 0.7], "fovDegrees": 40}]}}, 5, FOLDER, 60, group="large",
          light={"direction": [0.9, -0.6, 0.8]},
          lookFor="Boulders part the stream; the huts ride on the front until it stops, while the tail still comes down.",
          caption=f"{count} stones   tan 35° = {{=tan(35):2}} against μ = {{=sqrt(0.3*0.35):2}}   the near hut's roof has moved {{body:hut 1, roof.moved:2}} m")


def main():
    for scene in (chain_reaction, rockslide):
        scene()


if __name__ == "__main__":
    main()
