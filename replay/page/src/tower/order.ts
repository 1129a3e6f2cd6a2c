/** Sorting of many numbers. */

/**
 * The places of numbers in increasing order; of equal ones, as they stand. Some ten times as fast as sorting by a
 * function: digits of 16 bits, the last one first. Cost: four times the numbers, less where digits are all the same.
 */
export function orderBy(numbers: Float64Array): Uint32Array {
  const count = numbers.length;
  const copy = new Float64Array(numbers);
  for (let k = 0; k < count; ++k) {
    copy[k] += 0; // -0 is 0
  }
  const words = new Uint32Array(copy.buffer);
  // Bits that are ordered as the numbers: those of negative ones turned over, the sign of others set.
  for (let k = 0; k < words.length; k += 2) {
    if (words[k + 1] >>> 31) {
      words[k] = ~words[k];
      words[k + 1] = ~words[k + 1];
    } else {
      words[k + 1] |= 0x80000000;
    }
  }
  let from = new Uint32Array(count);
  for (let k = 0; k < count; ++k) {
    from[k] = k;
  }
  let to = new Uint32Array(count);
  const starts = new Uint32Array(0x10001);
  for (const [word, shift] of [[0, 0], [0, 16], [1, 0], [1, 16]]) {
    // Loops over lists and no functions for each number: those take ten times as long.
    starts.fill(0);
    for (let k = word; k < words.length; k += 2) {
      ++starts[((words[k] >>> shift) & 0xffff) + 1];
    }
    if (count === 0 || starts[((words[word] >>> shift) & 0xffff) + 1] === count) {
      continue;
    }
    for (let digit = 1; digit < starts.length; ++digit) {
      starts[digit] += starts[digit - 1];
    }
    for (let k = 0; k < count; ++k) {
      to[starts[(words[2 * from[k] + word] >>> shift) & 0xffff]++] = from[k];
    }
    [from, to] = [to, from];
  }
  return from;
}
