/** Which step is shown, and what moves from one to the next. */

export class Player {
  private timer: ReturnType<typeof setInterval> | null = null;
  private index: number;

  /** `stops`: numbers of steps at which the page stops, ascending. */
  constructor(private stops: readonly number[], private readonly onChange: (steps: number) => void) {
    this.index = stops.length - 1;
  }

  get steps(): number {
    return this.stops[this.index];
  }

  get isAtEnd(): boolean {
    return this.index === this.stops.length - 1;
  }

  /** There are other stops now: stays where it is, or where it is next to, or at the end if it was there. */
  setStops(stops: readonly number[]): void {
    const [wasAtEnd, steps] = [this.isAtEnd, this.steps];
    this.stops = stops;
    const found = stops.findIndex((stop) => stop >= steps);
    this.index = wasAtEnd || found < 0 ? stops.length - 1 : found;
  }

  get position(): number {
    return this.index;
  }

  /** The stop before this one. */
  get before(): number {
    return this.stops[Math.max(this.index - 1, 0)];
  }

  get isPlaying(): boolean {
    return this.timer !== null;
  }

  toPosition(index: number): void {
    const next = Math.min(Math.max(Math.round(index), 0), this.stops.length - 1);
    if (next !== this.index) {
      this.index = next;
      this.onChange(this.steps);
    }
  }

  /** To the first stop that has this step behind it. */
  toStep(steps: number): void {
    const found = this.stops.findIndex((stop) => stop >= steps);
    this.toPosition(found < 0 ? this.stops.length - 1 : found);
  }

  move(by: number): void {
    this.toPosition(this.index + by);
  }

  play(milliseconds: number): void {
    this.pause();
    if (this.isAtEnd) {
      this.toPosition(0);
    }
    this.timer = setInterval(() => {
      this.move(1);
      if (this.isAtEnd) {
        this.pause();
        this.onChange(this.steps);
      }
    }, milliseconds);
  }

  pause(): void {
    if (this.timer !== null) {
      clearInterval(this.timer);
      this.timer = null;
    }
  }
}
