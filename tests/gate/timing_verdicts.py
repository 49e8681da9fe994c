#!/usr/bin/env python3
"""How often `carom budget --against` is right: of equal programs, and of one whose PNG packing is slowed by a busy loop.

    python3 tests/gate/timing_verdicts.py CAROM equal [--pairs 1000] [--load 2] [--clock cpu]
    python3 tests/gate/timing_verdicts.py CAROM slowed --slow SLOW_ENCODING [--pairs 100] [--share 0.02] [--clock cpu]

  equal   CAROM against itself while --load processes keep the machine busy. Fails where one is called slower.
  slowed  CAROM against itself, beneath both the library that the build makes of tests/demos/preload/slow_encoding.cpp (for
          Ninja: build/release/tests/libslow_encoding.so), which lengthens packing in one of the two, so
          that its phase takes --share more CPU time. Fails where fewer than 95 of 100 are told with their phase, or another phase is blamed.

Prints a line a pair and what came out. --seconds ends it after the pair in which that time has passed: it then says of
how many pairs it tells.
"""
import argparse
import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

BUSY = "while True: pass"


@contextlib.contextmanager
def load(count):
    burners = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(count)]
    try:
        yield
    finally:
        for burner in burners:
            burner.kill()
            burner.wait()


def verdict(options, other, environment):
    """(what is called slower, what faster, the smallest change that would be seen by phase, the change by phase)"""
    words = [options.carom, "budget", options.scene, "-q", "--size", options.size, "--duration", str(options.duration),
             "--preset", options.preset, "--clock", options.clock, "--replays", str(options.rounds), "--against", other,
             "--json", "-"]
    end = subprocess.run(words, capture_output=True, text=True, env={**os.environ, **environment})
    if end.returncode not in (0, 1, 7):
        sys.exit("carom budget ended with %d: %s" % (end.returncode, end.stderr))
    said = json.loads(end.stdout)
    changes = said["phases"] + [said["frame"]]
    of = lambda speed: [change["name"] for change in changes if change["verdict"] == speed]
    seen = {change["name"]: change["smallestSeen"] for change in changes}
    return of("slower"), of("faster"), seen, {change["name"]: change["change"] for change in changes}


def tell(pair, slower, faster, seen, change):
    print("pair %d: slower %s, faster %s; changed by %.2f %%, %s would have been seen, load %.1f"
          % (pair, slower, faster, 100 * change, "nothing" if seen is None else "%.2f %%" % (100 * seen),
             os.getloadavg()[0]), flush=True)


def equal(options):
    slower, faster, done = 0, 0, 0
    end_s = time.monotonic() + options.seconds
    with load(options.load):
        while done < options.pairs and time.monotonic() < end_s:
            names_slower, names_faster, seen, change = verdict(options, options.carom, {})
            done += 1
            slower += bool(names_slower)
            faster += bool(names_faster)
            tell(done, names_slower, names_faster, seen["frame"], change["frame"])
    print("%d pairs of equal programs, %d busy processes, %s clock: %d slower, %d faster"
          % (done, options.load, options.clock, slower, faster))
    return 1 if slower else 0


def slowed(options):
    library = str(pathlib.Path(options.slow).resolve())
    right, wrong, done, longest_s = 0, 0, 0, 0.0
    end_s = time.monotonic() + options.seconds
    with tempfile.TemporaryDirectory(prefix="carom-timing-") as name, load(options.load):
        other = pathlib.Path(name) / "carom"
        # The other of the two has the library beneath it as well, and is not slowed.
        other.write_text("#!/bin/sh\nCAROM_SLOWDOWN=%s exec '%s' \"$@\"\n" % ("0.00000", options.carom))
        other.chmod(0o755)
        slow = lambda share: verdict(options, str(other), {"LD_PRELOAD": library, "CAROM_SLOWDOWN": "%.5f" % share})
        # Packing is a part of its phase: how large a part is seen where it takes twice its time.
        part = slow(1.0)[3]["encode"]
        print("packing is %.0f %% of its phase" % (100 * part), flush=True)
        while done < options.pairs and time.monotonic() < end_s:
            begin_s = time.monotonic()
            slower, faster, seen, change = slow(options.share / part)
            longest_s = max(longest_s, time.monotonic() - begin_s)
            done += 1
            blamed = [phase for phase in slower if phase not in ("encode", "frame")] + faster
            wrong += bool(blamed)
            right += "encode" in slower and not blamed
            tell(done, slower, faster, seen["encode"], change["encode"])
    print("%d pairs, encoding slowed by %g, %s clock: %d named, %d blamed on another phase, at most %.0f s a pair"
          % (done, options.share, options.clock, right, wrong, longest_s))
    return 0 if done and not wrong and 100 * right >= 95 * done else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("carom")
    parser.add_argument("what", choices=["equal", "slowed"])
    parser.add_argument("--slow")
    parser.add_argument("--pairs", type=int)
    parser.add_argument("--load", type=int)
    parser.add_argument("--share", type=float, default=0.02)
    parser.add_argument("--clock", default="cpu", choices=["cpu", "wall"])
    parser.add_argument("--scene", default="sliding")
    parser.add_argument("--size")
    parser.add_argument("--preset", default="fast", help="of the cheapest pictures a phase is the largest share")
    parser.add_argument("--duration", type=float)
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--seconds", type=float, default=1e9)
    options = parser.parse_args()
    options.carom = os.path.abspath(options.carom)
    equals = options.what == "equal"
    if not equals and not options.slow:
        parser.error("slowed: --slow is missing")
    options.pairs = options.pairs or (1000 if equals else 100)
    options.load = (2 if equals else 0) if options.load is None else options.load
    # Of 21 rounds, the fewest that can tell, all must lie on one side. Of 40, whose medians lie within 1.4 % of where
    # they should, nearly all lie on the side of a change of 2 %.
    options.rounds = options.rounds or (21 if equals else 64)
    options.size = options.size or ("64x48" if equals else "320x180")
    options.duration = options.duration or (0.2 if equals else 2 / 3)
    return equal(options) if equals else slowed(options)


if __name__ == "__main__":
    sys.exit(main())
