#!/usr/bin/env python3
"""Makes fourteen scenes of impulses and friction in assets/scenes/, the same bytes on every run.

Usage: python3 assets/make_scenes.py [FOLDER]        (needs nothing but Python 3)

Each function below is one scene: its set-up, and in the comment that opens the file what theory says of it.
The other scenes of the folder are written by hand.
"""

import json
import math
import sys
import textwrap
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "scenes"
GRAVITY = 9.81

BLUE, ORANGE, GREEN, YELLOW = "#0072b2", "#e69f00", "#009e73", "#f0e442"
SKY, RED, PINK, STEEL, SLATE = "#56b4e9", "#d55e00", "#cc79a7", "#8e9aa6", "#5f6b76"
FLOOR = {"staticFriction": 0.6, "color": "#d6d3cc", "checker": True}
CONCRETE, PLANKS, SAND = ({"staticFriction": 0.6, "ground": name} for name in ("concrete", "planks", "sand"))


def rounded(value, digits=9):
    """Numbers as short as they can be written, everywhere inside a value; -0 becomes 0."""
    if isinstance(value, float):
        value = round(value, digits) + 0.0
        return int(value) if value == int(value) else value
    if isinstance(value, (list, tuple)):
        return [rounded(v, digits) for v in value]
    if isinstance(value, dict):
        return {k: rounded(v, digits) for k, v in value.items()}
    return value


