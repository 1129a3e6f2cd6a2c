/** Long lists of numbers, which pages are given as base64 of their bytes: read in no time, and short. */

export interface Packed {
  /** What one number is: a float of 32 bits, or a whole number of 16 or 32 without a sign. */
  kind: "f32" | "u16" | "u32";
  data: string;
}

function bytesOf(text: string): Uint8Array {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; ++k) {
    bytes[k] = raw.charCodeAt(k);
  }
  return bytes;
}

export function floats({ data }: Packed): Float32Array {
  return new Float32Array(bytesOf(data).buffer);
}

/** As 32 bits each, which is what graphics cards take for any number of points. */
export function wholes({ kind, data }: Packed): Uint32Array {
  const { buffer } = bytesOf(data);
  return kind === "u16" ? Uint32Array.from(new Uint16Array(buffer)) : new Uint32Array(buffer);
}
