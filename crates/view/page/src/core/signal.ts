// A value that tells when it changes.

export class Signal<T> {
  private readonly listeners = new Set<(value: T, before: T) => void>();

  constructor(private current: T) {}

  get value(): T {
    return this.current;
  }

  set value(next: T) {
    if (Object.is(next, this.current)) return;
    const before = this.current;
    this.current = next;
    for (const listener of [...this.listeners]) listener(next, before);
  }

  /** Calls `listener` at each change; the answer ends that. */
  on(listener: (value: T, before: T) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** As `on`, and once now. */
  now(listener: (value: T, before: T) => void): () => void {
    listener(this.current, this.current);
    return this.on(listener);
  }
}

/** Calls `task` at most once in `period_ms`, the last time after the last call. */
export function throttled(period_ms: number, task: () => void): () => void {
  let last = -Infinity;
  let timer: ReturnType<typeof setTimeout> | undefined;
  return () => {
    if (timer !== undefined) return;
    const wait = last + period_ms - performance.now();
    const act = () => {
      timer = undefined;
      last = performance.now();
      task();
    };
    if (wait <= 0) act();
    else timer = setTimeout(act, wait);
  };
}
