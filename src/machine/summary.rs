//! Describes a machine file as text: its values, and the checks that are not made because of missing values.

use std::fmt::Write as _;

use super::{Axis, LETTERS, Machine, Travel};

/// What is known about a machine, as text for the user.
pub fn summary(machine: &Machine) -> String {
    let mut text = String::new();
    let mut missing: Vec<String> = Vec::new();
    let control = machine.control.map_or("not given", |control| control.name());
    _ = writeln!(text, "{}, {}, control {control}", machine.name, machine.units.name());
    for (axis, described) in machine.axes.iter().enumerate() {
        let letter = LETTERS[axis];
        let Some(described) = described else {
            if axis < 3 {
                missing.push(format!("the travel and the feeds of {letter}"));
            }
            continue;
        };
        let said = axis_text(machine, axis, described);
        if !said.is_empty() {
            _ = writeln!(text, "  {letter}  {said}");
        }
        if described.travel.is_none() {
            missing.push(format!("the travel of {letter}"));
        }
        if described.feed.is_none() {
            missing.push(format!("the feeds of {letter}"));
        }
    }
    for (point, name) in ["G28", "G30"].into_iter().enumerate() {
        match machine.references[point] {
            Some(at) => {
                let at: Vec<String> = (0..3).map(|axis| machine.at(axis, at[axis])).collect();
                _ = writeln!(text, "  {name} at {}", at.join(", "));
            }
            None => missing.push(format!("the position of {name}")),
        }
    }
    match machine.speeds {
        Some([least, most]) => _ = writeln!(text, "  spindle {least} to {most} rev/min"),
        None => missing.push("the speeds of the spindle".into()),
    }
    match machine.places {
        Some(places) => _ = writeln!(text, "  {places} places for tools"),
        None => missing.push("the number of places for tools".into()),
    }
    match &machine.tools {
        Some(table) => {
            let measured = table.0.values().filter(|entry| entry.length.is_some()).count();
            _ = writeln!(text, "  {} tools, {measured} with a length", table.0.len());
        }
        None => missing.push("the tool lengths: unknown; the allowed interval is printed".into()),
    }
    match &machine.offsets {
        Some(offsets) => {
            let control = machine.control.unwrap_or_else(crate::control::Control::usual);
            for (number, at) in offsets {
                let value = |axis: usize| at[axis].map_or("not given".to_owned(), |value| machine.at(axis, value));
                let lathe = [0, 2];
                let axes = if machine.by_diameter { &lathe[..] } else { &[0, 1, 2] };
                let values: Vec<String> =
                    axes.iter().map(|axis| format!("{}{}", LETTERS[*axis], value(*axis))).collect();
                _ = writeln!(text, "  {} at {}", super::offsets::name(control, *number), values.join(" "));
            }
        }
        None => missing.push("the work offsets: unknown; the allowed interval is printed".into()),
    }
    match &machine.coolant {
        Some(kinds) => {
            let kinds: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
            _ = writeln!(text, "  coolant: {}", kinds.join(", "));
        }
        None => missing.push("the kinds of coolant".into()),
    }
    match machine.bytes {
        Some(bytes) => _ = writeln!(text, "  stores {bytes} bytes"),
        None => missing.push("the size of programs".into()),
    }
    if let Err(lacks) = machine.rates() {
        missing.push(format!("times with accelerations: the file does not give {lacks}"));
    }
    if !machine.fixtures.is_empty() {
        _ = writeln!(text, "  fixtures: {}", machine.fixtures.len());
    }
    for what in &missing {
        _ = writeln!(text, "not checked: {what}");
    }
    text
}

fn axis_text(machine: &Machine, axis: usize, described: &Axis) -> String {
    let mut parts = Vec::new();
    match described.travel {
        Some(Travel::Between(least, greatest)) => {
            parts.push(format!("{} to {}", machine.at(axis, least), machine.at(axis, greatest)));
        }
        Some(Travel::Endless) => parts.push("endless".into()),
        None => {}
    }
    let mut say = |what: &str, value: Option<f64>| {
        if let Some(value) = value {
            parts.push(format!("{what} {}", machine.at(axis, value)));
        }
    };
    say("rapid", described.rapid);
    say("feed to", described.feed);
    say("acceleration", described.acceleration);
    parts.join(", ")
}
