//! Reads `job.json`, which is one JSON document, as a stream.

use std::cell::{Cell, RefCell};
use std::fmt;
use std::io::{Read, Seek};

use serde::Deserialize as _;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::de::IoRead;

use super::build::Builder;
use super::context::{Context, Step, not_utf_8};
use super::fast::{Kind, Simple, next_item, simple_item};
use super::objects::{CycleObject, ItemObject, JobHead, KeySeed, Object, OperationHead, SubprogramHead, once};
use super::order::{InParts, Order, order};
use super::position::PointSeed;
use super::values::Point;
use super::window::{AsItStands, Counting, Text, Window};
use crate::diag::{Code, Diag, Location};
use crate::toolpath::{ReadError, Sink, Stop};

/// The largest number of points of one cycle that are kept until the keys after the points are read. If a cycle has
/// more points, the reader passes them on at once.
const MOST_WAITING: usize = 4096;

/// Reads a job document and pushes its events. Memory does not grow with the job.
///
/// # Errors
/// The job has an error, or the sink can't do what the job requests.
pub fn read_document(input: impl Read, sink: &mut dyn Sink) -> Result<(), ReadError> {
    read_from(AsItStands(input), sink)
}

/// Reads a job document from an input that can seek. The keys of its objects may then be in any order.
///
/// # Errors
/// The same errors as for [`read_document`].
pub fn read_document_again(mut input: impl Read + Seek, sink: &mut dyn Sink) -> Result<(), ReadError> {
    let found = order(&mut input).map_err(ReadError::Io)?;
    input.rewind().map_err(ReadError::Io)?;
    match found {
        Order::Late(parts) => read_from(InParts::new(input, &parts), sink),
        Order::Usual => read_document(input, sink),
        // report syntax errors of the text first; otherwise the reader would report keys after the error as missing
        Order::Broken => {
            let is_whole = read_text(AsItStands(&mut input), |text, _, _| {
                IgnoredAny::deserialize(&mut *text).and_then(|_| text.end())
            });
            is_whole?;
            input.rewind().map_err(ReadError::Io)?;
            read_document(input, sink)
        }
    }
}

fn read_from(input: impl Text, sink: &mut dyn Sink) -> Result<(), ReadError> {
    read_text(input, |text, context, window| {
        let job = Job { context, window, builder: RefCell::new(Builder::new(sink)), passed: Cell::new(0) };
        JobSeed(&job, Part::Job).deserialize(&mut *text)?;
        text.end()?;
        job.builder.borrow_mut().finish().map_err(|stop| context.fail_with(stop))
    })
}

