// SPDX-License-Identifier: MIT

import EngineWorker from './worker?worker&inline';
import type { Calls, LoadedMesh, MeshSource, Reply, Request, TimedHierarchy, WalkParameters } from './calls';
import type { AutomaticMethod, Curves, FoundSurfaces, Walls } from './EngineModule';

/** A computation that the user has ended. */
export class Cancelled extends Error {
  constructor() {
    super('Cancelled.');
  }
}

interface Pending {
  request: Request;
  resolve: (result: never) => void;
  reject: (error: Error) => void;
  onProgress: ((fraction: number) => void) | undefined;
}

/**
 * The engine in a worker, as the page sees it: each call gives a promise.
 *
 * The engine computes without looking up, so that a computation is cancelled by ending its worker. A new one then gets
 * the mesh and the parameters again before the next call; seeds, and walls where no walk is prepared, come with each call.
 */
export class EngineClient {
  /** How often each call was made. */
  readonly counts: Partial<Record<keyof Calls, number>> = {};

  /** Started by the first call: an engine that nothing asks takes neither time nor memory. */
  private worker: Worker | null = null;
  private readonly pending = new Map<number, Pending>();
  private nextId = 0;
  /** The mesh, and whether the worker has it. */
  private source: MeshSource | null = null;
  private parameters: WalkParameters | null = null;
  private isLoaded = false;

  models(): Promise<string[]> {
    return this.call('models', []);
  }

  async load(source: MeshSource, parameters: WalkParameters): Promise<LoadedMesh> {
    const mesh = await this.call('load', [source, parameters]);
    Object.assign(this, { source, parameters, isLoaded: true });
    return mesh;
  }

  /** Takes a mesh that another engine has loaded, when it is needed. Computations on the former one end. */
  follow(source: MeshSource): void {
    if (this.pending.size > 0) this.end(new Cancelled());
    this.source = source;
    this.isLoaded = false;
  }

  async prepare(parameters: WalkParameters): Promise<Curves> {
    const walls = await this.callOnMesh('prepare', [parameters]);
    this.parameters = parameters;
    return walls;
  }

  segment(...values: Parameters<Calls['segment']>): Promise<Uint32Array | null> {
    return this.callOnMesh('segment', values);
  }

  probabilities(...values: Parameters<Calls['probabilities']>): Promise<Float32Array> {
    return this.callOnMesh('probabilities', values);
  }

  hierarchy(method: AutomaticMethod, walls: Walls, onProgress: (fraction: number) => void): Promise<TimedHierarchy> {
    return this.callOnMesh('hierarchy', [method, walls], onProgress);
  }

  surfaces(...values: Parameters<Calls['surfaces']>): Promise<FoundSurfaces> {
    return this.callOnMesh('surfaces', values);
  }

  smoothBoundaries(...values: Parameters<Calls['smoothBoundaries']>): Promise<Curves> {
    return this.callOnMesh('smoothBoundaries', values);
  }

  file(...values: Parameters<Calls['file']>): Promise<Uint8Array> {
    return this.callOnMesh('file', values);
  }

  /** Ends the search for a hierarchy: its promise is rejected with `Cancelled`. What waits behind it is asked anew. */
  cancel(): void {
    const waiting = [...this.pending.values()].filter(({ request }) => !['follow', 'hierarchy'].includes(request.name));
    for (const { request } of waiting) this.pending.delete(request.id);
    this.end(new Cancelled());
    for (const call of waiting) {
      this.giveMesh();
      this.post(call);
    }
  }

  private callOnMesh<Name extends keyof Calls>(
    name: Name,
    values: Parameters<Calls[Name]>,
    onProgress?: (fraction: number) => void,
  ): Promise<ReturnType<Calls[Name]>> {
    this.giveMesh();
    return this.call(name, values, onProgress);
  }

  /** Gives the worker the mesh that it does not have. */
  private giveMesh(): void {
    if (this.isLoaded || !this.source) return;
    this.isLoaded = true;
    const answer = this.call('follow', [this.source, this.parameters]);
    const { worker } = this;
    answer.catch(() => {
      if (worker === this.worker) this.isLoaded = false; // else another one may have it
    });
  }

  private call<Name extends keyof Calls>(
    name: Name,
    values: Parameters<Calls[Name]>,
    onProgress?: (fraction: number) => void,
  ): Promise<ReturnType<Calls[Name]>> {
    this.counts[name] = (this.counts[name] ?? 0) + 1;
    const id = this.nextId++;
    return new Promise((resolve, reject) => {
      this.post({ request: { id, name, values } as Request, resolve, reject, onProgress });
    });
  }

  private post(call: Pending): void {
    this.pending.set(call.request.id, call);
    this.worker ??= this.startWorker();
    this.worker.postMessage(call.request);
  }

  private startWorker(): Worker {
    const worker = new EngineWorker();
    worker.onmessage = (event: MessageEvent<Reply>) => this.receive(event.data);
    worker.onerror = (event) => this.end(new Error(`The engine stopped: ${event.message}`));
    return worker;
  }

  private receive(reply: Reply): void {
    const call = this.pending.get(reply.id);
    if (!call) return;
    if ('progress' in reply) return call.onProgress?.(reply.progress);
    this.pending.delete(reply.id);
    if ('result' in reply) return call.resolve(reply.result as never);
    call.reject(new Error(reply.error));
    if (reply.fatal) this.end(new Error(reply.error));
  }

  /** The next call starts another worker. */
  private end(reason: Error): void {
    this.worker?.terminate();
    this.worker = null;
    this.isLoaded = false;
    const calls = [...this.pending.values()];
    this.pending.clear();
    for (const call of calls) call.reject(reason);
  }
}
