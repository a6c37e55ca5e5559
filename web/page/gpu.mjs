// One rendering interface for WebGPU and WebGL 2: programs by name, tables as textures, targets
// that are displayed or read.

import { bits } from './rust.mjs';

/** Numbers of a vertex's attributes: position, plane, normal, tangent, texture coordinates. */
const ATTRIBUTES = [3, 4, 3, 3, 2];
const CORNER = 15;

const joined = (data, name) => {
  const { head, parts } = data.programs[name];
  return data.heads[head] + parts.map(part => `\n// ${part}\n\n${data.parts[part]}`).join('');
};

/** Returns the WGSL of a program with its dependencies. */
export function wgslOf(data, name) {
  return joined(data, name);
}

/** Returns the texels of a table in rows, padded with zeros. */
function rowsOf(array, width) {
  const height = Math.max(1, Math.ceil(array.length / width));
  if (array.length === width * height) return [array, height];
  const filled = new array.constructor(width * height);
  filled.set(array);
  return [filled, height];
}

/**
 * Opens WebGPU, or WebGL 2 if it is unavailable or requested by `api`; returns nothing without
 * either.
 */
export async function openGpu(data, canvas, api) {
  if (api !== 'webgl2') {
    const gpu = await openWebGpu(data, canvas);
    if (gpu || api === 'webgpu') return gpu;
  }
  return openWebGl(data, canvas);
}

