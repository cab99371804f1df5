// The state of the view and the loop that draws it: again only when something changed.

import {writeAddress} from './address.js';
import {loadBrowsersImage, placeGroundAndImage} from './browser.js';
import {Camera} from './camera.js';
import {manifest} from './data.js';
import {byId} from './dom.js';
import {clamp} from './matrix.js';
import {showNotice} from './messages.js';
import {grounds, Panel} from './panel.js';

const quiet = 120;  // milliseconds without a change after which a coarse frame is refined

export class Viewer {
  constructor(canvas, stage) {
    this.canvas = canvas;
    this.stage = stage;
    this.camera = new Camera(manifest);
    this.view = 'picture';
    this.ground = 'white';
    this.split = null;  // share of the window left of the divider; null: no divider
    this.picture = null;
    this.items = null;
    this.pending = false;
    this.changed = 0;
    this.frames = 0;
    this.panel = new Panel(this);
    this.resize();
    this.camera.fit();
    // Drawn at once: the browser paints the new size next.
    new ResizeObserver(() => {
      this.resize();
      if (this.picture)
        this.draw();
    }).observe(stage);
  }

  // ---- Commands ------------------------------------------------------------------------------------

  get middle() { return [this.camera.window.width / 2, this.camera.window.height / 2]; }
  get shortSide() { return Math.min(this.camera.window.width, this.camera.window.height); }

  move(x, y, dx, dy) { this.camera.drag(x, y, dx, dy); this.change(); }
  turn(angle, x, y) { this.camera.turn(angle, x, y); this.change(); }
  lean(angle) { this.camera.lean(angle); this.change(); }

  zoom(factor, x, y) {
    const wasFinest = this.camera.isFinest;
    this.camera.zoom(factor, x, y);
    if (this.camera.isFinest && !wasFinest)
      showNotice('Finest pixel: closer, boundaries would be off by more than 1/16 of a pixel.');
    this.change();
  }
  zoomTo(scale) { this.zoom(scale / this.camera.scale, ...this.middle); }

  command(name) {
    const views = ['picture', ...manifest.views.map((view) => view.name)];
    const after = (list, item) => list[(list.indexOf(item) + 1) % list.length];
    const commands = {
      fit: () => { this.camera.fit(); this.change(); },
      one: () => this.zoomTo(1),
      finest: () => this.zoomTo(this.camera.finestScale),
      view: () => this.show(after(views, this.view)),
      split: () => this.splitAt(this.split === null ? 0.5 : null),
      ground: () => { this.ground = after(grounds, this.ground); this.change(); },
      help: () => { const help = byId('help'); help.open ? help.close() : help.showModal(); },
    };
    commands[name]();
  }

  async show(name) {
    const known = manifest.views.find((view) => view.name === name);
    this.view = known ? name : 'picture';
    await this.picture?.prepare(this.view);
    this.panel.showLegend(known?.legend ?? []);
    this.change();
  }

  splitAt(share) {
    if (!manifest.svg)
      return;
    if (share !== null)
      loadBrowsersImage().catch(() => showNotice('The browser cannot draw this SVG file.'));
    this.split = share === null ? null : clamp(share, 0, 1);
    this.change();
  }

  // The item at a place of the window; null: none.
  point(x, y) {
    const place = x !== null && this.items && this.camera.pointAt(x, y);
    const {width, height} = manifest, isInside = place && place[0] >= 0 && place[1] >= 0 && place[0] < width && place[1] < height;
    const id = isInside ? this.items.idAt(place) : 0;
    this.panel.showItem(id ? this.items.describe(id) : null);
  }

  set state({view, ground, split, ...camera}) {
    this.camera.state = camera;
    this.ground = grounds.includes(ground) ? ground : grounds[0];
    if (split !== undefined)
      this.splitAt(split);
    this.show(view);
  }

  // ---- Drawing -------------------------------------------------------------------------------------

  resize() {
    const {clientWidth, clientHeight} = this.stage, fits = this.camera.scale === this.camera.fitScale;
    this.camera.resize(clientWidth, clientHeight, window.devicePixelRatio || 1);
    if (fits)
      this.camera.scale = this.camera.fitScale;
    this.camera.limit();
    this.change();
  }

  // A canvas loses its pixels when its size is set.
  fitCanvas() {
    const {width, height, pixelRatio} = this.camera.window, size = [width, height].map((length) => Math.round(length * pixelRatio));
    if (this.canvas.width !== size[0] || this.canvas.height !== size[1])
      [this.canvas.width, this.canvas.height] = size;
    Object.assign(this.canvas.style, {width: `${size[0] / pixelRatio}px`, height: `${size[1] / pixelRatio}px`});
  }

  change() {
    this.isChanged = true;
    this.canvas.dataset.state = 'changed';
    this.changed = performance.now();
    this.request();
  }

  request() {
    if (this.pending || !this.picture)
      return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      if (this.picture)
        this.draw();
    });
  }

  draw() {
    if (this.isChanged)
      this.begin();
    else if (performance.now() - this.changed > quiet || this.isFirst)
      this.isComplete = this.picture.refine();
    if (!this.isComplete)
      this.request();
    else
      this.finish();
  }

  begin() {
    this.isChanged = false;
    Object.assign(this.canvas.dataset, {state: 'coarse', frame: ++this.frames});
    this.fitCanvas();
    const left = this.split === null ? null : this.split * this.camera.window.width;
    this.isComplete = this.picture.begin(this.camera, this.picture.views.has(this.view) ? this.view : 'picture', left ?? Infinity);
    placeGroundAndImage(this.camera, left);
    performance.mark('vtm-drawn');
    this.panel.showView();
    writeAddress({...this.camera.state, view: this.view, split: this.split, ground: this.ground});
  }

  finish() {
    this.isFirst = false;
    performance.mark('vtm-complete');
    this.panel.showTime(this.picture.time);
    this.canvas.dataset.state = 'complete';
  }
}