def line(value):
    """One line of JSON with blanks inside braces, as the scenes written by hand have it."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)}: {line(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(line(v) for v in value) + "]"
    return json.dumps(value)


def body(name, shape, position, **rest):
    return {"name": name, "shape": shape, "position": position, **rest}


def floor(**rest):
    return body("floor", {"box": [60, 60, 1]}, [0, 0, -0.5], static=True, material="floor", **rest)


def turn(axis, degrees):
    return {"axis": axis, "degrees": degrees}


ABOUT = ("group", "lookFor", "caption")  # after the description; what else is given stands before the materials


def write(name, theory, description, materials, bodies, cameras, duration, folder, rate=240, **more):
    """`theory` opens the file as a comment; strings among the bodies are comments, too; `more` are other keys of the
    scene."""
    text = "".join(f"// {row}\n" for row in textwrap.wrap(theory, 107))
    text += f'{{\n  "format": 1,\n  "description": {json.dumps(description, ensure_ascii=False)},\n'
    for key in ABOUT:
        if key in more:
            text += f'  "{key}": {json.dumps(more[key], ensure_ascii=False)},\n'
    text += f'  "rate": {rate},\n  "duration": {json.dumps(duration)},\n'
    for key, value in more.items():
        if key not in ABOUT:
            text += f'  "{key}": {line(rounded(value))},\n'
    rows = [f"    {json.dumps(k)}: {line(rounded(v))}" for k, v in materials.items()]
    text += '  "materials": {\n' + ",\n".join(rows) + '\n  },\n  "bodies": [\n'
    last = max(i for i, b in enumerate(bodies) if not isinstance(b, str))
    for i, b in enumerate(bodies):
        text += f"    // {b}\n" if isinstance(b, str) else f"    {line(rounded(b))}{',' if i < last else ''}\n"
    rows = [f"    {json.dumps(k)}: {line(rounded(v))}" for k, v in cameras.items()]
    text += '  ],\n  "cameras": {\n' + ",\n".join(rows) + "\n  }\n}\n"
    (folder / f"{name}.json").write_text(text)


def main_camera(eye, target, fov):
    return {"main": {"eye": eye, "target": target, "fovDegrees": fov}}


def moving_camera(fov, *keys):
    """`keys` are time, eye and target."""
    return {"main": {"keyframes": [{"time": time, "eye": eye, "target": target, "fovDegrees": fov} for time, eye, target in keys]}}


def prism_points(sides, radius, height):
    """A regular prism about y, a flat side down."""
    points = []
    for y in (-height / 2, height / 2):
        for k in range(sides):
            angle = 2 * math.pi * (k + 0.5) / sides - math.pi / 2
            points.append([round(radius * math.cos(angle), 9), y, round(radius * math.sin(angle), 9)])
    return points


def cradle(folder):
    """Three troughs with buffers at both ends; one, two and three balls strike the rest of five."""
    radius, gap, rail = 0.25, 0.0005, 0.06
    bodies = [floor()]
    lanes = [("one", 1, -1.5), ("two", 2, 0.0), ("three", 3, 1.5)]
    half_length = 3.0
    for name, striking, y in lanes:
        bodies.append(f"The trough in which {name} of five strike" + ("s." if striking == 1 else "."))
        # Two planks at 45 degrees: their upper faces meet below the balls' centres, `root` high.
        root, wide = 0.2, 0.5
        for side, sign in (("near", -1), ("far", 1)):
            a = math.radians(45)
            along = (sign * math.cos(a), math.sin(a))
            normal = (-sign * math.sin(a), math.cos(a))
            centre = [0, y + (wide / 2) * along[0] - rail / 2 * normal[0] + sign * 0.001,
                      root + (wide / 2) * along[1] - rail / 2 * normal[1]]
            bodies.append(body(f"{name}, {side} plank", {"box": [2 * half_length, wide, rail]}, centre,
                               rotation=turn([1, 0, 0], sign * 45), static=True, material="trough"))
        # At the gap of lasting contact over both planks, so that no ball bounces.
        height = root + math.sqrt(2) * (radius + 0.001 * rail) - 0.001
        for side, sign in (("left", -1), ("right", 1)):
            bodies.append(body(f"{name}, {side} buffer", {"box": [0.15, 0.6, 0.6]},
                               [sign * (half_length + 0.075), y, 0.301], static=True, material="trough",
                               color=SLATE))
        pitch = 2 * radius + gap
        for k in range(5):
            moving = k < striking
            x = (k - 2) * pitch - (1.5 if moving else 0.0)
            colors = [RED, ORANGE, YELLOW, GREEN, BLUE]
            extra = {"linearVelocity": [2.5, 0, 0]} if moving else {}
            bodies.append(body(f"{name}, ball {k + 1}", {"sphere": {"radius": radius}}, [x, y, height],
                               material="steel", color=colors[k], **extra))
    write("cradle",
          "Newton's cradle without strings: five balls in a trough without friction, elastic as their "
          "buffers. One ball in, one ball out; two in, two out; three in, three out (energy and "
          "momentum leave no other way when the blow runs through the row from pair to pair). The "
          "buffers send them back for the next blow.",
          "one, two and three of five elastic balls strike the others, again and again",
          {"floor": FLOOR,
           "trough": {"staticFriction": 0, "restitution": 1, "density": 700, "color": "#b9c1c8"},
           "steel": {"staticFriction": 0, "restitution": 1, "density": 7800, "surface": "steel"}},
          bodies, main_camera([2.0, -7.9, 3.7], [0.05, -0.1, 0.3], 27), 8, folder,
          group="accuracy beside theory",
          lookFor="As many balls leave as have come, with the same speed.",
          caption="elastic: energy kept to {=100*energy/E0:4} %",
          set={"E0": 51133.66})


def overhang(folder):
    """Two stacks of eight blocks whose offsets are 0.99 and 1.01 of the harmonic series' L/2k."""
    length, width, height, count = 1.6, 0.5, 0.2, 8
    table = 1.4
    gap = 0.0002
    colors = [BLUE, SKY, GREEN, YELLOW, ORANGE, RED, PINK, STEEL]
    bodies = [floor()]
    for name, factor, side in (("standing", 0.99, -1), ("falling", 1.01, 1)):
        bodies.append(f"{factor} of the limit.")
        bodies.append(body(f"{name} table", {"box": [2.4, 0.9, table]}, [side * 1.3, 0, table / 2],
                           static=True,
                           material="table"))
        edge, z = 2.5, table + gap
        for k in range(count, 0, -1):
            edge += factor * length / (2 * k)
            bodies.append(body(f"{name} block {k}", {"box": [length, width, height]},
                               [side * (edge - length / 2), 0, z + height / 2], material="oak",
                               color=colors[k - 1]))
            z += height + gap
    write("overhang",
          "The harmonic overhang: of eight blocks, block k from the top reaches L/2k beyond the one "
          "below, 1.36 L in all, and every stack of k blocks balances on its edge. With 0.99 of that "
          "the stack stands, with 1.01 it falls.",
          "eight blocks 1 % short of the greatest overhang stand; 1 % beyond it they fall",
          {"floor": FLOOR, "table": {"staticFriction": 0.7, "color": SLATE},
           "oak": {"staticFriction": 0.7, "density": 700, "surface": "wood"}},
          bodies, main_camera([1.4, -11.0, 2.9], [0.35, 0, 1.1], 30), 3.6, folder,
          group="sliding and resting",
          lookFor="One stack in a hundred short of the limit stands, one in a hundred beyond it falls.",
          caption="L/2(1 + 1/2 + … + 1/8) = 1.36 L   99 % of it moved {=1000*[standing block 1.moved]:2} "
                  "mm, 101 % {body:falling block 1.moved:2} m")


