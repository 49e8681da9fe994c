#!/usr/bin/env python3
"""What pages cost in headless Chromium: pages.py frames CAROM [BODIES], or pages.py first-view GALLERY

frames: exports a scene of 200 (or BODIES) tumbling crates as a page, plays it through by Chromium's debugging pipe, and
prints the median and the slowest of 60 frames: of the page's own thread from poses to the last call of WebGL, with overlays
and without, and until the picture is finished, which the CPU draws here (SwiftShader).
first-view: opens the index of a gallery and three of its pages from disk, five times each, and prints the median time to the
first contents in the window, to all that the window shows, and the size of the folder. Exit 1 where the first contents take
a second or the folder is above 40 MB.
Needs Python 3 and Debian's chromium."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

SCENE = {"format": 1, "duration": 1, "bodies": [
    {"name": "floor", "shape": {"box": [60, 60, 1]}, "position": [0, 0, -0.5], "static": True, "material": {"checker": True}},
    {"name": "crate", "shape": {"box": [0.4, 0.3, 0.35]}, "position": [-2, -2, 0.5],
     "repeat": {"count": [5, 5, 8], "step": [1, 1, 0.6], "jitter": 0.05, "jitterDegrees": 30}}]}
SCRIPT = """(async () => {
  carom.setPlaying(false);
  const { gl } = carom.graphics, pixel = new Uint8Array(4), middle = times => times.sort((a, b) => a - b)[30];
  const measured = () => {
    const own = [], all = [];
    for (let i = 0; i < 60; ++i) {
      carom.seek(i / 60 * carom.recording.duration);
      const begin = performance.now();
      carom.draw();
      own.push(performance.now() - begin);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      all.push(performance.now() - begin);
    }
    return { own: middle(own), slowest: own[59], all: middle(all) };
  };
  measured();
  const plain = measured();
  for (const name of ["contacts", "impulses", "modes", "gaps"]) carom.setOverlay(name, true);
  return JSON.stringify({ bodies: carom.recording.bodies.length, size: [carom.view.width, carom.view.height], plain, overlays: measured() });
})()"""


class Chromium:
    """Speaks with it by file descriptors 3 and 4; messages end with a zero byte."""

    def __init__(self, folder):
        to_read, self.to = os.pipe()
        self.source, from_write = os.pipe()
        # The copies stay open when the process begins; they may be any numbers but 3 and 4.
        keep = [os.dup(to_read), os.dup(from_write)]
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec chromium "$@" 3<&{keep[0]} 4>&{keep[1]}', "chromium", "--headless", "--no-sandbox",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--window-size=1280,720",
             f"--user-data-dir={folder}/user", "--remote-debugging-pipe"],
            pass_fds=keep, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for descriptor in (to_read, from_write, *keep):
            os.close(descriptor)
        self.rest, self.number = b"", 0

    def ask(self, method, session=None, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.rest:
                part = os.read(self.source, 65536)
                if not part:
                    sys.exit("chromium has gone")
                self.rest += part
            text, self.rest = self.rest.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("id") == self.number:
                return answer.get("result")  # none: the page was not there yet


    def opened(self, page):
        """A session with a new tab, which opens the page once the browser has started."""
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.until(session, "document.readyState === 'complete'")
        time.sleep(1)
        self.ask("Page.navigate", session, url=page.as_uri())
        return session

    def value(self, session, script):
        told = self.ask("Runtime.evaluate", session, expression=script, awaitPromise=True)
        if told and "exceptionDetails" in told:
            sys.exit(told["exceptionDetails"]["exception"]["description"])
        return told["result"].get("value") if told else None

    def until(self, session, script):
        for _ in range(600):
            value = self.value(session, script)
            if value:
                return value
            time.sleep(0.1)
        sys.exit(f"in a minute there was no {script}")

    def close(self):
        self.ask("Browser.close")
        self.process.wait()


def frames(program, bodies):
    SCENE["bodies"][1]["repeat"]["count"][2] = max(1, bodies // 25)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        scene, page = pathlib.Path(folder) / "crates.json", pathlib.Path(folder) / "crates.html"
        scene.write_text(json.dumps(SCENE))
        subprocess.run([program, "export", scene, page, "-q"], check=True, stdout=subprocess.DEVNULL)
        chromium = Chromium(folder)
        session = chromium.opened(page)
        chromium.until(session, "!!(globalThis.caromStarted && globalThis.carom)")
        figures = json.loads(chromium.value(session, SCRIPT))
        chromium.close()
        print(f"{figures['bodies']} bodies, {figures['size'][0]}x{figures['size'][1]}, page of {page.stat().st_size} bytes")
        for name, text in (("plain", "without overlays"), ("overlays", "contacts, impulses, modes, gaps")):
            of = figures[name]
            print(f"{text:32}  page's thread {of['own']:.2f} ms, slowest {of['slowest']:.2f} ms; picture finished {of['all']:.1f} ms")
    return 0


# When the window's first contents were painted, and when the last picture in it had come: ms since the page was asked for.
FIRST_VIEW = """(async () => {
  if (location.href === "about:blank") return "";
  const paint = performance.getEntriesByName("first-contentful-paint")[0];
  if (!paint || document.readyState !== "complete") return "";
  const shown = [...document.images].filter(image => image.getBoundingClientRect().top < innerHeight);
  await Promise.all(shown.map(image => image.decode().catch(() => {})));
  const ends = performance.getEntriesByType("resource").filter(e => shown.some(i => i.currentSrc === e.name)).map(e => e.responseEnd);
  return JSON.stringify({ first: paint.startTime, all: Math.max(paint.startTime, ...ends), pictures: shown.length });
})()"""


def first_view(gallery):
    pages = [gallery / "index.html", *sorted(p for p in gallery.rglob("*.html") if p.name != "index.html")[:3]]
    megabytes = sum(f.stat().st_size for f in gallery.rglob("*") if f.is_file()) / 1e6
    late = megabytes >= 40
    print(f"{megabytes:.1f} MB in the folder")
    for page in pages:
        seen = []
        for _ in range(5):
            with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
                chromium = Chromium(folder)
                seen.append(json.loads(chromium.until(chromium.opened(page), FIRST_VIEW)))
                chromium.close()
        first, whole = (sorted(s[what] for s in seen)[2] for what in ("first", "all"))
        late = late or first >= 1000
        print(f"{page.name:32} first contents {first:.0f} ms, {seen[0]['pictures']} pictures in the window by {whole:.0f} ms")
    return 1 if late else 0


def main():
    if len(sys.argv) in (3, 4) and sys.argv[1] == "frames":
        return frames(sys.argv[2], int(sys.argv[3]) if len(sys.argv) == 4 else 200)
    if len(sys.argv) == 3 and sys.argv[1] == "first-view":
        return first_view(pathlib.Path(sys.argv[2]).resolve())
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
