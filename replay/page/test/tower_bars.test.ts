import assert from "node:assert/strict";
import { test } from "node:test";
import { Bars, joined } from "../src/tower/bars.ts";
import { BettiCurves, cornersOf, countUpTo } from "../src/tower/betti.ts";
import { apply, everything, type Filter, filterText, isPlain, noFilter } from "../src/tower/filter.ts";
import { Model } from "../src/tower/model.ts";
import { orderBy } from "../src/tower/order.ts";
import { circle, randomLists, randomNumbers, towerData } from "./tower_samples.ts";

test("numbers are put in order as by a comparison, equal ones as they stand", () => {
  const random = randomNumbers(3);
  const numbers = Float64Array.from([0, -0, Infinity, -Infinity, 5e-324, -5e-324, 1e300, -1e300, ...Array.from({ length: 3000 }, () => (random() - 0.5) * 10 ** Math.floor(random() * 20 - 10)), 7, 7, 7]);
  const expected = [...numbers.keys()].sort((a, b) => (numbers[a] < numbers[b] ? -1 : numbers[a] > numbers[b] ? 1 : a - b));
  assert.deepEqual([...orderBy(numbers)], expected);
  assert.deepEqual([...orderBy(new Float64Array())], []);
  for (const [low, high] of [[-5, 5], [-40000, 40000], [-2147483648, 2147483646], [-2147483648, 2147483648], [1e15, 1e15 + 9]]) {
    const whole = Float64Array.from({ length: 2000 }, () => Math.floor(low + random() * (high - low)));
    whole.set([low, high, low]);
    assert.deepEqual([...orderBy(whole)], [...whole.keys()].sort((a, b) => whole[a] - whole[b] || a - b));
  }
});

test("births and lengths are read as what they are more than the one before", () => {
  const bars = new Bars(circle);
  assert.deepEqual([...bars.births], [1, 2, 0, 5]);
  assert.deepEqual([...bars.deaths], [3, 4, Infinity, 6]);
  assert.deepEqual(bars.parts, [{ dim: 0, first: 0, open: 2, end: 3 }, { dim: 1, first: 3, open: 3 + 1, end: 4 }]);
  assert.deepEqual([0, 2, 3].map((bar) => bars.dimension(bar)), [0, 0, 1]);
  assert.deepEqual([...bars.inRows()], [2, 0, 1, 3]);
  assert.deepEqual([...bars.byLength()], [2, 0, 1, 3]);
  assert.deepEqual(bars.range(), [0, 6]);
  assert.deepEqual(new Bars([]).range(), [0, 1]);
  assert.equal(bars.longestOf(bars.parts[0]), 2);
});

test("two lists of bars are one, in order", () => {
  const all = joined(circle, [{ dim: 0, births: [0], deaths: [9], open: [4] }, { dim: 3, births: [], deaths: [], open: [1] }]);
  assert.deepEqual(all, [
    { dim: 0, births: [0, 1, 2], deaths: [9, 3, 4], open: [0, 4] },
    { dim: 1, births: [5], deaths: [6], open: [] },
    { dim: 3, births: [], deaths: [], open: [1] },
  ]);
});

/** Each bar for itself. */
function bettiByHand(bars: Bars, dim: number, time: number, kept?: Uint8Array): number {
  let count = 0;
  for (let bar = 0; bar < bars.count; ++bar) {
    count += bars.dimension(bar) === dim && bars.births[bar] <= time && time < bars.deaths[bar] && (kept?.[bar] ?? 1) ? 1 : 0;
  }
  return count;
}

test("Betti numbers are those of the bars that are alive, of all or of some", () => {
  const bars = new Bars(randomLists(60));
  const curves = new BettiCurves(bars, bars.inRows());
  const kept = Uint8Array.from({ length: bars.count }, (_, bar) => (bar % 3 === 0 ? 1 : 0));
  for (let time = -1; time < 62; time += 0.5) {
    assert.deepEqual(curves.at(time), [bettiByHand(bars, 0, time), 0, bettiByHand(bars, 2, time)]);
  }
  for (const [part, dim] of [[0, 0], [1, 2]]) {
    for (const some of [null, kept]) {
      let [last, value] = [-Infinity, 0];
      curves.visit(part, some, (time, next) => {
        assert.ok(time > last && next !== value, "at changes only, in order");
        if (last > -Infinity) {
          assert.equal(value, bettiByHand(bars, dim, (last + time) / 2, some ?? undefined));
        }
        [last, value] = [time, next];
      });
      assert.equal(value, bettiByHand(bars, dim, 1000, some ?? undefined));
    }
  }
  assert.deepEqual([0, 1, 3].map((x) => countUpTo(Float64Array.from([0, 1, 1, 2]), x)), [1, 3, 4]);
  const peaks = [0, 2].map((dim) => Math.max(...Array.from({ length: 63 }, (_, time) => bettiByHand(bars, dim, time))));
  assert.deepEqual([...curves.largest], peaks);
});

