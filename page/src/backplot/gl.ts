// Lines by WebGL2: a piece is two triangles, whose corners the shader makes of points and kinds that it fetches from textures.
// Instances would say it shorter, but many drivers draw small ones slowly, one by one.

import type { Camera } from "./camera.ts";
import { type Colours, TOOLS } from "./colours.ts";
import { count, type Level } from "./levels.ts";
import type { Painter, Stroke } from "./painter.ts";

/** Cells of a row of a texture: every WebGL2 has as many. */
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
uniform vec3 palette[${TOOLS + 1}];
uniform vec4 one;
out vec3 colour;
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
  float end = float(corner & 1), edge = float(corner >> 1) * 2. - 1.;
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
  readonly most = { still: Infinity, moving: 1_500_000 };
  private readonly program: WebGLProgram;
  private readonly at: Record<string, WebGLUniformLocation | null> = {};
  private readonly kept = new Map<Level, WebGLTexture[]>();
  private ratio = 1;
  private bound: Level | null = null;

  private constructor(private readonly gl: WebGL2RenderingContext) {
    this.program = link(gl);
    for (const name of ["axes", "target", "half_size", "scale", "width", "palette", "one", "alpha", "dash", "points", "kinds"]) {
      this.at[name] = gl.getUniformLocation(this.program, name);
    }
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** Null where the browser has none, or none that is faster than a plain canvas. */
  static on(canvas: HTMLCanvasElement): GlPainter | null {
    // asked of a canvas of its own: one that was asked for WebGL2 draws by nothing else
    const options: WebGLContextAttributes = { antialias: true, alpha: true, premultipliedAlpha: true, failIfMajorPerformanceCaveat: true };
    const tried = document.createElement("canvas").getContext("webgl2", options) as WebGL2RenderingContext | null;
    if (!tried || isSoftware(tried)) return null;
    const gl = canvas.getContext("webgl2", options) as WebGL2RenderingContext | null;
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
    gl.uniform1f(this.at.dash, dashed ? this.ratio : 0);
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

  /** Points and kinds of a level. */
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

/** Browsers have names for what draws without a GPU. */
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
