// SPDX-License-Identifier: MIT

declare module 'engine' {
  import type { EngineModule } from './EngineModule';
  export default function createEngine(): Promise<EngineModule>;
}
