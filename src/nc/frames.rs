//! Coordinate frames: work offsets, G92 and G52, rotation, tool length.

use super::action::Position;

/// The shift that G92 and G52 add to positions of the program.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shift {
    /// Distance by which the frame was moved.
    pub by: Position,
    /// As bits, the axes along which the shift is unknown: the position of the axis was known only at the machine when
    /// G92 was run.
    pub unknown: u8,
}

/// The frames of a machine, in the program's units.
#[derive(Clone, Debug)]
pub struct Frames {
    /// Work offsets by number. Number 0 shifts all other offsets, 1 to 9 are G54 to G59.3, 10 and up are G54.1 P1 and up.
    work: Vec<Position>,
    /// For each work offset, as bits, the axes for which the program has set the offset.
    given: Vec<u8>,
    /// Rotation of each work offset about its origin in XY, in degrees.
    rotation: Vec<f64>,
    /// Index of the active work offset.
    pub active: usize,
    /// The active shift of G92 and G52 together.
    pub shift: Shift,
    /// The part of the shift that comes from G52. On LinuxCNC, G52 and G92 set the same shift, and this part is 0.
    pub local: Position,
    /// The shift that G92.3 restores.
    pub shift_kept: Shift,
    /// Tool length offset on X, Y, Z.
    pub tool: [f64; 3],
}

/// The number of work offsets: one offset that shifts all others, nine usual offsets, 99 additional offsets of a Haas,
/// and one offset for all higher numbers.
const OFFSETS: usize = 110;

impl Default for Frames {
    fn default() -> Self {
        Frames {
            work: vec![[0.0; 6]; OFFSETS],
            given: vec![0; OFFSETS],
            rotation: vec![0.0; OFFSETS],
            active: 1,
            shift: Shift::default(),
            local: Position::default(),
            shift_kept: Shift::default(),
            tool: [0.0; 3],
        }
    }
}

impl Frames {
    /// Index of a work offset on a control that only numbers its offsets. All numbers that are too high share one index.
    pub fn counted(number: f64) -> usize {
        if (1.0..(OFFSETS - 1) as f64).contains(&number) { number as usize } else { OFFSETS - 1 }
    }

    /// Machine position of Z0 in program coordinates.
    pub fn zero_height(&self) -> f64 {
        self.to_machine(&[0.0; 6])[2]
    }

    /// The rotation of the active work offset, in degrees.
    pub fn angle(&self) -> f64 {
        self.rotation[self.active]
    }

    /// Converts program coordinates to coordinates of the work offset: adds the shift and applies the rotation.
    pub fn to_work(&self, at: &Position) -> Position {
        let mut place = *at;
        for (value, shift) in place.iter_mut().zip(&self.shift.by) {
            *value += shift;
        }
        turn(&mut place, self.angle());
        place
    }

    /// Converts program coordinates to machine coordinates.
    pub fn to_machine(&self, at: &Position) -> Position {
        let mut place = self.to_work(at);
        for (axis, value) in place.iter_mut().enumerate() {
            *value += self.work[self.active][axis] + self.work[0][axis];
        }
        for (value, tool) in place.iter_mut().zip(&self.tool) {
            *value += tool;
        }
        place
    }

    /// Converts machine coordinates to program coordinates.
    pub fn to_program(&self, at: &Position) -> Position {
        let mut place = *at;
        for (value, tool) in place.iter_mut().zip(&self.tool) {
            *value -= tool;
        }
        for (axis, value) in place.iter_mut().enumerate() {
            *value -= self.work[self.active][axis] + self.work[0][axis];
        }
        turn(&mut place, -self.angle());
        for (value, shift) in place.iter_mut().zip(&self.shift.by) {
            *value -= shift;
        }
        place
    }

    /// Records that the program has set the offset of an axis to a machine position.
    pub fn gives(&mut self, number: usize, axis: usize) {
        if let Some(axes) = self.given.get_mut(number) {
            *axes |= 1 << axis;
        }
    }

    /// As bits, the axes for which the program has set the active work offset.
    pub fn given(&self) -> u8 {
        self.given[self.active]
    }

    /// All work offsets by number: the position, the rotation, and as bits the axes that the program has set.
    pub fn offsets(&self) -> impl Iterator<Item = (Position, f64, u8)> {
        self.work.iter().zip(&self.rotation).zip(&self.given).map(|((work, angle), given)| (*work, *angle, *given))
    }

    /// The distance by which a work offset must move, so that the machine position `place` has these values in the
    /// offset. The distance is 0 for axes without a value.
    pub fn to_stand(&self, number: usize, place: &Position, values: &[Option<f64>; 6]) -> Position {
        if number >= self.work.len() {
            return Position::default();
        }
        let own = Frames { active: number, ..self.clone() };
        let at = own.to_program(place);
        let mut by: Position = std::array::from_fn(|axis| values[axis].map_or(0.0, |value| at[axis] - value));
        turn(&mut by, own.angle());
        by
    }

    /// The position and the rotation of the work offset with this number, if it exists.
    pub fn work(&mut self, number: usize) -> Option<(&mut Position, &mut f64)> {
        Some((self.work.get_mut(number)?, self.rotation.get_mut(number)?))
    }

    /// Converts all lengths to another unit.
    pub fn scale(&mut self, factor: f64) {
        let linear = |place: &mut Position| place[..3].iter_mut().for_each(|v| *v *= factor);
        self.work.iter_mut().for_each(linear);
        linear(&mut self.shift.by);
        linear(&mut self.local);
        linear(&mut self.shift_kept.by);
        self.tool.iter_mut().for_each(|v| *v *= factor);
    }
}

/// Rotates a position about the origin in XY.
fn turn(place: &mut Position, degrees: f64) {
    if degrees == 0.0 {
        return;
    }
    let (sin, cos) = degrees.to_radians().sin_cos();
    let [x, y, ..] = *place;
    place[0] = x * cos - y * sin;
    place[1] = x * sin + y * cos;
}
