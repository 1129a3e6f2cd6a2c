import assert from "node:assert/strict";
import { test } from "node:test";
import { BarcodePlot } from "../src/tower/barcode_plot.ts";
import { BettiPlot } from "../src/tower/betti_plot.ts";
import { DiagramPlot } from "../src/tower/diagram_plot.ts";
import { noFilter } from "../src/tower/filter.ts";
import { lightInks } from "../src/tower/inks.ts";
import { Model } from "../src/tower/model.ts";
import type { Shades } from "../src/tower/paper.ts";
import { escaped, SvgPaper } from "../src/tower/svg_paper.ts";
import { circle, randomLists, towerData } from "./tower_samples.ts";

/** Counts what is drawn on it. */
class CountingPaper extends SvgPaper {
  lines = 0;
  marks = 0;
  shaded = 0;
  texts: string[] = [];
  override segments(ends: readonly number[], colour: string, width: number): void {
    this.lines += lightInks.dims.includes(colour) ? ends.length / 4 : 0;
    super.segments(ends, colour, width);
  }
  override symbols(...[shape, places, colour, alpha]: Parameters<SvgPaper["symbols"]>): void {
    this.marks += places.length / 3;
    super.symbols(shape, places, colour, alpha);
  }
  override shades(x: number, y: number, shades: Shades, colour: string): void {
    this.shaded += shades.values.filter((value) => value > 0).length;
    super.shades(x, y, shades, colour);
  }
  override text(...[x, y, text, colour, style]: Parameters<SvgPaper["text"]>): void {
    this.texts.push(text);
    super.text(x, y, text, colour, style);
  }
}

const size = { width: 900, height: 400 };

test("each bar has a line that is found again where it is", () => {
  const model = new Model(towerData(circle));
  const plot = new BarcodePlot();
  const paper = new CountingPaper();
  plot.draw(paper, model, size, lightInks);
  assert.equal(paper.lines, 4 + 2, "one each, and the arrow of the open one");
  assert.ok(paper.texts.includes("H0") && paper.texts.includes("H1"));
  assert.equal(plot.note(), "");
  const found = new Set<number>();
  for (let y = 0; y < 360; y += 3) {
    found.add(plot.barAt(model, 400, y));
  }
  assert.deepEqual([...found].filter((bar) => bar >= 0).sort(), [0, 1, 2, 3]);
  const middle = plot.timeAt((46 + 882) / 2)!;
  assert.ok(Math.abs(middle - 3) < 1e-9);
  assert.equal(plot.timeAt(10), null);
  const { alive } = plot.brushed(10, 0, 464);
  assert.deepEqual([alive![0], Math.round(alive![1] * 1e9) / 1e9], [-Infinity, 3]);
});

test("of more bars than there are rows none is left out, and the picture says how", () => {
  const model = new Model(towerData(randomLists(5000)));
  const plot = new BarcodePlot();
  const paper = new CountingPaper();
  plot.draw(paper, model, size, lightInks);
  assert.match(plot.note(), /^Nothing is left out: H0 has 5,500 bars in \d+ rows, up to \d+ in each; H2 has 5,500 bars/);
  assert.ok(paper.shaded > 1000);
  // The bars at a point are found by looking at all of its row: the longest one there is alive then.
  for (const [x, y] of [[200, 60], [400, 100], [300, 300], [700, 350]]) {
    const bar = plot.barAt(model, x, y);
    const time = plot.timeAt(x)!;
    if (bar >= 0) {
      const slack = (model.range.high - model.range.low) / 100;
      assert.ok(model.bars.births[bar] <= time + slack && model.bars.deaths[bar] >= time - slack);
    }
  }
  // With few bars of one dimension and many of another, the few have lines.
  const mixed = new Model(towerData([randomLists(5000)[0], { dim: 1, births: [3], deaths: [9], open: [] }]));
  plot.draw(paper, mixed, size, lightInks);
  assert.match(plot.note(), /^Nothing is left out: H0 has 5,500 bars[^;]*\. The darker/);
});

test("a filter leaves its bars in the picture only", () => {
  const model = new Model(towerData(circle));
  model.setFilter({ ...noFilter, without: new Set([0]) });
  const plot = new BarcodePlot();
  const paper = new CountingPaper();
  plot.draw(paper, model, size, lightInks);
  assert.equal(paper.lines, 1);
  model.setFilter({ ...noFilter, without: new Set([0, 1]) });
  plot.draw(paper, model, size, lightInks);
  assert.ok(paper.texts.includes("no bars"));
});

