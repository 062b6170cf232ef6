// Lines by WebGL2: a piece is an instance, four corners around it are made in the shader.

import type { Camera } from "./camera.ts";
import { type Colours, TOOLS } from "./colours.ts";
import { count, type Level } from "./levels.ts";
import type { Painter, Stroke } from "./painter.ts";

const VERTEX = `#version 300 es
layout(location=0) in vec3 a;
layout(location=1) in vec3 b;
layout(location=2) in uvec4 kind;
uniform mat3 axes;
uniform vec3 target;
uniform vec2 half_size;
uniform float scale, width;
uniform vec3 palette[${TOOLS + 1}];
uniform vec4 one;
out vec3 colour;
out float along;
flat out uint dashes;
void main() {
  vec2 from = ((a - target) * axes).xy * scale;
  vec2 to = ((b - target) * axes).xy * scale;
  vec2 way = to - from;
  float length_ = length(way);
  vec2 ahead = length_ > 1e-4 ? way / length_ : vec2(1, 0);
  vec2 side = vec2(-ahead.y, ahead.x);
  float end = float(gl_VertexID & 1), edge = float(gl_VertexID >> 1) * 2. - 1.;
  vec2 cap = ahead * width * .5 * (end * 2. - 1.) * (kind.x == 0u ? 0. : .8);
  vec2 at = mix(from, to, end) + side * edge * width * .5 + cap;
  along = end * length_;
  dashes = kind.x == 0u ? 1u : 0u;
  colour = one.a > 0. ? one.rgb : kind.x == 0u ? palette[${TOOLS}] : palette[(kind.y + ${TOOLS - 1}u) % ${TOOLS}u];
  gl_Position = kind.x == 3u ? vec4(2, 2, 2, 1) : vec4(at / half_size, 0, 1);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec3 colour;
in float along;
flat in uint dashes;
uniform float alpha, dash;
out vec4 pixel;
void main() {
  if (dashes == 1u && dash > 0. && mod(along, dash * 7.) > dash * 4.) discard;
  pixel = vec4(colour * alpha, alpha);
}`;

export class GlPainter implements Painter {
  readonly name = "WebGL2";
  private readonly program: WebGLProgram;
  private readonly at: Record<string, WebGLUniformLocation | null> = {};
  private readonly kept = new Map<Level, { array: WebGLVertexArrayObject; buffers: WebGLBuffer[] }>();
  private ratio = 1;
  private bound: Level | null = null;

  private constructor(private readonly gl: WebGL2RenderingContext) {
    this.program = link(gl);
    for (const name of ["axes", "target", "half_size", "scale", "width", "palette", "one", "alpha", "dash"]) {
      this.at[name] = gl.getUniformLocation(this.program, name);
    }
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** Null where the browser has none. */
  static on(canvas: HTMLCanvasElement): GlPainter | null {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: true });
    return gl && new GlPainter(gl);
  }

  begin(camera: Camera, colours: Colours, ratio: number): void {
    const gl = this.gl;
    this.ratio = ratio;
    this.bound = null;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.useProgram(this.program);
    const axes = camera.axes();
    gl.uniformMatrix3fv(this.at.axes, false, axes.flat());
    gl.uniform3fv(this.at.target, camera.target);
    gl.uniform2f(this.at.half_size, gl.drawingBufferWidth / 2, gl.drawingBufferHeight / 2);
    gl.uniform1f(this.at.scale, camera.scale * ratio);
    gl.uniform3fv(this.at.palette, [...colours.tools, colours.rapid].flat());
  }

  stroke({ level, from, to, width, alpha, colour, dashed }: Stroke): void {
    if (to <= from) return;
    const gl = this.gl;
    if (this.bound !== level) {
      gl.bindVertexArray(this.array(level).array);
      this.bound = level;
    }
    // attributes begin at the first piece that is drawn
    const points = this.array(level).buffers;
    gl.bindBuffer(gl.ARRAY_BUFFER, points[0]);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 12, from * 12);
    gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 12, from * 12 + 12);
    gl.bindBuffer(gl.ARRAY_BUFFER, points[1]);
    gl.vertexAttribIPointer(2, 4, gl.UNSIGNED_BYTE, 4, from * 4);
    gl.uniform1f(this.at.width, width * this.ratio);
    gl.uniform1f(this.at.alpha, alpha);
    gl.uniform1f(this.at.dash, dashed ? this.ratio : 0);
    gl.uniform4f(this.at.one, ...(colour ?? [0, 0, 0]), colour ? 1 : 0);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, to - from);
  }

  forget(levels: Level[]): void {
    for (const level of levels) {
      const kept = this.kept.get(level);
      if (!kept) continue;
      this.gl.deleteVertexArray(kept.array);
      kept.buffers.forEach((buffer) => this.gl.deleteBuffer(buffer));
      this.kept.delete(level);
    }
  }

  private array(level: Level) {
    const known = this.kept.get(level);
    if (known) return known;
    const gl = this.gl;
    const array = gl.createVertexArray()!;
    gl.bindVertexArray(array);
    const buffers = [level.points, count(level) ? level.kinds : new Uint8Array(4)].map((data) => {
      const buffer = gl.createBuffer()!;
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      return buffer;
    });
    for (const attribute of [0, 1, 2]) {
      gl.enableVertexAttribArray(attribute);
      gl.vertexAttribDivisor(attribute, 1);
    }
    const kept = { array, buffers };
    this.kept.set(level, kept);
    return kept;
  }
}

function link(gl: WebGL2RenderingContext): WebGLProgram {
  const program = gl.createProgram()!;
  for (const [type, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) ?? "no shader");
  return program;
}
