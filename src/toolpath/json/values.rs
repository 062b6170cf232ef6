//! The simple values of a job: numbers, words of a list, positions.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};

use crate::lang::Machine;
use crate::toolpath::{Axes, Coolant, Direction, FeedMode, Given, Plane, Section, Side, SpindleTurn, StopKind};
use crate::toolpath::{CycleKind, EdmAction, Hole, Units};

/// A finite number, because JSON can't write infinity or NaN.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(inline))]
pub struct Number(pub f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberVisitor;
        impl Visitor<'_> for NumberVisitor {
            type Value = Number;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number")
            }
            fn visit_f64<E>(self, value: f64) -> Result<Number, E> {
                Ok(Number(value))
            }
            fn visit_u64<E>(self, value: u64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
        }
        deserializer.deserialize_f64(NumberVisitor)
    }
}

/// Reads a number, a text, or `true` and `false`, which become `yes` and `no`.
impl<'de> Deserialize<'de> for Given {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct GivenVisitor;
        impl Visitor<'_> for GivenVisitor {
            type Value = Given;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number, a text or true or false")
            }
            fn visit_f64<E>(self, value: f64) -> Result<Given, E> {
                Ok(Given::Number(value))
            }
            fn visit_u64<E>(self, value: u64) -> Result<Given, E> {
                Ok(Given::Number(value as f64))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Given, E> {
                Ok(Given::Number(value as f64))
            }
            fn visit_bool<E>(self, value: bool) -> Result<Given, E> {
                Ok(Given::Text(if value { "yes" } else { "no" }.into()))
            }
            fn visit_str<E>(self, value: &str) -> Result<Given, E> {
                Ok(Given::Text(value.into()))
            }
        }
        deserializer.deserialize_any(GivenVisitor)
    }
}

/// A value that is written as one word of a fixed list.
pub trait Words: Copy + 'static {
    /// The words of the list, each with its value.
    const WORDS: &'static [(&'static str, Self)];
}

/// A value of type `T`, read from its word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Word<T>(pub T);

impl<'de, T: Words> Deserialize<'de> for Word<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WordVisitor<T>(PhantomData<T>);
        impl<T: Words> Visitor<'_> for WordVisitor<T> {
            type Value = Word<T>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                let words: Vec<_> = T::WORDS.iter().map(|(word, _)| format!("\"{word}\"")).collect();
                write!(f, "{}", words.join(" or "))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Word<T>, E> {
                match T::WORDS.iter().find(|(word, _)| *word == text) {
                    Some((_, value)) => Ok(Word(*value)),
                    None => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
                }
            }
        }
        deserializer.deserialize_str(WordVisitor(PhantomData))
    }
}

#[cfg(feature = "schema")]
impl<T: Words> schemars::JsonSchema for Word<T> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        T::WORDS.iter().map(|(word, _)| *word).collect::<Vec<_>>().join("_").into()
    }
    fn inline_schema() -> bool {
        true
    }
    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let words: Vec<_> = T::WORDS.iter().map(|(word, _)| *word).collect();
        schemars::json_schema!({ "enum": words })
    }
}

macro_rules! words {
    ($($type:ty: $($word:literal $value:expr),*;)*) => {
        $(impl Words for $type { const WORDS: &'static [(&'static str, Self)] = &[$(($word, $value)),*]; })*
    };
}

words! {
    Units: "inch" Units::Inch, "mm" Units::Mm;
    Machine: "mill" Machine::Mill, "lathe" Machine::Lathe, "edm" Machine::Edm;
    SpindleTurn: "cw" SpindleTurn::Cw, "ccw" SpindleTurn::Ccw, "off" SpindleTurn::Off;
    FeedMode: "per_minute" FeedMode::PerMinute, "per_rev" FeedMode::PerRev, "inverse_time" FeedMode::InverseTime;
    Direction: "cw" Direction::Cw, "ccw" Direction::Ccw;
    Plane: "xy" Plane::Xy, "xz" Plane::Xz, "yz" Plane::Yz;
    Side: "left" Side::Left, "right" Side::Right;
    StopKind: "program" StopKind::Program, "optional" StopKind::Optional;
    Section: "leadin" Section::Leadin, "leadout" Section::Leadout, "plunge" Section::Plunge,
        "retract" Section::Retract, "sidestep" Section::SideStep, "zlevel" Section::ZLevel, "row" Section::Row;
    EdmAction: "thread" EdmAction::Thread, "cut" EdmAction::Cut, "predrill" EdmAction::PreDrill, "submerge" EdmAction::Submerge;
    SpeedMode: "rpm" SpeedMode::Rpm, "css" SpeedMode::Css;
    PeckMode: "deep" PeckMode::Deep, "chipbreak" PeckMode::Chipbreak;
    StepFrom: "clear" StepFrom::Clear, "point" StepFrom::Point;
}

