// How long pictures take, and how fine they are: where they take long they get coarser, and one that stands still is
// drawn again, fine.

import type * as THREE from "three";

const SLOW_MS = 50;
const QUICK_MS = 18;
const COARSEST = 0.5;
/** A picture stands still if none follows for so long. */
const REST_MS = 350;
/** A picture at rest may take so long: nobody waits for it. */
const PATIENCE_MS = 1500;
const POLL_MS = 3;

/** How fine a picture is that stands: as fine as patience allows where one of `ratio` takes `ms`, but as fine as the screen if that can be. */
export function atRest(ratio: number, ms: number, finest: number): number {
  const allowed = ratio * Math.sqrt(PATIENCE_MS / Math.max(ms, 1e-3));
  // In quarters, so that a little more or less time is no other picture.
  return Math.min(finest, Math.max(1, ratio, Math.floor(allowed * 4) / 4));
}

export class Pace {
  /** Pixels of the picture for each CSS pixel. */
  ratio: number;
  drawn = 0;
  /** Mean time of the last pictures, from their beginning until the graphics card has finished them, ms. */
  ms = 0;
  private moving: number;
  private standing = false;
  private began = 0;
  private recent: number[] = [];
  private rest = 0;
  private poll = 0;
  private fence: WebGLSync | null = null;
  private gl: WebGL2RenderingContext;

  constructor(
    renderer: THREE.WebGLRenderer,
    /** There is no graphics card: pictures begin coarser, and one at rest is drawn with twice as many pixels instead of smooth edges. */
    private soft: boolean,
    private setRatio: (ratio: number) => void,
    private redraw: () => void,
  ) {
    this.gl = renderer.getContext() as WebGL2RenderingContext;
    this.ratio = this.moving = soft ? 1 : this.finest();
  }

  /** A picture begins: one of many, one that stands, or one to keep, however long it takes. */
  begin(kind: "motion" | "rest" | "finest"): void {
    this.began = performance.now();
    clearTimeout(this.rest);
    this.rest = 0;
    this.use(kind === "motion" ? this.moving : kind === "rest" ? atRest(this.moving, this.ms, this.finest()) : this.finest());
    this.standing = kind !== "motion";
  }

  /** It has been handed to the graphics card. */
  end(): void {
    this.drawn++;
    // One at a time: while one is waited for, the next is not measured.
    if (this.fence === null) {
      this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      this.gl.flush();
      this.wait(this.began, this.ratio === this.moving);
    }
    if (!this.standing && this.ratio < this.finest()) {
      this.rest = window.setTimeout(() => {
        this.rest = 0;
        if (atRest(this.moving, this.ms, this.finest()) > this.ratio) this.redraw();
      }, REST_MS);
    }
  }

  /** The last picture is finished, and none is to come that shows the same finer. */
  get quiet(): boolean {
    return this.rest === 0 && this.fence === null;
  }

  dispose(): void {
    clearTimeout(this.rest);
    clearTimeout(this.poll);
    if (this.fence) this.gl.deleteSync(this.fence);
  }

  private wait(began: number, counts: boolean): void {
    this.poll = window.setTimeout(() => {
      if (!this.fence) return;
      const done = this.gl.isContextLost() || this.gl.getSyncParameter(this.fence, this.gl.SYNC_STATUS) === this.gl.SIGNALED;
      if (!done) return this.wait(began, counts);
      this.gl.deleteSync(this.fence);
      this.fence = null;
      // The first pictures wait until shaders are made.
      if (counts && this.drawn > 3) this.note(performance.now() - began);
    }, POLL_MS);
  }

  private finest(): number {
    return this.soft ? 2 : Math.min(devicePixelRatio || 1, 2);
  }

  private finestMoving(): number {
    return this.soft ? 1 : this.finest();
  }

  private use(ratio: number): void {
    if (ratio === this.ratio) return;
    this.ratio = ratio;
    this.setRatio(ratio);
  }

  private note(took: number): void {
    this.recent.push(took);
    if (this.recent.length > 8) this.recent.shift();
    this.ms = this.recent.reduce((a, b) => a + b, 0) / this.recent.length;
    if (this.recent.length < 5) return;
    const finest = this.finestMoving();
    if (this.ms > SLOW_MS && this.moving > COARSEST) {
      this.moving = Math.max(COARSEST, this.moving * 0.8);
      this.recent = [];
    } else if (this.ms < QUICK_MS && this.moving < finest) {
      this.moving = Math.min(finest, this.moving * 1.1);
      this.recent = [];
    }
  }
}