/// Reads a JSON text. `read` deserializes it.
fn read_text<T: Text>(
    input: T,
    read: impl FnOnce(&mut serde_json::Deserializer<IoRead<Counting<'_, T>>>, &Context, &Window) -> serde_json::Result<()>,
) -> Result<(), ReadError> {
    let context = Context::default();
    context.at.set((1, 0));
    let window = Window::default();
    let mut reader = Counting::new(input, &context, &window);
    if reader.begin().map_err(ReadError::Io)? == 0 {
        return Err(ReadError::Job(Box::new(Diag::new(Code::PJ007, "the job is empty").help("write a job file"))));
    }
    if let Some(mut diag) = not_utf_8(&window.buffer.borrow()[..window.to.get()]) {
        diag = diag.place(Location::at(1, 1));
        return Err(ReadError::Job(Box::new(diag)));
    }
    let mut text = serde_json::Deserializer::from_reader(reader);
    read(&mut text, &context, &window).map_err(|error| {
        let (line, column) = context.at.get();
        context.explain(error, line, column.max(1))
    })
}

/// Data that all parts of one document share.
struct Job<'a, 's> {
    context: &'a Context,
    window: &'a Window,
    builder: RefCell<Builder<'s>>,
    /// Number of items that the last call of `plain_items` passed on, minus one.
    passed: Cell<u64>,
}

impl<'s> Job<'_, 's> {
    fn build<E: serde::de::Error>(&self, f: impl FnOnce(&mut Builder<'s>) -> Result<(), Stop>) -> Result<(), E> {
        f(&mut self.builder.borrow_mut()).map_err(|stop| self.context.fail_with(stop))
    }

    fn misplaced<E: serde::de::Error>(&self, list: &str, object: &str, key: &str) -> E {
        let help = format!("make `{list}` the last key of {object}, or give a job from standard input as a file");
        self.context.fail(Diag::new(Code::PJ005, format!("`{key}` comes after `{list}`")).help(help))
    }

    /// Passes on plain items from the buffered text, up to the first item that is not plain. serde_json has already
    /// read the opening brace of the first item. The closing brace of the last plain item stays in the buffer, so
    /// serde_json reads an empty object. Returns `false` if there is no plain item.
    fn plain_items<E: serde::de::Error>(&self) -> Result<bool, E> {
        let (buffer, start, to) = (self.window.buffer.borrow(), self.window.from.get(), self.window.to.get());
        if start == 0 || buffer[start - 1] != b'{' {
            return Ok(false);
        }
        let is_plain = |simple: &Simple| simple.kind != Kind::Point && simple.feed.is_none_or(|feed| feed > 0.0);
        let item = |at: usize| simple_item(&buffer[at..to]).filter(|(simple, _)| is_plain(simple));
        let (mut at, mut count) = (start, 0);
        let mut next = item(at);
        let mut builder = self.builder.borrow_mut();
        while let Some((simple, length)) = next {
            let (line, column) = self.context.at.get();
            (builder.place.line, builder.place.column) = (line, column);
            builder.place.item += 1;
            let rapid = simple.kind == Kind::Rapid;
            builder.simple_move(simple.to, simple.feed, rapid).map_err(|stop| self.context.fail_with(stop))?;
            count += 1;
            let mut end = at + length;
            next = next_item(&buffer[end + 1..to]).and_then(|rest| {
                let begin = to - rest.len();
                item(begin).inspect(|_| end = begin)
            });
            self.context.pass(&buffer[at..end]);
            at = end;
        }
        self.window.from.set(at);
        self.passed.set(u64::max(count, 1) - 1);
        Ok(count > 0)
    }

    /// Sets the location to the beginning of the next value.
    fn mark(&self) {
        let (line, column) = self.context.at.get();
        let mut builder = self.builder.borrow_mut();
        builder.place.line = line;
        builder.place.column = column;
    }
}

/// An object whose last key is a list. Each element of the list is passed on as soon as it is read.
trait Streamed: Object {
    /// The name of the last key, as a list with one element.
    const LIST: &'static [&'static str];
}
impl Streamed for OperationHead {
    const LIST: &'static [&'static str] = &["path"];
}
impl Streamed for SubprogramHead {
    const LIST: &'static [&'static str] = &["path"];
}

/// Reads a streamed object. `head` receives the keys before the list. Returns whether the object has the list.
fn streamed<'de, T: Streamed, A: MapAccess<'de>>(
    job: &Job,
    mut map: A,
    head: impl Fn(T) -> Result<(), A::Error>,
    list: Part,
) -> Result<bool, A::Error> {
    let (mut object, mut seen, mut listed) = (Some(T::default()), 0, false);
    let keys = |context| KeySeed { context, object: T::NAME, keys: [T::KEYS, T::LIST] };
    while let Some(key) = map.next_key_seed(keys(job.context))? {
        let name = T::KEYS.get(key).copied().unwrap_or(T::LIST[0]);
        once(&mut seen, key, name, job.context)?;
        if key == T::KEYS.len() {
            head(object.take().unwrap_or_default())?;
        }
        job.context.enter(Step::Key(name));
        if key == T::KEYS.len() {
            map.next_value_seed(JobSeed(job, list))?;
            listed = true;
        } else if let Some(object) = &mut object {
            object.read(key, &mut map, job.context)?;
        } else {
            return Err(job.misplaced(T::LIST[0], T::NAME, name));
        }
        job.context.leave();
    }
    if let Some(object) = object.take() {
        head(object)?;
    }
    Ok(listed)
}

/// The part of the document that a seed reads. The elements of lists are passed on one by one.
#[derive(Clone, Copy)]
enum Part {
    Job,
    Subprograms,
    Subprogram,
    Operations,
    Operation,
    Path,
    Item,
    Cycle,
}

struct JobSeed<'j, 'a, 's>(&'j Job<'a, 's>, Part);

