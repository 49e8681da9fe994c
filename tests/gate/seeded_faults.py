#!/usr/bin/env python3
"""Faults put into scenes, files and programs by seed, and what `carom compare` calls them.

    python3 tests/gate/seeded_faults.py CAROM [--count 200] [--seed 1] [--mutants FOLDER] [--out FOLDER]

For each fault a scene is rendered as it is (the golden frames) and with the fault, and compared. A fault is
  named    the first line names the body, or the part of the picture's making, that was touched
  wrong    it names another
  noted    the pictures are within the gate, and a note names the fault all the same
  passed   nothing is said
Every fault's twin, an unchanged run, must pass without a word. FOLDER of --mutants holds programs built from
changed sources, as tests/gate/build_mutants.sh makes them: light, shader, tone-map, solver. Prints a confusion
table by kind; exit code 1 when a fault passes or an equal run fails, or fewer than 19 of 20 are named or noted.
"""
import argparse
import copy
import json
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

SCENES = ["sliding", "resting", "fifty-bodies", "dominoes", "bouncing-ball", "tower-hit", "card-house", "boat",
          "crates-in-a-pool", "cradle", "drop-mesh", "multi-contact"]
ROOT = pathlib.Path(__file__).resolve().parents[2]
FRAMES = ["--portable", "--size", "320x180", "--fps", "2", "--duration", "1.5", "-q"]


def without_comments(text):
    return re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*|/\*.*?\*/', lambda m: m.group(1) or "", text, flags=re.S)


def read_scene(name):
    scene = json.loads(without_comments((ROOT / "assets/scenes" / (name + ".json")).read_text()))
    meshes = (ROOT / "assets/scenes").resolve()
    def resolve(value):
        if isinstance(value, dict):
            for key, inner in value.items():
                if key == "file" and isinstance(inner, str):
                    at = meshes / inner
                    value[key] = str(at if at.exists() else ROOT / "assets" / inner)
                else:
                    resolve(inner)
        elif isinstance(value, list):
            for inner in value:
                resolve(inner)
    resolve(scene)
    return scene


def run(words):
    return subprocess.run(words, capture_output=True, text=True)


class Unsuitable(Exception):
    """The scene has nothing for this fault, or cannot start with it."""


def movers(scene):
    return [b for b in scene["bodies"] if not b.get("static")]


def named(body):
    """What a message may call it: the body or one of its copies."""
    return re.compile(r"(?<!\w)" + re.escape(body["name"]) + r"(?!\w)")


def pick(random_, items):
    if not items:
        raise Unsuitable
    return random_.choice(items)


def moved_body(scene, rng):
    body = pick(rng, movers(scene))
    place = body.setdefault("position", [0, 0, 0])
    place[rng.choice([0, 1])] += rng.choice([-1, 1]) * rng.uniform(0.01, 0.05)
    place[2] += rng.uniform(0.0, 0.02)
    return [named(body), re.compile("starts")]


def material_fault(key, words, change):
    def fault(scene, rng):
        used = {m for m in (b.get("material") for b in movers(scene)) if isinstance(m, str)}
        names = [n for n in scene.get("materials", {}) if n in used]
        name = pick(rng, names)
        scene["materials"][name][key] = change(scene["materials"][name].get(key), rng)
        if key == "staticFriction":
            scene["materials"][name]["dynamicFriction"] = scene["materials"][name][key]
        return [words]
    return fault


def scaled(usual):
    return lambda old, rng: (usual if old is None else old) * rng.choice([0.5, 0.7, 1.4]) + 0.01


def restitution(old, rng):
    return 0.3 if (old or 0.0) > 0.6 else (old or 0.0) + 0.25


def missing_body(scene, rng):
    single = [b for b in movers(scene)]
    if len(single) < 2 and "repeat" not in (single or [{}])[0]:
        raise Unsuitable
    body = pick(rng, single)
    count = body.get("repeat", {}).get("count")
    words = [named(body), re.compile("missing|no longer")]
    if count and max(count) > 1:
        count[count.index(max(count))] -= 1
    else:
        scene["bodies"].remove(body)
    return words


def colour(scene, rng):
    body = pick(rng, movers(scene))
    body["color"] = "#%02x%02x%02x" % tuple(rng.randrange(20, 235) for _ in range(3))
    return [named(body), re.compile("color")]


