//! Feeds and speeds as they are in force.

use super::action::{Action, Rotation};
use crate::toolpath::FeedMode;

/// What feeds and speeds count from.
#[derive(Clone, Debug)]
pub struct Pace {
    mode: FeedMode,
    /// S, in revolutions a minute, or the surface speed's unit.
    speed: f64,
    /// S is a surface speed.
    surface: bool,
    /// Revolutions a minute that the machine has.
    fastest: f64,
    /// Revolutions a minute that the program allows.
    limit: f64,
}

impl Pace {
    /// Nothing is said yet; `fastest`: the speed that the spindle does not exceed, infinite where that is not known.
    pub fn new(fastest: f64) -> Pace {
        Pace { mode: FeedMode::PerMinute, speed: 0.0, surface: false, fastest, limit: f64::INFINITY }
    }

    /// Takes what an action says of it.
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

    /// Is the feed one for each move, a share of it in a minute?
    pub fn is_inverse(&self) -> bool {
        self.mode == FeedMode::InverseTime
    }

    /// The feed along a path of this length in millimetres a minute, or degrees where the length is one. `scale`: millimetres
    /// of a unit of the feed; `radius`: where a lathe cuts, in millimetres; `lead`: it follows the spindle, by so much a turn.
    pub fn per_minute(&self, feed: f64, lead: Option<f64>, length: f64, scale: f64, radius: f64) -> f64 {
        match (lead, self.mode) {
            (Some(lead), _) => lead * scale * self.turns(scale, radius),
            (None, FeedMode::PerMinute) => feed * scale,
            (None, FeedMode::PerRev) => feed * scale * self.turns(scale, radius),
            (None, FeedMode::InverseTime) => feed * length,
        }
    }

    /// Revolutions a minute of the spindle; a surface speed is metres or feet a minute.
    fn turns(&self, scale: f64, radius: f64) -> f64 {
        if !self.surface {
            return self.speed;
        }
        let metres = if scale == 1.0 { 1000.0 } else { 12.0 * 25.4 };
        (self.speed * metres / (std::f64::consts::TAU * radius)).min(self.limit).min(self.fastest)
    }

    /// The speed of a spindle that is switched, in revolutions a minute; 0 where it depends on where the tool cuts.
    pub fn switched(&self, rotation: Rotation, speed: f64) -> f64 {
        if rotation == Rotation::Stop || self.surface { 0.0 } else { speed }
    }
}
