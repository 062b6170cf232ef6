//! A custom reader: it makes holes of the points in a table, and pushes them to the form as events.

use postform::toolpath::{
    Axes, CycleKind, CycleSpec, Event, Hole, Place, ReadError, Sink, Spindle, SpindleTurn, Start, Tool, ToolChange,
    Units,
};
use postform::{Error, Job, NoFiles, Options, Post, Source};

const FORM: &str = include_str!("../postforms/fanuc.pf");
const TABLE: &str = "x;y;depth\n10;20;8\n30;20;8\n30;45;12.5\n";

fn main() -> Result<(), Error> {
    let post = Post::compile(Source::from_text("fanuc.pf", FORM), &NoFiles)?;
    let program = post.render(Job::events(|sink| holes(TABLE, sink)), &Options::default())?;
    print!("{}", program.text());
    Ok(())
}

/// Pushes the events of a job that drills the table's holes.
fn holes(table: &str, sink: &mut dyn Sink) -> Result<(), ReadError> {
    let line = |number| Place { line: number, column: 1, ..Place::default() };
    let start = Start { program: Some(100.0), ..Start::new(Units::Mm) };
    sink.push(Event::Start(&start), line(1))?;
    let change = ToolChange {
        tool: Some(Tool { number: 5.0, diameter: Some(6.0), ..Tool::default() }),
        spindle: Some(Spindle { speed: Some(2400.0), turn: Some(SpindleTurn::Cw), ..Spindle::default() }),
        work: Some(54.0),
        ..ToolChange::default() // postform fills in the first move from the events that follow
    };
    sink.push(Event::ToolChange(&change), line(1))?;
    sink.push(
        Event::CycleBegin(&CycleSpec { clear: Some(2.0), feed: Some(150.0), ..CycleSpec::new(CycleKind::Drill) }),
        line(2),
    )?;
    for (row, number) in table.lines().skip(1).zip(2..) {
        let numbers: Vec<f64> = row.split(';').filter_map(|cell| cell.parse().ok()).collect();
        if let [x, y, depth] = numbers[..] {
            sink.push(Event::Hole(Hole { at: Axes::new(&[x, y, 0.0]), depth: Some(depth) }), line(number))?;
        }
    }
    sink.push(Event::CycleEnd, line(2))?;
    sink.push(Event::Finish, line(2))?;
    Ok(())
}
