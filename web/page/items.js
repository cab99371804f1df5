// Which item covers a place of the picture (docs/picking.md), and which element of the source it is.

import {chunkFile, manifest} from './data.js';
import {Inputs, makeProgram} from './gpu.js';

export class Items {
  static async make(gl) {
    const {ids} = manifest;
    if (!ids)
      return null;
    const items = new Items();
    items.gl = gl;
    items.program = await makeProgram(gl, ids.vertex, ids.fragment);
    items.inputs = await Inputs.make(gl, ids.data);
    items.lines = manifest.svg ? new TextDecoder().decode(await chunkFile(manifest.svg)).split(/\r\n|\r|\n/) : [];
    items.target = gl.createFramebuffer();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.R32UI, 1, 1);
    gl.bindFramebuffer(gl.FRAMEBUFFER, items.target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return items;
  }

  // At a point of the picture: 0 for nothing.
  idAt([x, y]) {
    const {gl, program} = this, [left, top, side] = manifest.ids.square, units = manifest.ids.unitsPerSide;
    const place = [(x - left) / side * units, (y - top) / side * units].map((u) => Math.min(units, Math.max(-1, u)));
    const whole = place.map(Math.floor);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.disable(gl.SCISSOR_TEST);
    gl.viewport(0, 0, 1, 1);
    gl.useProgram(program);
    this.inputs.set(gl, program);
    const at = (name) => gl.getUniformLocation(program, name);
    gl.uniform2i(at('baseUnit'), whole[0], whole[1]);
    gl.uniform4f(at('unitAnchor'), place[0] - whole[0], place[1] - whole[1], 0.5, 0.5);
    gl.uniform4f(at('pixelToUnit'), 0, 0, 0, 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const pixel = new Uint32Array(4);
    gl.readPixels(0, 0, 1, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, pixel);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return pixel[0];
  }

  // What an id is called: {name, id, place}.
  describe(number) {
    const item = manifest.ids.items[number - 1];
    if (!item)
      return {name: `region ${number}`, id: '', place: ''};
    const [element, line, , isStroke] = item;
    return {name: element ? `<${element}>` : 'item', id: this.idOfElement(item),
      place: [isStroke ? 'stroke' : 'fill', line ? `line ${line}` : ''].filter(Boolean).join(', ')};
  }

  // The attribute of the tag that begins there.
  idOfElement([element, line, column]) {
    const maxLines = 50, from = this.lines[line - 1];
    if (from === undefined)
      return '';
    const text = [from.slice(Math.max(0, column - 2)), ...this.lines.slice(line, line + maxLines)].join('\n');
    const start = text.search(new RegExp(`<([\\w.-]+:)?${element}\\b`));
    const tag = start < 0 ? '' : text.slice(start).match(/^<(?:"[^"]*"|'[^']*'|[^>"'])*/)[0];
    return tag.match(/\sid\s*=\s*(?:"([^"]*)"|'([^']*)')/)?.slice(1).find((id) => id !== undefined) ?? '';
  }
}
