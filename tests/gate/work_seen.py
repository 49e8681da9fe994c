#!/usr/bin/env python3
"""Whether `carom budget --baseline` sees a change of one sweep, one texture or one band in the work, and nothing else.

    python3 tests/gate/work_seen.py CAROM --mutants FOLDER [--scene fifty-bodies]

FOLDER holds programs built by tests/gate/build_mutants.sh: sweep (each solve makes one more), texture (the shadow
map is one texel larger), band (the first band of every PNG is packed anew). Each runs against a baseline that CAROM
wrote and must end with 1 and name its own counter; CAROM itself, with one thread and two, must find the same work in
every frame. Times may differ by anything. Exit code 1 when one is missed or an equal run is not.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

MUTANTS = {"sweep": "row visits", "texture": "shadow texels", "band": "bands packed"}
# So that only work can end with 1: no frame is slow, no phase slower.
ANY_TIME = ["--budget", "100000", "--percentile", "50"]


def budget(program, options, words):
    return subprocess.run([program, "budget", options.scene, "-q", "--size", "640x360", "--duration", "1", "--replays", "2",
                           *ANY_TIME, *words], capture_output=True, text=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("carom")
    parser.add_argument("--mutants", type=pathlib.Path, required=True)
    parser.add_argument("--scene", default="fifty-bodies")
    options = parser.parse_args()
    carom, missed = os.path.abspath(options.carom), 0
    with tempfile.TemporaryDirectory(prefix="carom-work-") as folder:
        baseline = os.path.join(folder, "baseline.json")
        made = budget(carom, options, ["--json", baseline])
        if made.returncode not in (0, 1, 7):
            sys.exit("no baseline: " + made.stderr)
        trials = [("itself", carom, [], None), ("itself, two threads", carom, ["--threads", "2"], None)]
        trials += [(name, str(options.mutants / name), [], counter) for name, counter in MUTANTS.items()]
        for name, program, words, counter in trials:
            end = budget(program, options, words + ["--baseline", baseline, "--tolerance", "1000%"])
            lines = [line for line in (end.stdout + end.stderr).splitlines() if "work" in line]
            more = [line for line in lines if "more work: " in line]
            right = end.returncode == 1 and any(counter in line for line in more) if counter else \
                not more and "the same work in every frame" in "".join(lines)
            missed += not right
            print("%-20s %s (exit %d): %s" % (name, "seen" if counter and right else "right" if right else "MISSED",
                                              end.returncode, "; ".join(line.split(": ", 1)[-1] for line in more)), flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
