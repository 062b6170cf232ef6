//! The objects of a job. A table of keys defines each object; the reader and the schema of the object are generated
//! from this table.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{DeserializeSeed, Deserializer, MapAccess, Visitor};

use super::context::{Context, Step};
use super::values::{Few, Kinds, Number, PeckMode, Position, SpeedMode, StepFrom, Word};
use crate::diag::{Code, Diag};
use crate::lang::Machine;
use crate::suggest::did_you_mean;
use crate::toolpath::{CycleKind, EdmAction, MOST_PECKS};
use crate::toolpath::{Direction, FeedMode, Given, Plane, Section, Side, SpindleTurn, StopKind, Units};

/// An object with a fixed list of keys.
pub trait Object: Default {
    /// Name of the object in messages.
    const NAME: &'static str;
    /// Keys of the object.
    const KEYS: &'static [&'static str];
    /// Reads the value of the key with index `key` in `KEYS`.
    fn read<'de, A: MapAccess<'de>>(&mut self, key: usize, map: &mut A, context: &Context) -> Result<(), A::Error>;
}

/// A value inside an object: a number, text or list of numbers, or another object.
pub trait Value: Sized {
    /// Reads the value.
    fn read<'de, A: MapAccess<'de>>(map: &mut A, context: &Context) -> Result<Self, A::Error>;
}

macro_rules! leaves {
    ($($type:ty)*) => { $(impl Value for $type {
        fn read<'de, A: MapAccess<'de>>(map: &mut A, _: &Context) -> Result<Self, A::Error> { map.next_value() }
    })* };
}
leaves! { Number String bool Position Kinds Vec<Number> }

impl Value for Few<Number> {
    fn read<'de, A: MapAccess<'de>>(map: &mut A, context: &Context) -> Result<Self, A::Error> {
        let list: Vec<Number> = Value::read(map, context)?;
        if list.len() > MOST_PECKS { Err(too_many(MOST_PECKS)) } else { Ok(Few(list)) }
    }
}

impl Value for Few<PeckObject> {
    fn read<'de, A: MapAccess<'de>>(map: &mut A, context: &Context) -> Result<Self, A::Error> {
        map.next_value_seed(ListSeed { most: MOST_PECKS, ..ListSeed::new(context) }).map(Few)
    }
}

impl<T: super::values::Words> Value for Word<T> {
    fn read<'de, A: MapAccess<'de>>(map: &mut A, _: &Context) -> Result<Self, A::Error> {
        map.next_value()
    }
}

/// Values that are objects or lists of objects.
macro_rules! nested {
    ($($type:ty)*) => { $(
        impl Value for $type {
            fn read<'de, A: MapAccess<'de>>(map: &mut A, context: &Context) -> Result<Self, A::Error> {
                map.next_value_seed(ObjectSeed::new(context))
            }
        }
        impl Value for Vec<$type> {
            fn read<'de, A: MapAccess<'de>>(map: &mut A, context: &Context) -> Result<Self, A::Error> {
                map.next_value_seed(ListSeed::new(context))
            }
        }
    )* };
}

