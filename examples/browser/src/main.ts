// SPDX-License-Identifier: MIT

import { Session } from './model/Session';
import { automaticPanel } from './panels/automaticPanel';
import { byId } from './panels/dom';
import { frame } from './panels/frame';
import { labelsPanel } from './panels/labelsPanel';
import { openPanel } from './panels/openPanel';
import { savePanel } from './panels/savePanel';
import { segmentsPanel } from './panels/segmentsPanel';
import { shortcuts } from './panels/shortcuts';
import { statusPanel } from './panels/statusPanel';
import { surfacesPanel } from './panels/surfacesPanel';
import { toolsPanel } from './panels/toolsPanel';
import { wallsPanel } from './panels/wallsPanel';
import { showEmbeddedResult } from './showEmbeddedResult';
import { exposeForTests } from './testing';
import { PointerTools } from './view/PointerTools';
import { Stage } from './view/Stage';

const session = new Session();
statusPanel(session);
const stage = newStage();
const pointerTools = new PointerTools(session, stage, byId('brush-cursor'));

frame(session);
labelsPanel(session);
automaticPanel(session);
wallsPanel(session);
segmentsPanel(session);
surfacesPanel(session);
savePanel(session, stage.viewer);
openPanel(session);
toolsPanel(session, stage, pointerTools);
shortcuts(session, stage, pointerTools);
exposeForTests(session, stage);

if (!(await showEmbeddedResult(session))) await session.openModel('hand');

function newStage(): Stage {
  try {
    return new Stage(session, byId<HTMLCanvasElement>('canvas'));
  } catch (error) {
    session.report(error, 'This browser cannot draw meshes: it has no WebGL 2. ');
    throw error;
  }
}
