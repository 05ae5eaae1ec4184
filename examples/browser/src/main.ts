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
import { toolsPanel } from './panels/toolsPanel';
import { showEmbeddedResult } from './showEmbeddedResult';
import { exposeForTests } from './testing';
import { PointerTools } from './view/PointerTools';
import { Stage } from './view/Stage';

const session = new Session();
const stage = new Stage(session, byId<HTMLCanvasElement>('canvas'));
const pointerTools = new PointerTools(session, stage, byId('brush-cursor'));

frame(session);
labelsPanel(session);
automaticPanel(session);
segmentsPanel(session);
savePanel(session, stage.viewer);
openPanel(session);
toolsPanel(session, stage, pointerTools);
statusPanel(session);
shortcuts(session, stage, pointerTools);
exposeForTests(session, stage);

if (!(await showEmbeddedResult(session))) await session.openModel('hand');