macro_rules! objects {
    ($($(#[doc = $about:literal])* $name:ident $title:literal { $($key:literal $field:ident $type:ty, $doc:literal;)* })*) => { $(
        $(#[doc = $about])*
        #[derive(Debug, Default)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[cfg_attr(feature = "schema", schemars(deny_unknown_fields))]
        pub struct $name {
            $(#[doc = $doc]
            #[cfg_attr(feature = "schema", schemars(rename = $key))]
            pub $field: Option<$type>,)*
        }

        impl Object for $name {
            const NAME: &'static str = $title;
            const KEYS: &'static [&'static str] = &[$($key),*];
            fn read<'de, A: MapAccess<'de>>(&mut self, key: usize, map: &mut A, context: &Context) -> Result<(), A::Error> {
                let mut index = 0;
                $(if key == index {
                    self.$field = Some(Value::read(map, context)?);
                    return Ok(());
                }
                index += 1;)*
                _ = index;
                Ok(())
            }
        }
    )* };
}

objects! {
    /// The head of a job, without its subprograms and operations, which are read as streams.
    JobHead "a job" {
        "postform" version Number, "version of this format: 1";
        "program" program Number, "program number";
        "name" name String, "the job's name";
        "part" part String, "the part";
        "material" material String, "its material";
        "customer" customer String, "the customer";
        "author" author String, "the author of the job";
        "units" units Word<Units>, "units of all numbers (inch)";
        "machine" machine Word<Machine>, "the type of machine (mill)";
        "set" set Values, "values for variables of the form";
        "tools" tools Vec<ToolObject>, "the tools";
        "tool_order" tool_order Vec<Number>, "tool numbers in the order of their use";
    }
    /// A tool.
    ToolObject "a tool" {
        "number" number Number, "tool number";
        "diameter" diameter Number, "diameter";
        "corner_radius" corner_radius Number, "corner radius";
        "length_offset" length_offset Number, "length offset register";
        "diameter_offset" diameter_offset Number, "diameter offset register";
        "turret" turret Number, "turret";
        "name" name String, "its name";
        "comment" comment String, "what it is";
        "data" data Values, "further data of the tool: numbers or texts with any names";
    }
    /// The spindle data of an operation, or a change of the spindle data.
    SpindleObject "a spindle" {
        "speed" speed Number, "revolutions per minute, or surface speed";
        "direction" direction Word<SpindleTurn>, "its direction";
        "mode" mode Word<SpeedMode>, "the unit of the speed";
        "max" max Number, "speed limit at constant surface speed";
    }
    /// The data of an operation without its path.
    OperationHead "an operation" {
        "name" name String, "the operation's name";
        "tool" tool Number, "the operation's tool; if left out, the tool of the operation before";
        "work" work Number, "work offset: a fixture number below 50, or a code";
        "spindle" spindle SpindleObject, "its spindle";
        "coolant" coolant Kinds, "the operation's coolant: a kind, or a list of the kinds that are on together";
        "feed" feed Number, "feed of moves without their own feed";
        "plunge" plunge Number, "feed of plunges";
        "feed_mode" feed_mode Word<FeedMode>, "the unit of feeds (per_minute)";
        "comment" comment String, "a comment to print";
        "set" set Values, "values for variables of the form, from the operation's tool change on";
    }
    /// One item of a path: exactly one main key, and the keys that belong to this main key.
    ItemObject "a path item" {
        "rapid" rapid Position, "rapid to a position";
        "line" line Position, "feed to a position";
        "arc" arc ArcObject, "an arc";
        "infeed" infeed Position, "feed to a position, turning cutter compensation on";
        "outfeed" outfeed Position, "feed to a position, turning cutter compensation off";
        "side" side Word<Side>, "side of an infeed";
        "begin" begin Word<Section>, "a named part of the path begins";
        "end" end EndWord, "the named part ends; in JSON Lines `true` ends the job";
        "call" call CallObject, "call of a subprogram";
        "thread" thread ThreadObject, "a thread on a lathe";
        "edm" edm Word<EdmAction>, "an action of a wire EDM machine between moves";
        "home" home bool, "`true`: the tool goes to the machine's home position";
        "dwell" dwell Number, "dwell in seconds";
        "stop" stop Word<StopKind>, "a stop";
        "comment" comment String, "a comment to print";
        "text" text String, "a block that is printed unchanged";
        "feed" feed Number, "feed of this move and of the moves after it";
        "work" work Number, "change of the work offset";
        "spindle" spindle SpindleObject, "change of the spindle";
        "coolant" coolant Kinds, "change of the coolant";
        "set" set Values, "values for variables of the form";
    }
    /// The data of a subprogram without its path.
    SubprogramHead "a subprogram" {
        "number" number Number, "its number";
    }
    /// A thread on a lathe; x is a radius.
    ThreadObject "a thread" {
        "from" from Position, "the start of the thread: z, and the radius of the crest";
        "to" to Position, "its end";
        "pitch" pitch Number, "distance from crest to crest";
        "depth" depth Number, "height on the radius; negative for an inner thread";
        "first_depth" first_depth Number, "the first cut, on the radius";
        "min_depth" min_depth Number, "the least cut";
        "taper" taper Number, "radius at the start less radius at the end";
        "angle" angle Number, "angle of the thread in degrees (60)";
        "passes" passes Number, "number of passes, instead of first_depth";
        "chamfer" chamfer Number, "length of the runout, in the unit of the control";
        "starts" starts Number, "number of starts (1)";
    }
    /// A call of a subprogram.
    CallObject "a call" {
        "sub" sub Number, "the subprogram's number";
        "times" times Number, "number of runs (1)";
        "at" at Position, "position of the call";
        "work" work Number, "work offset of the call";
    }
    /// An arc from the tool's position.
    ArcObject "an arc" {
        "to" to Position, "its end";
        "center" center Position, "its centre";
        "radius" radius Number, "the radius of the arc, instead of the centre; negative for the longer arc";
        "direction" direction Word<Direction>, "the direction of the arc, seen from the positive third axis of the plane";
        "plane" plane Word<Plane>, "its plane (xy)";
        "turns" turns Number, "additional full turns before the end (0)";
    }
    /// A canned cycle without its points; heights are distances along the tool axis from each point.
    CycleObject "a cycle" {
        "kind" kind Word<CycleKind>, "which cycle";
        "depth" depth Number, "depth below the point, positive down";
        "clear" clear Number, "clearance above the point: the height where the feed begins";
        "return" return_height Number, "return plane above the first point";
        "feed" feed Number, "feed into the hole";
        "plunge" plunge Number, "plunge feed (default: the feed)";
        "step" step Number, "peck, measured from the clearance plane";
        "first_step" first_step Number, "first peck";
        "back" back Number, "secondary clearance: distance above the last depth, at which the feed begins again";
        "dwell" dwell Number, "dwell at the bottom in seconds";
        "revs" revs Number, "dwell at the bottom in revolutions";
        "rapto" rapto Number, "extra rapid below the clearance plane";
        "orient" orient Number, "spindle angle of a boring cycle";
        "offset" offset Number, "jog off the wall of a boring cycle";
        "ratio" ratio Number, "retract feed as a factor of the feed";
        "starts" starts Number, "starts of a tapped thread";
        "rigid" rigid bool, "a rigid tap";
        "times" times Number, "chip breaks between full retracts";
        "decr" decr Number, "decrease of each peck from the peck before";
        "min_step" min_step Number, "least peck";
        "diameter" diameter Number, "diameter of a countersink";
        "angle" angle Number, "angle of a countersink";
        "hole_diameter" hole_diameter Number, "hole under a countersink";
        "webs" webs Few<Number>, "depths of a cycle through webs: end, start, end, ..";
        "mode" mode Word<PeckMode>, "how a tap pecks";
        "offset_y" offset_y Number, "jog off the wall along y; `offset` is then along x";
        "step_from" step_from Word<StepFrom>, "the plane from which steps are measured (clear)";
        "emulate" emulate bool, "print single moves, even if the form has the cycle";
        "pecks" pecks Few<PeckObject>, "absolute steps";
        "norevr" norevr bool, "a tap that does not reverse";
        "rapout" rapout bool, "a tap that retracts with a rapid";
        "jog" jog Number, "lift of the tool after the jog of a boring cycle";
    }
    /// An absolute step.
    PeckObject "a peck" {
        "to" to Number, "depth below the point";
        "feed" feed Number, "its feed";
    }
}

nested! { ToolObject SpindleObject ArcObject CallObject ThreadObject PeckObject }

impl Value for super::values::Point {
    fn read<'de, A: MapAccess<'de>>(map: &mut A, context: &Context) -> Result<Self, A::Error> {
        map.next_value_seed(super::position::PointSeed { context })
    }
}

/// The value of `end`: the name of a section, such as `"leadin"`, or `true` at the end of a JSON Lines job.
#[derive(Clone, Copy, Debug)]
pub enum EndWord {
    /// A section of the path ends.
    Section(Section),
    /// The job ends.
    Job,
}

impl Value for EndWord {
    fn read<'de, A: MapAccess<'de>>(map: &mut A, _: &Context) -> Result<Self, A::Error> {
        struct EndVisitor;
        impl Visitor<'_> for EndVisitor {
            type Value = EndWord;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the name of a part of the path, or true at the end of JSON Lines")
            }
            fn visit_bool<E: serde::de::Error>(self, value: bool) -> Result<EndWord, E> {
                if value { Ok(EndWord::Job) } else { Err(E::invalid_value(serde::de::Unexpected::Bool(false), &self)) }
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<EndWord, E> {
                let words = <Section as super::values::Words>::WORDS;
                match words.iter().find(|(word, _)| *word == text) {
                    Some((_, section)) => Ok(EndWord::Section(*section)),
                    None => Err(E::invalid_value(serde::de::Unexpected::Str(text), &self)),
                }
            }
        }
        struct EndSeed;
        impl<'de> DeserializeSeed<'de> for EndSeed {
            type Value = EndWord;
            fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<EndWord, D::Error> {
                deserializer.deserialize_any(EndVisitor)
            }
        }
        map.next_value_seed(EndSeed)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for EndWord {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "End".into()
    }
    fn inline_schema() -> bool {
        true
    }
    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let section = generator.subschema_for::<Word<Section>>();
        schemars::json_schema!({ "anyOf": [section, { "const": true }] })
    }
}

