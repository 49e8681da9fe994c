#!/usr/bin/env python3
"""Makes assets/meshes/: small solids in six file formats, from closed forms, the same bytes on every run.

Usage: python3 assets/make_meshes.py        (needs nothing but Python 3)

Each solid is a list of parts (points, faces); faces are counter-clockwise seen from outside. The volumes that the
tests compare with are in tests/demos/asset/mesh_import_test.cpp.
"""

import base64
import json
import math
import struct
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "meshes"
GOLDEN = (1 + math.sqrt(5)) / 2


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


def convex_faces(points):
    """The faces of a small convex polyhedron, by testing every plane through three points (brute force)."""
    middle = [sum(p[i] for p in points) / len(points) for i in range(3)]
    found = {}
    n = len(points)
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(j + 1, n):
                normal = cross(sub(points[j], points[i]), sub(points[k], points[i]))
                if dot(normal, normal) < 1e-12:
                    continue
                normal = unit(normal)
                if dot(normal, sub(points[i], middle)) < 0:
                    normal = [-x for x in normal]
                sides = [dot(normal, sub(p, points[i])) for p in points]
                if max(sides) > 1e-9:
                    continue
                found[tuple(m for m in range(n) if sides[m] > -1e-9)] = normal
    return [around(points, list(members), normal) for members, normal in found.items()]


def around(points, members, normal):
    """The members of a face in counter-clockwise order."""
    centre = [sum(points[m][i] for m in members) / len(members) for i in range(3)]
    u = unit(sub(points[members[0]], centre))
    v = cross(normal, u)
    return sorted(members, key=lambda m: math.atan2(dot(sub(points[m], centre), v), dot(sub(points[m], centre), u)))


def box(size, centre=(0, 0, 0)):
    x, y, z = (s / 2 for s in size)
    points = [[centre[0] + a * x, centre[1] + b * y, centre[2] + c * z] for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    return points, convex_faces(points)


def ring(count, radius, z):
    return [[radius * math.cos(2 * math.pi * i / count), radius * math.sin(2 * math.pi * i / count), z] for i in range(count)]


def gem():
    """A brilliant of eight sides: table, crown, girdle band, pavilion."""
    points = ring(8, 0.34, 0.25) + ring(8, 0.55, 0.06) + ring(8, 0.55, 0.0) + [[0.0, 0.0, -0.5]]
    return points, convex_faces(points)


def dodecahedron(edge):
    s = edge * GOLDEN / 2  # a cube of this half side stands in it
    g = GOLDEN
    points = [[a * s, b * s, c * s] for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    for a in (-1, 1):
        for b in (-1, 1):
            points += [[0.0, a * s / g, b * s * g], [a * s / g, b * s * g, 0.0], [a * s * g, 0.0, b * s / g]]
    return points, convex_faces(points)


def icosahedron(edge):
    h = edge / 2
    points = []
    for a in (-1, 1):
        for b in (-1, 1):
            points += [[0.0, a * h, b * h * GOLDEN], [a * h, b * h * GOLDEN, 0.0], [a * h * GOLDEN, 0.0, b * h]]
    return points, convex_faces(points)


def wedge():
    """A right-angled ramp, 1.0 long, 0.6 wide, 0.5 high."""
    points = [[x, y, z] for y in (-0.3, 0.3) for x, z in ((-0.5, -0.2), (0.5, -0.2), (-0.5, 0.3))]
    return points, convex_faces(points)


def prism(sides, radius, height):
    points = ring(sides, radius, -height / 2) + ring(sides, radius, height / 2)
    return points, convex_faces(points)


def pyramid():
    points = [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0], [0.0, 0.0, 0.8]]
    return points, convex_faces(points)


def triangles(faces):
    return [[f[0], f[i], f[i + 1]] for f in faces for i in range(1, len(f) - 1)]


def number(x):
    return f"{x + 0.0:.9g}"  # nine digits hold a single-precision number


def write_obj(name, parts):
    lines, first = ["# Carom, own work, public domain (CC0)"], 1
    for part, (points, faces) in parts.items():
        lines.append(f"o {part}")
        lines += ["v " + " ".join(map(number, p)) for p in points]
        lines += ["f " + " ".join(str(first + i) for i in f) for f in faces]
        first += len(points)
    (FOLDER / name).write_text("\n".join(lines) + "\n")


def write_ply(name, part):
    points, faces = part
    lines = ["ply", "format ascii 1.0", "comment Carom, own work, public domain (CC0)", f"element vertex {len(points)}"]
    lines += [f"property float {axis}" for axis in "xyz"]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(number, p)) for p in points]
    lines += [" ".join(map(str, [len(f)] + f)) for f in faces]
    (FOLDER / name).write_text("\n".join(lines) + "\n")


