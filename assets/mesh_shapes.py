"""Meshes made by formulas, for the scenes of assets/ and the suites of tests/: outlines drawn out, profiles turned,
tubes bent, threads wound, cells cut. Each is a closed surface as (points, faces), faces counter-clockwise seen from
outside."""

import math
import random


def circle(n, radius, centre=(0.0, 0.0), phase=0.0):
    return [(centre[0] + radius * math.cos(2 * math.pi * (k + phase) / n),
             centre[1] + radius * math.sin(2 * math.pi * (k + phase) / n)) for k in range(n)]


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


def torus(ring_radius, tube_radius, sides, tube_sides):
    return revolved(circle(tube_sides, tube_radius, (ring_radius, 0.0), 0.5), sides)


def extruded(outline, height):
    """A closed outline in x and y, counter-clockwise, between -height / 2 and height / 2."""
    n = len(outline)
    points = [[x, y, z] for z in (-height / 2, height / 2) for x, y in outline]
    faces = [list(range(n - 1, -1, -1)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return points, faces


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


def rectangle(width, height, centre=(0.0, 0.0)):
    x, y = centre
    return [(x - width / 2, y - height / 2), (x + width / 2, y - height / 2),
            (x + width / 2, y + height / 2), (x - width / 2, y + height / 2)]


def signed_area(outline):
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(outline, outline[1:] + outline[:1]))


def cross(o, a, b):
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def bridged(points, outline, holes):
    """One loop of indices around outline and holes: each hole is joined by a cut to a corner that sees it."""
    loop = list(outline)
    rest = sorted(holes, key=lambda hole: max(points[i][0] for i in hole), reverse=True)

    def meets(p, q, ring):
        for i in range(len(ring)):
            a, b = points[ring[i]], points[ring[(i + 1) % len(ring)]]
            if p in (a, b) or q in (a, b):
                continue
            if cross(p, q, a) * cross(p, q, b) < 0 and cross(a, b, p) * cross(a, b, q) < 0:
                return True
        return False

    for number, hole in enumerate(rest):
        start = max(range(len(hole)), key=lambda i: points[hole[i]][0])
        p = points[hole[start]]
        walls = [loop] + rest[number:]
        seen = [k for k in range(len(loop)) if not any(meets(p, points[loop[k]], wall) for wall in walls)]
        k = min(seen, key=lambda i: math.dist(p, points[loop[i]]))
        loop = loop[:k + 1] + hole[start:] + hole[:start + 1] + loop[k:]
    return loop


def triangulated(points, outline, holes=()):
    """Ears are cut off one by one. The outline is counter-clockwise, holes are clockwise; indices into points."""
    loop, triangles = bridged(points, list(outline), [list(h) for h in holes]), []

    def is_ear(i):
        a, b, c = (loop[(i + d) % len(loop)] for d in (-1, 0, 1))
        pa, pb, pc = points[a], points[b], points[c]
        if cross(pa, pb, pc) <= 1e-15:
            return False
        return not any(v not in (a, b, c) and points[v] not in (pa, pb, pc) and cross(pa, pb, points[v]) >= 0 and
                       cross(pb, pc, points[v]) >= 0 and cross(pc, pa, points[v]) >= 0 for v in loop)

    while len(loop) > 3:
        ears = [i for i in range(len(loop)) if is_ear(i)]
        if not ears:
            raise ValueError("the outline crosses itself")
        # The fattest ear, so that no slivers are left over.
        def fatness(i):
            a, b, c = (points[loop[(i + d) % len(loop)]] for d in (-1, 0, 1))
            longest = max(math.dist(a, b), math.dist(b, c), math.dist(c, a))
            return cross(a, b, c) / longest**2
        i = max(ears, key=fatness)
        triangles.append([loop[i - 1], loop[i], loop[(i + 1) % len(loop)]])
        del loop[i]
    return triangles + [loop]


def plate(outline, height, holes=()):
    """An outline (counter-clockwise) with holes, between -height / 2 and height / 2."""
    rings = [list(outline)] + [list(h) if signed_area(list(h)) < 0 else list(h)[::-1] for h in holes]
    flat, loops = [], []
    for ring in rings:
        loops.append(list(range(len(flat), len(flat) + len(ring))))
        flat += ring
    n = len(flat)
    points = [[x, y, z] for z in (-height / 2, height / 2) for x, y in flat]
    faces = []
    for t in triangulated(flat, loops[0], loops[1:]):
        faces += [[t[2], t[1], t[0]], [n + t[0], n + t[1], n + t[2]]]
    for loop in loops:
        for a, b in zip(loop, loop[1:] + loop[:1]):
            faces.append([a, b, n + b, n + a])
    return points, faces


def link(length=1.5, width=1.0, thickness=0.190211, sides=10, bend=10):
    """A chain's link by its outer length along x and width along y: 440 triangles as it stands."""
    radius = (width - thickness) / 2
    return stadium_link((length - width) / 2, radius, thickness / 2, sides, bend)


def grille(holes, pitch, height):
    """A square plate with so many square holes along each side, bars as wide as the holes."""
    n, points, faces = 2 * holes + 1, [], []
    half = n * pitch / 2
    at = lambda i, j, top: (i * (n + 1) + j) * 2 + top
    for i in range(n + 1):
        for j in range(n + 1):
            points += [[i * pitch - half, j * pitch - half, z] for z in (-height / 2, height / 2)]
    solid = lambda i, j: 0 <= i < n and 0 <= j < n and not (i % 2 and j % 2)
    for i in range(n):
        for j in range(n):
            if not solid(i, j):
                continue
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            faces += [[at(*c, 1) for c in corners], [at(*c, 0) for c in corners[::-1]]]
            for k, (di, dj) in enumerate(((0, -1), (1, 0), (0, 1), (-1, 0))):
                if not solid(i + di, j + dj):
                    a, b = corners[k], corners[(k + 1) % 4]
                    faces.append([at(*a, 0), at(*b, 0), at(*b, 1), at(*a, 1)])
    return points, faces


def gear(teeth, module, height, bore=0.0, backlash=0.02):
    """A spur gear of involutes, with a round bore where it is asked for."""
    outline = involute_gear(teeth, module, backlash)
    return plate(outline, height, [circle(24, bore)] if bore else [])


def rod(length, eye, bore, height, sides=16):
    """A bar with an eye at both ends: the middles of the bores are at x = -length / 2 and length / 2."""
    half, outline = length / 2, []
    for sign in (1, -1):
        for i in range(sides // 2 + 1):
            a = -math.pi / 2 + math.pi * i / (sides // 2)
            outline.append((sign * (half + eye * math.cos(a)), sign * eye * math.sin(a)))
    return plate(outline, height, [circle(sides, bore, (x, 0.0), 0.5) for x in (half, -half)])


def arms(count, inner, outer, width, height):
    """A flat body with arms, as an octopus lies."""
    outline, half = [], width / 2
    for k in range(count):
        a = 2 * math.pi * k / count
        c, s = math.cos(a), math.sin(a)
        for x, y in ((inner, -half), (outer, -0.6 * half), (outer, 0.6 * half), (inner, half)):
            outline.append((x * c - y * s, x * s + y * c))
    return plate(outline, height)


def bumpy(seed, radius=0.5, rings=10, sides=16, depth=0.35):
    """A dented ball: concave, closed, 2 sides (rings - 1) triangles."""
    rng = random.Random(seed)
    waves = [(rng.uniform(0, 2 * math.pi), rng.randint(1, 3), rng.randint(1, 3)) for _ in range(3)]

    def reach(theta, phi):
        return radius * (1 - depth + depth * sum(math.sin(a * phi + p) * math.sin(b * theta) ** 2
                                                 for p, a, b in waves) / 3)

    points = [[0, 0, reach(0, 0)]]
    for i in range(1, rings):
        theta = math.pi * i / rings
        for k in range(sides):
            phi = 2 * math.pi * k / sides
            r = reach(theta, phi)
            points.append([r * math.sin(theta) * math.cos(phi), r * math.sin(theta) * math.sin(phi), r * math.cos(theta)])
    points.append([0, 0, -reach(math.pi, 0)])
    faces, last = [], len(points) - 1
    for k in range(sides):
        there = (k + 1) % sides
        faces.append([0, 1 + k, 1 + there])
        for i in range(rings - 2):
            a, b = 1 + i * sides, 1 + (i + 1) * sides
            faces += [[a + k, b + k, b + there], [a + k, b + there, a + there]]
        faces.append([last, last - sides + there, last - sides + k])
    return points, faces


def cells(size, count, seed, shrink=0.9995):
    """The Voronoi cells of random points in a box, each as its corners: (points, middle)."""
    rng = random.Random(seed)
    seeds = [[rng.uniform(-s / 2, s / 2) for s in size] for _ in range(count)]
    made = []
    for p in seeds:
        planes = [([1.0 if i == axis else 0.0 for i in range(3)], size[axis] / 2) for axis in range(3)]
        planes += [([-x for x in n], d) for n, d in planes]
        for q in sorted(seeds, key=lambda q: math.dist(p, q))[1:]:
            n = [b - a for a, b in zip(p, q)]
            planes.append((n, sum(c * (a + b) / 2 for c, a, b in zip(n, p, q))))
        corners = half_space_corners(planes, p)
        middle = [sum(c[i] for c in corners) / len(corners) for i in range(3)]
        made.append([[m + shrink * (x - m) for x, m in zip(c, middle)] for c in corners])
    return made


def half_space_corners(planes, inside):
    """The corners of the polytope of `n . x <= d`: those of a large cube's faces, cut by one plane after another."""
    low, high = [x - 1e3 for x in inside], [x + 1e3 for x in inside]
    box = [[(low, high)[i >> b & 1][b] for b in range(3)] for i in range(8)]
    faces = [[box[i] for i in f] for f in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))]
    for n, d in planes:
        height = lambda c: sum(a * b for a, b in zip(n, c)) - d
        cut, rim = [], []
        for face in faces:
            kept = []
            for a, b in zip(face, face[1:] + face[:1]):
                ha, hb = height(a), height(b)
                if ha <= 0:
                    kept.append(a)
                if (ha < 0 < hb) or (hb < 0 < ha):
                    t = ha / (ha - hb)
                    c = [x + t * (y - x) for x, y in zip(a, b)]
                    kept.append(c)
                    rim.append(c)
            if len(kept) > 2:
                cut.append(kept)
        if rim:
            middle = [sum(c[i] for c in rim) / len(rim) for i in range(3)]
            u = [x - m for x, m in zip(rim[0], middle)]
            v = [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]]
            along = lambda c, w: sum((x - m) * y for x, m, y in zip(c, middle, w))
            cut.append(sorted(rim, key=lambda c: math.atan2(along(c, v), along(c, u) * math.hypot(*n))))
        faces = cut
    return sorted({tuple(round(x, 12) for x in c) for f in faces for c in f})