def arch(folder):
    """Two semicircular arches of equal voussoirs, 0.12 and 0.09 of the mean radius thick."""
    radius, depth, count, gap = 2.0, 0.8, 21, 0.0002
    bodies = [floor()]
    colors = [ORANGE, RED, YELLOW]
    cool = [BLUE, SKY, GREEN]
    for name, ratio, y, palette in (("standing", 0.12, 0.9, cool), ("falling", 0.09, -0.9, colors)):
        thick = ratio * radius
        bodies.append(f"t/R = {ratio}.")
        for k in range(count):
            middle = math.pi * (k + 0.5) / count
            half = math.pi / count / 2
            points = []
            for yy in (-depth / 2, depth / 2):
                for r in (radius - thick / 2, radius + thick / 2):
                    for sign in (-1, 1):
                        along = r * math.sin(half) - gap / 2
                        points.append([r * math.cos(half) - radius, yy, sign * along])
            bodies.append(body(f"{name} stone {k + 1}", {"hull": {"points": points}},
                               [radius * math.cos(middle), y, radius * math.sin(middle) + gap],
                               rotation=turn([0, 1, 0], -math.degrees(middle)), material="stone",
                               color=palette[k % len(palette)]))
    write("arch",
          "Semicircular arches without mortar: one of mean radius R stands under its own weight if its "
          "thickness t is at least 0.1075 R (Milankovitch). The far one has 0.12 R; the near one has "
          "0.09 R and opens at five hinges.",
          "an arch of stones thick enough to stand, and one that is too thin",
          {"floor": {**FLOOR, "staticFriction": 0.9}, "stone": {"staticFriction": 0.9, "density": 2400}},
          bodies, main_camera([1.7, -7.6, 1.9], [0.05, 0, 0.98], 31), 2, folder,
          group="accuracy beside theory",
          lookFor="The thick arch stands, the thin one opens at five hinges.",
          caption="an arch stands if t/R ≥ 0.1075: 0.12 has moved {=1000*[standing stone 11.moved]:2} mm, "
                  "0.09 {body:falling stone 11.moved:2} m")


def card_house(folder):
    """Three storeys of leaning cards; a ball comes when they have stood for a while."""
    high, wide, thick, lean, gap = 0.9, 0.62, 0.016, 20.0, 0.00002
    a = math.radians(lean)
    rise = high * math.cos(a) + thick * math.sin(a)
    # A card leans with its upper inner edge in the middle plane, half a gap away from the other's.
    reach = high / 2 * math.sin(a) - thick / 2 * math.cos(a)
    half = reach + thick * math.cos(a) + gap / 2
    spacing = 0.78
    bodies, colors = [floor()], [RED, BLUE, ORANGE, GREEN, PINK, SKY]
    z, number = gap, 0
    for storey in range(3):
        pairs = 3 - storey
        bodies.append(f"Storey {storey + 1}.")
        for p in range(pairs):
            x = (p - (pairs - 1) / 2) * spacing
            for side, sign in (("left", -1), ("right", 1)):
                bodies.append(body(f"storey {storey + 1}, pair {p + 1}, {side} card",
                                   {"box": [thick, wide, high]},
                                   [x + sign * half, 0, z + rise / 2], rotation=turn([0, 1, 0], -sign * lean),
                                   material="card", color=colors[number % len(colors)]))
            number += 1
        z += rise + gap
        for p in range(pairs - 1):
            x = (p - (pairs - 2) / 2) * spacing
            bodies.append(body(f"floor {storey + 1}, card {p + 1}", {"box": [spacing - 0.002, wide, thick]},
                               [x, 0, z + thick / 2], material="card", color="#f4f1ea"))
        z += thick + gap
    flight, speed = 0.6, 5.0
    bodies.append(f"A ball that arrives after {flight} s.")
    bodies.append(body("ball", {"sphere": {"radius": 0.16}}, [-1.2 - speed * flight, -0.05, 0.1602],
                       linearVelocity=[speed, 0, 0], material={"staticFriction": 0, "density": 2500},
                       color=YELLOW))
    write("card-house",
          "A house of cards: pairs that lean by 20 degrees need friction of about tan 20 = 0.36 "
          "at their feet; they have 0.7. It stands by friction alone until a ball knocks its feet away.",
          "a card house of three storeys stands by friction alone until a ball comes",
          {"floor": {**FLOOR, "staticFriction": 0.7}, "card": {"staticFriction": 0.7, "density": 700}},
          bodies, main_camera([1.7, -5.8, 2.0], [0.1, 0, 0.98], 32), 2.4, folder,
          group="many contacts",
          lookFor="Friction alone holds it, until the ball takes the feet away.",
          caption="cards at 20° need μ ≈ tan 20° = {=tan(20):2} at their feet and have 0.70   the top card: "
                  "{body:storey 3, pair 1, left card.z:2} m")


