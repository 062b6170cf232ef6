// The view of the path. It has no perspective, so that lengths are to scale.

export type Vector = [number, number, number];

export interface View {
  name: string;
  /** Angles around the vertical axis, and up from the floor, in radians. */
  turn: number;
  tilt: number;
  /** The view of a lathe: Z to the right, X up. */
  lathe?: boolean;
}

export const VIEWS: View[] = [
  { name: "top", turn: 0, tilt: Math.PI / 2 },
  { name: "front", turn: 0, tilt: 0 },
  { name: "side", turn: Math.PI / 2, tilt: 0 },
  { name: "iso", turn: Math.PI / 4, tilt: Math.atan(Math.SQRT1_2) },
  { name: "lathe", turn: 0, tilt: 0, lathe: true },
];

export class Camera {
  turn = VIEWS[3].turn;
  tilt = VIEWS[3].tilt;
  lathe = false;
  /** The name of the view; it changes when the user turns the view. */
  view = "iso";
  /** Pixels per unit of length. */
  scale = 1;
  /** The point in the middle of the view. */
  target: Vector = [0, 0, 0];
  width = 1;
  height = 1;

  look(view: View): void {
    [this.turn, this.tilt, this.lathe, this.view] = [view.turn, view.tilt, !!view.lathe, view.name];
  }

  orbit(dx: number, dy: number): void {
    this.turn -= dx * 0.008;
    this.tilt = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.tilt + dy * 0.008));
    this.view = "";
  }

  /** The directions to the right, up, and towards the viewer. */
  axes(): [Vector, Vector, Vector] {
    const [st, ct, se, ce] = [Math.sin(this.turn), Math.cos(this.turn), Math.sin(this.tilt), Math.cos(this.tilt)];
    const right: Vector = [ct, st, 0];
    const eye: Vector = [st * ce, -ct * ce, se];
    const up: Vector = [-st * se, ct * se, ce];
    // a lathe is shown in Z and X: its axes are mapped to those of a mill
    const rename = (v: Vector): Vector => (this.lathe ? [v[2], -v[1], v[0]] : v);
    return [rename(right), rename(up), rename(eye)];
  }

  project(at: ArrayLike<number>, offset = 0): [number, number] {
    const [right, up] = this.axes();
    const x = at[offset] - this.target[0];
    const y = at[offset + 1] - this.target[1];
    const z = at[offset + 2] - this.target[2];
    return [
      this.width / 2 + (x * right[0] + y * right[1] + z * right[2]) * this.scale,
      this.height / 2 - (x * up[0] + y * up[1] + z * up[2]) * this.scale,
    ];
  }

  pan(dx: number, dy: number): void {
    const [right, up] = this.axes();
    for (let axis = 0; axis < 3; axis++) {
      this.target[axis] += (-dx * right[axis] + dy * up[axis]) / this.scale;
    }
  }

  /** Zooms. The point at the given pixel keeps its position. */
  zoom(factor: number, x: number, y: number): void {
    const [dx, dy] = [x - this.width / 2, y - this.height / 2];
    this.pan(-dx, -dy);
    this.scale = Math.min(1e9, Math.max(1e-9, this.scale * factor));
    this.pan(dx, dy);
  }

  /** Fits points into the view. Each point has three numbers. */
  fit(points: ArrayLike<number>, margin = 40): void {
    const axes = this.axes();
    const least = [Infinity, Infinity, Infinity];
    const greatest = [-Infinity, -Infinity, -Infinity];
    for (let at = 0; at + 2 < points.length; at += 3) {
      for (let along = 0; along < 3; along++) {
        const axis = axes[along];
        const value = points[at] * axis[0] + points[at + 1] * axis[1] + points[at + 2] * axis[2];
        if (value < least[along]) least[along] = value;
        if (value > greatest[along]) greatest[along] = value;
      }
    }
    if (least[0] > greatest[0]) return;
    const middle = least.map((value, along) => (value + greatest[along]) / 2);
    this.target = [0, 1, 2].map((axis) => axes[0][axis] * middle[0] + axes[1][axis] * middle[1] + axes[2][axis] * middle[2]) as Vector;
    const wide = Math.max(10, this.width - 2 * margin) / Math.max(1e-9, greatest[0] - least[0]);
    const high = Math.max(10, this.height - 2 * margin) / Math.max(1e-9, greatest[1] - least[1]);
    this.scale = Math.min(wide, high, 1e7);
  }
}