impl<'de> DeserializeSeed<'de> for JobSeed<'_, '_, '_> {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        match self.1 {
            Part::Subprograms | Part::Operations | Part::Path => deserializer.deserialize_seq(self),
            Part::Item if self.0.plain_items()? => IgnoredAny::deserialize(deserializer).map(drop),
            _ => deserializer.deserialize_map(self),
        }
    }
}

impl<'de> Visitor<'de> for JobSeed<'_, '_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self.1 {
            Part::Job => "a job, an object",
            Part::Subprograms => "a list of subprograms",
            Part::Subprogram => "a subprogram, an object",
            Part::Operations => "a list of operations",
            Part::Operation => "an operation, an object",
            Part::Path => "a path, a list of items",
            Part::Item => "a path item, an object",
            Part::Cycle => "a cycle, an object",
        })
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        let JobSeed(job, part) = self;
        let element = match part {
            Part::Subprograms => Part::Subprogram,
            Part::Operations => Part::Operation,
            _ => Part::Item,
        };
        let mut index = 0;
        loop {
            job.context.enter(Step::Index(index));
            if seq.next_element_seed(JobSeed(job, element))?.is_none() {
                break;
            }
            job.context.leave();
            index += 1 + job.passed.take();
        }
        job.context.leave();
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<(), A::Error> {
        let JobSeed(job, part) = self;
        job.mark();
        match part {
            Part::Job => self::job(job, map)?,
            Part::Subprogram => {
                let head = |head| job.build(|b| b.subprogram(head));
                if !streamed::<SubprogramHead, A>(job, map, head, Part::Path)? {
                    let diag = Diag::new(Code::PJ004, "a subprogram without `path`")
                        .help("give the subprogram's moves as \"path\": []");
                    return Err(job.context.fail(diag));
                }
                job.build(|b| b.subprogram_end())?;
            }
            Part::Operation => {
                let head = |head| job.build(|b| b.operation(head));
                if !streamed::<OperationHead, A>(job, map, head, Part::Path)? {
                    let diag = Diag::new(Code::PJ004, "an operation without `path`")
                        .help("give the operation's moves as \"path\": []");
                    return Err(job.context.fail(diag));
                }
            }
            Part::Cycle => cycle(job, map)?,
            _ => item(job, map)?,
        }
        Ok(())
    }
}

/// Reads the job: its head, then its subprograms, then its operations. It passes on each list element as soon as the
/// element is read.
fn job<'de, A: MapAccess<'de>>(job: &Job, mut map: A) -> Result<(), A::Error> {
    const LISTS: &[&str] = &["subprograms", "operations"];
    let (mut head, mut seen, mut done) = (Some(JobHead::default()), 0, "");
    let keys = || KeySeed { context: job.context, object: JobHead::NAME, keys: [JobHead::KEYS, LISTS] };
    while let Some(key) = map.next_key_seed(keys())? {
        let name = JobHead::KEYS.get(key).or_else(|| LISTS.get(key - JobHead::KEYS.len())).copied().unwrap_or("");
        once(&mut seen, key, name, job.context)?;
        let is_list = key >= JobHead::KEYS.len();
        if done == LISTS[1] || (done == LISTS[0] && name != LISTS[1]) {
            return Err(job.misplaced(done, JobHead::NAME, name));
        }
        if let Some(head) = head.take_if(|_| is_list) {
            job.build(|b| b.start(head))?;
        }
        job.context.enter(Step::Key(name));
        match &mut head {
            Some(head) => head.read(key, &mut map, job.context)?,
            None => {
                done = name;
                let part = if name == LISTS[0] { Part::Subprograms } else { Part::Operations };
                map.next_value_seed(JobSeed(job, part))?;
            }
        }
        job.context.leave();
    }
    match head {
        Some(head) => job.build(|b| b.start(head)),
        None => Ok(()),
    }
}

