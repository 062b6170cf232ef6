//! Items that only jobs with rotary axes have.

use serde_json::json;

use super::mill::out;
use super::pen::Pen;

/// Turns the part: moves the tool up, then turns.
pub fn turn(pen: &mut Pen<'_>, angle: &mut f64) {
    let [x, y, _] = pen.at;
    let high = pen.length(1.0, 2.0);
    pen.rapid([x, y, high]);
    *angle += pen.random.pick(&[90.0, -90.0, 45.0, 180.0, 22.5, -270.0, 360.0]);
    let [x, y] = pen.across();
    if pen.random.once_in(3) {
        pen.put(json!({ "rapid": [null, null, null, *angle] }));
        pen.put(json!({ "rapid": [x, y, high, *angle] }));
    } else {
        pen.put(json!({ "rapid": [x, y, high, *angle] }));
    }
    pen.at = [x, y, high];
    pen.moves += 1;
    if pen.random.once_in(3) {
        // a cut while the part turns
        let low = pen.length(-0.2, 0.2);
        pen.line([x, y, low], true);
        *angle += pen.random.pick(&[30.0, -30.0, 90.0, 5.0]);
        let along = pen.length(-2.0, 2.0);
        pen.feeding(json!({ "line": [along, y, low, *angle] }), true);
        pen.at = [along, y, low];
        out(pen);
    }
}
