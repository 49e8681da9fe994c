"""coverage.py FOLDER PROGRAM...: prints the share of the engine's lines that were run, folder by folder, from the profiles
(*.profraw) that PROGRAMs built by clang with -fprofile-instr-generate -fcoverage-mapping left in FOLDER; then the ten files
with the most lines that were not. Exit 1: fewer than nine tenths were. Run by `bash tests/checks.sh clang`."""
import collections
import json
import pathlib
import subprocess
import sys

SHARE_TO_RUN = 0.9
ROOT = pathlib.Path(__file__).resolve().parent.parent


def lines_of(folder, programs):
    """{path of a source of the engine: (lines that were run, lines)}."""
    profiles = sorted(pathlib.Path(folder).glob("*.profraw"))
    if not profiles:
        sys.exit(f"nothing was measured in {folder}")
    merged = pathlib.Path(folder) / "all.profdata"
    subprocess.run(["llvm-profdata-14", "merge", "-o", merged, *profiles], check=True)
    more = [word for program in programs[1:] for word in ("-object", program)]
    out = subprocess.run(["llvm-cov-14", "export", "-summary-only", f"-instr-profile={merged}", programs[0], *more],
                         check=True, capture_output=True, text=True)
    lines = {}
    for file in json.loads(out.stdout)["data"][0]["files"]:
        path = pathlib.Path(file["filename"]).resolve()
        if path.is_relative_to(ROOT / "engine"):
            found = file["summary"]["lines"]
            lines[path.relative_to(ROOT).as_posix()] = (found["covered"], found["count"])
    return lines


def main(folder, *programs):
    whole, by_folder, missed = [0, 0], collections.defaultdict(lambda: [0, 0]), collections.Counter()
    for path, (run, lines) in lines_of(folder, programs).items():
        for total in (whole, by_folder[path.rpartition("/")[0]]):
            total[0] += run
            total[1] += lines
        missed[path] = lines - run
    for name, (run, lines) in sorted(by_folder.items()):
        print(f"{100 * run / lines:6.1f} %  {lines:5} lines  {name}")
    print(f"{100 * whole[0] / whole[1]:6.1f} %  {whole[1]:5} lines  engine")
    for path, lines in missed.most_common(10):
        if lines:
            print(f"{lines:5} lines not run in {path}")
    if whole[0] < SHARE_TO_RUN * whole[1]:
        sys.exit(f"fewer than {100 * SHARE_TO_RUN:g} % of the engine's lines are run")


if __name__ == "__main__":
    main(*sys.argv[1:])
