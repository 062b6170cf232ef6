// Draws lines with WebGL2. Each piece is two triangles; the shader computes their corners from points and kinds in textures. Instanced drawing would
// need less code, but many drivers draw small instances slowly.

import type { Camera } from "./camera.ts";
import { type Colours, FADE, RAMP, TOOLS } from "./colours.ts";
import { AGAIN, count, JUMP, type Level } from "./levels.ts";
import { type Painter, RAPID, type Stroke, type Style } from "./painter.ts";

/** Number of cells in a row of a texture. Every WebGL2 implementation allows this number. */
const WIDE = 2048;

const VERTEX = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform sampler2D points;
uniform usampler2D kinds;
uniform mat3 axes;
uniform vec3 target;
uniform vec2 half_size;
uniform float scale, width;
uniform vec3 palette[${TOOLS + 1}], ramp[${RAMP}], paper;
uniform bool by_value;
uniform vec4 one;
out vec3 colour;
flat out float faint;
out float along;
flat out uint dashes;
ivec2 cell(int i) { return ivec2(i % ${WIDE}, i / ${WIDE}); }
void main() {
  int piece = gl_VertexID / 6;
  int corner = gl_VertexID % 6;
  corner = corner > 2 ? 6 - corner : corner; // 0 1 2, 3 2 1
  vec3 a = texelFetch(points, cell(piece), 0).xyz;
  vec3 b = texelFetch(points, cell(piece + 1), 0).xyz;
  uvec4 kind = texelFetch(kinds, cell(piece), 0);
  vec2 from = ((a - target) * axes).xy * scale;
  vec2 to = ((b - target) * axes).xy * scale;
  vec2 way = to - from;
  float length_ = length(way);
  vec2 ahead = length_ > 1e-4 ? way / length_ : vec2(1, 0);
  vec2 side = vec2(-ahead.y, ahead.x);
  bool rapid = kind.x == 0u && one.a == 0.;
  float wide = rapid ? width * ${RAPID.width} : width;
  float end = float(corner & 1), edge = float(corner >> 1) * 2. - 1.;
  vec2 cap = ahead * wide * .5 * (end * 2. - 1.) * (kind.x == 0u ? 0. : .8);
  vec2 at = mix(from, to, end) + side * edge * wide * .5 + cap;
  along = end * length_;
  dashes = kind.x == 0u ? 1u : 0u;
  faint = rapid ? ${RAPID.alpha} : 1.;
  float value = float(kind.z) / 255. * ${RAMP - 1}.;
  int below = min(${RAMP - 2}, int(value));
  vec3 own = by_value ? mix(ramp[below], ramp[below + 1], value - float(below)) : palette[kind.z % ${TOOLS}u];
  colour = one.a > 0. ? one.rgb : rapid ? palette[${TOOLS}] : mix(own, paper, ${FADE} * (1. - float(kind.w) / 255.));
  bool hidden = kind.x == ${JUMP}u || (kind.x == ${AGAIN}u && one.a == 0.);
  gl_Position = hidden ? vec4(2, 2, 2, 1) : vec4(at / half_size, 0, 1);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec3 colour;
in float along;
flat in uint dashes;
flat in float faint;
uniform float alpha, dash;
out vec4 pixel;
void main() {
  if (dashes == 1u && dash > 0. && mod(along, dash * 1.75) > dash) discard;
  pixel = vec4(colour * alpha * faint, alpha * faint);
}`;

export class GlPainter implements Painter {
  readonly name = "WebGL2";
  readonly ground = null;
  readonly most = { still: Infinity, moving: 1_500_000 };
  private readonly program: WebGLProgram;
  private readonly at: Record<string, WebGLUniformLocation | null> = {};
  private readonly kept = new Map<Level, WebGLTexture[]>();
  private ratio = 1;
  private dash = 4;
  private bound: Level | null = null;

  private constructor(private readonly gl: WebGL2RenderingContext) {
    this.program = link(gl);
    for (const name of ["axes", "target", "half_size", "scale", "width", "palette", "ramp", "paper", "by_value", "one", "alpha", "dash", "points", "kinds"]) {
      this.at[name] = gl.getUniformLocation(this.program, name);
    }
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** A painter for the canvas. Null if the browser has no WebGL2, or only one that is no faster than a plain canvas. */
  static on(canvas: HTMLCanvasElement): GlPainter | null {
    // tested on a separate canvas, because a canvas with a WebGL2 context can't get another context
    const options: WebGLContextAttributes = { antialias: true, alpha: true, premultipliedAlpha: true, failIfMajorPerformanceCaveat: true };
    const tried = document.createElement("canvas").getContext("webgl2", options) as WebGL2RenderingContext | null;
    if (!tried || isSoftware(tried)) return null;
    const gl = canvas.getContext("webgl2", options) as WebGL2RenderingContext | null;
    return gl && new GlPainter(gl);
  }

  begin(camera: Camera, colours: Colours, ratio: number, style: Style): void {
    const gl = this.gl;
    this.ratio = ratio;
    this.dash = style.dash * ratio;
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
    gl.uniform3fv(this.at.ramp, colours.ramp.flat());
    gl.uniform3fv(this.at.paper, colours.paper);
    gl.uniform1i(this.at.by_value, style.ramp ? 1 : 0);
  }

  stroke({ level, from, to, width, alpha, colour, dashed }: Stroke): void {
    if (to <= from) return;
    const gl = this.gl;
    if (this.bound !== level) {
      this.textures(level).forEach((texture, unit) => {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, texture);
      });
      gl.uniform1i(this.at.points, 0);
      gl.uniform1i(this.at.kinds, 1);
      this.bound = level;
    }
    gl.uniform1f(this.at.width, width * this.ratio);
    gl.uniform1f(this.at.alpha, alpha);
    gl.uniform1f(this.at.dash, dashed ? this.dash : 0);
    gl.uniform4f(this.at.one, ...(colour ?? [0, 0, 0]), colour ? 1 : 0);
    gl.drawArrays(gl.TRIANGLES, from * 6, (to - from) * 6);
  }

  forget(levels: Level[]): void {
    for (const level of levels) {
      const kept = this.kept.get(level);
      if (!kept) continue;
      kept.forEach((texture) => this.gl.deleteTexture(texture));
      this.kept.delete(level);
    }
  }

  /** Textures with the points and kinds of a level. */
  private textures(level: Level): WebGLTexture[] {
    const known = this.kept.get(level);
    if (known) return known;
    const gl = this.gl;
    const rows = Math.ceil((count(level) + 1) / WIDE);
    const made = (form: number, channels: number, type: number, cells: Float32Array | Uint8Array) => {
      const texture = gl.createTexture()!;
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      gl.texImage2D(gl.TEXTURE_2D, 0, form, WIDE, rows, 0, channels, type, cells);
      return texture;
    };
    const points = new Float32Array(rows * WIDE * 3);
    points.set(level.points);
    const kinds = new Uint8Array(rows * WIDE * 4);
    kinds.set(level.kinds);
    const kept = [made(gl.RGB32F, gl.RGB, gl.FLOAT, points), made(gl.RGBA8UI, gl.RGBA_INTEGER, gl.UNSIGNED_BYTE, kinds)];
    this.kept.set(level, kept);
    this.bound = null;
    return kept;
  }
}

/** Is the renderer one of the known software renderers? */
function isSoftware(gl: WebGL2RenderingContext): boolean {
  const named = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(named?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
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
