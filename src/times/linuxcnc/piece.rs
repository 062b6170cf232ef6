//! A move and the limits of its speed.

use crate::times::curve::Curve;
use crate::times::leg::Leg;
use crate::times::rates::{Rates, Way, size};

/// The period of the servo thread, in seconds. No move is shorter than this.
pub(super) const PERIOD: f64 = 0.001;
/// Shares of the acceleration on an arc. `TANGENTIAL` is the share along the path while the whole share across the path is in
/// use; `NORMAL` is the share across the path.
pub(super) const TANGENTIAL: f64 = 0.5;
pub(super) const NORMAL: f64 = 0.866_025_403_784_438_6;

/// The end of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    Stop,
    Tangent,
    /// The move ends after the next move has begun.
    Overlap,
}

/// A direction, or a vector, of X Y Z.
pub(super) type Vector = [f64; 3];

/// A move. Speeds are in millimetres per second.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Directions at the beginning and at the end of the move.
    pub directions: [Vector; 2],
    /// The remaining length of the move.
    pub length: f64,
    /// The length of the move before blends shortened it.
    pub nominal: f64,
    /// The greatest possible speed of the move.
    pub most: f64,
    /// The programmed speed of the move.
    pub wanted: f64,
    pub acceleration: f64,
    pub round: Option<Round>,
    pub is_cut: bool,
    /// The index of this move in the list of block times.
    pub row: usize,
    pub end: End,
    /// Whether no move follows. Without a next move, the acceleration for the end of the move does not reduce the speed
    /// on an arc.
    pub is_last: bool,
    /// Whether the move begins in an overlap with the move before it.
    pub begins_in_overlap: bool,
    /// The shares of the acceleration that the kinks at the two ends of the move use.
    pub kinks: [f64; 2],
}

/// The data of an arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    pub radius: f64,
    /// The effective radius, which takes the rise of the helix into account.
    pub bend: f64,
    pub sweep: f64,
    /// The direction perpendicular to the plane of the arc.
    pub axis: Vector,
    /// Directions from the beginning and from the end of the arc to its centre.
    pub inwards: [Vector; 2],
}

impl Piece {
    /// Creates the piece for a line. Returns `None` if the line has no length, or if its speed is unknown.
    pub fn line(way: &Way, feed: Option<f64>, rates: &Rates) -> Option<Piece> {
        let length = rates.length(way);
        if length == 0.0 {
            return None;
        }
        let along = way.map(|part| part / length);
        let most = rates.speed(&along, None);
        let wanted = rates.speed(&along, feed);
        if !(wanted > 0.0 && wanted.is_finite()) {
            return None;
        }
        let linear = size(&way[..3]);
        let direction = if linear > 0.0 { [0, 1, 2].map(|axis| way[axis] / linear) } else { [0.0; 3] };
        let acceleration = rates.along(&along, |axis| axis.acceleration);
        Some(Piece::new([direction; 2], length, [most, wanted], acceleration, feed.is_some()))
    }

