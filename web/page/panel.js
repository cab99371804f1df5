// The page's bars: buttons that command a viewer, and what they say of its state.

import {manifest} from './data.js';
import {byId} from './dom.js';
import {turnStep} from './gestures.js';

export const grounds = ['white', 'grid', 'none'];
const tiltOfButton = 50 * Math.PI / 180;

const rounded = (x, digits = 3) => String(Number(x.toPrecision(digits)));

export class Panel {
  constructor(viewer) {
    this.viewer = viewer;
    document.title = manifest.title;
    byId('size').textContent = `${rounded(manifest.width, 5)} × ${rounded(manifest.height, 5)}`;
    for (const {name, title} of manifest.views)
      byId('view').append(new Option(title, name));
    byId('split').hidden = !manifest.svg;
    byId('view').addEventListener('change', () => viewer.show(byId('view').value));
    const click = (id, action) => byId(id).addEventListener('click', action);
    click('turn', () => viewer.turn(turnStep, ...viewer.middle));
    click('tilt', () => viewer.lean(viewer.camera.tilt > 0 ? -Math.PI : tiltOfButton));
    click('split', () => viewer.command('split'));
    click('paper', () => viewer.command('ground'));
    click('help-button', () => viewer.command('help'));
    click('zoom-in', () => viewer.zoom(1.5, ...viewer.middle));
    click('zoom-out', () => viewer.zoom(1 / 1.5, ...viewer.middle));
    click('zoom', () => viewer.command('one'));
    click('fit', () => viewer.command('fit'));
    this.listenToDivider();
  }

  listenToDivider() {
    const divider = byId('divider'), {viewer} = this;
    const follow = (event) => viewer.splitAt((event.clientX - byId('stage').getBoundingClientRect().left) / viewer.camera.window.width);
    divider.addEventListener('pointerdown', (event) => {
      divider.setPointerCapture(event.pointerId);
      event.preventDefault();
    });
    divider.addEventListener('pointermove', (event) => {
      if (divider.hasPointerCapture(event.pointerId))
        follow(event);
    });
    divider.addEventListener('keydown', (event) => {
      const step = {ArrowLeft: -0.02, ArrowRight: 0.02}[event.key];
      if (step)
        viewer.splitAt(viewer.split + step);
    });
  }

  // After each change of the view.
  showView() {
    const {camera, split, view, ground} = this.viewer, percent = camera.scale * 100;
    byId('zoom').textContent = `${percent < 1000 ? rounded(percent) : Math.round(percent).toLocaleString('en')} %`;
    byId('zoom-in').disabled = camera.isFinest;
    byId('finest').hidden = !camera.isFinest;
    byId('finest').title = `A pixel is ${rounded(1 / (camera.scale * camera.window.pixelRatio))} units wide. Closer, boundaries would be off by more than 1/16 of a pixel.`;
    byId('tilt').setAttribute('aria-pressed', String(camera.tilt > 0));
    byId('split').setAttribute('aria-pressed', String(split !== null));
    byId('view').value = view;
    byId('ground').className = ground;
    const divider = byId('divider');
    divider.hidden = split === null;
    divider.style.left = `${(split ?? 0) * camera.window.width}px`;
    divider.setAttribute('aria-valuenow', String(Math.round((split ?? 0) * 100)));
  }

  showLegend(marks) {
    byId('legend').hidden = marks.length === 0;
    byId('legend').replaceChildren(...marks.map(({color, text}) => {
      const mark = document.createElement('li'), svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
      svg.style.background = `rgb(${color.join()})`;
      mark.append(svg, text);
      return mark;
    }));
  }

  // {name, id, place}, or null.
  showItem(item) {
    const output = byId('item');
    output.replaceChildren();
    if (!item)
      return;
    const name = document.createElement('b'), place = document.createElement('i');
    name.textContent = item.name;
    place.textContent = item.place ? ` ${item.place}` : '';
    output.append(name, item.id ? ` #${item.id}` : '', place);
  }

  showTime(milliseconds) {
    byId('time').textContent = milliseconds === 0 ? '' : `${milliseconds < 9.95 ? milliseconds.toFixed(1) : Math.round(milliseconds)} ms`;
  }
}