async function openWebGpu(data, canvas) {
  const adapter = await navigator.gpu?.requestAdapter();
  const device = await adapter?.requestDevice();
  const context = device && canvas.getContext('webgpu');
  if (!context) return null;
  const format = 'rgba8unorm';
  context.configure({ device, format, alphaMode: 'opaque', usage: GPUTextureUsage.COPY_DST | GPUTextureUsage.RENDER_ATTACHMENT });
  const about = adapter.info ?? {};
  const programs = new Map(), tables = new WeakMap();
  const visibility = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT;

  const compile = async name => {
    const { bindings, entries } = data.programs[name];
    device.pushErrorScope('validation');
    const module = device.createShaderModule({ code: joined(data, name) });
    const layout = device.createBindGroupLayout({
      entries: bindings.map(([, kind], binding) => kind === 'u' ? { binding, visibility, buffer: {} } : {
        binding, visibility, texture: { sampleType: kind === 'w' ? 'uint' : 'unfilterable-float' },
      }),
    });
    let offset = 0;
    const attributes = ATTRIBUTES.map((count, shaderLocation) => {
      const attribute = { shaderLocation, offset, format: `float32x${count}` };
      offset += 4 * count;
      return attribute;
    });
    const meshed = !entries[0].startsWith('screen');
    const pipeline = await device.createRenderPipelineAsync({
      layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
      vertex: { module, entryPoint: entries[0], buffers: meshed ? [{ arrayStride: 4 * CORNER, attributes }] : [] },
      fragment: { module, entryPoint: entries[1], targets: [{ format }] },
      depthStencil: { format: 'depth32float', depthWriteEnabled: meshed, depthCompare: meshed ? 'greater' : 'always' },
    });
    const error = await device.popErrorScope();
    if (error) throw new Error(error.message);
    const uniforms = bindings.filter(([, kind]) => kind === 'u').map(([uniform]) => [uniform, null]);
    return { pipeline, layout, bindings, uniforms: new Map(uniforms) };
  };
  const uniform = (program, name, array) => {
    const words = bits(array);
    let buffer = program.uniforms.get(name);
    if (!buffer) {
      buffer = device.createBuffer({ size: words.byteLength, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
      program.uniforms.set(name, buffer);
    }
    device.queue.writeBuffer(buffer, 0, words);
    return { buffer };
  };
  const table = (kind, width, array) => {
    if (!tables.has(array)) {
      const [texels, height] = rowsOf(array, width);
      const texture = device.createTexture({
        size: [width, height], format: kind === 'w' ? 'r32uint' : 'r32float',
        usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
      });
      device.queue.writeTexture({ texture }, texels, { bytesPerRow: 4 * width }, [width, height]);
      tables.set(array, texture);
    }
    return tables.get(array).createView();
  };

  return {
    api: 'WebGPU',
    name: ['WebGPU', about.vendor, about.architecture, about.description].filter(Boolean).join(' '),
    near: near => [near, 0],
    rows: -1,
    lost: device.lost.then(({ message }) => message),
    destroy: () => device.destroy(),
    program(name) {
      if (!programs.has(name)) programs.set(name, compile(name));
      return programs.get(name);
    },
    mesh(corners) {
      const buffer = device.createBuffer({ size: corners.byteLength, usage: GPUBufferUsage.VERTEX | GPUBufferUsage.COPY_DST });
      device.queue.writeBuffer(buffer, 0, corners);
      return { buffer, count: corners.length / CORNER, free: () => buffer.destroy() };
    },
    /** Frees an unused table. */
    forget(array) {
      tables.get(array)?.destroy();
      tables.delete(array);
    },
    target(width, height) {
      const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
      const colour = device.createTexture({ size: [width, height], format, usage });
      const depth = device.createTexture({ size: [width, height], format: 'depth32float', usage: GPUTextureUsage.RENDER_ATTACHMENT });
      return { width, height, colour, depth, free: () => { colour.destroy(); depth.destroy(); } };
    },
    async draw(target, { program: name, resources, mesh, clear, box }) {
      const program = await this.program(name);
      const entries = program.bindings.map(([of, kind, width], binding) => ({
        binding, resource: kind === 'u' ? uniform(program, of, resources[of]) : table(kind, width, resources[of]),
      }));
      const group = device.createBindGroup({ layout: program.layout, entries });
      const encoder = device.createCommandEncoder();
      const loadOp = clear ? 'clear' : 'load', [r, g, b] = clear || [0, 0, 0];
      const pass = encoder.beginRenderPass({
        colorAttachments: [{ view: target.colour.createView(), loadOp, storeOp: 'store', clearValue: { r, g, b, a: 1 } }],
        depthStencilAttachment: { view: target.depth.createView(), depthLoadOp: loadOp, depthStoreOp: 'store', depthClearValue: 0 },
      });
      if (box) pass.setScissorRect(...box);
      pass.setPipeline(program.pipeline);
      pass.setBindGroup(0, group);
      if (mesh) pass.setVertexBuffer(0, mesh.buffer);
      pass.draw(mesh ? mesh.count : 3);
      pass.end();
      device.queue.submit([encoder.finish()]);
    },
    done: () => device.queue.onSubmittedWorkDone(),
    show(target) {
      if (canvas.width !== target.width || canvas.height !== target.height) {
        canvas.width = target.width;
        canvas.height = target.height;
      }
      const encoder = device.createCommandEncoder();
      encoder.copyTextureToTexture({ texture: target.colour }, { texture: context.getCurrentTexture() }, [target.width, target.height]);
      device.queue.submit([encoder.finish()]);
    },
    async pixels({ width, height, colour }) {
      const bytesPerRow = Math.ceil(width / 64) * 256;
      const buffer = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
      const encoder = device.createCommandEncoder();
      encoder.copyTextureToBuffer({ texture: colour }, { buffer, bytesPerRow }, [width, height]);
      device.queue.submit([encoder.finish()]);
      await buffer.mapAsync(GPUMapMode.READ);
      const padded = new Uint8Array(buffer.getMappedRange()), pixels = new Uint8ClampedArray(4 * width * height);
      for (let y = 0; y < height; y++) pixels.set(padded.subarray(y * bytesPerRow, y * bytesPerRow + 4 * width), 4 * width * y);
      buffer.destroy();
      return pixels;
    },
  };
}

function openWebGl(data, canvas) {
  const gl = canvas.getContext('webgl2', { antialias: false, alpha: false, depth: false, preserveDrawingBuffer: true });
  if (!gl) return null;
  const debug = gl.getExtension('WEBGL_debug_renderer_info');
  const programs = new Map(), tables = new WeakMap();
  const lost = new Promise(resolve => canvas.addEventListener('webglcontextlost', event => {
    event.preventDefault();
    resolve('the context was lost');
  }));
  const nothing = gl.createVertexArray();

  const shader = (kind, numbers) => {
    const made = gl.createShader(kind);
    gl.shaderSource(made, numbers.map(number => data.glsl[number]).join(''));
    gl.compileShader(made);
    return made;
  };
  const compile = async name => {
    const { bindings, glsl } = data.programs[name];
    const program = gl.createProgram(), shaders = [shader(gl.VERTEX_SHADER, glsl[0]), shader(gl.FRAGMENT_SHADER, glsl[1])];
    shaders.forEach(made => gl.attachShader(program, made));
    gl.linkProgram(program);
    const parallel = gl.getExtension('KHR_parallel_shader_compile');
    while (parallel && !gl.isContextLost() && !gl.getProgramParameter(program, parallel.COMPLETION_STATUS_KHR)) {
      await new Promise(resolve => setTimeout(resolve, 5));
    }
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error([gl.getProgramInfoLog(program), ...shaders.map(made => gl.getShaderInfoLog(made))].filter(Boolean).join('\n'));
    }
    gl.useProgram(program);
    const bound = [];
    let [block, unit] = [0, 0];
    for (const [of, kind, width] of bindings) {
      if (kind === 'u') {
        const index = gl.getUniformBlockIndex(program, `${of}_block`);
        if (index === gl.INVALID_INDEX) continue;
        gl.uniformBlockBinding(program, index, block);
        bound.push({ of, kind, slot: block++, buffer: gl.createBuffer() });
      } else {
        const place = gl.getUniformLocation(program, `${of}_table_`);
        if (!place) continue;
        gl.uniform1i(place, unit);
        bound.push({ of, kind, width, slot: unit++ });
      }
    }
    return { program, bound };
  };
  const table = (kind, width, array) => {
    if (!tables.has(array)) {
      const [texels, height] = rowsOf(array, width), texture = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, texture);
      const [internal, format, type] = kind === 'w' ? [gl.R32UI, gl.RED_INTEGER, gl.UNSIGNED_INT] : [gl.R32F, gl.RED, gl.FLOAT];
      gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, type, texels);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      tables.set(array, texture);
    }
    return tables.get(array);
  };

  return {
    api: 'WebGL 2',
    name: ['WebGL 2', debug && gl.getParameter(debug.UNMASKED_RENDERER_WEBGL)].filter(Boolean).join(' '),
    near: near => [2 * near, -1],
    rows: 1,
    lost,
    destroy: () => gl.getExtension('WEBGL_lose_context')?.loseContext(),
    program(name) {
      if (!programs.has(name)) programs.set(name, compile(name));
      return programs.get(name);
    },
    mesh(corners) {
      const array = gl.createVertexArray(), buffer = gl.createBuffer();
      gl.bindVertexArray(array);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STATIC_DRAW);
      let offset = 0;
      ATTRIBUTES.forEach((count, place) => {
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, count, gl.FLOAT, false, 4 * CORNER, offset);
        offset += 4 * count;
      });
      const free = () => { gl.deleteVertexArray(array); gl.deleteBuffer(buffer); };
      return { array, count: corners.length / CORNER, free };
    },
    forget(array) {
      gl.deleteTexture(tables.get(array) ?? null);
      tables.delete(array);
    },
    target(width, height) {
      const frame = gl.createFramebuffer(), colour = gl.createRenderbuffer(), depth = gl.createRenderbuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
      gl.bindRenderbuffer(gl.RENDERBUFFER, colour);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, colour);
      gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
      const free = () => { gl.deleteFramebuffer(frame); gl.deleteRenderbuffer(colour); gl.deleteRenderbuffer(depth); };
      return { width, height, frame, free };
    },
    async draw(target, { program: name, resources, mesh, clear, box }) {
      const { program, bound } = await this.program(name);
      gl.useProgram(program);
      for (const { of, kind, width, slot, buffer } of bound) {
        if (kind === 'u') {
          gl.bindBuffer(gl.UNIFORM_BUFFER, buffer);
          gl.bufferData(gl.UNIFORM_BUFFER, bits(resources[of]), gl.DYNAMIC_DRAW);
          gl.bindBufferBase(gl.UNIFORM_BUFFER, slot, buffer);
        } else {
          gl.activeTexture(gl.TEXTURE0 + slot);
          gl.bindTexture(gl.TEXTURE_2D, table(kind, width, resources[of]));
        }
      }
      gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
      gl.viewport(0, 0, target.width, target.height);
      gl.disable(gl.SCISSOR_TEST);
      gl.depthMask(true);
      if (clear) {
        gl.clearColor(...clear, 1);
        gl.clearDepth(0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      }
      if (box) {
        const [x, y, width, height] = box;
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(x, target.height - y - height, width, height);
      }
      if (mesh) gl.enable(gl.DEPTH_TEST); else gl.disable(gl.DEPTH_TEST);
      gl.depthFunc(gl.GREATER);
      gl.bindVertexArray(mesh ? mesh.array : nothing);
      gl.drawArrays(gl.TRIANGLES, 0, mesh ? mesh.count : 3);
    },
    async done() {
      // WebKit signals a fence before it is passed, and loses draws meanwhile. Reading back a pixel
      // waits reliably.
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      await new Promise(resolve => setTimeout(resolve));
    },
    show(target) {
      if (canvas.width !== target.width || canvas.height !== target.height) {
        canvas.width = target.width;
        canvas.height = target.height;
      }
      gl.disable(gl.SCISSOR_TEST);
      gl.bindFramebuffer(gl.READ_FRAMEBUFFER, target.frame);
      gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
      const { width, height } = target;
      gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    },
    async pixels({ width, height, frame }) {
      const raw = new Uint8Array(4 * width * height), pixels = new Uint8ClampedArray(4 * width * height);
      gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, raw);
      for (let y = 0; y < height; y++) pixels.set(raw.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)), 4 * width * y);
      return pixels;
    },
  };
}
