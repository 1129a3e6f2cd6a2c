/** What is drawn less finely while the camera moves, where that would not be fluid otherwise. */

/** Frames that take longer than this on average are not fluid, in milliseconds. */
const fluid = 28;
const framesToJudge = 4;
/** The camera has come to rest when it has not moved for so long, in milliseconds. */
const rest = 250;

export class Motion {
  /** The camera moves. */
  isTurning = false;
  /** It does, or what is drawn has just been changed. */
  isMoving = false;
  /** Once it was not fluid, it is taken not to be from then on. */
  isSlow = false;
  private last = 0;
  private recent: number[] = [];
  private timer: ReturnType<typeof setTimeout> | null = null;

  constructor(private readonly onRest: () => void, private readonly onSlow: () => void) {}

  /** The camera has moved: a frame is drawn at this time, in milliseconds. */
  frame(now: number): void {
    if (this.isTurning && now - this.last < 1000) {
      this.recent.push(now - this.last);
    }
    this.last = now;
    this.isTurning = true;
    if (!this.isSlow && this.recent.length >= framesToJudge) {
      const mean = this.recent.reduce((sum, time) => sum + time, 0) / this.recent.length;
      this.recent = [];
      if (mean > fluid) {
        this.isSlow = true;
        this.onSlow();
      }
    }
    this.stir();
  }

  /** Something else has changed: a while has to pass until all is at rest. */
  stir(): void {
    this.isMoving = true;
    if (this.timer !== null) {
      clearTimeout(this.timer);
    }
    this.timer = setTimeout(() => this.settle(), rest);
  }

  private settle(): void {
    this.timer = null;
    this.isMoving = false;
    this.isTurning = false;
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
