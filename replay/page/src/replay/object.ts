/** The object as it was after any number of steps: events are carried out and taken back one step at a time. */
import { type Data, dimensionOf, stepOf } from "./data.ts";

/** Stands for a cell that is still one of its own. */
const itself = -0x7fffffff;
const unshown = -1;
const none: number[] = [];

/** The cell that another one has become. */
export interface Found {
  cell: number;
  /** It has its ends exchanged. */
  turned: boolean;
  /** It lies on `cell`, of smaller dimension. */
  squashed: boolean;
}

const isThere = 1;
const isConsumed = 2;

export class ObjectState {
  /** Of so many cells and faces there are numbers; lists are longer, as they grow. */
  private size = 0;
  private faceSize = 0;
  private dimensions = new Int8Array();
  /** By cell, as C++ numbers references; `itself` for a cell of its own. */
  private became = new Int32Array();
  private state = new Uint8Array();
  private eldest = new Int32Array();
  private faces = new Int32Array();
  /** What a step that is carried out has written over, if anything: faces, then eldest cells. */
  private readonly saved: (number[] | undefined)[] = [];
  /** By step, and one more: the first cell that it made. */
  private firstMade = new Int32Array(1);
  private stepCount = 0;
  private after = 0;

  constructor(readonly data: Data) {
    this.grow();
  }

  /** To be called when the data have more cells and steps than before. */
  grow(): void {
    this.growSteps();
    const { type, faces } = this.data.cells;
    if (type.length > this.became.length) {
      const room = Math.max(type.length, 2 * this.became.length);
      const larger = <T extends Int8Array | Uint8Array | Int32Array>(to: T, from: T): T => (to.set(from), to);
      this.dimensions = larger(new Int8Array(room), this.dimensions);
      this.became = larger(new Int32Array(room).fill(itself), this.became);
      this.state = larger(new Uint8Array(room), this.state);
      this.eldest = larger(new Int32Array(room), this.eldest);
    }
    for (; this.size < type.length; ++this.size) {
      this.dimensions[this.size] = dimensionOf(this.data, this.size);
      this.eldest[this.size] = this.size;
    }
    if (faces.length > this.faces.length) {
      const larger = new Int32Array(Math.max(faces.length, 2 * this.faces.length));
      larger.set(this.faces);
      this.faces = larger;
    }
    for (; this.faceSize < faces.length; ++this.faceSize) {
      this.faces[this.faceSize] = faces[this.faceSize];
    }
  }

  private growSteps(): void {
    const { steps } = this.data;
    if (steps.length >= this.firstMade.length) {
      const larger = new Int32Array(Math.max(steps.length + 1, 2 * this.firstMade.length));
      larger.set(this.firstMade);
      this.firstMade = larger;
    }
    for (; this.stepCount < steps.length; ++this.stepCount) {
      const step = steps[this.stepCount];
      const made = typeof step === "number" ? step : (step.made?.[1] ?? 0);
      this.firstMade[this.stepCount + 1] = this.firstMade[this.stepCount] + made;
    }
  }

  /** Whether a face is one of a map, whose sides follow one another. */
  isPolygon(cell: number): boolean {
    return this.data.cells.types[this.data.cells.type[cell]][0] === 0;
  }
  /** Whether a cell is known by its boundary only, which does not say how it lies. */
  hasNoShape(cell: number): boolean {
    return this.data.cells.types[this.data.cells.type[cell]][0] < 0;
  }
  dimension(cell: number): number {
    return this.dimensions[cell];
  }

  /** Of all cells that there ever were. */
  get topDimension(): number {
    return this.dimensions.subarray(0, this.size).reduce((top, p) => Math.max(top, p), -1);
  }

  /** How many steps it has behind it. */
  get steps(): number {
    return this.after;
  }

  goTo(steps: number): void {
    while (this.after < steps) {
      const { undone } = stepOf(this.data.steps[this.after]);
      if (undone) {
        undone.forEach((k) => this.takeBack(k));
      } else {
        this.carryOut(this.after);
      }
      ++this.after;
    }
    while (this.after > steps) {
      --this.after;
      const { undone } = stepOf(this.data.steps[this.after]);
      if (undone) {
        [...undone].reverse().forEach((k) => this.carryOut(k));
      } else {
        this.takeBack(this.after);
      }
    }
  }

  /** A cell of the object as it is now, not one that has become another. */
  isCurrent(cell: number): boolean {
    return this.state[cell] === isThere && this.became[cell] === itself;
  }