def camera(scene, rng):
    cameras = scene.get("cameras", {})
    used = cameras.get("main") or (cameras[min(cameras)] if cameras else {})
    views = [used] if "eye" in used else []
    view = pick(rng, views)
    key = rng.choice(["eye", "target", "fovDegrees"])
    if key == "fovDegrees":
        view[key] = view.get(key, 40) * 1.03
    else:
        view[key][rng.randrange(3)] += rng.choice([-1, 1]) * rng.uniform(0.03, 0.2)
    return [re.compile("camera")]


def mesh_vertex(scene, rng, folder):
    meshes = [b for b in movers(scene) if b["shape"].get("mesh", {}).get("file", "").endswith(".obj")]
    body = pick(rng, meshes)
    mesh = body["shape"]["mesh"]
    lines = pathlib.Path(mesh["file"]).read_text().splitlines()
    at = rng.choice([i for i, line in enumerate(lines) if line.startswith("v ")])
    numbers = [float(x) * 1.08 for x in lines[at].split()[1:4]]
    lines[at] = "v %g %g %g" % tuple(numbers)
    copy_ = folder / "edited.obj"
    copy_.write_text("\n".join(lines) + "\n")
    mesh["file"] = str(copy_)
    return [named(body), re.compile("shape")]


def step_rate(scene, rng):
    scene["rate"] = scene.get("rate", 240) * rng.choice([2, 0.5, 1.25])
    return [re.compile("step rate")]


def chunks(data):
    at = 8
    while at < len(data):
        length, = struct.unpack(">I", data[at:at + 4])
        yield data[at + 4:at + 8], data[at + 8:at + 8 + length]
        at += 12 + length