def write_off(name, part):
    points, faces = part
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(map(number, p)) for p in points]
    lines += [" ".join(map(str, [len(f)] + f)) for f in faces]
    (FOLDER / name).write_text("\n".join(lines) + "\n")


def normal_of(corners):
    return unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])))


def write_ascii_stl(name, part):
    points, faces = part
    lines = ["solid " + Path(name).stem]
    for triangle in triangles(faces):
        corners = [points[i] for i in triangle]
        lines += ["facet normal " + " ".join(map(number, normal_of(corners))), " outer loop"]
        lines += ["  vertex " + " ".join(map(number, p)) for p in corners]
        lines += [" endloop", "endfacet"]
    lines.append("endsolid " + Path(name).stem)
    (FOLDER / name).write_text("\n".join(lines) + "\n")


def write_binary_stl(name, part):
    points, faces = part
    flat = triangles(faces)
    data = b"Carom, own work, public domain (CC0)".ljust(80) + struct.pack("<I", len(flat))
    for triangle in flat:
        corners = [points[i] for i in triangle]
        data += struct.pack("<12fH", *normal_of(corners), *[x for p in corners for x in p], 0)
    (FOLDER / name).write_bytes(data)


def write_gltf(name, meshes, nodes):
    """`meshes`: name -> part; `nodes`: dicts with a mesh's name and a transform. Buffers are inside the file."""
    buffer, views, accessors, gltf_meshes = b"", [], [], []
    for part, (points, faces) in meshes.items():
        vertices = b"".join(struct.pack("<3f", *p) for p in points)
        indices = [i for t in triangles(faces) for i in t]
        for data, target in ((vertices, 34962), (struct.pack(f"<{len(indices)}I", *indices), 34963)):
            views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data), "target": target})
            buffer += data
        accessors.append({"bufferView": len(views) - 2, "componentType": 5126, "count": len(points), "type": "VEC3",
                          "min": [min(p[i] for p in points) for i in range(3)],
                          "max": [max(p[i] for p in points) for i in range(3)]})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"})
        gltf_meshes.append({"name": part, "primitives": [{"attributes": {"POSITION": len(accessors) - 2},
                                                          "indices": len(accessors) - 1}]})
    order = list(meshes)
    gltf_nodes = [dict(node, mesh=order.index(node["mesh"])) for node in nodes]
    uri = "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()
    gltf = {"asset": {"version": "2.0", "copyright": "Carom, own work, public domain (CC0)"}, "scene": 0,
            "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": gltf_nodes, "meshes": gltf_meshes,
            "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(buffer), "uri": uri}]}
    (FOLDER / name).write_text(json.dumps(gltf, indent=1) + "\n")


def main():
    FOLDER.mkdir(exist_ok=True)
    write_obj("gem.obj", {"gem": gem()})
    write_obj("hammer.obj", {"handle": box((1.2, 0.14, 0.14)), "head": box((0.3, 0.7, 0.3), (0.75, 0, 0))})
    write_ascii_stl("wedge.stl", wedge())
    write_binary_stl("pyramid.stl", pyramid())
    write_ply("dodecahedron.ply", dodecahedron(0.36))
    write_off("icosahedron.off", icosahedron(0.55))
    write_ply("prism.ply", prism(6, 0.45, 0.6))
    # Two nodes share the weight; the second is turned by a quarter about the bar.
    quarter = math.sqrt(0.5)
    write_gltf("dumbbell.gltf", {"bar": prism(8, 0.09, 0.8), "weight": prism(10, 0.5, 0.4)},
               [{"mesh": "bar"},
                {"mesh": "weight", "translation": [0, 0, 0.5], "scale": [0.7, 0.7, 0.5]},
                {"mesh": "weight", "translation": [0, 0, -0.5], "rotation": [0, 0, quarter, quarter],
                 "scale": [0.7, 0.7, 0.5]}])


if __name__ == "__main__":
    main()