impl Words for CycleKind {
    const WORDS: &'static [(&'static str, Self)] = &CycleKind::NAMES;
}

impl Words for Coolant {
    const WORDS: &'static [(&'static str, Self)] = &Coolant::NAMES;
}

/// Coolant, written as one kind or as a list of kinds that are on at the same time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinds(pub Coolant);

impl<'de> Deserialize<'de> for Kinds {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct KindsVisitor;
        impl<'de> Visitor<'de> for KindsVisitor {
            type Value = Kinds;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                let kinds: Vec<_> = Coolant::NAMES.iter().map(|(name, _)| format!("\"{name}\"")).collect();
                write!(f, "{}, or a list of them", kinds.join(" or "))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Kinds, E> {
                Word::deserialize(de::value::StrDeserializer::new(text)).map(|Word(kind)| Kinds(kind))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Kinds, A::Error> {
                let mut all: Option<Coolant> = None;
                while let Some(Word(kind)) = seq.next_element::<Word<Coolant>>()? {
                    if kind == Coolant::OFF || all == Some(Coolant::OFF) {
                        return Err(de::Error::custom(
                            "a list of coolants contains only coolants that are on: write \"off\" without a list",
                        ));
                    }
                    if all.is_some_and(|all| all.holds(kind)) {
                        return Err(de::Error::custom(format!("{} is in the list twice", kind.name())));
                    }
                    all = Some(all.unwrap_or(Coolant::OFF).and(kind));
                }
                all.map(Kinds).ok_or_else(|| de::Error::custom("an empty list of coolants: write \"off\""))
            }
        }
        deserializer.deserialize_any(KindsVisitor)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Kinds {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Coolant".into()
    }
    fn inline_schema() -> bool {
        true
    }
    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let one = generator.subschema_for::<Word<Coolant>>();
        let on: Vec<_> =
            Coolant::NAMES.iter().filter(|(_, kind)| *kind != Coolant::OFF).map(|(name, _)| *name).collect();
        schemars::json_schema!({ "anyOf": [one, { "type": "array", "minItems": 1, "uniqueItems": true, "items": { "enum": on } }] })
    }
}

/// The unit of a spindle speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum SpeedMode {
    Rpm,
    Css,
}

/// How a tap pecks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum PeckMode {
    Deep,
    Chipbreak,
}

/// The height from which the steps of a peck cycle are measured.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum StepFrom {
    Clear,
    Point,
}

/// A list that postform keeps in memory for a hole. The list has at most `MOST_PECKS` entries.
#[derive(Clone, Debug, PartialEq)]
pub struct Few<T>(pub Vec<T>);

#[cfg(feature = "schema")]
impl<T: schemars::JsonSchema> schemars::JsonSchema for Few<T> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("Few_{}", T::schema_name()).into()
    }
    fn inline_schema() -> bool {
        true
    }
    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let one = generator.subschema_for::<T>();
        schemars::json_schema!({ "type": "array", "maxItems": crate::toolpath::MOST_PECKS, "items": one })
    }
}

/// A position of up to six numbers. If a number is `null`, the axis keeps its position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Position(pub Axes);

/// Reads a position from a sequence that is already open.
pub fn position<'de, A: SeqAccess<'de>>(mut seq: A) -> Result<Position, A::Error> {
    let mut axes = Axes::default();
    let mut axis = 0;
    while let Some(value) = seq.next_element::<Option<Number>>()? {
        if axis == 6 {
            return Err(de::Error::invalid_length(7, &"at most six coordinates"));
        }
        if let Some(Number(value)) = value {
            axes.set(axis, value);
        }
        axis += 1;
    }
    Ok(Position(axes))
}

impl<'de> Deserialize<'de> for Position {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PositionVisitor;
        impl<'de> Visitor<'de> for PositionVisitor {
            type Value = Position;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a position, as [1, 2.5, null]")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Position, A::Error> {
                position(seq)
            }
        }
        deserializer.deserialize_seq(PositionVisitor)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Position {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Position".into()
    }
    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "h v d in the frame of the part, then rotary a b c in degrees; null or a missing value \
                keeps the last position of the tool",
            "type": "array", "maxItems": 6, "items": { "type": ["number", "null"] }
        })
    }
}

/// A point of a cycle: a position, or `{"at": position, "depth": number}`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Point(pub Hole);

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Point {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Point".into()
    }
    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let position = generator.subschema_for::<Position>();
        schemars::json_schema!({
            "description": "a point of a cycle, with its own depth if it differs",
            "anyOf": [position.clone(), {
                "type": "object", "additionalProperties": false, "required": ["at"],
                "properties": { "at": position, "depth": { "type": "number" } }
            }]
        })
    }
}