def dominoes(folder):
    """Two rows of the same shape, one four times the other; its wave runs twice as fast."""
    bodies = [floor()]
    for name, scale, count, y, x0, colors in (
            ("small", 1.0, 42, -1.3, -4.4, [YELLOW, ORANGE, RED, PINK]),
            ("large", 4.0, 14, 0.8, -4.9, [BLUE, SKY, GREEN, STEEL])):
        high, wide, thick, pitch = 0.4 * scale, 0.2 * scale, 0.07 * scale, 0.18 * scale
        gap = 0.001 * thick
        bodies.append(f"{count} {name} ones; the first is pushed.")
        rate = 1.6 / math.sqrt(scale)
        # Turning about its lower front edge.
        bodies.append(body(f"{name} first", {"box": [thick, wide, high]}, [x0, y, high / 2 + gap],
                           linearVelocity=[rate * high / 2, 0, rate * thick / 2],
                           angularVelocity=[0, rate, 0],
                           material="domino", color=colors[-1]))
        bodies.append(body(f"{name}", {"box": [thick, wide, high]}, [x0 + pitch, y, high / 2 + gap],
                           material="domino", color=colors,
                           repeat={"count": [count - 1, 1, 1], "step": [pitch, 0, 0]}))
    write("dominoes",
          "Two rows of dominoes, one four times as large as the other in everything. The wave's speed "
          "grows with the square root of g times the size, so the large row's is twice the small one's.",
          "rows of dominoes at two scales; the one four times as large runs twice as fast",
          {"floor": FLOOR, "domino": {"staticFriction": 0.3, "dynamicFriction": 0.2, "density": 900}},
          bodies, main_camera([2.2, -11.4, 3.5], [0.55, -0.1, 0.35], 29), 4.2, folder,
          group="accuracy beside theory",
          lookFor="The row four times as large is twice as fast.",
          caption="waves grow with √(g·size): four times as large, {=sqrt(4):0} times as fast")


def rocking_block(folder):
    """Three 1 x 4 blocks of different size, let go at four fifths of the angle at which they balance."""
    bodies = [floor()]
    alpha = math.degrees(math.atan(0.25))
    for name, high, x, color in (("small", 1.0, -1.5, YELLOW), ("middle", 1.7, -0.1, GREEN),
                                 ("large", 2.4, 1.8, BLUE)):
        wide = high / 4
        tilt = math.radians(0.8 * alpha)
        gap = 0.001 * wide
        # About the lower right edge, which stays at x + wide / 2.
        cx = x + wide / 2 - wide / 2 * math.cos(tilt) + high / 2 * math.sin(tilt)
        cz = gap + wide / 2 * math.sin(tilt) + high / 2 * math.cos(tilt)
        bodies.append(body(f"{name} block", {"box": [wide, wide * 1.6, high]}, [cx, 0, cz],
                           rotation=turn([0, 1, 0], math.degrees(tilt)), material="stone", color=color))
    write("rocking-block",
          "Blocks of 1 x 4 rock on their edges. Each time the edge changes, Housner's factor of their "
          "energy is left, (1 - 3/2 sin^2 a)^2 = 0.8313 with tan a = 1/4, whatever their size; small "
          "ones rock faster.",
          "slender blocks of three sizes rock from edge to edge until they stand",
          {"floor": {**FLOOR, "staticFriction": 0.9}, "stone": {"staticFriction": 0.9, "density": 2000}},
          bodies, main_camera([0.9, -7.6, 1.9], [0.15, 0, 0.85], 29), 6, folder,
          group="sliding and resting",
          lookFor="Small blocks rock faster, but each loses the same share of its energy at an impact.",
          caption="each impact leaves (1 − ³⁄₂ sin² α)² = {=(1-1.5*sin(14.036)^2)^2:3} of the energy   "
                  "tilts {body:small block.tilt:1}°, {body:middle block.tilt:1}°, {body:large block.tilt:1}°")


def rolling_race(folder):
    """Five lanes down 12 degrees: a block without friction, a ball, a capsule and two prisms."""
    slope, length = math.radians(12), 9.0
    s, c = math.sin(slope), math.cos(slope)
    toe = [4.0, 0.0]
    top = [toe[0] - length * c, toe[1] + length * s]
    bodies = [floor(), body("incline", {"hull": {"points": [
        [toe[0], -2.9, 0], [toe[0], 2.9, 0], [top[0], -2.9, 0], [top[0], 2.9, 0],
        [top[0], -2.9, top[1]], [top[0], 2.9, top[1]]]}}, [0, 0, 0], static=True, material="ramp")]
    r = 0.3
    start = 1.0
    racers = [("ice block", {"box": [0.8, 0.6, 0.45]}, 0.225, -2.2, "ice", SKY, turn([0, 1, 0], 12)),
              ("ball", {"sphere": {"radius": r}}, r, -1.1, "rubber", RED, None),
              ("prism of 48 sides", {"hull": {"points": prism_points(48, r, 0.7)}},
               r * math.cos(math.pi / 48), 0.0,
               "rubber", YELLOW, turn([0, 1, 0], 12)),
              ("capsule", {"capsule": {"radius": r, "length": 0.4}}, r, 1.1, "rubber", GREEN,
               turn([1, 0, 0], 90)),
              ("prism of 12 sides", {"hull": {"points": prism_points(12, r, 0.7)}},
               r * math.cos(math.pi / 12), 2.2,
               "rubber", PINK, turn([0, 1, 0], 12 + 15.5))]
    for name, shape, height, y, material, color, rotation in racers:
        h = height + 0.0006
        if name.endswith("12 sides"):
            h = r + 0.0006
        position = [top[0] + start * c + h * s, y, top[1] - start * s + h * c]
        extra = {"rotation": rotation} if rotation else {}
        bodies.append(body(name, shape, position, material=material, color=color, **extra))
    write("rolling-race",
          "Down 12 degrees: a block without friction with g sin a = 2.04 m/s^2, a ball with 5/7 of "
          "that, a capsule and prisms with a little more than 2/3, less what each edge of a prism "
          "costs.",
          "a sliding block, a ball, a capsule and prisms race down an incline",
          {"floor": CONCRETE, "ramp": {"staticFriction": 0.6, "surface": "wood", "color": "#a98a66", "surfaceScale": 2},
           "ice": {"staticFriction": 0, "density": 900, "surface": "marble"},
           "rubber": {"staticFriction": 0.6, "density": 1100, "surface": "marble", "surfaceScale": 0.5}},
          bodies, moving_camera(34, (0, [0.6, -6.2, 3.7], [-2.9, -0.2, 1.3]), (1.2, [1.8, -6.6, 3.5], [-1.9, -0.2, 1.0]),
                                (3, [6.6, -6.6, 3.3], [1.6, -0.4, 0.4])), 3.1, folder,
          group="accuracy beside theory",
          lookFor="The block without friction wins; edges cost the prism of 12 sides most.",
          caption="½at²: ice {=0.5*9.81*sin(12)*time^2:2}, ball ⁵⁄₇ of it {=5/14*9.81*sin(12)*time^2:2} m   "
                  "measured {body:ice block.moved:2}, {body:ball.moved:2} m")


