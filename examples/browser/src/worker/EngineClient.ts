import EngineWorker from './worker?worker&inline';
import type { Calls, LoadedMesh, MeshSource, Reply, Request, WalkParameters } from './calls';

/** A computation that the user has ended. */
export class Cancelled extends Error {
  constructor() {
    super('Cancelled.');
  }
}

interface Pending {
  resolve: (result: never) => void;
  reject: (error: Error) => void;
  onProgress: ((fraction: number) => void) | undefined;
}

/**
 * The engine in its worker, as the page sees it: each call gives a promise.
 *
 * The engine computes without looking up, so that a computation is cancelled by ending its worker. A new one then gets
 * the mesh and the parameters again; the seeds come with each call.
 */
export class EngineClient {
  /** How often each call was made. */
  readonly counts: Partial<Record<keyof Calls, number>> = {};

  private worker = this.startWorker();
  private readonly pending = new Map<number, Pending>();
  private nextId = 0;
  private loadedFrom: { source: MeshSource; parameters: WalkParameters } | undefined;

  models(): Promise<string[]> {
    return this.call('models', []);
  }

  async load(source: MeshSource, parameters: WalkParameters): Promise<LoadedMesh> {
    const mesh = await this.call('load', [source, parameters]);
    this.loadedFrom = { source, parameters };
    return mesh;
  }

  async prepare(parameters: WalkParameters): Promise<void> {
    await this.call('prepare', [parameters]);
    if (this.loadedFrom) this.loadedFrom.parameters = parameters;
  }

  segment(...values: Parameters<Calls['segment']>): Promise<Uint32Array | null> {
    return this.call('segment', values);
  }

  probabilities(...values: Parameters<Calls['probabilities']>): Promise<Float32Array> {
    return this.call('probabilities', values);
  }

  hierarchy(
    kind: Parameters<Calls['hierarchy']>[0],
    onProgress: (fraction: number) => void,
  ): Promise<ReturnType<Calls['hierarchy']>> {
    return this.call('hierarchy', [kind], onProgress);
  }

  smoothBoundaries(labels: Uint32Array): Promise<ReturnType<Calls['smoothBoundaries']>> {
    return this.call('smoothBoundaries', [labels]);
  }

  /** Ends all computations: their promises are rejected with `Cancelled`. */
  cancel(): void {
    this.restart(new Cancelled());
  }

  private call<Name extends keyof Calls>(
    name: Name,
    values: Parameters<Calls[Name]>,
    onProgress?: (fraction: number) => void,
  ): Promise<ReturnType<Calls[Name]>> {
    this.counts[name] = (this.counts[name] ?? 0) + 1;
    const id = this.nextId++;
    return new Promise((resolve, reject) => {
      this.pending.set(id, { resolve, reject, onProgress });
      this.worker.postMessage({ id, name, values } as Request);
    });
  }

  private startWorker(): Worker {
    const worker = new EngineWorker();
    worker.onmessage = (event: MessageEvent<Reply>) => this.receive(event.data);
    worker.onerror = (event) => this.restart(new Error(`The engine stopped: ${event.message}`));
    return worker;
  }

  private receive(reply: Reply): void {
    const call = this.pending.get(reply.id);
    if (!call) return;
    if ('progress' in reply) return call.onProgress?.(reply.progress);
    this.pending.delete(reply.id);
    if ('result' in reply) return call.resolve(reply.result as never);
    call.reject(new Error(reply.error));
    if (reply.fatal) this.restart(new Error(reply.error));
  }

  private restart(reason: Error): void {
    this.worker.terminate();
    const interrupted = [...this.pending.values()];
    this.pending.clear();
    this.worker = this.startWorker();
    if (this.loadedFrom) {
      const { source, parameters } = this.loadedFrom;
      this.call('load', [source, parameters]).catch(() => {}); // it has loaded before
    }
    for (const call of interrupted) call.reject(reason);
  }
}
