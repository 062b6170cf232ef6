//! The sheet of a job, from what lies in it.

use super::{OperationRow, SetupSheet, StopRow, ToolRow, Work};
use crate::survey::{Survey, Totals};
use crate::toolpath::{Event, Flow, Place, Sink, Start, StopKind, Units};

/// Takes the head of a job and its stops.
#[derive(Debug, Default)]
pub struct Stops {
    /// The head.
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

/// The rows that the job gives; the caller adds what it knows of program, machine and files.
pub fn of_job(survey: &Survey, stops: Stops, work_name: &dyn Fn(f64) -> String) -> SetupSheet {
    let lowest = |totals: &Totals| totals.cuts.0[2].map(|(least, _)| least);
    let ranges = |reach: &crate::survey::Reach| reach.0.map(|range| range.map(|(least, most)| [least, most]));
    let name = |at: &usize| survey.operations.get(*at).and_then(|operation| operation.begins.name.clone());
    let start = stops.start.clone();
    SetupSheet {
        name: start.as_ref().and_then(|start| start.name.clone()),
        part: start.as_ref().and_then(|start| start.about.part.clone()),
        material: start.as_ref().and_then(|start| start.about.material.clone()),
        program: start.as_ref().and_then(|start| start.program).map(|number| number as u32),
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
                length_register: row.tool.length_offset.or(Some(row.tool.number)),
                diameter_register: row.tool.diameter_offset,
                comment: row.tool.comment.clone(),
                operations: row.operations.iter().filter_map(name).collect(),
                lowest: lowest(&row.totals),
                minutes: row.totals.minutes(),
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
                feed: operation.begins.feed,
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