def rolling_stop(folder):
    """Equal balls roll out on three lanes, to posts where theory stops them; two tops spin beside them."""
    radius, speed, gap = 0.3, 2.4, 0.0001  # the rest gap on a lane 0.1 thick
    thick, lift, start = 0.1, 0.0005, -3.2
    lane_top = lift + thick
    bodies = [floor()]
    materials = {"floor": FLOOR, "post": {"color": "#3b4148"}}
    lanes = (("ice", 0.02, 2.2, SKY, "#cfe0ea"), ("cork", 0.04, 0.9, ORANGE, "#d9bf94"),
             ("felt", 0.08, -0.4, RED, "#7d9c83"))
    for name, lever, y, color, lane_color in lanes:
        # The pair's lever is the geometric mean of both.
        materials[name] = {"staticFriction": 0.6, "rollingResistance": lever, "density": 900}
        way = speed ** 2 / (2 * 5 / 7 * GRAVITY * lever / radius)
        bodies.append(body(f"{name} lane", {"box": [8.2, 1.0, thick]}, [0.3, y, lift + thick / 2],
                           static=True, material=name, color=lane_color))
        bodies.append(body(f"{name} ball", {"sphere": {"radius": radius}},
                           [start, y, lane_top + radius + gap],
                           linearVelocity=[speed, 0, 0], angularVelocity=[0, speed / radius, 0],
                           material=name, color=color))
        for side, sign in (("near", -1), ("far", 1)):
            bodies.append(body(f"{side} post of {name}", {"box": [0.06, 0.06, 0.55]},
                               [start + way, y + sign * 0.42, lane_top + 0.276],
                               static=True, material="post"))
    materials["glass"] = {"staticFriction": 0.6, "density": 900}
    materials["leather"] = {"staticFriction": 0.6, "spinningResistance": 0.012, "density": 900}
    bar = {"shape": {"capsule": {"radius": 0.09, "length": 1.2}}, "rotation": turn([0, 1, 0], 90)}
    top = {"compound": [{"shape": {"sphere": {"radius": radius}}}, bar]}
    for name, x, color, plate in (("glass", -1.6, GREEN, "#dfe9e4"), ("leather", 1.2, YELLOW, "#a98467")):
        bodies.append(body(f"{name} plate", {"box": [2.0, 2.0, thick]}, [x, -2.3, lift + thick / 2],
                           static=True, material=name, color=plate))
        bodies.append(body(f"top on {name}", top, [x, -2.3, lane_top + radius + gap],
                           angularVelocity=[0, 0, 9], material=name, color=color))
    write("rolling-stop",
          "Balls of radius r = 0.3 m with 2.4 m/s and rolling resistances c of 2, 4 and 8 cm lose "
          "5/7 g c / r and stop between their posts, after 6.2, 3.1 and 1.5 m. Of two tops, the one on "
          "leather (spinning resistance 1.2 cm) comes to a stop, the one on glass spins on.",
          "balls roll out at three distances, one of two tops stops",
          materials, bodies, main_camera([4.6, -7.4, 4.7], [0.35, -0.45, 0.0], 33), 6, folder,
          group="sliding and resting",
          lookFor="Every ball stops between the posts that theory has put up for it.",
          caption="stop after v²/(2·⁵⁄₇ g c/r): {=2.4^2/2/(5/7*9.81*0.02/0.3):2}, "
                  "{=2.4^2/2/(5/7*9.81*0.04/0.3):2}, {=2.4^2/2/(5/7*9.81*0.08/0.3):2} m   gone: {body:ice "
                  "ball.moved:2}, {body:cork ball.moved:2}, {body:felt ball.moved:2} m")