def thread_rows(root, crest, pitch):
    """Radius and height of the rows of a thread's tooth, from root to root; the tooth is 0.7 of the pitch wide at the
    root and 0.2 at the crest. In a nut the crest is inside."""
    return [(root, -0.35 * pitch), (crest, -0.1 * pitch), (crest, 0.1 * pitch), (root, 0.35 * pitch)]


class Wound:
    """A thread wound about z as points and faces, faces outwards: rows of a tooth that climb with the angle."""

    def __init__(self, root, crest, pitch, turns, sides, start=0.0):
        rows, self.sides, steps = thread_rows(root, crest, pitch), sides, round(turns * sides)
        self.points, self.faces, self.bottom, self.top, m = [], [], [], [], len(rows)
        # Row i at step s + sides is row i + m at step s: what follows the last row of a turn is the first of the next.
        self.index, self.steps, self.rows = {}, steps, m
        for s in range(steps + 1):
            angle = 2 * math.pi * s / sides
            for i, (r, z) in enumerate(rows):
                self.index[s, i] = len(self.points)
                self.points.append([r * math.cos(angle), r * math.sin(angle), start + z + pitch * s / sides])
        for s in range(steps):
            for i in range(m - 1):
                self.quad((s, i), (s + 1, i), (s + 1, i + 1), (s, i + 1))
            if s + sides < steps:
                self.quad((s, m - 1), (s + 1, m - 1), (s + 1 + sides, 0), (s + sides, 0))

    def quad(self, *corners):
        a, b, c, d = (self.index[corner] for corner in corners)
        self.faces += [[a, b, c], [a, c, d]]

    def ends(self, low, high, root):
        """Rings of the root's radius below and above, and what joins them to the thread; their indices."""
        n, m, last = self.sides, self.rows - 1, self.steps
        rings = []
        for z in (low, high):
            rings.append(list(range(len(self.points), len(self.points) + n)))
            self.points += [[root * math.cos(2 * math.pi * k / n), root * math.sin(2 * math.pi * k / n), z] for k in range(n)]
        first, at = rings[0], self.index
        # The last step of the first turn meets the tooth's end, whose foot stands on the same line.
        for s in range(n):
            a, b = first[s], first[(s + 1) % n]
            if s < n - 1:
                self.faces += [[a, b, at[s + 1, 0]], [a, at[s + 1, 0], at[s, 0]]]
            else:
                self.faces.append([a, b, at[0, 0]])
                self.faces.append([a, at[0, 0], at[0, m]])
                self.faces += [[a, at[0, m], at[n, 0]], [a, at[n, 0], at[s, 0]]]
        self.faces.append([at[0, i] for i in range(m + 1)])
        second, begin = rings[1], last - n
        for s in range(begin, last):
            a, b = second[s % n], second[(s + 1) % n]
            if s > begin:
                self.faces += [[a, at[s, m], at[s + 1, m]], [a, at[s + 1, m], b]]
            else:
                self.faces += [[b, a, at[s + 1, m]], [a, at[last, m], at[s + 1, m]], [at[last, m], at[last, 0], at[s + 1, m]],
                               [at[last, 0], at[s, m], at[s + 1, m]]]
        self.faces.append([at[last, i] for i in range(m, -1, -1)])
        return rings