def repainted(data, rng):
    """The same file with some pixels of other values: unfiltered rows, packed anew."""
    parts = list(chunks(data))
    width, height = struct.unpack(">II", parts[0][1][:8])
    raw = bytearray(zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT")))
    stride = 1 + 3 * width
    rows, last = [], bytearray(3 * width)
    for y in range(height):
        kind, row = raw[y * stride], raw[y * stride + 1:(y + 1) * stride]
        for i in range(3 * width):
            a, b, c = (row[i - 3] if i > 2 else 0), last[i], (last[i - 3] if i > 2 else 0)
            if kind == 1: row[i] = (row[i] + a) & 255
            elif kind == 2: row[i] = (row[i] + b) & 255
            elif kind == 3: row[i] = (row[i] + (a + b) // 2) & 255
            elif kind == 4:
                p = a + b - c
                pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                row[i] = (row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
        rows.append(row)
        last = row
    for _ in range(rng.randrange(1, 40)):
        rows[rng.randrange(height)][rng.randrange(3 * width)] ^= 0x40
    packed = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))
    out, done = data[:8], False
    for kind, body in parts:
        if kind == b"IDAT":
            if done:
                continue
            body, done = packed, True
        out += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    return out


def drawn(folder):
    """What the frames show: the states of the world, and the pixels."""
    frames = json.loads((folder / "manifest.json").read_text())["frames"]
    return [(frame["stateHash"], frame["pixelHash"]) for frame in frames]


def damage(folder, rng):
    file = rng.choice(sorted(folder.glob("*.png")))
    data = file.read_bytes()
    how = rng.choice(["cut", "flip", "repaint"])
    if how == "cut":
        file.write_bytes(data[:rng.randrange(len(data) // 4, len(data) - 20)])
    elif how == "flip":
        at = rng.randrange(len(data) // 2, len(data) - 40)
        file.write_bytes(data[:at] + bytes([data[at] ^ (1 << rng.randrange(8))]) + data[at + 1:])
    else:
        file.write_bytes(repainted(data, rng))
    return [re.compile("cannot decode|changed after it was drawn")]


SCENE_FAULTS = {
    "moved body": moved_body,
    "friction": material_fault("staticFriction", re.compile("friction of"), scaled(0.5)),
    "density": material_fault("density", re.compile("density of"), scaled(1000.0)),
    "restitution": material_fault("restitution", re.compile("restitution of"), restitution),
    "missing body": missing_body,
    "colour": colour,
    "camera": camera,
    "step rate": step_rate,
}
MUTANTS = {"light": re.compile(r"\blight\b"), "shader": re.compile("renderer/"), "tone-map": re.compile("renderer/"),
           "solver": re.compile("engine/")}
KINDS = list(SCENE_FAULTS) + ["mesh vertex", "preset", "PNG damage"]


class Gate:
    def __init__(self, carom, mutants, work):
        self.carom, self.mutants, self.work = carom, mutants, work

    def render(self, scene, name, folder, program=None, options=()):
        file = self.work / "scene" / (name + ".json")
        file.parent.mkdir(exist_ok=True)
        file.write_text(json.dumps(scene))
        shutil.rmtree(folder, ignore_errors=True)
        return run([program or self.carom, "render", str(file), *FRAMES, *options, "-o",
                    str(folder / "frame_%04d.png")]).returncode == 0

    def compare(self, actual, golden):
        return run([self.carom, "compare", str(actual), str(golden), "--report", "none", "--progress", "none"])

    def trial(self, kind, rng):
        """(verdict, what was said, whether the equal twin passed in silence)"""
        golden, actual = self.work / "golden", self.work / "actual"
        for _ in range(30):
            name = rng.choice(SCENES if kind != "mesh vertex" else ["fifty-bodies", "drop-mesh", "imported-meshes"])
            scene = read_scene(name)
            faulty = copy.deepcopy(scene)
            options, program = [], None
            try:
                if kind in SCENE_FAULTS:
                    words = SCENE_FAULTS[kind](faulty, rng)
                elif kind == "mesh vertex":
                    words = mesh_vertex(faulty, rng, self.work)
                elif kind == "preset":
                    preset = rng.choice(["fast", "quality"])
                    words, options = [re.compile("preset is " + preset)], ["--preset", preset]
                elif kind in MUTANTS:
                    words, program = [MUTANTS[kind]], str(self.mutants / kind)
                else:
                    words = None
            except Unsuitable:
                continue
            if not self.render(scene, name, golden):
                sys.exit("the golden frames of %s could not be drawn" % name)
            twin_ok = True
            if kind == "PNG damage" or rng.random() < 0.5:
                self.render(scene, name, actual)
                twin = self.compare(actual, golden)
                twin_ok = twin.returncode == 0 and twin.stderr == ""
            if kind == "PNG damage":
                words = damage(actual, rng)
            elif not self.render(faulty, name, actual, program, options):
                continue
            elif kind in MUTANTS and drawn(actual) == drawn(golden):
                continue  # the changed part of the program has no part in this scene
            end = self.compare(actual, golden)
            said = (end.stdout if end.returncode else "") + end.stderr
            first = next((line for line in said.splitlines()), "")
            right = all(w.search(first) for w in words)
            if end.returncode == 0:
                verdict = "noted" if right and first.startswith("note: ") else "passed"
            else:
                verdict = "named" if right else "wrong"
            return verdict, name + ": " + first, twin_ok
        return "unsuitable", "", True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("carom")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--mutants", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--kinds", help="only these, comma separated: " + ", ".join(KINDS + list(MUTANTS)))
    options = parser.parse_args()
    work = options.out or pathlib.Path(tempfile.mkdtemp(prefix="carom-faults-"))
    work.mkdir(parents=True, exist_ok=True)
    kinds = KINDS + ([k for k in MUTANTS if (options.mutants / k).exists()] if options.mutants else [])
    if options.kinds:
        kinds = [k for k in kinds if k in options.kinds.split(",")]
    gate = Gate(os.path.abspath(options.carom), options.mutants and options.mutants.resolve(), work.resolve())
    table = {kind: {} for kind in kinds}
    twins_failed = 0
    for i in range(options.count):
        kind = kinds[i % len(kinds)]
        seed = options.seed * 100000 + i
        verdict, said, twin_ok = gate.trial(kind, random.Random(seed))
        twins_failed += not twin_ok
        table[kind][verdict] = table[kind].get(verdict, 0) + 1
        if verdict not in ("named", "noted") or not twin_ok:
            print("seed %d %s: %s%s: %s" % (seed, kind, verdict, "" if twin_ok else ", EQUAL RUN FAILS", said), flush=True)
    columns = ["named", "noted", "wrong", "passed", "unsuitable"]
    print("%-14s" % "fault" + "".join("%12s" % c for c in columns))
    for kind, row in table.items():
        print("%-14s" % kind + "".join("%12d" % row.get(c, 0) for c in columns))
    total = {c: sum(row.get(c, 0) for row in table.values()) for c in columns}
    print("%-14s" % "all" + "".join("%12d" % total[c] for c in columns))
    print("equal runs that fail: %d" % twins_failed)
    tried = options.count - total["unsuitable"]
    if not options.out:
        shutil.rmtree(work)
    good = total["named"] + total["noted"]
    return 1 if total["passed"] or twins_failed or 20 * good < 19 * tried else 0


if __name__ == "__main__":
    sys.exit(main())
