#!/usr/bin/env python3
"""Makes the moving picture at the top of the README: moving_picture.py CAROM [OUT.png]

Renders a shipped scene by the program CAROM and puts its frames into one animated PNG, of which only what changes from frame
to frame is kept, in a palette of at most 256 colours. Needs only Python 3."""
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
SCENE, SIZE, FPS, SECONDS = "fifty-bodies", (640, 360), 15, 4.0


def frames_of(carom, folder):
    width, height = SIZE
    run = subprocess.run([carom, "render", SCENE, "--size", f"{width}x{height}", "--fps", str(FPS), "--duration",
                          str(SECONDS), "-q", "-o", "-", "--stream", "rgb24"], stdout=subprocess.PIPE, check=True,
                         cwd=folder)
    size = 3 * width * height
    return [run.stdout[at:at + size] for at in range(0, len(run.stdout), size)]


def pixels_of(frame):
    """24-bit colours, the lowest two bits of each channel rounded off: flat parts pack well."""
    coarse = frame.translate(bytes(min(255, (value + 2) // 4 * 4) for value in range(256)))
    return [coarse[at:at + 3] for at in range(0, len(coarse), 3)]


def palette_of(frames, most=256):
    """Median cut of the colours of all frames."""
    counts = {}
    for pixels in frames:
        for color in pixels:
            counts[color] = counts.get(color, 0) + 1
    boxes = [list(counts)]
    while len(boxes) < most:
        def spread(box):
            if len(box) < 2:
                return (0, 0)
            ranges = [max(c[k] for c in box) - min(c[k] for c in box) for k in range(3)]
            widest = max(range(3), key=lambda k: ranges[k])
            return (ranges[widest] * sum(counts[c] for c in box) ** 0.5, widest)
        scored = max(range(len(boxes)), key=lambda i: spread(boxes[i])[0])
        score, channel = spread(boxes[scored])
        if score == 0:
            break
        box = sorted(boxes.pop(scored), key=lambda c: (c[channel], c))
        half, below, cut = sum(counts[c] for c in box) / 2, 0, 1
        for cut in range(1, len(box)):
            below += counts[box[cut - 1]]
            if below >= half:
                break
        boxes += [box[:cut], box[cut:]]
    palette, index = [], {}
    for number, box in enumerate(boxes):
        total = sum(counts[c] for c in box)
        palette.append(bytes(round(sum(c[k] * counts[c] for c in box) / total) for k in range(3)))
        index.update((color, number) for color in box)
    return palette, index


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def packed(rows):
    return zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)


def changed_part(before, now, width, height):
    """The rectangle in which two frames differ: x, y, width, height."""
    rows = [y for y in range(height) if before[y * width:(y + 1) * width] != now[y * width:(y + 1) * width]]
    if not rows:
        return 0, 0, 1, 1
    y0, y1 = rows[0], rows[-1] + 1
    columns = [x for x in range(width) if any(before[y * width + x] != now[y * width + x] for y in range(y0, y1))]
    return columns[0], y0, columns[-1] + 1 - columns[0], y1 - y0


def animated_png(frames, palette):
    width, height = SIZE
    clear = len(palette)  # a colour that leaves what is there
    out = [b"\x89PNG\r\n\x1a\n", chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)),
           chunk(b"PLTE", b"".join(palette) + b"\0\0\0"), chunk(b"tRNS", b"\xff" * clear + b"\0"),
           chunk(b"acTL", struct.pack(">II", len(frames), 0))]
    sequence, before = 0, None
    for number, now in enumerate(frames):
        x, y, w, h = (0, 0, width, height) if before is None else changed_part(before, now, width, height)
        rows = []
        for row in range(y, y + h):
            begin, end = row * width + x, row * width + x + w
            fresh = now[begin:end]
            if before is not None:
                fresh = bytes(clear if a == b else b for a, b in zip(before[begin:end], fresh))
            rows.append(fresh)
        delay = 2 * FPS if number + 1 == len(frames) else 1  # the last one stays for two seconds
        out.append(chunk(b"fcTL", struct.pack(">IIIIIHHBB", sequence, w, h, x, y, delay, FPS, 0, int(number > 0))))
        sequence += 1
        if number == 0:
            out.append(chunk(b"IDAT", packed(rows)))
        else:
            out.append(chunk(b"fdAT", struct.pack(">I", sequence) + packed(rows)))
            sequence += 1
        before = now
    return b"".join(out + [chunk(b"IEND", b"")])


def main():
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    out = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE / "moving-picture.png"
    with tempfile.TemporaryDirectory() as folder:
        frames = [pixels_of(frame) for frame in frames_of(str(pathlib.Path(sys.argv[1]).resolve()), folder)]
    palette, index = palette_of(frames, 255)
    out.write_bytes(animated_png([bytes(index[color] for color in pixels) for pixels in frames], palette))
    print(f"{out}: {len(frames)} frames, {out.stat().st_size} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
