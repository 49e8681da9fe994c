// Reads what the program wrote (demos/page/byte_stream.h): a zlib stream in base64, and in it whole numbers of variable
// length.

export async function unpacked(base64) {
  const packed = Uint8Array.from(atob(base64.trim()), c => c.charCodeAt(0));
  const inflating = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(inflating).arrayBuffer());
}

export class Stream {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  whole() {
    let value = 0;
    for (let factor = 1; ; factor *= 128) {
      const byte = this.bytes[this.at++];
      value += (byte & 127) * factor;
      if (byte < 128) break;
    }
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  byte() {
    return this.bytes[this.at++];
  }

  wholes(count) {
    return Array.from({ length: count }, () => this.whole());
  }

  text() {
    const length = this.whole();
    this.at += length;
    return new TextDecoder().decode(this.bytes.subarray(this.at - length, this.at));
  }

  /** A column of second differences, into every `stride`-th place of `out`, in units of `quantum`. */
  column(out, first, stride, count, quantum) {
    for (let i = 0, at = first, last = 0, step = 0; i < count; ++i, at += stride) {
      step += this.whole();
      last += step;
      out[at] = last * quantum;
    }
  }

  /** A column of first differences, in units of `quantum`. */
  differences(out, first, stride, count, quantum = 1) {
    for (let i = 0, at = first, last = 0; i < count; ++i, at += stride) {
      last += this.whole();
      out[at] = last * quantum;
    }
  }

  /** What byLogarithm wrote. */
  logarithm() {
    return 2 ** (this.whole() / 128);
  }
}
