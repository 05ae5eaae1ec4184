// SPDX-License-Identifier: MIT

import createEngine from 'engine';
import { seedEdit, type Seeds } from '../model/seeds';
import { adjacentFaces } from './adjacentFaces';
import type { Calls, LoadedMesh, MeshSource, Reply, Request, TimedHierarchy, WalkParameters } from './calls';
import type { AutomaticMethod, Curves, Engine, Failure, FoundSurfaces, Walls } from './EngineModule';

const moduleIsReady = createEngine();
let engine: Engine | undefined;
let seedsOfEngine = new Map<number, number>();

/** The value, or throws what the engine reports. */
function value<T>(result: T | Failure): T {
  if (typeof result === 'object' && result !== null && 'error' in result) throw new Error(result.error);
  return result as T;
}

function loaded(): Engine {
  if (!engine) throw new Error('There is no mesh yet.');
  return engine;
}

/** Reads a mesh, and takes it in the place of the former one if all goes well. */
async function take<T>(source: MeshSource, use: (next: Engine) => T): Promise<T> {
  const module = await moduleIsReady;
  const next = value(
    'model' in source ? module.generateMesh(source.model) : module.readMesh(source.bytes, source.fileName),
  );
  try {
    const result = use(next);
    engine?.delete();
    engine = next;
    seedsOfEngine = new Map();
    return result;
  } catch (error) {
    next.delete();
    throw error;
  }
}

function prepare(engine: Engine, { convexWeight, sigma, walls }: WalkParameters): Curves {
  const lines = value(engine.setWalls(walls));
  value(engine.prepare(convexWeight, sigma));
  return lines;
}

function load(source: MeshSource, parameters: WalkParameters): Promise<LoadedMesh> {
  return take(source, (next) => {
    const walls = prepare(next, parameters);
    const mesh = value(next.mesh());
    return { ...mesh, walls, adjacentFaces: adjacentFaces(mesh.triangles, mesh.faceOfTriangle) };
  });
}

function follow(source: MeshSource, parameters: WalkParameters | null): Promise<void> {
  return take(source, (next) => {
    if (parameters) prepare(next, parameters);
  });
}

/** The engine with walls, on which no walk is prepared. */
function walled(walls: Walls): Engine {
  value(loaded().setWalls(walls));
  return loaded();
}

function setSeeds(seeds: Seeds): void {
  const { removed, added } = seedEdit(seedsOfEngine, seeds);
  for (const face of removed) {
    value(loaded().removeSeed(face));
    seedsOfEngine.delete(face);
  }
  for (const [face, label] of added) {
    value(loaded().addSeed(face, label));
    seedsOfEngine.set(face, label);
  }
}

function hierarchy(method: AutomaticMethod, walls: Walls, tell: (progress: number) => void): TimedHierarchy {
  let told = 0;
  const start = performance.now();
  const hierarchy = value(
    walled(walls).hierarchy(method, (progress) => {
      if (progress >= told + 0.01) tell((told = progress));
      return true;
    }),
  );
  return { ...hierarchy, milliseconds: performance.now() - start };
}

/** The calls, of which only some take long enough to tell their progress. */
function calls(tell: (progress: number) => void) {
  return {
    models: async () => (await moduleIsReady).models(),
    load,
    follow,
    prepare: (parameters) => prepare(loaded(), parameters),
    segment(seeds) {
      setSeeds(seeds);
      return seeds.size === 0 ? null : value(loaded().segment());
    },
    probabilities(seeds, label) {
      setSeeds(seeds);
      return value(loaded().probabilities(label));
    },
    hierarchy: (method, walls) => hierarchy(method, walls, tell),
    surfaces: (labels, regularity, walls) =>
      JSON.parse(value(walled(walls).surfaces(labels, regularity))) as FoundSurfaces,
    smoothBoundaries: (labels, walls) => value(walled(walls).smoothBoundaries(labels)),
    file: (...values) => value(loaded().file(...values)),
  } satisfies { [Name in keyof Calls]: (...values: Parameters<Calls[Name]>) => unknown };
}

async function answer(request: Request): Promise<void> {
  const { id, name, values } = request;
  const call = calls((progress) => post({ id, progress }))[name] as (...values: unknown[]) => unknown;
  try {
    const result = await call(...values);
    post({ id, result }, buffers(result));
  } catch (error) {
    post({ id, error: messageOf(error), fatal: error instanceof WebAssembly.RuntimeError });
  }
}

function messageOf(error: unknown): string {
  if (error instanceof WebAssembly.RuntimeError)
    return `The engine stopped, maybe for want of memory (${error.message}).`;
  return error instanceof Error ? error.message : String(error);
}

/** The buffers of the arrays in a result, which are handed over instead of copied. */
function buffers(result: unknown): ArrayBuffer[] {
  const parts = ArrayBuffer.isView(result) ? [result] : Object.values(result ?? {});
  return parts.filter((part) => ArrayBuffer.isView(part)).map((array) => array.buffer as ArrayBuffer);
}

function post(reply: Reply, transfer: ArrayBuffer[] = []): void {
  self.postMessage(reply, { transfer });
}

/** Requests are answered one after the other, in their order. With none waiting there is time to prepare for the next. */
let last = Promise.resolve();
let waiting = 0;
self.onmessage = (event: MessageEvent<Request>) => {
  ++waiting;
  last = last.then(async () => {
    await answer(event.data);
    if (--waiting === 0 && event.data.name === 'segment' && seedsOfEngine.size > 0) engine?.anticipate();
  });
};
