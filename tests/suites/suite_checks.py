"""What may be expected of a run. Each returns a function of it: what is wrong, in words with a figure, or None."""

import math


def every(*checks):
    def check(run):
        for one in checks:
            wrong = one(run)
            if wrong:
                return wrong
        return None
    return check


def nothing(run):
    """Only what holds of every fixture: no overlap, no energy from nothing."""
    return None


def rests(*names, speed=1e-2):
    """At the end everything, or these, stands still."""
    def check(run):
        for name in names or run.moving():
            v = math.hypot(*run.velocity(name))
            if v > speed:
                return f"{name} still moves at {v:.3g} m/s"
        return None
    return check


def stays(*names, within, since=0):
    """Does not leave the place where it was in frame `since`."""
    def check(run):
        for name in names or run.moving():
            d = math.dist(run.place(name), run.place(name, since))
            if d > within:
                return f"{name} moved by {d:.3g} m, not within {within:g}"
        return None
    return check


def sides(name, axis, least=-math.inf, most=math.inf, of_mass=False):
    """Never beyond a wall, in any frame: the origin of its shape, or its centre of mass."""
    def check(run):
        for frame in run.frames():
            x = (run.centre if of_mass else run.place)(name, frame)[axis]
            if not least <= x <= most:
                return f"{name} is at {'xyz'[axis]} = {x:.4g} at {run.time(frame):.2f} s, not within {least:g} to {most:g}"
        return None
    return check


def all_sides(axis, least=-math.inf, most=math.inf):
    """The centres of mass of all that moves."""
    return lambda run: every(*(sides(name, axis, least, most, True) for name in run.moving()))(run)


def reaches(name, axis, least, most):
    """Its lowest coordinate of all frames is within these."""
    def check(run):
        x = min(run.place(name, frame)[axis] for frame in run.frames())
        return None if least <= x <= most else f"{name} reaches {'xyz'[axis]} = {x:.4g}, not within {least:g} to {most:g}"
    return check


def ends(name, axis, least=-math.inf, most=math.inf):
    def check(run):
        x = run.place(name)[axis]
        return None if least <= x <= most else f"{name} ends at {'xyz'[axis]} = {x:.4g}, not within {least:g} to {most:g}"
    return check


def speeds_up(name, direction, acceleration, share=2e-3, start=0.0):
    """From rest (or `start` m/s) with a constant acceleration along a unit direction."""
    def check(run):
        v = sum(a * b for a, b in zip(run.velocity(name), direction))
        expected = start + acceleration * run.time()
        if abs(v - expected) > share * abs(expected):
            return f"{name} moves at {v:.5g} m/s, {v / expected:.5f} of what theory says"
        return None
    return check


def linked(names, farthest):
    """Neighbours of a chain are never farther apart than links that are in each other can be."""
    def check(run):
        for frame in run.frames():
            for a, b in zip(names, names[1:]):
                d = math.dist(run.place(a, frame), run.place(b, frame))
                if d > farthest:
                    return f"{a} and {b} are {d:.4g} m apart at {run.time(frame):.2f} s, more than {farthest:.4g}"
        return None
    return check


def pairs_linked(pairs, farthest):
    return every(*(linked(pair, farthest) for pair in pairs))


def turns(name, axis, rate, share=0.01, since=0.2):
    """The mean spin about a world axis after that share of the time."""
    def check(run):
        frames = [f for f in run.frames() if run.time(f) >= since * run.time()]
        mean = sum(run.spin(name, f)[axis] for f in frames) / len(frames)
        if abs(mean - rate) > share * abs(rate):
            return f"{name} turns at {mean:.5g} rad/s, not at {rate:.5g}"
        return None
    return check


def follows(name, axis, path, within, since=0.0):
    """Its coordinate is `path(time)` within play, in every frame after `since` seconds."""
    def check(run):
        worst, when = 0.0, 0.0
        for f in run.frames():
            if run.time(f) < since:
                continue
            off = abs(run.place(name, f)[axis] - path(run.time(f)))
            if off > worst:
                worst, when = off, run.time(f)
        return None if worst <= within else f"{name} is {worst:.4g} m off its path at {when:.2f} s, not within {within:g}"
    return check


def keeps_energy(share):
    """Neither gains nor loses."""
    def check(run):
        energies = [a["kinetic_J"] + a["potential_J"] for a in run.audit]
        most = max(a["kinetic_J"] for a in run.audit)
        off = (max(energies) - min(energies)) / most
        return None if off <= share else f"energy wanders by {off:.3g} of the kinetic energy, not {share:g}"
    return check


def work_only(share=1e-3):
    """Where bodies are moved: there is no more energy at the end than at the start and what was put in."""
    def check(run):
        first, last = run.audit[0], run.audit[-1]
        gained = last["kinetic_J"] + last["potential_J"] - first["kinetic_J"] - first["potential_J"]
        work = run.facts.get("work_J", 0.0)
        scale = max(abs(work), last["kinetic_J"], 1e-9)
        return None if gained <= work + share * scale + first["kinetic_J"] * share else \
            f"gained {gained:.4g} J from work of {work:.4g} J"
    return check


def on_time(run):
    late = run.facts.get("kinematic_late_s", 0.0)
    return None if late == 0 else f"what is moved is late by {late:.3g} s"