  currentCells(): number[] {
    const cells = [];
    for (let cell = 0; cell < this.size; ++cell) {
      if (this.isCurrent(cell)) {
        cells.push(cell);
      }
    }
    return cells;
  }

  /** What a cell has become; nothing when that is not shown. */
  find(cell: number): Found | null {
    let turned = false;
    let squashed = false;
    for (;;) {
      const ref = this.became[cell];
      if (ref === itself) {
        return { cell, turned, squashed };
      }
      if (ref === unshown) {
        return null;
      }
      squashed ||= ref < 0;
      turned = ref >= 0 && (ref & 1) === 1 ? !turned : turned;
      cell = ref < 0 ? -2 - ref : ref >> 1;
    }
  }

  /** Face k of a cell, as it is now. */
  face(cell: number, k: number): Found | null {
    const ref = this.faces[this.data.cells.first[cell] + k];
    if (ref === unshown) {
      return null;
    }
    const found = this.find(ref < 0 ? -2 - ref : ref >> 1);
    return found && { cell: found.cell, turned: found.turned !== (ref >= 0 && (ref & 1) === 1), squashed: found.squashed || ref < 0 };
  }

  faceCount(cell: number): number {
    return this.data.cells.first[cell + 1] - this.data.cells.first[cell];
  }

  /** The oldest of the cells that a current one stands for: it has its name and its place. */
  oldest(cell: number): number {
    return this.eldest[cell];
  }

  name(cell: number): string {
    return this.data.cells.names[this.eldest[cell]];
  }

  /** The cells of the object now that the steps from one number to another had to do with. */
  touchedBy(first: number, last: number): Set<number> {
    const touched = new Set<number>();
    const add = (cell: number) => {
      const found = this.find(cell);
      if (found && this.isCurrent(found.cell)) {
        touched.add(found.cell);
      }
    };
    const addStep = (k: number) => {
      const { removed = none, moved = none } = stepOf(this.data.steps[k]);
      for (let cell = this.firstMade[k]; cell < this.firstMade[k + 1]; ++cell) {
        add(cell);
      }
      for (let i = 0; i < removed.length; i += 2) {
        add(removed[i]);
      }
      for (let i = 0; i < moved.length; i += 3) {
        add(moved[i]);
      }
    };
    for (let k = first; k < last; ++k) {
      addStep(k);
      stepOf(this.data.steps[k]).undone?.forEach(addStep);
    }
    return touched;
  }

  private carryOut(k: number): void {
    const step = this.data.steps[k];
    if (step === 0) {
      return; // as most steps are of which only cells are told that are not shown
    }
    this.state.fill(isThere, this.firstMade[k], this.firstMade[k + 1]);
    if (typeof step === "number") {
      return;
    }
    const { removed = none, moved = none, consumed = none } = step;
    const saved: number[] = [];
    for (const cell of consumed) {
      this.state[cell] = isConsumed;
    }
    for (let i = 0; i < moved.length; i += 3) {
      const at = this.data.cells.first[moved[i]] + moved[i + 1];
      saved.push(this.faces[at]);
      this.faces[at] = moved[i + 2];
    }
    for (let i = 0; i < removed.length; i += 2) {
      const [cell, ref] = [removed[i], removed[i + 1]];
      this.became[cell] = ref;
      if (ref >= 0) {
        const to = ref >> 1;
        saved.push(this.eldest[to]);
        this.eldest[to] = Math.min(this.eldest[to], this.eldest[cell]);
      }
    }
    this.saved[k] = saved.length > 0 ? saved : undefined;
  }

  private takeBack(k: number): void {
    const { removed = none, moved = none, consumed = none } = stepOf(this.data.steps[k]);
    const saved = this.saved[k] ?? [];
    for (let i = removed.length - 2; i >= 0; i -= 2) {
      const [cell, ref] = [removed[i], removed[i + 1]];
      this.became[cell] = itself;
      if (ref >= 0) {
        this.eldest[ref >> 1] = saved.pop()!;
      }
    }
    for (let i = moved.length - 3; i >= 0; i -= 3) {
      this.faces[this.data.cells.first[moved[i]] + moved[i + 1]] = saved.pop()!;
    }
    for (const cell of consumed) {
      this.state[cell] = isThere;
    }
    this.state.fill(0, this.firstMade[k], this.firstMade[k + 1]);
  }
}
