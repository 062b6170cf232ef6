//! Counts the contents of a program.

use std::fmt::Write as _;

use postform::internals::nc::{Tally, clock, rapid_rate};
use postform::internals::preflight::Times;

/// The summary as text for a machinist.
pub fn describe(tally: &Tally, blocks: u64) -> String {
    let mut text = String::new();
    let unit = tally.units.name();
    let [rapids, feeds, arcs] = tally.moves;
    _ = writeln!(text, "blocks    {blocks}");
    _ = writeln!(text, "moves     {rapids} rapid, {feeds} straight, {arcs} arcs");
    _ = writeln!(text, "holes     {}", tally.holes);
    _ = writeln!(text, "tools     {}", tally.tools);
    if let Some(extents) = &tally.extents {
        for (axis, (least, greatest)) in ["X", "Y", "Z"].iter().zip(extents) {
            _ = writeln!(text, "{axis} at feed {} to {} {unit}", short(*least), short(*greatest));
        }
    }
    let [rapid, feed] = tally.distances;
    _ = writeln!(text, "distance  {} {unit} at rapid, {} {unit} at feed", short(rapid), short(feed));
    let rate = rapid_rate(tally.units);
    let minutes = [tally.cutting, tally.dwelling, rapid / rate];
    _ = writeln!(
        text,
        "time      {}: cutting {}, dwells {}, rapids {} at {} {unit}/min, without tool changes",
        clock(tally.minutes()),
        clock(minutes[0]),
        clock(minutes[1]),
        clock(minutes[2]),
        short(rate)
    );
    if tally.timeless > 0 {
        _ = writeln!(
            text,
            "          {} feed moves not counted: their feed is per revolution, and the spindle has no speed",
            tally.timeless
        );
    }
    text
}

/// The summary as JSON, with the times on a machine.
pub fn counted(tally: &Tally, blocks: u64, times: Option<&Times>) -> String {
    let [rapids, feeds, arcs] = tally.moves;
    let rapid = tally.distances[0];
    let mut row = serde_json::json!({
        "blocks": blocks, "units": tally.units.name(), "rapids": rapids, "feeds": feeds, "arcs": arcs,
        "holes": tally.holes, "tools": tally.tools,
        "extents": tally.extents.map(|extents| extents.map(|(least, greatest)| [least, greatest])),
        "distance": { "rapid": rapid, "feed": tally.distances[1] },
        "minutes": { "cutting": tally.cutting, "dwells": tally.dwelling, "rapids": rapid / rapid_rate(tally.units) },
    });
    if let Some(times) = times {
        row["seconds"] = times.json();
    }
    format!("{row}\n")
}

fn short(value: f64) -> String {
    format!("{}", (value * 1e4).round() / 1e4 + 0.0)
}