/// Values of variables and properties, each with its name, in the order of the job: `{"val1": 2.5, "through": "high"}`.
#[derive(Debug, Default, PartialEq)]
pub struct Values(pub Vec<(String, Given)>);

impl Value for Values {
    fn read<'de, A: MapAccess<'de>>(map: &mut A, _: &Context) -> Result<Self, A::Error> {
        struct ValuesVisitor;
        impl<'de> Visitor<'de> for ValuesVisitor {
            type Value = Values;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("values by the names of variables and properties")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Values, A::Error> {
                let mut values = Vec::new();
                while let Some((name, value)) = map.next_entry::<String, Given>()? {
                    values.push((name, value));
                }
                Ok(Values(values))
            }
        }
        struct ValuesSeed;
        impl<'de> DeserializeSeed<'de> for ValuesSeed {
            type Value = Values;
            fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Values, D::Error> {
                deserializer.deserialize_map(ValuesVisitor)
            }
        }
        map.next_value_seed(ValuesSeed)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Values {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Values".into()
    }
    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": "object", "additionalProperties": { "type": ["number", "string", "boolean"] } })
    }
}

/// Reads a key and returns its index in the list of known keys. For an unknown key, returns an error with a suggestion.
pub struct KeySeed<'c> {
    /// The shared context.
    pub context: &'c Context,
    /// Name of the object in messages.
    pub object: &'static str,
    /// The known keys of the object, in two parts.
    pub keys: [&'static [&'static str]; 2],
}

