#!/usr/bin/env python3
"""Makes the pictures of tutorial.md by the commands that stand in it: tutorial_pictures.py CAROM

Writes each scene of the page to run.json, runs the page's `carom render ... -o stepN.png` in a folder of its own, and puts
the pictures beside the page as tutorial-N.png. Needs only Python 3."""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
MOST_BYTES = 40000


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    carom = str(pathlib.Path(sys.argv[1]).resolve())
    blocks = re.findall(r"^```(\w+)([^\n]*)\n(.*?)^```", (HERE / "tutorial.md").read_text(), re.M | re.S)
    with tempfile.TemporaryDirectory() as folder:
        for language, remark, text in blocks:
            if remark.strip().startswith("file: "):
                (pathlib.Path(folder) / remark.split(": ", 1)[1].strip()).write_text(text)
                continue
            for command in text.splitlines():
                words = shlex.split(command, comments=True)
                if language != "sh" or words[:2] != ["carom", "render"]:
                    continue
                subprocess.run([carom, *words[1:], "-q"], cwd=folder, check=True)
                step = re.fullmatch(r"step(\d+)\.png", words[-1]).group(1)
                picture = (pathlib.Path(folder) / words[-1]).read_bytes()
                if len(picture) > MOST_BYTES:
                    raise SystemExit(f"{words[-1]}: {len(picture)} bytes; at most {MOST_BYTES}")
                (HERE / f"tutorial-{step}.png").write_bytes(picture)
                print(f"tutorial-{step}.png: {len(picture)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