    /// Creates the piece for an arc. Returns `None` if the arc has no length, or if its speed is unknown.
    pub fn arc(curve: &Curve, feed: f64, rates: &Rates) -> Option<Piece> {
        let [a, b] = curve.plane;
        let (radius, length) = (curve.radius(), curve.length());
        let sense = curve.sweep.signum();
        let rise: Vector = [0, 1, 2].map(|axis| curve.rise[axis]);
        let at = |angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            [curve.from[0] * cosine - curve.from[1] * sine, curve.from[0] * sine + curve.from[1] * cosine]
        };
        let flat = radius * curve.sweep.abs();
        if flat == 0.0 {
            return None;
        }
        let direction = |[x, y]: [f64; 2]| {
            let mut way = rise.map(|rise| rise / flat);
            (way[a], way[b]) = (-y * sense / radius, x * sense / radius);
            let size = size(&way);
            way.map(|part| part / size)
        };
        let inwards = |[x, y]: [f64; 2]| {
            let mut way = [0.0; 3];
            (way[a], way[b]) = (-x, -y);
            way
        };
        let (begin, end) = (at(0.0), at(curve.sweep));
        let smaller = |of: fn(&crate::times::rates::AxisRates) -> Option<f64>| {
            [a, b].iter().filter_map(|&axis| of(&rates.axes[axis])).fold(f64::INFINITY, f64::min)
        };
        let (fast, strong) = (smaller(|axis| axis.rapid), smaller(|axis| axis.acceleration));
        let across = (strong * NORMAL * radius).sqrt().min(fast);
        // the straight path from the beginning to the end of the arc sets a further limit
        let mut way = Way::default();
        (0..3).for_each(|axis| way[axis] = rise[axis]);
        (way[a], way[b]) = (end[0] - begin[0], end[1] - begin[1]);
        let straight = |of: fn(&crate::times::rates::AxisRates) -> Option<f64>| {
            way.iter().zip(&rates.axes).filter_map(|(part, axis)| Some(part.abs() / of(axis)?)).fold(0.0, f64::max)
        };
        let most = length / straight(|axis| axis.rapid).max(flat / across);
        let acceleration = length / straight(|axis| axis.acceleration).max(flat / strong);
        let wanted = feed.min(most);
        if !(wanted > 0.0 && wanted.is_finite() && acceleration.is_finite()) {
            return None;
        }
        let mut axis = [0.0; 3];
        axis[3 - a - b] = 1.0;
        let up = size(&rise);
        let round = Round {
            radius,
            bend: radius + up * up / radius,
            sweep: curve.sweep.abs(),
            axis,
            inwards: [inwards(begin), inwards(end)],
        };
        let directions = [direction(begin), direction(end)];
        let mut piece = Piece::new(directions, length, [most, wanted], acceleration, true);
        piece.round = Some(round);
        Some(piece)
    }

    fn new(directions: [Vector; 2], length: f64, [most, wanted]: [f64; 2], acceleration: f64, is_cut: bool) -> Piece {
        Piece {
            directions,
            length,
            nominal: length,
            most: most.min(length / PERIOD),
            wanted,
            acceleration,
            round: None,
            is_cut,
            row: 0,
            end: End::Overlap,
            is_last: false,
            begins_in_overlap: false,
            kinks: [0.0; 2],
        }
    }

    /// The speed of the move without the adjacent moves.
    pub fn speed(&self) -> f64 {
        self.wanted.min(self.fastest())
    }

    /// The greatest speed of the move. On an arc this speed depends on the share of the acceleration across the path.
    fn fastest(&self) -> f64 {
        let most = self.most.min(self.length / PERIOD);
        match self.round {
            Some(round) if !self.is_last => most.min((NORMAL * self.share() * round.bend).sqrt()),
            _ => most,
        }
    }

    /// The acceleration without the share for the kinks at the ends of the move.
    fn share(&self) -> f64 {
        let overlaps = self.begins_in_overlap || self.end == End::Overlap;
        self.acceleration * (1.0 - self.kinks[0].max(self.kinks[1])) * if overlaps { 0.5 } else { 1.0 }
    }

    /// The acceleration along the move.
    pub fn along(&self) -> f64 {
        let share = self.share();
        let Some(round) = self.round else { return share };
        let across = self.fastest().powi(2) / round.bend;
        if self.is_last || across >= NORMAL * share * (1.0 - 1e-12) {
            share * TANGENTIAL
        } else {
            share * (1.0 - (across / share).powi(2)).sqrt()
        }
    }

    /// Converts the move to a leg. `most_entry` is the square of the greatest speed at the beginning of the move.
    pub fn leg(&self, most_entry: f64) -> Leg {
        let speed = self.speed();
        Leg {
            length: self.length,
            speed: speed * speed,
            acceleration: self.along(),
            most_entry: most_entry.min(speed * speed),
            entry: 0.0,
            is_cut: self.is_cut,
            row: self.row,
        }
    }
}
