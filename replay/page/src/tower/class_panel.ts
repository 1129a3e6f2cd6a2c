/** What is known of the chosen bar: how its class came and went, and its chains. */
import { button, copy, paragraph } from "../elements.ts";
import { chainJson, chainSum } from "./chain_text.ts";
import type { BarClass, Operation, Term } from "./data.ts";
import { dimensionMark } from "./marks.ts";
import type { Model } from "./model.ts";

/** "by including {4 7}, line 12"; a cell of a boundary matrix is called by its column. */
export function operationText({ line, text }: Operation): string {
  const [kind, ...labels] = text.split(" ");
  if (kind === "column") {
    return `by ${text}`;
  }
  const what = kind === "c" ? `contracting ${labels[0]} into ${labels[1]}` : `including {${labels.join(" ")}}`;
  return `by ${what}, line ${line}`;
}

/** What there is to say of a bar, a sentence each. */
export function barSentences(model: Model, bar: number): string[] {
  const { births, deaths } = model.bars;
  const known = model.classes.get(bar);
  const time = model.data.time_name;
  const by = (operation: Operation | undefined) => (operation ? ` ${operationText(operation)}` : "");
  const open = deaths[bar] === Infinity;
  return [
    `Born at ${time} ${model.times.text(births[bar])}${by(known?.born)}.`,
    open ? "It never ends." : `Ends at ${time} ${model.times.text(deaths[bar])}${by(known?.killed)}; length ${model.times.length(births[bar], deaths[bar])}.`,
  ];
}

/** A chain, or how long it is, with a button that copies it. */
function chainBox(name: string, chain: readonly Term[] | undefined, terms: number | undefined): HTMLElement {
  const box = document.createElement("div");
  box.className = "chain";
  box.append(paragraph(name, "label"));
  if (!chain) {
    box.append(paragraph(`a chain of ${terms} terms, too long for this page; sesame tower --generators --json has it`));
    return box;
  }
  const text = document.createElement("textarea");
  text.readOnly = true;
  text.rows = 2;
  text.value = chainJson(chain);
  text.setAttribute("aria-label", `${name}, as JSON`);
  box.append(paragraph(chain.length > 0 ? chainSum(chain) : "0: nothing is left of it", "sum"), text, button("copy", (made) => void copy(text.value, made)));
  return box;
}

function chainBoxes(known: BarClass): HTMLElement[] {
  const boxes = [chainBox("cycle at the birth", known.cycle, known.cycle_terms)];
  if (known.killed) {
    boxes.push(chainBox("which from its end on is the boundary of", known.bounds, known.bounds_terms));
  } else {
    boxes.push(chainBox("what it is at the end", known.now, known.now_terms));
  }
  return boxes;
}

export class ClassPanel {
  constructor(private readonly box: HTMLElement, private readonly model: Model) {}

  update(): void {
    const { chosen, classes, kept, data } = this.model;
    if (chosen < 0) {
      this.box.replaceChildren(paragraph("None: click a bar, a point of the diagram or a line of the list."));
      return;
    }
    const title = document.createElement("p");
    title.className = "which";
    title.append(dimensionMark(this.model.bars.dimension(chosen)), this.model.text(chosen));
    const parts: HTMLElement[] = [title, ...barSentences(this.model, chosen).map((text) => paragraph(text))];
    if (!kept[chosen]) {
      parts.push(paragraph("The filter does not keep it.", "weak"));
    }
    const known = classes.get(chosen);
    if (known) {
      parts.push(...chainBoxes(known));
    } else {
      parts.push(paragraph(data.classes.length > 0 ? "Its cycle is not on this page: see the notes." : "No cycles are on this page: see the notes.", "weak"));
    }
    this.box.replaceChildren(...parts);
  }
}