impl<'de> DeserializeSeed<'de> for KeySeed<'_> {
    type Value = usize;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for KeySeed<'_> {
    type Value = usize;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a key")
    }
    fn visit_str<E: serde::de::Error>(self, key: &str) -> Result<usize, E> {
        let all = || self.keys.iter().copied().flatten();
        if let Some(at) = all().position(|known| *known == key) {
            return Ok(at);
        }
        let mut diag = Diag::new(Code::PJ002, format!("{} has no key `{}`", self.object, key));
        diag.help = did_you_mean(key, all().copied())
            .or_else(|| Some(format!("its keys are {}", all().copied().collect::<Vec<_>>().join(", "))));
        Err(self.context.fail(diag))
    }
}

/// Records that a key occurred. Returns an error if the key occurs a second time.
pub fn once<E: serde::de::Error>(seen: &mut u64, key: usize, name: &str, context: &Context) -> Result<(), E> {
    if *seen & 1 << key != 0 {
        return Err(context.fail(Diag::new(Code::PJ010, format!("the key `{name}` is given twice")).help("keep one")));
    }
    *seen |= 1 << key;
    Ok(())
}

/// Reads an object by its table of keys.
pub struct ObjectSeed<'c, T> {
    context: &'c Context,
    object: PhantomData<T>,
}

impl<'c, T> ObjectSeed<'c, T> {
    /// A reader that uses this context.
    pub fn new(context: &'c Context) -> Self {
        ObjectSeed { context, object: PhantomData }
    }
}

impl<'de, T: Object> DeserializeSeed<'de> for ObjectSeed<'_, T> {
    type Value = T;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<T, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de, T: Object> Visitor<'de> for ObjectSeed<'_, T> {
    type Value = T;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}, an object", T::NAME)
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<T, A::Error> {
        let (mut object, mut seen) = (T::default(), 0);
        let keys = || KeySeed { context: self.context, object: T::NAME, keys: [T::KEYS, &[]] };
        while let Some(key) = map.next_key_seed(keys())? {
            once(&mut seen, key, T::KEYS[key], self.context)?;
            self.context.enter(Step::Key(T::KEYS[key]));
            object.read(key, &mut map, self.context)?;
            self.context.leave();
        }
        Ok(object)
    }
}

/// Reads a list of objects.
struct ListSeed<'c, T> {
    context: &'c Context,
    /// The largest number of objects in the list.
    most: usize,
    object: PhantomData<T>,
}

impl<'c, T> ListSeed<'c, T> {
    fn new(context: &'c Context) -> Self {
        ListSeed { context, most: usize::MAX, object: PhantomData }
    }
}

/// The error for a list that is too long.
fn too_many<E: serde::de::Error>(most: usize) -> E {
    E::custom(format!("a list of more than {most} values: is a decimal point missing?"))
}

impl<'de, T: Object> DeserializeSeed<'de> for ListSeed<'_, T> {
    type Value = Vec<T>;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<T>, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de, T: Object> Visitor<'de> for ListSeed<'_, T> {
    type Value = Vec<T>;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a list, each {}", T::NAME)
    }
    fn visit_seq<A: serde::de::SeqAccess<'de>>(self, mut seq: A) -> Result<Vec<T>, A::Error> {
        let mut list = Vec::new();
        loop {
            self.context.enter(Step::Index(list.len() as u64));
            match seq.next_element_seed(ObjectSeed::new(self.context))? {
                Some(_) if list.len() == self.most => return Err(too_many(self.most)),
                Some(object) => list.push(object),
                None => break,
            }
            self.context.leave();
        }
        self.context.leave();
        Ok(list)
    }
}
