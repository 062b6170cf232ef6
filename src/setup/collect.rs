//! Collects the data of the setup sheet from a job.

use super::{OperationRow, SetupSheet, StopRow, ToolRow, Work};
use crate::survey::{Reach, Survey, Totals};
use crate::toolpath::{Event, FeedMode, Flow, Given, Place, Sink, Start, StopKind, Tool, Units};

/// Collects the head of a job and its program stops.
#[derive(Debug, Default)]
pub struct Stops {
    /// The head of the job.
    pub start: Option<Start>,
    stops: Vec<StopRow>,
    tool: Option<f64>,
    comment: Option<String>,
}

impl Sink for Stops {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        match event {
            Event::Start(start) => self.start = Some(start.clone()),
            Event::ToolChange(change) => {
                self.tool = change.tool.as_ref().map(|tool| tool.number);
                self.comment.clone_from(&change.comment);
            }
            Event::Comment(text) => self.comment = Some(text.to_owned()),
            Event::Stop(kind) => self.stops.push(StopRow {
                optional: kind == StopKind::Optional,
                tool: self.tool,
                comment: self.comment.take(),
            }),
            Event::Rapid(_) | Event::Line { .. } | Event::Arc { .. } | Event::Hole(_) => self.comment = None,
            _ => {}
        }
        Flow::Continue(())
    }
}

fn json(value: &Given) -> serde_json::Value {
    match value {
        Given::Number(number) => (*number).into(),
        Given::Text(text) => text.as_str().into(),
    }
}

/// The rows that come from the job. The caller adds the data of the program, the machine and the files. `by_diameter`:
/// whether X in the programs of a lathe is a diameter; `None` for a mill.
pub fn of_job(
    survey: &Survey,
    stops: Stops,
    by_diameter: Option<bool>,
    work_name: &dyn Fn(f64) -> String,
) -> SetupSheet {
    let ranges = |reach: &Reach| {
        let [first, second, third] = reach.0.map(|range| range.map(|(least, most)| [least, most]));
        match by_diameter {
            None => [first, second, third],
            // in a job for a lathe, the first axis is Z and the second is the radius
            Some(by_diameter) => {
                let scale = if by_diameter { 2.0 } else { 1.0 };
                [second.map(|ends| ends.map(|end| end * scale)), None, first]
            }
        }
    };
    let lowest = |totals: &Totals| ranges(&totals.cuts)[2].map(|[least, _]| least);
    let register = |tool: &Tool| tool.length_offset.or(Some(tool.number).filter(|_| by_diameter.is_none()));
    let name = |at: &usize| survey.operations.get(*at).and_then(|operation| operation.begins.name.clone());
    let start = stops.start.clone();
    SetupSheet {
        name: start.as_ref().and_then(|start| start.name.clone()),
        part: start.as_ref().and_then(|start| start.about.part.clone()),
        material: start.as_ref().and_then(|start| start.about.material.clone()),
        program: start.as_ref().and_then(|start| start.program).map(|number| number as u32),
        x: by_diameter.map(|by_diameter| if by_diameter { "diameters" } else { "radii" }),
        units: start.map_or(Units::Mm, |start| start.units).name(),
        works: survey
            .works
            .iter()
            .map(|work| Work {
                name: work_name(work.work),
                cuts: ranges(&work.totals.cuts),
                moves: ranges(&work.totals.moves),
            })
            .collect(),
        tools: survey
            .tools
            .iter()
            .map(|row| ToolRow {
                number: row.tool.number,
                name: row.tool.name.clone(),
                diameter: row.tool.diameter,
                corner_radius: row.tool.corner_radius,
                length_register: register(&row.tool),
                diameter_register: row.tool.diameter_offset,
                length: None,
                comment: row.tool.comment.clone(),
                data: row.tool.data.iter().map(|(name, value)| (name.clone(), json(value))).collect(),
                operations: row.operations.iter().filter_map(name).collect(),
                lowest: lowest(&row.totals),
                minutes: row.totals.minutes(),
                seconds: None,
            })
            .collect(),
        operations: survey
            .operations
            .iter()
            .map(|operation| OperationRow {
                name: operation.begins.name.clone(),
                tool: operation.begins.tool.as_ref().map(|tool| tool.number),
                work: work_name(operation.work),
                speed: operation.spindle.speed,
                surface: operation.spindle.css.filter(|css| *css).map(|_| operation.spindle.max.unwrap_or(0.0)),
                feed: operation.begins.feed,
                feed_mode: match operation.begins.feed_mode {
                    Some(FeedMode::PerRev) => "per_rev",
                    Some(FeedMode::InverseTime) => "inverse_time",
                    Some(FeedMode::PerMinute) | None => "per_minute",
                },
                holes: operation.totals.holes,
                length: operation.totals.length,
                lowest: lowest(&operation.totals),
                minutes: operation.totals.minutes(),
            })
            .collect(),
        stops: stops.stops,
        minutes: survey.whole.minutes(),
        ..SetupSheet::default()
    }
}
