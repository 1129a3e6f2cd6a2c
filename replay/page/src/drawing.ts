/** When what has been drawn is there: browsers hand it on and do not wait for it, unless they have to. */

/** In milliseconds. */
const betweenLooks = 50;

export class Drawing {
  private sync: WebGLSync | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** `onWaiting` is called from time to time, as long as the last picture is not there. */
  constructor(private readonly gl: WebGL2RenderingContext, private readonly onWaiting: () => void) {}

  /** A picture has just been handed on. */
  begin(): void {
    const { gl } = this;
    gl.deleteSync(this.sync);
    this.sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.look(), betweenLooks);
  }

  private look(): void {
    const { gl, sync } = this;
    if (sync && !gl.isContextLost() && gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED) {
      this.onWaiting();
      this.timer = setTimeout(() => this.look(), betweenLooks);
    }
  }
}
