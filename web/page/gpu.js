// WebGL 2: programs, textures and uniforms as the page's data describe them.

import {chunk, chunkText} from './data.js';

const setters = {
  int: ['uniform1iv', 'uniform2iv', 'uniform3iv', 'uniform4iv'],
  uint: ['uniform1uiv', 'uniform2uiv', 'uniform3uiv', 'uniform4uiv'],
  float: ['uniform1fv', 'uniform2fv', 'uniform3fv', 'uniform4fv'],
};

function compiled(gl, stage, source) {
  const shader = gl.createShader(stage);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  return shader;
}

// How long a driver may compile on threads of its own before it is waited for.
const patience = 500;

async function compileOnThreads(gl, program) {
  const parallel = gl.getExtension('KHR_parallel_shader_compile');
  const start = performance.now();
  while (parallel && performance.now() - start < patience && !gl.getProgramParameter(program, parallel.COMPLETION_STATUS_KHR))
    await new Promise((resolve) => setTimeout(resolve, 5));
}

// From the chunks of its two stages.
export async function makeProgram(gl, vertexChunk, fragmentChunk) {
  const program = gl.createProgram();
  const shaders = [compiled(gl, gl.VERTEX_SHADER, await chunkText(vertexChunk)),
    compiled(gl, gl.FRAGMENT_SHADER, await chunkText(fragmentChunk))];
  shaders.forEach((shader) => gl.attachShader(program, shader));
  gl.linkProgram(program);
  await compileOnThreads(gl, program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`${fragmentChunk}: ${shaders.map((shader) => gl.getShaderInfoLog(shader)).join('')}${gl.getProgramInfoLog(program)}`);
  return program;
}

async function makeTexture(gl, {format, width, height, levels, filtered, chunk: source}) {
  const largest = gl.getParameter(gl.MAX_TEXTURE_SIZE);
  if (width > largest || height > largest)
    throw new RangeError(`The picture needs textures of ${width} × ${height} texels; this browser's limit is ${largest} per side.`);
  const bytes = await chunk(source), isRecords = format === 'rgba32ui', texel = isRecords ? 16 : 4;
  const data = isRecords ? new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4) : bytes;
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filtered ? gl.LINEAR_MIPMAP_LINEAR : gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filtered ? gl.LINEAR : gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  gl.texStorage2D(gl.TEXTURE_2D, levels, isRecords ? gl.RGBA32UI : gl.RGBA8, width, height);
  for (let level = 0, offset = 0; level < levels; ++level) {
    const [w, h] = [Math.max(1, width >> level), Math.max(1, height >> level)];
    const part = data.subarray(offset, offset += w * h * texel / data.BYTES_PER_ELEMENT);
    gl.texSubImage2D(gl.TEXTURE_2D, level, 0, 0, w, h, isRecords ? gl.RGBA_INTEGER : gl.RGBA,
      isRecords ? gl.UNSIGNED_INT : gl.UNSIGNED_BYTE, part);
  }
  return texture;
}

// A program's textures and uniforms, on the GPU.
export class Inputs {
  static async make(gl, data, prefix = '') {
    const inputs = new Inputs();
    inputs.uniforms = data.uniforms.map((uniform) => ({...uniform, name: prefix + uniform.name}));
    inputs.textures = [];
    for (const texture of data.textures)
      inputs.textures.push({name: prefix + texture.name, texture: await makeTexture(gl, texture)});
    return inputs;
  }

  // Of the program in use. A sampler that it has and these inputs do without shares the unit of the last texture, which is
  // of the same kind: of bytes.
  set(gl, program, samplers = []) {
    for (const {name, type, numbers} of this.uniforms)
      gl[setters[type][numbers.length - 1]](gl.getUniformLocation(program, name), numbers);
    for (const name of samplers)
      gl.uniform1i(gl.getUniformLocation(program, name), this.textures.length - 1);
    this.textures.forEach(({name, texture}, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(gl.getUniformLocation(program, name), unit);
    });
  }
}