def spinning_coin(folder):
    """Coins of 120 sides: one spins upright, one rolls in a circle, one wobbles like Euler's disk."""
    radius, thick = 0.5, 0.08
    points = prism_points(120, radius, thick)
    shape = {"hull": {"points": points}}
    gap = 0.0004
    bodies = [floor()]
    tilt = 13.0
    a = math.radians(tilt)
    low = radius * math.cos(a) + thick / 2 * math.sin(a)
    bodies.append(body("spinning coin", shape, [-1.7, 0, low + gap], rotation=turn([1, 0, 0], tilt),
                       angularVelocity=[0, 0, 7], material="brass", color=ORANGE))
    # Euler's disk at the angle theta of its face to the floor: it goes round at rate^2 = 4 g / (r sin theta).
    theta = math.radians(35)
    rate = math.sqrt(4 * GRAVITY / (radius * math.sin(theta)))
    t = math.degrees(math.pi / 2 - theta)
    # Its angular velocity lies along the diameter that goes down to the contact.
    down = [0.0, -math.cos(theta), -math.sin(theta)]
    spin = rate * math.sin(theta)
    height = radius * math.sin(theta) + thick / 2 * math.cos(theta) + gap
    bodies.append(body("wobbling coin", shape, [0.1, 0, height], rotation=turn([1, 0, 0], -t),
                       angularVelocity=[0, -spin * down[1], -spin * down[2]], material="brass", color=SKY))
    speed = 1.8
    bodies.append(body("rolling coin", shape, [2.6, 2.3, radius * math.cos(math.radians(14)) + thick / 2 *
                                               math.sin(math.radians(14)) + gap],
                       rotation=turn([1, 0, 0], 14), linearVelocity=[-speed, 0, 0],
                       angularVelocity=[0, -speed / radius, 0], material="brass", color=RED))
    write("spinning-coin",
          "Coins, prisms of 120 sides. One spins upright and sinks, one wobbles like Euler's disk, "
          "faster and faster until it lies, and one rolls along a curve. Edges take the place of the "
          "round rim, so all lose energy as they go.",
          "coins spin, wobble and roll on their rims until they lie flat",
          {"floor": FLOOR, "brass": {"staticFriction": 0.4, "density": 8500}},
          bodies, main_camera([0.8, -4.9, 2.1], [0.1, 0.1, 0.25], 33), 7, folder,
          group="accuracy beside theory",
          lookFor="The wobbling coin rings faster and faster until it lies, as Euler's disk does.",
          caption="Euler's disk goes round at √(4g/(r sin θ)): {=sqrt(4*9.81/(0.5*sin(35))):1} rad/s at "
                  "35°   tilts: {=abs(90-[wobbling coin.tilt]):0}°")


def stick_slip_ramp(folder):
    """Blocks on 25 degrees with friction around the slope, and two that differ in a push only."""
    degrees = 25.0
    a = math.radians(degrees)
    slope, length = math.tan(a), 7.0
    s, c = math.sin(a), math.cos(a)
    toe = 3.0
    top = [toe - length * c, length * s]
    bodies = [floor(), body("incline", {"hull": {"points": [
        [toe, -3.6, 0], [toe, 3.6, 0], [top[0], -3.6, 0], [top[0], 3.6, 0],
        [top[0], -3.6, top[1]], [top[0], 3.6, top[1]]]}}, [0, 0, 0], static=True, material="ramp")]
    materials = {"floor": PLANKS, "ramp": {"staticFriction": 1, "surface": "concrete", "color": "#9a9c9e"}}

    def place(name, y, material, color, **extra):
        h = 0.15 + 0.0003
        start = 1.3
        bodies.append(body(name, {"box": [0.8, 0.6, 0.3]},
                           [top[0] + start * c + h * s, y, top[1] - start * s + h * c],
                           rotation=turn([0, 1, 0], degrees), material=material, color=color, **extra))

    for k, (factor, color) in enumerate(((0.9, RED), (0.97, ORANGE), (0.99, YELLOW), (1.001, GREEN),
                                         (1.01, SKY))):
        # The pair's coefficient is the geometric mean of both.
        materials[f"{factor} of tan a"] = {"staticFriction": (factor * slope) ** 2, "density": 800, "surface": "wood"}
        place(f"block of {factor}", -3.0 + k, f"{factor} of tan a", color)
    materials["holds, but slides on"] = {"staticFriction": (1.05 * slope) ** 2,
                                         "dynamicFriction": (0.9 * slope) ** 2,
                                         "density": 800, "surface": "wood"}
    bodies.append("Both have 1.05 of the slope while they stick, 0.9 while they slide; one is pushed.")
    place("left alone", 2.0, "holds, but slides on", BLUE)
    place("pushed", 3.0, "holds, but slides on", PINK, linearVelocity=[0.3 * c, 0, -0.3 * s])
    write("stick-slip-ramp",
          "Stick and slip on 25 degrees: friction coefficients of 0.9, 0.97, 0.99, 1.001 and 1.01 times"
          " tan 25; the first three slide with g (sin a - mu cos a), the other two never move.",
          "blocks just above and just below the friction that holds them on a ramp",
          materials, bodies, moving_camera(36, (0, [2.4, -6.0, 4.9], [-1.9, 0.1, 1.9]), (1.2, [2.6, -6.0, 4.7], [-1.7, 0, 1.7]),
                                           (3.3, [4.6, -6.3, 4.0], [-0.4, -0.5, 1.0])), 3.4, folder,
          group="sliding and resting",
          lookFor="The three below tan 25° slide, the three above stay; one that would stay slides on "
                  "because it was pushed.",
          caption="½g(sin α − μ cos α)t² with μ = 0.90 tan 25°: "
                  "{=0.5*9.81*(sin(25)-0.9*tan(25)*cos(25))*time^2:2} m   measured {body:block of "
                  "0.9.moved:2} m; with 1.001 tan 25°: {body:block of 1.001.moved:2} m")