test("the diagram finds the bar that is nearest, and says what a box means", () => {
  const model = new Model(towerData(circle));
  const plot = new DiagramPlot();
  const paper = new CountingPaper();
  plot.draw(paper, model, { width: 440, height: 440 }, lightInks);
  assert.equal(paper.marks, 4 + 2, "and two in the legend");
  const places = new Map<number, [number, number]>();
  for (let x = 0; x < 440; x += 4) {
    for (let y = 0; y < 440; y += 4) {
      const bar = plot.barAt(model, x, y);
      bar >= 0 && places.set(bar, [x, y]);
    }
  }
  assert.deepEqual([...places.keys()].sort(), [0, 1, 2, 3]);
  assert.ok(places.get(2)![1] < 34, "what never ends is above");
  assert.deepEqual(plot.brushed(0, 0, 440, 440), { birth: [-Infinity, Infinity], death: [-Infinity, Infinity] });
  const { death } = plot.brushed(0, 0, 440, 20);
  assert.deepEqual(death, [Infinity, Infinity]);
  const some = plot.brushed(100, 100, 200, 200);
  assert.ok(some.birth![0] < some.birth![1] && some.death![0] < some.death![1] && some.death![1] < Infinity);
});

test("the diagram of very many bars is shades, of each dimension for itself", () => {
  const model = new Model(towerData(randomLists(4000)));
  const plot = new DiagramPlot();
  const paper = new CountingPaper();
  plot.draw(paper, model, { width: 440, height: 440 }, lightInks);
  assert.ok(paper.shaded > 200);
  assert.match(plot.note(), /^Nothing is left out: 8,800 bars as shades/);
});

test("Betti curves of the kept bars lie over those of all", () => {
  const model = new Model(towerData(circle));
  const plot = new BettiPlot();
  plot.draw(new CountingPaper(), model, size, lightInks);
  assert.equal(plot.note(), "");
  model.setFilter({ ...noFilter, open: false });
  const paper = new CountingPaper();
  plot.draw(paper, model, size, lightInks);
  assert.match(plot.note(), /^Thick: the bars that are kept/);
  assert.ok(paper.file(900, 400, "t").includes("stroke-opacity"));
});

test("an axis is logarithmic, and says so, where a curve would be flat", () => {
  const many = { dim: 0, births: new Array(1000).fill(0), deaths: new Array(1000).fill(2), open: [] };
  const paper = new CountingPaper();
  new BettiPlot().draw(paper, new Model(towerData([many, { dim: 1, births: [1], deaths: [2], open: [] }])), size, lightInks);
  assert.ok(paper.texts.includes("Betti number (logarithmic)"));
});

test("an SVG file has its texts escaped and finite coordinates, whatever the bars", () => {
  const odd = [[], [{ dim: 0, births: [-1e308, 0], deaths: [1e308, 1], open: [] }], [{ dim: 0, births: [], deaths: [], open: [1.7e308] }], [{ dim: 3, births: [0], deaths: [5e-324], open: [] }], [{ dim: 40, births: [], deaths: [], open: [-1.5] }]];
  for (const bars of [...odd, circle, randomLists(5000)]) {
    for (const plot of [new BarcodePlot(), new DiagramPlot(), new BettiPlot()]) {
      const paper = new SvgPaper();
      const model = new Model(towerData(bars));
      plot.draw(paper, model, size, lightInks);
      model.chosen = bars.length > 0 ? 0 : -1;
      plot.mark(paper, model, lightInks);
      const file = paper.file(900, 400, 'a & <b> "c"');
      assert.doesNotMatch(file, /NaN|Infinity/);
      assert.ok(file.includes("<title>a &amp; &lt;b&gt; &quot;c&quot;</title>"));
      assert.equal(file.match(/<text/g)?.length, file.match(/<\/text>/g)?.length);
    }
  }
  assert.equal(escaped("\x01<"), "\ufffd&lt;");
});

test("shades are a few paths of runs", () => {
  const paper = new SvgPaper();
  paper.shades(10, 20, { values: Uint8Array.from([0, 255, 255, 255, 0, 1]), columns: 3, size: 2 }, "#123456");
  const paths = paper.file(1, 1, "").match(/<path[^>]*>/g)!;
  assert.equal(paths.length, 2);
  assert.match(paths[1], /d="M12 20h4v2h-4zM10 22h2v2h-2z"/);
});