def bolt(root, crest, pitch, turns, sides, ends, head=None):
    """A threaded rod from z = 0 on, with `ends` metres without thread at both; `head` is (across corners, height) of a
    hexagonal one below z = 0, a plate with the rod's section on top."""
    thread = Wound(root, crest, pitch, turns, sides, ends + 0.35 * pitch)
    height = 2 * ends + (turns + 0.7) * pitch
    low, high = thread.ends(0.0, height, root)
    thread.faces.append(high)
    points, faces = thread.points, thread.faces
    if head is None:
        return points, faces + [low[::-1]]
    rim, tall = head
    flat = [tuple(points[i][:2]) for i in low] + circle(6, rim)
    n, base = len(low), len(points)
    for z in (0.0, -tall):
        points += [[x, y, z] for x, y in flat[n:]]
    triangles = triangulated(flat, list(range(n, n + 6)), [list(range(n))[::-1]])
    faces += [[low[i] if i < n else base + i - n for i in t] for t in triangles]
    faces += [[base + k, base + 6 + k, base + 6 + (k + 1) % 6, base + (k + 1) % 6] for k in range(6)]
    return points, faces + [[base + 11 - k for k in range(6)]]


def nut(root, crest, pitch, turns, sides, rim):
    """A hexagonal nut about z, its middle at the origin, whose tooth is at angle 0 in the middle of its height; `root`
    is the wide radius of its thread and `crest` the narrow one."""
    thread = Wound(root, crest, pitch, turns, sides, -0.5 * turns * pitch)
    half = (0.5 * turns + 0.35) * pitch + 0.02 * pitch
    rings = thread.ends(-half, half, root)
    points, n = thread.points, sides
    faces = [f[::-1] for f in thread.faces]  # A bore: its faces look inwards.
    flat = [tuple(points[i][:2]) for i in rings[0]] + circle(6, rim)
    triangles, base = triangulated(flat, list(range(n, n + 6)), [list(range(n))[::-1]]), len(points)
    for ring, z, upwards in ((rings[0], -half, False), (rings[1], half, True)):
        first = len(points)
        points += [[x, y, z] for x, y in flat[n:]]
        for t in triangles:
            face = [ring[i] if i < n else first + i - n for i in t]
            faces.append(face if upwards else face[::-1])
    faces += [[base + k, base + (k + 1) % 6, base + 6 + (k + 1) % 6, base + 6 + k] for k in range(6)]
    return points, faces


def write_obj(path, mesh):
    """With all digits of a double: what is flat stays flat."""
    points, faces = mesh
    lines = ["v " + " ".join(repr(float(x) + 0.0) for x in p) for p in points]
    lines += ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n")
