/** Generators, and what is said of a chain that was chosen: its order, its text, what it bounds. */
import { colourOfGenerator, cssColour } from "../colours.ts";
import { button, copy, paragraph } from "../elements.ts";
import type { Answer, Chain, Data, Generator } from "./data.ts";
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

export class ChainPanel {
  private readonly buttons: HTMLButtonElement[] = [];

  constructor(
    private readonly list: HTMLElement,
    private readonly details: HTMLElement,
    private readonly data: Data,
    private readonly nameOf: NameOf,
    private readonly onChoose: (indices: number[]) => void,
  ) {
    this.fill();
  }

  /** Lists the generators that the data have. */
  fill(): void {
    const { list, data, onChoose } = this;
    list.replaceChildren();
    this.buttons.length = 0;
    const ofDimension = new Map<number, number[]>();
    data.generators.forEach((generator, index) => {
      const same = ofDimension.get(generator.dim) ?? [];
      const number = same.push(index) - 1;
      ofDimension.set(generator.dim, same);
      const made = button("", () => onChoose(made.getAttribute("aria-pressed") === "true" ? [] : [index]));
      const swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.backgroundColor = cssColour(colourOfGenerator(index));
      made.append(swatch, generatorTitle(generator, number));
      made.setAttribute("aria-pressed", "false");
      list.append(made);
      this.buttons.push(made);
    });
    for (const [dimension, indices] of ofDimension) {
      if (indices.length > 1) {
        list.append(button(`all of H${dimension}`, () => onChoose(indices)));
      }
    }
    if (data.generators.length === 0) {
      list.append(paragraph("The object has no homology: nothing is left of it."));
    }
  }

  /** Of the object at the end. `wanted`: how many there are in each dimension. */
  remark(wanted: readonly number[]): string {
    const missing = wanted.flatMap((count, p) => {
      const shown = this.data.generators.filter(({ dim }) => dim === p).length;
      return shown < count ? [`${shown} of the ${count} of H${p}`] : [];
    });
    return missing.length > 0 ? `Generators are listed up to a limit: ${missing.join(", ")}.` : "";
  }

  choose(indices: readonly number[]): void {
    this.buttons.forEach((made, k) => made.setAttribute("aria-pressed", String(indices.includes(k))));
    this.details.replaceChildren();
    if (indices.length > 1) {
      this.details.append(paragraph(`${indices.length} generators are drawn; one that is clicked is explained.`));
    }
    if (indices.length !== 1) {
      return;
    }
    const generator = this.data.generators[indices[0]];
    this.details.append(paragraph(`A generator of H${generator.dim}, ${orderText(generator)}.`));
    this.details.append(chainBox("cycle", generator.chain, this.nameOf));
    if (generator.bounds) {
      this.details.append(chainBox(`${generator.order} times it bounds`, generator.bounds, this.nameOf));
    }
  }

  showAnswer(answer: Answer): void {
    this.choose([]);
    const is = !answer.cycle ? "no cycle" : answer.zero ? "a cycle that bounds" : `a cycle of the class (${answer.coefficients.join(", ")})`;
    this.details.append(paragraph(`The chain that this step asks for is ${is}.`));
    this.details.append(chainBox("the chain", answer.asked, this.nameOf));
    if (answer.bounds) {
      this.details.append(chainBox("it bounds", answer.bounds, this.nameOf));
    }
  }
}
