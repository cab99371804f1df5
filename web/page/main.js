// Starts the page, and starts again where the GPU was lost.

import {readAddress} from './address.js';
import {manifest} from './data.js';
import {byId} from './dom.js';
import {listenToKeys, listenToPointers} from './gestures.js';
import {Items} from './items.js';
import {hideMessage, showMessage} from './messages.js';
import {Picture} from './picture.js';
import {Viewer} from './viewer.js';

// What is in data attributes of these says how far the page is: canvas state and frame, stage items.
const canvas = byId('canvas'), stage = byId('stage');
const contextOptions = {alpha: true, antialias: false, depth: false, stencil: false, preserveDrawingBuffer: true};

function explain(error) {
  showMessage('The picture cannot be drawn', error instanceof Error ? error.message : String(error));
}

async function start(gl, viewer) {
  hideMessage();
  viewer.picture = await Picture.make(gl);
  viewer.isFirst = true;
  await viewer.show(viewer.view);
  viewer.items = await Items.make(gl);
  stage.dataset.items = viewer.items ? 'ready' : 'none';
}

function listenToLoss(gl, viewer) {
  canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    viewer.picture = viewer.items = null;
    showMessage('The GPU was reset', 'The picture is drawn again as soon as it is back.');
  });
  canvas.addEventListener('webglcontextrestored', () => start(gl, viewer).catch(explain));
}

async function main() {
  if (typeof DecompressionStream === 'undefined')
    throw new Error('This browser cannot unpack data (DecompressionStream); every one of 2023 or later can.');
  const gl = canvas.getContext('webgl2', contextOptions);
  const viewer = new Viewer(canvas, stage);
  viewer.state = readAddress();
  listenToPointers(stage, viewer);
  listenToKeys(viewer);
  window.addEventListener('hashchange', () => { viewer.state = readAddress(); });
  if (!gl)
    throw new Error('This browser has no WebGL 2, or it is switched off. The picture needs it.');
  listenToLoss(gl, viewer);
  await start(gl, viewer);
}

if (manifest.version === 1)
  main().catch(explain);
else
  explain(new Error(`Its data are of version ${manifest.version}, which this page does not know.`));
