//! JSON Lines: one object on each line. A job in JSON Lines can be written and read as a stream.

use std::fmt;
use std::io::Read;

use serde::de::{DeserializeSeed, Deserializer, MapAccess, Visitor};

use super::build::Builder;
use super::context::{Context, Step, not_utf_8};
use super::fast::{Kind, Simple, simple};
use super::objects::{
    CycleObject, EndWord, ItemObject, JobHead, KeySeed, Object, ObjectSeed, OperationHead, SubprogramHead, Value, once,
};
use super::strings::{self, Strings};
use super::values::Point;
use crate::diag::{Code, Diag, Location};
use crate::toolpath::{Hole, ReadError, Sink, Stop};

/// The maximum length of a line. A file with longer lines is not a job.
const LONGEST: usize = 4 << 20;

/// Reads a job in JSON Lines and pushes its events. Memory does not grow with the job.
///
/// # Errors
/// The job has an error, or the sink can't do what the job requests.
pub fn read_lines(mut input: impl Read, sink: &mut dyn Sink) -> Result<(), ReadError> {
    let context = Context::default();
    let mut lines = Lines { builder: Builder::new(sink), context: &context, started: false, ended: false };
    let mut buffer = vec![0; 256 * 1024];
    let (mut from, mut to, mut at_end) = (0, 0, false);
    let mut number = 0;
    loop {
        if let Some((simple, length)) = lines.is_open().then(|| simple(&buffer[from..to])).flatten() {
            number += 1;
            lines.builder.place.line = number;
            lines.builder.place.column = 1;
            lines.simple(simple)?;
            from += length;
            continue;
        }
        let line_end = memchr::memchr(b'\n', &buffer[from..to]);
        let (end, next) = match line_end {
            Some(length) => (from + length, from + length + 1),
            None if at_end && from == to => break,
            None if at_end => (to, to),
            None => {
                buffer.copy_within(from..to, 0);
                (to, from) = (to - from, 0);
                if to == buffer.len() {
                    if to >= LONGEST {
                        let diag = Diag::new(Code::PJ001, "a line longer than 4 MB").help("write one item per line");
                        lines.builder.place.line = number + 1;
                        return Err(lines.placed(diag));
                    }
                    buffer.resize(to * 2, 0);
                }
                match input.read(&mut buffer[to..]) {
                    Ok(0) => at_end = true,
                    Ok(count) => to += count,
                    Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                    Err(error) => return Err(ReadError::Io(error)),
                }
                continue;
            }
        };
        number += 1;
        lines.builder.place.line = number;
        lines.builder.place.column = 1;
        let mut line = &buffer[from..end];
        if number == 1 {
            line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line);
            if let Some(diag) = not_utf_8(line) {
                return Err(lines.placed(diag));
            }
        }
        lines.other(line)?;
        from = next;
    }
    lines.end()
}

struct Lines<'c, 's> {
    builder: Builder<'s>,
    context: &'c Context,
    started: bool,
    ended: bool,
}

impl Lines<'_, '_> {
    /// Whether the job has started and has not ended yet.
    fn is_open(&self) -> bool {
        self.started && !self.ended
    }

    /// Handles a plain line.
    #[inline]
    fn simple(&mut self, simple: Simple) -> Result<(), ReadError> {
        let done = match simple.kind {
            Kind::Point => self.builder.hole(Hole { at: simple.to, depth: None }),
            kind => {
                self.builder.place.item += 1;
                self.builder.simple_move(simple.to, simple.feed, kind == Kind::Rapid)
            }
        };
        done.map_err(|stop| self.placed(stop))
    }

    /// Handles a line that is not plain.
    fn other(&mut self, line: &[u8]) -> Result<(), ReadError> {
        if line.iter().all(u8::is_ascii_whitespace) {
            return Ok(());
        }
        if self.ended {
            let diag = Diag::new(Code::PJ008, "there is text after the end of the job");
            return Err(self.placed(diag.help("`{\"end\": true}` must be the last line")));
        }
        if line.len() > strings::LONGEST && !Strings::default().take(line) {
            return Err(self.placed(strings::too_long()));
        }
        let number = self.builder.place.line;
        let mut deserializer = serde_json::Deserializer::from_slice(line);
        let read = LineSeed { context: self.context }.deserialize(&mut deserializer);
        match read.and_then(|line| deserializer.end().map(|()| line)) {
            Ok(line) => self.take(line).map_err(|stop| self.placed(stop)),
            Err(error) => {
                let column = u32::try_from(error.column()).unwrap_or(u32::MAX).max(1);
                let mut place = self.builder.place;
                place.item += u64::from(place.operation > 0);
                let mut failure = self.context.explain(error, number, column);
                if let ReadError::Job(diag) = &mut failure {
                    if diag.code == Code::PJ008 {
                        **diag = Diag::new(Code::PJ008, "there is text after the object on this line");
                        diag.help = Some("write one item per line".into());
                    }
                    let key = self.context.path();
                    let steps = [place.path(), key].into_iter().filter(|step| !step.is_empty()).collect::<Vec<_>>();
                    diag.place = Some(Box::new(Location::at(number, column).step(steps.join("."))));
                }
                Err(failure)
            }
        }
    }