test("a drawn curve has each level where there is room, and the extremes of each pixel where there is none", () => {
  const bars = new Bars(circle);
  const curves = new BettiCurves(bars, bars.inRows());
  assert.deepEqual(cornersOf(curves, 0, null, (time) => 10 * time, 60), [0, 0, 0, 1, 10, 1, 10, 2, 20, 2, 20, 3, 30, 3, 30, 2, 40, 2, 40, 1, 60, 1]);
  const dense = new Bars([{ dim: 0, births: [0, 1, 2, 3], deaths: [10, 10, 10, 10], open: [] }]);
  const corners = cornersOf(new BettiCurves(dense, dense.inRows()), 0, null, (time) => time / 1000, 5);
  assert.deepEqual(corners, [0, 0, 0, 4, 0, 0, 5, 0]);
});

test("a filter keeps what it says, by dimension and in all", () => {
  const bars = new Bars(randomLists(40, 5));
  const kept = new Uint8Array(bars.count);
  const cases: [Partial<Filter>, (dim: number, b: number, d: number) => boolean][] = [
    [{}, () => true],
    [{ without: new Set([2]) }, (dim) => dim !== 2],
    [{ open: false }, (_, __, d) => d < Infinity],
    [{ length: [5, 12] }, (_, b, d) => d - b >= 5 && d - b <= 12],
    [{ birth: [10, 20], death: [0, 30] }, (_, b, d) => b >= 10 && b <= 20 && d <= 30],
    [{ death: [Infinity, Infinity] }, (_, __, d) => d === Infinity],
    [{ alive: [15, 15] }, (_, b, d) => b <= 15 && d > 15],
    [{ alive: [-Infinity, 3] }, (_, b) => b <= 3],
  ];
  for (const [some, keeps] of cases) {
    const counts = apply({ ...noFilter, ...some }, bars, kept);
    const expected = Array.from({ length: bars.count }, (_, bar) => (keeps(bars.dimension(bar), bars.births[bar], bars.deaths[bar]) ? 1 : 0));
    assert.deepEqual([...kept], expected, JSON.stringify(some));
    assert.deepEqual(counts, bars.parts.map(({ first, end }) => expected.slice(first, end).reduce<number>((sum, x) => sum + x, 0)));
  }
  assert.ok(isPlain(noFilter) && isPlain({ ...noFilter, birth: everything }) && !isPlain({ ...noFilter, birth: [0, Infinity] }));
});

test("a filter is said in words", () => {
  const filter: Filter = { without: new Set([2, 0]), open: false, length: [3, Infinity], birth: [-Infinity, 4], death: everything, alive: [1, 2] };
  assert.equal(filterText(filter, String, String), "without H0, H2; length from 3 on; born up to 4; alive at a time from 1 to 2; none that never end");
  assert.equal(filterText({ ...noFilter, death: [Infinity, Infinity] }, String, String), "only those that never end");
  assert.equal(filterText(noFilter, String, String), "");
});

test("a model lists the longest of the bars that are kept, and knows their places", () => {
  const model = new Model(towerData(randomLists(50, 9)));
  model.setFilter({ ...noFilter, alive: [10, 12], open: false });
  assert.equal(model.filterText(), `${model.keptCount} of 110 bars: alive at a time from 10 to 12; none that never end`);
  const list = model.longest(0, 1000);
  assert.equal(list.length, model.keptCount);
  assert.ok(model.keptCount > 20 && model.keptCount < model.bars.count);
  list.forEach((bar, place) => {
    assert.ok(model.kept[bar] === 1);
    assert.equal(model.placeOf(bar), place);
    assert.ok(place === 0 || model.bars.length(list[place - 1]) >= model.bars.length(bar));
  });
  assert.deepEqual(model.longest(7, 3), list.slice(7, 10));
  assert.deepEqual([...model.rows].sort((a, b) => a - b), [...list].sort((a, b) => a - b));
  model.fits = true;
  model.setRange();
  assert.ok(model.range.low > -2 && model.range.high < 40);
});

test("bars that are left out are in the Betti curves and nowhere else", () => {
  const model = new Model(towerData(circle, { left_out: [{ dim: 1, births: [0], deaths: [9], open: [] }] }));
  assert.equal(model.bars.count, 4);
  assert.deepEqual(model.allCurves.at(5), [1, 2]);
  assert.deepEqual(model.curves.at(5), [1, 1]);
  assert.ok(model.range.high > 9);
  assert.equal(model.text(3), "H1 [5, 6), length 1");
  assert.equal(model.text(2), "H0 [0, \u221e), never ends");
});
