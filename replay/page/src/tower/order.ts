/** Sorting of many numbers. */

/**
 * The places of numbers in increasing order; of equal ones, as they stand. Some ten times as fast as sorting by a
 * function: digits of 16 bits, the last one first. Cost: twice the numbers when they are whole and not too far apart, else
 * four times, less where digits are all the same.
 */
export function orderBy(numbers: Float64Array): Uint32Array {
  let order = new Uint32Array(numbers.length);
  for (let k = 0; k < order.length; ++k) {
    order[k] = k;
  }
  for (const word of wordsOf(numbers)) {
    order = orderByDigit(word, 16, orderByDigit(word, 0, order));
  }
  return order;
}

// Loops over lists from here on, and no functions for each number: those take ten times as long.

/** Lists of whole numbers of 32 bits, the last of which counts most, that are ordered as these. */
function wordsOf(numbers: Float64Array): Uint32Array[] {
  const count = numbers.length;
  let [least, largest] = [Infinity, -Infinity];
  let areWhole = true;
  for (let k = 0; k < count; ++k) {
    const x = numbers[k];
    least = x < least ? x : least;
    largest = x > largest ? x : largest;
    areWhole &&= Math.floor(x) === x;
  }
  const low = new Uint32Array(count);
  if (areWhole && largest - least < 2 ** 32) {
    for (let k = 0; k < count; ++k) {
      low[k] = numbers[k] - least;
    }
    return [low];
  }
  const copy = new Float64Array(numbers);
  const halves = new Uint32Array(copy.buffer);
  const high = new Uint32Array(count);
  for (let k = 0; k < count; ++k) {
    copy[k] += 0; // -0 is 0
    // The bits of negative numbers turned over, the sign of others set.
    const isNegative = halves[2 * k + 1] >>> 31 === 1;
    low[k] = isNegative ? ~halves[2 * k] : halves[2 * k];
    high[k] = isNegative ? ~halves[2 * k + 1] : halves[2 * k + 1] | 0x80000000;
  }
  return [low, high];
}

/** The same places in the order of a digit of 16 bits; where that is equal, as before. */
function orderByDigit(words: Uint32Array, shift: number, before: Uint32Array): Uint32Array<ArrayBuffer> {
  const count = words.length;
  const starts = new Uint32Array(0x10001);
  for (let k = 0; k < count; ++k) {
    ++starts[((words[k] >>> shift) & 0xffff) + 1];
  }
  const after = new Uint32Array(before);
  if (count === 0 || starts[((words[0] >>> shift) & 0xffff) + 1] === count) {
    return after;
  }
  for (let digit = 1; digit < starts.length; ++digit) {
    starts[digit] += starts[digit - 1];
  }
  for (let k = 0; k < count; ++k) {
    const place = before[k];
    after[starts[(words[place] >>> shift) & 0xffff]++] = place;
  }
  return after;
}
