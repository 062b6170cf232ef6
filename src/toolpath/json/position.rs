//! Reads the points of a cycle.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};

use super::context::Context;
use super::objects::{KeySeed, once};
use super::values::{Number, Point, Position, position};
use crate::diag::{Code, Diag};
use crate::toolpath::Hole;

/// Reads a point: a position, or an object with a position and its own depth.
pub struct PointSeed<'c> {
    /// The shared context.
    pub context: &'c Context,
}

impl<'de> DeserializeSeed<'de> for PointSeed<'_> {
    type Value = Point;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Point, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for PointSeed<'_> {
    type Value = Point;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a point: a position, or {\"at\": position, \"depth\": number}")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Point, A::Error> {
        self.context.point_at.set(self.context.at.get());
        Ok(Point(Hole { at: position(seq)?.0, depth: None }))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Point, A::Error> {
        const KEYS: &[&str] = &["at", "depth"];
        self.context.point_at.set(self.context.at.get());
        let (mut at, mut depth, mut seen) = (None, None, 0);
        let keys = || KeySeed { context: self.context, object: "a point", keys: [KEYS, &[]] };
        while let Some(key) = map.next_key_seed(keys())? {
            once(&mut seen, key, KEYS[key], self.context)?;
            match key {
                0 => at = Some(map.next_value::<Position>()?.0),
                _ => depth = Some(map.next_value::<Number>()?.0),
            }
        }
        let Some(at) = at else {
            return Err(self.context.fail(Diag::new(Code::PJ004, "a point needs `at`")));
        };
        Ok(Point(Hole { at, depth }))
    }
}

/// Reads a list of points.
pub struct PointsSeed<'c> {
    /// The shared context.
    pub context: &'c Context,
}

impl<'de> DeserializeSeed<'de> for PointsSeed<'_> {
    type Value = Vec<Point>;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<Point>, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for PointsSeed<'_> {
    type Value = Vec<Point>;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a list of points")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Vec<Point>, A::Error> {
        let mut points = Vec::new();
        while let Some(point) = seq.next_element_seed(PointSeed { context: self.context })? {
            points.push(point);
        }
        Ok(points)
    }
}
