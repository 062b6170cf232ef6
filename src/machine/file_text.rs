//! The structure of a machine file for serde.

use std::collections::BTreeMap;

use serde::de::Error;
use serde::{Deserialize, Deserializer};
use toml::{Spanned, Value};

use super::axis::Kind;
use crate::toolpath::Coolant;

type Range = Spanned<[f64; 2]>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub(super) name: Option<String>,
    pub(super) control: Option<Spanned<String>>,
    pub(super) units: Option<UnitsText>,
    #[serde(default)]
    pub(super) axes: BTreeMap<Spanned<String>, AxisText>,
    pub(super) rotary: Option<RotaryText>,
    #[serde(default)]
    pub(super) corners: CornersText,
    #[serde(default)]
    pub(super) reference: ReferenceText,
    #[serde(default)]
    pub(super) spindle: SpindleText,
    pub(super) tools: Option<BTreeMap<Spanned<String>, Spanned<Value>>>,
    pub(super) offsets: Option<BTreeMap<Spanned<String>, Spanned<Vec<f64>>>>,
    #[serde(default)]
    pub(super) coolant: CoolantText,
    #[serde(default)]
    pub(super) memory: MemoryText,
    #[serde(default)]
    pub(super) fixtures: Vec<FixtureText>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum UnitsText {
    Inch,
    Mm,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisText {
    pub(super) travel: Option<Spanned<Value>>,
    pub(super) rapid: Option<Spanned<f64>>,
    pub(super) feed: Option<Spanned<f64>>,
    pub(super) acceleration: Option<Spanned<f64>>,
    pub(super) turns: Option<Spanned<Kind>>,
    pub(super) about: Option<Spanned<[f64; 3]>>,
    pub(super) counts: Option<Counts>,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Counts {
    Tool,
    Table,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RotaryText {
    #[serde(default)]
    pub(super) order: Vec<Spanned<String>>,
    pub(super) centre: Option<Spanned<[f64; 3]>>,
    #[serde(default)]
    pub(super) tip_control: bool,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CornersText {
    pub(super) deviation: Option<Spanned<f64>>,
    pub(super) ahead: Option<Spanned<u32>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ReferenceText {
    #[serde(rename = "G28")]
    pub(super) first: Option<Spanned<Vec<f64>>>,
    #[serde(rename = "G30")]
    pub(super) second: Option<Spanned<Vec<f64>>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SpindleText {
    pub(super) speed: Option<Range>,
    pub(super) acceleration: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ToolText {
    pub(super) length: Option<f64>,
    pub(super) diameter: Option<f64>,
    pub(super) name: Option<String>,
}

/// Reads the names of kinds of coolant.
fn kinds<'de, D: Deserializer<'de>>(text: D) -> Result<Option<Vec<Coolant>>, D::Error> {
    const KINDS: &[&str] = &["flood", "mist", "through", "air", "high"];
    let names = Vec::<String>::deserialize(text)?;
    let kind = |name: &String| match Coolant::parse(name).filter(|_| KINDS.contains(&name.as_str())) {
        Some(kind) => Ok(kind),
        None => Err(Error::unknown_variant(name, KINDS)),
    };
    names.iter().map(kind).collect::<Result<_, _>>().map(Some)
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CoolantText {
    #[serde(default, deserialize_with = "kinds")]
    pub(super) kinds: Option<Vec<Coolant>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MemoryText {
    pub(super) bytes: Option<u64>,
    pub(super) numbers: Option<Spanned<[u32; 2]>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FixtureText {
    pub(super) name: Option<String>,
    pub(super) work: Spanned<String>,
    #[serde(rename = "box")]
    pub(super) corners: Spanned<[[f64; 3]; 2]>,
}