def heavy_on_light(folder):
    """Bodies of tonnes laid on boxes of kilograms and on four legs, and one dropped."""
    bodies = [floor()]
    light, heavy = {"material": "cork"}, {"material": "lead"}
    bodies.append("Laid on each other: 2 kg, 2 t, 2 kg.")
    z = 0.0005
    for k in range(3):
        bodies.append(body(f"column box {k + 1}", {"box": [0.7, 0.7, 0.5]}, [-2.0, 0.2, z + 0.25],
                           color=(YELLOW if k % 2 == 0 else SLATE), **(light if k % 2 == 0 else heavy)))
        z += 0.5005
    bodies.append("3 kg, and 307 kg from 1.5 m above.")
    bodies.append(body("light box", {"box": [0.8, 0.8, 0.6]}, [0, 0, 0.3006], color=ORANGE, **light))
    bodies.append(body("heavy box", {"box": [0.8, 0.8, 0.6]}, [0.05, -0.03, 2.4],
                       rotation=turn([0, 0, 1], 20),
                       material="stone", color=BLUE))
    bodies.append("A slab of a tonne on four legs of 0.4 kg, and a crate of 1 kg that falls on it.")
    bodies.append(body("leg", {"box": [0.25, 0.25, 0.8]}, [1.7, -0.45, 0.40025], color=GREEN, material="cork",
                       repeat={"count": [2, 2, 1], "step": [0.9, 0.9, 0]}))
    bodies.append(body("slab", {"box": [1.3, 1.3, 0.3]}, [2.15, 0, 0.9505], color=RED, material="slab"))
    bodies.append(body("crate", {"box": [0.5, 0.5, 0.5]}, [2.0, 0.1, 4.0], rotation=turn([1, 0.4, 0], 25),
                       angularVelocity=[1, 0.5, 0.3], color=PINK, **light))
    write("heavy-on-light",
          "Bodies a thousand times as heavy as the ones that carry them: nothing sinks in, nothing is "
          "squeezed out.",
          "heavy bodies laid and dropped on bodies up to 2500 times lighter",
          {"floor": FLOOR, "cork": {"staticFriction": 0.6, "density": 8},
           "lead": {"staticFriction": 0.6, "density": 8000}, "slab": {"staticFriction": 0.6, "density": 2000},
           "stone": {"staticFriction": 0.6, "density": 800}},
          bodies, main_camera([1.2, -6.9, 2.4], [0.15, 0, 0.9], 32), 1.8, folder,
          group="many contacts",
          lookFor="Nothing sinks in and nothing is squeezed out under up to 2500 times its weight.",
          caption="2 t between 2 kg, 307 kg on 3 kg, a tonne on four legs of 0.4 kg   the column has sunk "
                  "{=1000*(1.2515-[column box 3.z]):2} mm")


def pyramid(folder):
    """Twenty rows of boxes; a ball flies past and takes the top away."""
    rows, wide, high, gap = 20, 0.5, 0.3, 0.0003
    pitch = 0.53
    bodies = [floor()]
    colors = [BLUE, SKY, GREEN, YELLOW, ORANGE, RED, PINK]
    for r in range(rows):
        n = rows - r
        bodies.append(body(f"row {r + 1}", {"box": [wide, 0.5, high]},
                           [-(n - 1) / 2 * pitch, 0, gap + high / 2 + r * (high + gap)], material="brick",
                           color=colors[r % 7], repeat={"count": [n, 1, 1], "step": [pitch, 0, 0]}))
    speed, flight = 9.0, 0.7
    z_hit = gap + 17.6 * (high + gap)
    vz = GRAVITY * flight / 2
    bodies.append(f"A ball that reaches the eighteenth row after {flight} s.")
    bodies.append(body("ball", {"sphere": {"radius": 0.4}}, [-1.2 - speed * flight, -0.05, z_hit],
                       linearVelocity=[speed, 0, vz], material={"staticFriction": 0.2, "density": 3000},
                       color=SLATE))
    write("pyramid",
          "A pyramid of 210 boxes in twenty rows, at rest, until a ball takes its top away; the rest "
          "stays.",
          "a pyramid of 210 boxes, and a ball that takes its top away",
          {"floor": SAND, "brick": {"staticFriction": 0.6, "density": 700, "surface": "brick"}},
          bodies, main_camera([2.5, -15.5, 4.9], [-0.1, 0, 3.0], 31), 3.4, folder, 60,
          group="large",
          lookFor="The top goes, the rest of the 210 boxes stays as it was.",
          caption="210 boxes in 20 rows   the ball: {body:ball.speed:1} m/s")