/// Reads an item of a path. If the item is a cycle, the cycle is passed on while it is read, and the item must have no
/// other key.
fn item<'de, A: MapAccess<'de>>(job: &Job, mut map: A) -> Result<(), A::Error> {
    const CYCLE: &[&str] = &["cycle"];
    job.builder.borrow_mut().place.item += 1;
    let (mut item, mut seen, mut cycle) = (ItemObject::default(), 0, false);
    let keys = || KeySeed { context: job.context, object: ItemObject::NAME, keys: [ItemObject::KEYS, CYCLE] };
    while let Some(key) = map.next_key_seed(keys())? {
        let name = ItemObject::KEYS.get(key).copied().unwrap_or(CYCLE[0]);
        once(&mut seen, key, name, job.context)?;
        job.context.enter(Step::Key(name));
        if key == ItemObject::KEYS.len() {
            map.next_value_seed(JobSeed(job, Part::Cycle))?;
            cycle = true;
        } else {
            item.read(key, &mut map, job.context)?;
        }
        job.context.leave();
    }
    if cycle {
        if seen.count_ones() > 1 {
            let diag = Diag::new(Code::PJ005, "the path item contains more than one action")
                .help("make a separate item of each action");
            return Err(job.context.fail(diag));
        }
        return Ok(());
    }
    job.build(|b| b.item(&item))
}

/// Reads a cycle. Up to [`MOST_WAITING`] points are kept until all keys of the cycle are read. If the cycle has more
/// points, they are passed on without waiting for these keys.
fn cycle<'de, A: MapAccess<'de>>(job: &Job, mut map: A) -> Result<(), A::Error> {
    const POINTS: &[&str] = &["points"];
    let (mut object, mut seen) = (CycleObject::default(), 0);
    let mut waiting = Vec::new();
    let mut begun = false;
    let keys = || KeySeed { context: job.context, object: CycleObject::NAME, keys: [CycleObject::KEYS, POINTS] };
    while let Some(key) = map.next_key_seed(keys())? {
        let name = CycleObject::KEYS.get(key).copied().unwrap_or(POINTS[0]);
        once(&mut seen, key, name, job.context)?;
        if begun {
            return Err(late_key(job, name));
        }
        job.context.enter(Step::Key(name));
        if key == CycleObject::KEYS.len() {
            begun = map.next_value_seed(Points { job, object: &object, waiting: &mut waiting })?;
        } else {
            object.read(key, &mut map, job.context)?;
        }
        job.context.leave();
    }
    if !begun {
        job.build(|b| b.cycle_begin(&object))?;
        pass_on(job, &mut waiting)?;
    }
    job.build(|b| b.cycle_end())
}

/// The error for a key that comes after more points than are kept.
fn late_key<E: serde::de::Error>(job: &Job, key: &str) -> E {
    let message = format!("`{key}` does not come before the `points` of a cycle with more than {MOST_WAITING} points");
    job.context.fail(Diag::new(Code::PJ005, message).help("make `points` the last key of the cycle"))
}

fn pass_on<E: serde::de::Error>(job: &Job, waiting: &mut Vec<(Point, (u64, u32))>) -> Result<(), E> {
    for (Point(hole), (line, column)) in waiting.drain(..) {
        job.build(|b| {
            (b.place.line, b.place.column) = (line, column);
            b.hole(hole)
        })?;
    }
    Ok(())
}

/// Reads the points of a cycle. The result is `true` if the points were passed on.
struct Points<'w, 'j, 'a, 's> {
    job: &'j Job<'a, 's>,
    object: &'w CycleObject,
    waiting: &'w mut Vec<(Point, (u64, u32))>,
}

impl<'de> DeserializeSeed<'de> for Points<'_, '_, '_, '_> {
    type Value = bool;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<bool, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Points<'_, '_, '_, '_> {
    type Value = bool;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a list of points")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<bool, A::Error> {
        let (job, mut index, mut begun) = (self.job, 0, false);
        loop {
            job.context.enter(Step::Index(index));
            let Some(point) = seq.next_element_seed(PointSeed { context: job.context })? else { break };
            job.context.leave();
            index += 1;
            self.waiting.push((point, job.context.point_at.get()));
            if begun || self.waiting.len() == MOST_WAITING {
                if !begun {
                    if self.object.kind.is_none() {
                        return Err(late_key(job, "kind"));
                    }
                    job.build(|b| b.cycle_begin(self.object))?;
                }
                begun = true;
                pass_on(job, self.waiting)?;
            }
        }
        job.context.leave();
        Ok(begun)
    }
}
