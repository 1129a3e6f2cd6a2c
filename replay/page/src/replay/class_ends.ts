/** When classes come to their ends, and how that is said. */
import type { AnyStep, End } from "./data.ts";

const sentences: Record<End, string> = {
  bounds: "Its cycle comes to bound with",
  cut: "What its cycle goes through is split by",
  removed: "A cell of its cycle is removed by",
  consumed: "Its cells become a factor of a product with",
  undone: "The step that wrote its cycle is taken back by",
};

export class ClassEnds {
  private readonly ends = new Map<number, { step: number; how: End }[]>();
  private read = 0;

  constructor(private readonly steps: readonly AnyStep[]) {
    this.grow();
  }

  /** To be called when there are more steps. */
  grow(): void {
    for (; this.read < this.steps.length; ++this.read) {
      const step = this.steps[this.read];
      if (typeof step === "number" || !step.ended) {
        continue; // as most are in a long history
      }
      for (const [number, how] of step.ended) {
        const list = this.ends.get(number) ?? [];
        list.push({ step: this.read, how });
        this.ends.set(number, list);
      }
    }
  }

  /** The step, counted from 0, with which a class that is there after some steps ends, if there is one. */
  after(steps: number, number: number): { step: number; sentence: string } | null {
    const found = this.ends.get(number)?.find(({ step }) => step >= steps);
    return found ? { step: found.step, sentence: sentences[found.how] } : null;
  }
}
