// How the picture's plane lies in the window: units of the picture to CSS pixels, in perspective where it is tilted.

import {clamp, inverse, mapped, multiply, rotation, scaling, translation} from './matrix.js';

const margin = 0.94;       // of the window, that a picture which fits takes
const smallest = 1 / 32;   // of the scale that fits
export const mostTilted = 75 * Math.PI / 180;
const eyeDistance = 1.4;   // of the plane's middle, in heights of the window

export class Camera {
  constructor({width, height, finestPixel}) {
    this.picture = {width, height, finestPixel};
    this.window = {width: 1, height: 1, pixelRatio: 1};
    this.centre = [width / 2, height / 2];
    this.scale = 1;  // CSS pixels a unit, in the middle of the window
    this.angle = 0;  // clockwise
    this.tilt = 0;
  }

  resize(width, height, pixelRatio) { this.window = {width: Math.max(1, width), height: Math.max(1, height), pixelRatio}; }

  get fitScale() {
    const {width, height} = this.picture, c = Math.abs(Math.cos(this.angle)), s = Math.abs(Math.sin(this.angle));
    return margin * Math.min(this.window.width / (width * c + height * s), this.window.height / (width * s + height * c));
  }
  // A device's pixel is then the asset's finest.
  get finestScale() { return Math.max(1 / (this.picture.finestPixel * this.window.pixelRatio), this.fitScale); }
  get isFinest() { return this.scale >= this.finestScale * (1 - 1e-9); }

  // The plane around the middle of the window.
  get tilting() {
    const distance = eyeDistance * this.window.height;
    return [1, 0, 0, 0, Math.cos(this.tilt), 0, 0, -Math.sin(this.tilt) / distance, 1];
  }
  get toWindow() {
    const {width, height} = this.window;
    return [translation(width / 2, height / 2), this.tilting, rotation(this.angle), scaling(this.scale, this.scale),
      translation(-this.centre[0], -this.centre[1])].reduce(multiply);
  }
  // Where the plane ends, as y in the window; it lies below.
  get horizon() {
    return this.tilt > 0 ? this.window.height * (0.5 - eyeDistance / Math.tan(this.tilt)) : -Infinity;
  }

  // The picture's point at a place of the window, or null beyond the horizon.
  pointAt(x, y) {
    if (y <= this.horizon + 1)
      return null;
    const [px, py, w] = mapped(inverse(this.toWindow), x, y);
    return [px / w, py / w];
  }

  // Changes something while the picture's point at a place of the window stays there.
  around(x, y, change) {
    const before = this.pointAt(x, y);
    change();
    this.limit();
    const after = before && this.pointAt(x, y);
    if (after)
      this.centre = [this.centre[0] + before[0] - after[0], this.centre[1] + before[1] - after[1]];
    this.limit();
  }

  // By CSS pixels.
  drag(x, y, dx, dy) {
    const from = this.pointAt(x, y), to = this.pointAt(x + dx, y + dy);
    if (from && to)
      this.centre = [this.centre[0] + from[0] - to[0], this.centre[1] + from[1] - to[1]];
    this.limit();
  }
  zoom(factor, x, y) { this.around(x, y, () => { this.scale *= factor; }); }
  turn(angle, x, y) { this.around(x, y, () => { this.angle += angle; }); }
  lean(angle) { this.tilt += angle; this.limit(); }

  fit() {
    this.angle = this.tilt = 0;
    this.centre = [this.picture.width / 2, this.picture.height / 2];
    this.scale = this.fitScale;
  }

  // The picture stays near, and no boundary is shown closer than it is known.
  limit() {
    this.scale = clamp(this.scale, this.fitScale * smallest, this.finestScale);
    this.tilt = clamp(this.tilt, 0, mostTilted);
    this.angle = Math.atan2(Math.sin(this.angle), Math.cos(this.angle));
    this.centre = [clamp(this.centre[0], 0, this.picture.width), clamp(this.centre[1], 0, this.picture.height)];
  }

  get state() { return {x: this.centre[0], y: this.centre[1], scale: this.scale, rotate: this.angle * 180 / Math.PI, tilt: this.tilt * 180 / Math.PI}; }
  set state({x, y, scale, rotate = 0, tilt = 0}) {
    this.centre = [x ?? this.picture.width / 2, y ?? this.picture.height / 2];
    this.angle = rotate * Math.PI / 180;
    this.tilt = tilt * Math.PI / 180;
    this.scale = scale ?? this.fitScale;
    this.limit();
  }

  // The part of the window that shows the picture: [left, top, right, bottom], at most all of it.
  get extent() {
    const {width, height} = this.picture, m = this.toWindow;
    const corners = [[0, 0], [width, 0], [width, height], [0, height]].map(([x, y]) => mapped(m, x, y));
    const top = Math.max(0, this.horizon + 1), bounds = [0, top, this.window.width, this.window.height];
    if (corners.some((corner) => corner[2] <= 1e-3))
      return bounds;
    const xs = corners.map(([x, , w]) => x / w), ys = corners.map(([, y, w]) => y / w);
    return [Math.max(bounds[0], Math.min(...xs) - 1), Math.max(bounds[1], Math.min(...ys) - 1),
      Math.min(bounds[2], Math.max(...xs) + 1), Math.min(bounds[3], Math.max(...ys) + 1)];
  }
}
