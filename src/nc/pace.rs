//! The active feed mode and spindle speeds.

use super::action::{Action, Rotation};
use crate::toolpath::FeedMode;

/// The modes and speeds on which feeds depend.
#[derive(Clone, Debug)]
pub struct Pace {
    mode: FeedMode,
    /// The S value, in revolutions per minute or in the unit of the surface speed.
    speed: f64,
    /// Whether S is a surface speed.
    surface: bool,
    /// Maximum spindle speed of the machine, in revolutions per minute.
    fastest: f64,
    /// Maximum spindle speed that the program sets, in revolutions per minute.
    limit: f64,
}

impl Pace {
    /// The state at the beginning of a program. `fastest` is the maximum spindle speed of the machine, infinite if unknown.
    pub fn new(fastest: f64) -> Pace {
        Pace { mode: FeedMode::PerMinute, speed: 0.0, surface: false, fastest, limit: f64::INFINITY }
    }

    /// Updates the state after an action.
    pub fn takes(&mut self, action: &Action) {
        match action {
            Action::FeedMode(mode) => self.mode = *mode,
            Action::SurfaceSpeed(on) => {
                self.surface = on.is_some();
                if let Some(limit) = on.filter(|limit| *limit > 0.0) {
                    self.limit = limit;
                }
            }
            Action::SpeedLimit(limit) => self.limit = *limit,
            Action::Spindle(_, speed) => self.speed = *speed,
            _ => {}
        }
    }

    /// Whether the feed mode is inverse time: F is moves per minute.
    pub fn is_inverse(&self) -> bool {
        self.mode == FeedMode::InverseTime
    }

    /// The feed along a path of this length, in millimetres per minute, or in degrees per minute if the length is in
    /// degrees. `scale`: millimetres per unit of the feed. `radius`: radius of a lathe cut in millimetres. `lead`: feed
    /// per revolution, if the move follows the spindle.
    pub fn per_minute(&self, feed: f64, lead: Option<f64>, length: f64, scale: f64, radius: f64) -> f64 {
        match (lead, self.mode) {
            (Some(lead), _) => lead * scale * self.turns(scale, radius),
            (None, FeedMode::PerMinute) => feed * scale,
            (None, FeedMode::PerRev) => feed * scale * self.turns(scale, radius),
            (None, FeedMode::InverseTime) => feed * length,
        }
    }

    /// Spindle speed in revolutions per minute. A surface speed is converted from metres or feet per minute.
    fn turns(&self, scale: f64, radius: f64) -> f64 {
        if !self.surface {
            return self.speed;
        }
        let metres = if scale == 1.0 { 1000.0 } else { 12.0 * 25.4 };
        (self.speed * metres / (std::f64::consts::TAU * radius)).min(self.limit).min(self.fastest)
    }

    /// The speed of the spindle after it is switched, in revolutions per minute; 0 if the speed depends on the radius of the cut.
    pub fn switched(&self, rotation: Rotation, speed: f64) -> f64 {
        if rotation == Rotation::Stop || self.surface { 0.0 } else { speed }
    }
}
