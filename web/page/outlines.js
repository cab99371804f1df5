// Rectangles of the picture as lines of one pixel.

import {chunk, manifest} from './data.js';
import {makeProgram} from './gpu.js';
import {byColumns, multiply} from './matrix.js';

const bytesPerOutline = 20;  // four floats, then a colour of four bytes

export class Outlines {
  static async make(gl, name) {
    const outlines = new Outlines(), bytes = await chunk(name);
    outlines.gl = gl;
    outlines.program = await makeProgram(gl, manifest.programs.outlineVertex, manifest.programs.outlineFragment);
    outlines.count = bytes.length / bytesPerOutline;
    outlines.vertices = gl.createVertexArray();
    gl.bindVertexArray(outlines.vertices);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.STATIC_DRAW);
    [[4, gl.FLOAT, false, 0], [4, gl.UNSIGNED_BYTE, true, 16]].forEach(([size, type, normalized, offset], place) => {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, type, normalized, bytesPerOutline, offset);
      gl.vertexAttribDivisor(place, 1);
    });
    gl.bindVertexArray(null);
    return outlines;
  }

  // Into a target of so many pixels.
  draw(fromPicture, columns, rows) {
    const {gl, program} = this, toClip = [2 / columns, 0, -1, 0, -2 / rows, 1, 0, 0, 1];
    gl.useProgram(program);
    gl.uniformMatrix3fv(gl.getUniformLocation(program, 'toClip'), false, byColumns(multiply(toClip, fromPicture)));
    gl.bindVertexArray(this.vertices);
    gl.drawArraysInstanced(gl.LINE_LOOP, 0, 4, this.count);
    gl.bindVertexArray(null);
  }
}