    fn take(&mut self, line: Line) -> Result<(), Stop> {
        let is_start = matches!(line, Line::Start(_));
        if is_start == self.started {
            let (message, help) = if is_start {
                ("the job starts twice", "remove this line")
            } else {
                ("the job does not begin with `start`", "write {\"start\": {\"postform\": 1}} as the first line")
            };
            return Err(Diag::new(Code::PJ011, message).help(help).into());
        }
        match line {
            Line::Start(head) => {
                self.started = true;
                self.builder.start(head)
            }
            Line::Operation(head) => self.builder.operation(head),
            Line::Item(item) => {
                if let Some(EndWord::Job) = item.end {
                    self.ended = true;
                    return self.builder.finish();
                }
                self.builder.place.item += 1;
                self.builder.item(&item)
            }
            Line::Cycle(cycle, points) => {
                self.builder.place.item += 1;
                self.builder.cycle_begin(&cycle)?;
                let Some(points) = points else { return Ok(()) };
                for Point(hole) in points {
                    self.builder.hole(hole)?;
                }
                self.builder.cycle_end()
            }
            Line::Point(Point(hole)) => self.builder.hole(hole),
            Line::CycleEnd => self.builder.cycle_end(),
            Line::Subprogram(head) => self.builder.subprogram(head),
            Line::SubprogramEnd => self.builder.subprogram_end(),
        }
    }

    /// Checks after the last line that the job is complete.
    fn end(self) -> Result<(), ReadError> {
        if self.ended {
            return Ok(());
        }
        let diag = if self.builder.place.line == 0 {
            Diag::new(Code::PJ007, "the job is empty").help("write a job file")
        } else {
            Diag::new(Code::PJ007, "the job has no end").help(
                "write the job again: its last line must be {\"end\": true}; postform prints no program from an \
                 incomplete job",
            )
        };
        Err(self.placed(diag))
    }

    #[cold]
    fn placed(&self, stop: impl Into<Stop>) -> ReadError {
        stop.into().placed(|| self.builder.place.into()).into()
    }
}

/// The content of a line.
enum Line {
    Start(JobHead),
    Operation(OperationHead),
    Item(Box<ItemObject>),
    Cycle(Box<CycleObject>, Option<Vec<Point>>),
    Point(Point),
    CycleEnd,
    Subprogram(SubprogramHead),
    SubprogramEnd,
}

struct LineSeed<'c> {
    context: &'c Context,
}

impl<'de> DeserializeSeed<'de> for LineSeed<'_> {
    type Value = Line;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Line, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for LineSeed<'_> {
    type Value = Line;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("one item of a job, an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Line, A::Error> {
        const OWN: &[&str] = &["start", "operation", "subprogram", "subprogram_end", "cycle", "point", "cycle_end"];
        let context = self.context;
        let (mut item, mut seen) = (ItemObject::default(), 0);
        let mut line = None;
        let keys = || KeySeed { context, object: "a line", keys: [OWN, ItemObject::KEYS] };
        while let Some(key) = map.next_key_seed(keys())? {
            let name = OWN.iter().chain(ItemObject::KEYS).nth(key).copied().unwrap_or("");
            once(&mut seen, key, name, context)?;
            context.enter(Step::Key(name));
            match name {
                "start" => line = Some(Line::Start(map.next_value_seed(ObjectSeed::new(context))?)),
                "operation" => line = Some(Line::Operation(map.next_value_seed(ObjectSeed::new(context))?)),
                "cycle" => {
                    let CycleLine { cycle, points } = map.next_value_seed(CycleLineSeed { context })?;
                    line = Some(Line::Cycle(Box::new(cycle), points));
                }
                "point" => line = Some(Line::Point(Value::read(&mut map, context)?)),
                "subprogram" => line = Some(Line::Subprogram(map.next_value_seed(ObjectSeed::new(context))?)),
                "cycle_end" | "subprogram_end" => {
                    if !map.next_value::<bool>()? {
                        let diag = Diag::new(Code::PJ003, format!("`{name}` is false")).help("write true");
                        return Err(context.fail(diag));
                    }
                    line = Some(if name == "cycle_end" { Line::CycleEnd } else { Line::SubprogramEnd });
                }
                _ => item.read(key - OWN.len(), &mut map, context)?,
            }
            context.leave();
        }
        match line {
            Some(_) if seen.count_ones() > 1 => {
                let diag = Diag::new(Code::PJ005, "the line contains more than one action")
                    .help("make a separate line of each action");
                Err(context.fail(diag))
            }
            Some(line) => Ok(line),
            None => Ok(Line::Item(Box::new(item))),
        }
    }
}

/// A cycle. The points of the cycle may be on the line of the cycle or on later lines.
struct CycleLine {
    cycle: CycleObject,
    points: Option<Vec<Point>>,
}

struct CycleLineSeed<'c> {
    context: &'c Context,
}

impl<'de> DeserializeSeed<'de> for CycleLineSeed<'_> {
    type Value = CycleLine;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<CycleLine, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for CycleLineSeed<'_> {
    type Value = CycleLine;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a cycle, an object")
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<CycleLine, A::Error> {
        const POINTS: &[&str] = &["points"];
        let context = self.context;
        let (mut cycle, mut points, mut seen) = (CycleObject::default(), None, 0);
        let keys = || KeySeed { context, object: CycleObject::NAME, keys: [CycleObject::KEYS, POINTS] };
        while let Some(key) = map.next_key_seed(keys())? {
            let name = CycleObject::KEYS.get(key).copied().unwrap_or(POINTS[0]);
            once(&mut seen, key, name, context)?;
            context.enter(Step::Key(name));
            if key == CycleObject::KEYS.len() {
                points = Some(map.next_value_seed(super::position::PointsSeed { context })?);
            } else {
                cycle.read(key, &mut map, context)?;
            }
            context.leave();
        }
        Ok(CycleLine { cycle, points })
    }
}
