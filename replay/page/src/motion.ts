/** What is drawn less finely while the camera moves, where that would not be fluid otherwise. */

/** Frames that take longer than this on average are not fluid, in milliseconds. */
const fluid = 28;
/** There is time for finer ones when they take less than this. */
const easy = 18;
const framesToJudge = 4;
/** The camera has come to rest when it has not moved for so long, in milliseconds. */
const rest = 250;
/** How many pixels there are to one of the page each way: the third and fourth only where fewer layers were not enough. */
const ratios = [1, 1, 0.75, 0.5];

export class Motion {
  /** The camera moves. */
  isTurning = false;
  /** It does, or what is drawn has just been changed. */
  isMoving = false;
  /** How much is left out: nothing, fine layers, and then pixels too. */
  private level = 0;
  private last = 0;
  private recent: number[] = [];
  private timer: ReturnType<typeof setTimeout> | null = null;

  constructor(private readonly onRest: () => void, private readonly onSlow: () => void) {}

  /** Once it was not fluid, it is taken not to be from then on. */
  get isSlow(): boolean {
    return this.level > 0;
  }

  /** Of pixels while it moves, where the processor draws. */
  get ratio(): number {
    return this.isTurning ? ratios[this.level] : 1;
  }

  /** The camera has moved: a frame is drawn at this time, in milliseconds. */
  frame(now: number): void {
    if (this.isTurning && now - this.last < 1000) {
      this.recent.push(now - this.last);
    }
    this.last = now;
    this.isTurning = true;
    if (this.recent.length >= framesToJudge && this.mean > fluid && this.level + 1 < ratios.length) {
      this.recent = [];
      ++this.level;
      this.level === 1 && this.onSlow();
    }
    this.recent.splice(0, this.recent.length - framesToJudge);
    this.stir();
  }

  /** Something else has changed, or is on the screen at last: a while has to pass until all is at rest. */
  stir(): void {
    this.isMoving = true;
    if (this.timer !== null) {
      clearTimeout(this.timer);
    }
    this.timer = setTimeout(() => this.settle(), rest);
  }

  private get mean(): number {
    return this.recent.reduce((sum, time) => sum + time, 0) / this.recent.length;
  }

  private settle(): void {
    this.timer = null;
    this.isMoving = false;
    this.isTurning = false;
    if (this.level > 1 && this.recent.length >= framesToJudge && this.mean < easy) {
      --this.level; // finer the next time, not now, or it would go to and fro
    }
    this.recent = [];
    this.onRest();
  }
}

/** Whether pictures are drawn by the processor, as in virtual machines: then smooth edges of lines cost half of the time. */
export function isDrawnByProcessor(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) {
    return false;
  }
  const plain = String(gl.getParameter(gl.RENDERER));
  // Some browsers say it here, others only when they are asked by name; and the former warn of asking so.
  const known = plain === "WebKit WebGL" ? gl.getExtension("WEBGL_debug_renderer_info") : null;
  const name = known ? String(gl.getParameter(known.UNMASKED_RENDERER_WEBGL)) : plain;
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
