/** Generators, and what is said of a chain that was chosen: its order, its text, what it bounds. */
import { colourOfGenerator, cssColour } from "../colours.ts";
import { button, copy, paragraph } from "../elements.ts";
import { type Answer, type Chain, type Data, type Generator, stepOf } from "./data.ts";
import { chainJson, chainSum } from "./replay_text.ts";

type NameOf = (cell: number) => string;

/** A chain with a button that copies it; its text can be selected, too. */
function chainBox(label: string, chain: Chain, nameOf: NameOf): HTMLElement {
  const box = document.createElement("div");
  box.className = "chain";
  box.append(paragraph(label, "label"), paragraph(chainSum(chain, nameOf), "sum"));
  if (chain.length === undefined && chain.length_at_most === undefined) {
    const text = document.createElement("textarea");
    text.readOnly = true;
    text.rows = 2;
    text.value = chainJson(chain, nameOf);
    text.setAttribute("aria-label", `${label}, as a class step takes it`);
    box.append(text, button("copy", (made) => void copy(text.value, made)));
  }
  return box;
}

export function orderText(generator: Generator): string {
  return generator.order === "0" ? "free" : `order ${generator.order}`;
}

export function generatorTitle(generator: Generator, index: number): string {
  return `H${generator.dim}, generator ${index + 1}: ${orderText(generator)}`;
}

/** What a panel is to show of a class that is chosen. */
export interface Chosen {
  generator: Generator;
  chain: Chain;
  bounds?: Chain;
  /** Steps, counted from 0. */
  since?: number;
  end: { step: number; sentence: string } | null;
}

export class ChainPanel {
  private readonly buttons = new Map<number, HTMLButtonElement>();
  private shown = "";

  constructor(
    private readonly list: HTMLElement,
    private readonly details: HTMLElement,
    private readonly data: Data,
    private readonly nameOf: NameOf,
    private readonly onChoose: (numbers: number[]) => void,
    private readonly onJump: (steps: number) => void,
  ) {}

  /** Lists these classes; null: they are not known. */
  fill(numbers: readonly number[] | null): void {
    const shown = JSON.stringify(numbers);
    if (shown === this.shown) {
      return; // so that the focus stays
    }
    this.shown = shown;
    this.list.replaceChildren();
    this.buttons.clear();
    const ofDimension = new Map<number, number[]>();
    for (const number of numbers ?? []) {
      const generator = this.data.classes[number];
      const same = ofDimension.get(generator.dim) ?? [];
      const index = same.push(number) - 1;
      ofDimension.set(generator.dim, same);
      const made = button("", () => this.onChoose(made.getAttribute("aria-pressed") === "true" ? [] : [number]));
      const swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.backgroundColor = cssColour(colourOfGenerator(number));
      made.append(swatch, generatorTitle(generator, index));
      made.setAttribute("aria-pressed", "false");
      this.list.append(made);
      this.buttons.set(number, made);
    }
    for (const [dimension, same] of ofDimension) {
      if (same.length > 1) {
        this.list.append(button(`all of H${dimension}`, () => this.onChoose(same)));
      }
    }
    if (numbers === null) {
      this.list.append(paragraph("Those of this step were not kept; those of the last step are."));
    } else if (numbers.length === 0) {
      this.list.append(paragraph("The object has no homology: there is nothing."));
    }
  }

  /** What is said of lists that are not whole. `wanted`: how many there are in each dimension. */
  remark(numbers: readonly number[] | null, wanted: readonly number[]): string {
    const missing = wanted.flatMap((count, p) => {
      const shown = (numbers ?? []).filter((number) => this.data.classes[number].dim === p).length;
      return shown < count ? [`${shown} of the ${count} of H${p}`] : [];
    });
    return missing.length > 0 ? `Generators are listed up to a limit, at the end ${missing.join(", ")}.` : "";
  }

  /** Marks these classes as chosen; explains the one if it is one. */
  choose(numbers: readonly number[], chosen: Chosen | null): void {
    this.buttons.forEach((made, number) => made.setAttribute("aria-pressed", String(numbers.includes(number))));
    this.details.replaceChildren();
    if (numbers.length > 1) {
      this.details.append(paragraph(`${numbers.length} generators are drawn; one that is clicked is explained.`));
    }
    if (!chosen) {
      return;
    }
    const { generator, chain, bounds, since, end } = chosen;
    this.details.append(paragraph(`A generator of H${generator.dim}, ${orderText(generator)}.`));
    if (since !== undefined) {
      this.details.append(this.sentence("This class is made by", since, "since"));
    }
    if (end) {
      this.details.append(this.sentence(end.sentence, end.step, "end"));
    }
    this.details.append(chainBox("cycle", chain, this.nameOf));
    if (bounds) {
      this.details.append(chainBox(`${generator.order} times it bounds`, bounds, this.nameOf));
    }
  }

  showAnswer(answer: Answer): void {
    this.choose([], null);
    const is = !answer.cycle ? "no cycle" : answer.zero ? "a cycle that bounds" : `a cycle of the class (${answer.coefficients.join(", ")})`;
    this.details.append(paragraph(`The chain that this step asks for is ${is}.`));
    this.details.append(chainBox("the chain", answer.asked, this.nameOf));
    if (answer.bounds) {
      this.details.append(chainBox("it bounds", answer.bounds, this.nameOf));
    }
  }

  /** A sentence about a step, with a button that goes there. */
  private sentence(text: string, step: number, name: string): HTMLElement {
    const made = paragraph(`${text} `, name);
    const { op } = stepOf(this.data.steps[step]);
    made.append(button(`step ${step + 1}${op ? `, ${op}` : ""}`, () => this.onJump(step + 1)), ".");
    return made;
  }
}
