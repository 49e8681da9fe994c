"""coverage.py FOLDER: prints the share of the engine's lines that were run, folder by folder, from what a build with
--coverage left in FOLDER; then the ten files with the most lines that were not. Exit 1: fewer than nine tenths were.
Run by `bash tests/checks.sh coverage`."""
import collections
import json
import pathlib
import subprocess
import sys

SHARE_TO_RUN = 0.9
ROOT = pathlib.Path(__file__).resolve().parent.parent


def counts_of(data):
    """Of one .gcda: {(source, line): runs} of the engine's sources."""
    out = subprocess.run(["gcov", "--json-format", "--stdout", str(data)], capture_output=True, text=True, cwd=data.parent)
    counts = collections.Counter()
    for line in out.stdout.splitlines():
        report = json.loads(line)
        for source in report["files"]:
            path = (pathlib.Path(report["current_working_directory"]) / source["file"]).resolve()
            if not path.is_relative_to(ROOT / "engine"):
                continue
            for entry in source["lines"]:
                counts[path.relative_to(ROOT).as_posix(), entry["line_number"]] += entry["count"]
    return counts


def main(folder):
    runs = {}
    for data in sorted(pathlib.Path(folder).rglob("*.gcda")):
        for place, count in counts_of(data).items():
            runs[place] = runs.get(place, 0) + count
    if not runs:
        sys.exit(f"nothing was measured in {folder}")
    whole, by_folder, missed = [0, 0], collections.defaultdict(lambda: [0, 0]), collections.Counter()
    for (path, _), count in runs.items():
        for total in (whole, by_folder[path.rpartition("/")[0]]):
            total[0] += count > 0
            total[1] += 1
        missed[path] += count == 0
    for name, (hit, lines) in sorted(by_folder.items()):
        print(f"{100 * hit / lines:6.1f} %  {lines:5} lines  {name}")
    print(f"{100 * whole[0] / whole[1]:6.1f} %  {whole[1]:5} lines  engine")
    for path, lines in missed.most_common(10):
        if lines:
            print(f"{lines:5} lines not run in {path}")
    if whole[0] < SHARE_TO_RUN * whole[1]:
        sys.exit(f"fewer than {100 * SHARE_TO_RUN:g} % of the engine's lines are run")


if __name__ == "__main__":
    main(sys.argv[1])
