// The browser's own drawing of the SVG file, under the same view.

import {chunkFile, manifest} from './data.js';
import {byId} from './dom.js';
import {css, multiply, scaling} from './matrix.js';

// The file is loaded when it is first wanted. An image runs no scripts and loads nothing.
let loading = null;
export function loadBrowsersImage() {
  loading ??= chunkFile(manifest.svg).then((bytes) => {
    byId('browser-image').src = URL.createObjectURL(new Blob([bytes], {type: 'image/svg+xml'}));
    return byId('browser-image').decode();
  });
  return loading;
}

// Boxes of the picture's size in CSS pixels, so that the browser draws at the resolution that is seen.
function place(element, camera) {
  const {width, height} = camera.picture, {scale} = camera;
  element.style.width = `${width * scale}px`;
  element.style.height = `${height * scale}px`;
  element.style.transform = css(multiply(camera.toWindow, scaling(1 / scale, 1 / scale)));
}

// From `left` on; null: not at all.
export function placeGroundAndImage(camera, left) {
  place(byId('ground'), camera);
  byId('browser').hidden = left === null;
  if (left === null)
    return;
  place(byId('browser-image'), camera);
  byId('browser').style.clipPath = `inset(0 0 0 ${left}px)`;
}