def wall(folder, rows=11, columns=13):
    """A running bond with half bricks at the ends, and a ball."""
    long, wide, high, gap = 0.6, 0.3, 0.25, 0.00025
    joint = 0.002
    pitch = long + joint
    bodies = [floor()]
    full = columns * pitch
    shuffled = [RED, "#b5532d", "#d98a3d", "#c8622f", "#a9694a", RED, "#c8622f"]
    for r in range(rows):
        z = gap + high / 2 + r * (high + gap)
        odd = r % 2
        tones = shuffled[3 * r % 7:] + shuffled[:3 * r % 7]
        n = columns - odd
        x = -full / 2 + pitch / 2 + odd * pitch / 2
        bodies.append(body(f"row {r + 1}", {"box": [long, wide, high]}, [x, 0, z], material="brick",
                           color=tones,
                           repeat={"count": [n, 1, 1], "step": [pitch, 0, 0]}))
        if odd:
            half = (long - joint) / 2
            bodies.append(body(f"row {r + 1}, half", {"box": [half, wide, high]},
                               [-full / 2 + pitch / 4, 0, z], material="brick", color=tones[0],
                               repeat={"count": [2, 1, 1], "step": [full - pitch / 2, 0, 0]}))
    speed, flight = 9.0, 0.55
    bodies.append(f"A ball that arrives after {flight} s.")
    bodies.append(body("ball", {"sphere": {"radius": 0.4}}, [-0.1, -0.6 - speed * flight, 1.6],
                       linearVelocity=[1.0, speed, GRAVITY * flight / 2],
                       material={"staticFriction": 0.4, "density": 2000}, color=BLUE))
    count = sum(columns - r % 2 + 2 * (r % 2) for r in range(rows))
    write("wall",
          f"A wall of {count} bricks in running bond without mortar, and a ball.",
          f"a wall of {count} bricks without mortar, and a ball",
          {"floor": CONCRETE, "brick": {"staticFriction": 0.6, "density": 1800, "surface": "brick"}},
          bodies, main_camera([4.3, -8.6, 2.8], [0.1, 0.2, 1.05], 34), 3.2, folder, 120,
          group="large",
          lookFor="The ball punches a hole; the bricks above bridge it for a moment, then come down.",
          caption="198 bricks without mortar   the ball: {body:ball.speed:1} m/s")


def tower_hit(folder):
    """A tower of planks, three a storey, crosswise; a ball hits it below the middle."""
    long, wide, high, gap = 1.2, 0.39, 0.24, 0.00024
    bodies = [floor()]
    colors = [[ORANGE, YELLOW, SKY], [GREEN, RED, PINK]]
    storeys = 12
    for k in range(storeys):
        z = gap + high / 2 + k * (high + gap)
        across = k % 2
        size = [wide, long, high] if across else [long, wide, high]
        step = [0.4, 0, 0] if across else [0, 0.4, 0]
        start = [-0.4, 0, z] if across else [0, -0.4, z]
        count = [3, 1, 1] if across else [1, 3, 1]
        bodies.append(body(f"storey {k + 1}", {"box": size}, start, material="wood", color=colors[across],
                           repeat={"count": count, "step": step}))
    speed, flight = 12.0, 0.4
    bodies.append(body("ball", {"sphere": {"radius": 0.35}}, [-1.0 - speed * flight, -0.12, 1.9],
                       linearVelocity=[speed, 0, GRAVITY * flight / 2],
                       material={"staticFriction": 0.3, "density": 5000}, color=BLUE))
    write("tower-hit",
          "A tower of planks, three a storey and crosswise, stands until a ball hits it.",
          "a tower of planks is hit by a ball",
          {"floor": PLANKS, "wood": {"staticFriction": 0.5, "density": 600, "surface": "wood"}},
          bodies, main_camera([4.2, -8.0, 3.0], [0.75, 0, 1.35], 33), 2.8, folder,
          group="many contacts",
          lookFor="The ball goes through the middle; what stood above comes down where it was.",
          caption="36 planks   the ball: {body:ball.speed:1} m/s")


SCENES = [cradle, overhang, arch, card_house, dominoes, rocking_block, rolling_race, rolling_stop,
          spinning_coin, stick_slip_ramp,
          heavy_on_light, pyramid, wall, tower_hit]


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER
    for scene in SCENES:
        scene(folder)


if __name__ == "__main__":
    main()
