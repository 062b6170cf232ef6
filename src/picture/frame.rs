//! Converts positions of the axes to positions on the part: rotary axes turn the part under the tool.
//!
//! A positive angle turns the tool about the part by the right-hand rule (ISO 841, "as if the tool moved"). The axis of
//! this rotation passes through program zero. If several axes turn, A and B carry C, as on most trunnion tables;
//! postform assumes this order, because no program states the order.

/// The tool position on the part, X Y Z, for positions of A B C in degrees.
pub(super) fn on_part([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = sin_cos(a);
    let (y, z) = (y * cos - z * sin, y * sin + z * cos);
    let (sin, cos) = sin_cos(b);
    let (z, x) = (z * cos - x * sin, z * sin + x * cos);
    let (sin, cos) = sin_cos(c);
    [x * cos - y * sin, x * sin + y * cos, z]
}

/// Sine and cosine of an angle in degrees; exact at multiples of 90.
fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}
