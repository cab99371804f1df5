// Draws a view of the picture: at once where the driver is fast, else coarsely and then tile by tile.

import {manifest} from './data.js';
import {Inputs, makeProgram} from './gpu.js';
import {byColumns, inverse, multiply, scaling} from './matrix.js';
import {Outlines} from './outlines.js';

const budget = 32;       // milliseconds that a step of drawing takes
const tileSide = 128;    // device pixels
const coarsest = 1 / 8;  // of the window's resolution
const faded = 0.55;      // towards white, under outlines

// Boxes are [left, top, right, bottom] in device pixels of the target, downwards.
const width = ([left, , right]) => Math.max(0, right - left);
const height = ([, top, , bottom]) => Math.max(0, bottom - top);
const area = (box) => width(box) * height(box);

export class Picture {
  static async make(gl) {
    const picture = new Picture();
    picture.gl = gl;
    picture.program = await makeProgram(gl, manifest.programs.viewVertex, manifest.programs.viewFragment);
    performance.mark('vtm-compiled');
    picture.views = new Map();
    await picture.prepare('picture');
    picture.secondsPerPixel = null;
    picture.coarse = {framebuffer: gl.createFramebuffer(), texture: null, width: 0, height: 0};
    picture.tiles = [];
    return picture;
  }

  // Loads what a view needs.
  async prepare(name) {
    if (this.views.has(name))
      return;
    const view = manifest.views.find((known) => known.name === name), data = name === 'picture' ? manifest.picture : view.data;
    const inputs = data ? await Inputs.make(this.gl, data, 'picture.') : this.views.get('picture').inputs;
    const outlines = view?.outlines ? await Outlines.make(this.gl, view.outlines) : null;
    this.views.set(name, {inputs, outlines, fade: outlines ? faded : 0});
  }

  // Begins a frame of a camera's view, from a window's left border to `right`. Returns whether it is complete.
  begin(camera, name, right) {
    const {gl} = this, {pixelRatio} = camera.window, canvas = gl.canvas;
    this.frame = {camera: camera.toWindow, view: this.views.get(name), pixelRatio, started: performance.now(), drawn: 0};
    const [left, top, end, bottom] = camera.extent.map((length) => length * pixelRatio);
    this.box = [Math.floor(left), Math.floor(top), Math.min(Math.ceil(end), Math.ceil(right * pixelRatio), canvas.width),
      Math.min(Math.ceil(bottom), canvas.height)];
    this.clear();
    this.tiles = [];
    if (area(this.box) === 0)
      return true;
    if (this.secondsPerPixel === null)
      this.warmUp();
    const share = budget / 1000 / (this.secondsPerPixel * area(this.box));
    if (share >= 1) {
      this.draw(this.box, 1);
      return true;
    }
    this.drawCoarsely(Math.max(coarsest, Math.sqrt(share)));
    this.tiles = this.tilesOf(this.box);
    return false;
  }

  // Draws more of the frame. Returns whether it is complete.
  refine() {
    const end = performance.now() + budget;
    let pixels = budget / 1000 / this.secondsPerPixel;
    for (let first = true; this.tiles.length > 0 && (first || (pixels > 0 && performance.now() < end)); first = false) {
      const tile = this.tiles.pop();
      pixels -= area(tile);
      this.draw(tile, 1);
    }
    return this.tiles.length === 0;
  }

  // Milliseconds that drawing the frame took.
  get time() { return this.frame.drawn; }

  // A driver compiles when a program first draws; then a few pixels tell how fast it is.
  warmUp() {
    this.secondsPerPixel = 1e-9;
    const [left, top, right, bottom] = this.box, x = (left + right) >> 1, y = (top + bottom) >> 1;
    this.draw([x, y, x + 1, y + 1], 1);
    const side = 64, sample = [Math.max(left, x - side), Math.max(top, y - side), Math.min(right, x + side), Math.min(bottom, y + side)];
    performance.mark('vtm-warm');
    this.secondsPerPixel = 0;
    this.draw(sample, 1);
    this.frame.drawn = 0;
  }

  clear() {
    const {gl} = this;
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }

  // The box's pixels at a share of the window's resolution, into the target that is bound, and how long they take.
  draw(box, share) {
    const {gl} = this, targetHeight = share === 1 ? gl.canvas.height : this.coarse.height;
    const scale = share * this.frame.pixelRatio, start = performance.now();
    const fromPicture = multiply(scaling(scale, scale), this.frame.camera);  // to pixels, downwards
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(box[0], targetHeight - box[3], width(box), height(box));
    gl.viewport(0, 0, share === 1 ? gl.canvas.width : this.coarse.width, targetHeight);
    this.drawPicture(fromPicture, targetHeight);
    this.frame.view.outlines?.draw(fromPicture, share === 1 ? gl.canvas.width : this.coarse.width, targetHeight);
    this.wait(box, targetHeight);
    this.note(performance.now() - start, area(box));
  }

  drawPicture(fromPicture, targetHeight) {
    const {gl, program} = this, {inputs, fade} = this.frame.view;
    const upwards = [1, 0, 0, 0, -1, targetHeight, 0, 0, 1];
    const toUnit = scaling(1 / manifest.width, 1 / manifest.height);
    gl.useProgram(program);
    inputs.set(gl, program, ['picture.images']);
    gl.uniformMatrix3fv(gl.getUniformLocation(program, 'toPicture'), false,
      byColumns([toUnit, inverse(fromPicture), upwards].reduce(multiply)));
    gl.uniform1f(gl.getUniformLocation(program, 'fade'), fade);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Reading a pixel waits until all are drawn, which finish() does not in every browser.
  wait([left, , , bottom], targetHeight) {
    this.gl.readPixels(left, targetHeight - bottom, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  note(milliseconds, pixels) {
    this.frame.drawn += milliseconds;
    const now = milliseconds / 1000 / Math.max(1, pixels), weight = Math.min(1, pixels / 16384);
    if (this.secondsPerPixel === 0)
      this.secondsPerPixel = Math.max(1e-10, now);
    else if (pixels > 1024)
      this.secondsPerPixel = Math.max(1e-10, this.secondsPerPixel + 0.5 * weight * (now - this.secondsPerPixel));
  }

  drawCoarsely(share) {
    const {gl, coarse} = this;
    this.resizeCoarse(Math.ceil(gl.canvas.width * share), Math.ceil(gl.canvas.height * share));
    gl.bindFramebuffer(gl.FRAMEBUFFER, coarse.framebuffer);
    gl.disable(gl.SCISSOR_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT);
    this.draw([...this.box.slice(0, 2).map((x) => Math.floor(x * share)), ...this.box.slice(2).map((x) => Math.ceil(x * share))], share);
    this.enlarge(share);
  }

  resizeCoarse(columns, rows) {
    const {gl, coarse} = this;
    if (coarse.width === columns && coarse.height === rows)
      return;
    gl.deleteTexture(coarse.texture);
    Object.assign(coarse, {texture: gl.createTexture(), width: columns, height: rows});
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, coarse.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, columns, rows);
    gl.bindFramebuffer(gl.FRAMEBUFFER, coarse.framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, coarse.texture, 0);
  }

  // The coarse picture onto the canvas.
  enlarge(share) {
    const {gl, coarse} = this, right = Math.round(coarse.width / share), top = gl.canvas.height - Math.round(coarse.height / share);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, coarse.framebuffer);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(this.box[0], gl.canvas.height - this.box[3], width(this.box), height(this.box));
    gl.blitFramebuffer(0, 0, coarse.width, coarse.height, 0, top, right, gl.canvas.height, gl.COLOR_BUFFER_BIT, gl.LINEAR);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  // The last is drawn first: those in the middle.
  tilesOf([left, top, right, bottom]) {
    const tiles = [], distance = (tile) => Math.hypot(tile[0] + tile[2] - left - right, tile[1] + tile[3] - top - bottom);
    for (let y = top; y < bottom; y += tileSide)
      for (let x = left; x < right; x += tileSide)
        tiles.push([x, y, Math.min(right, x + tileSide), Math.min(bottom, y + tileSide)]);
    return tiles.sort((a, b) => distance(b) - distance(a));
  }
}
