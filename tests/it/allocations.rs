//! After warm-up, rendering an event allocates no memory.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use crate::support::{check, mill};
use postform::internals::compile::compile;
use postform::internals::json::read_lines;
use postform::internals::render::{Options, Renderer};
use postform::toolpath::{Arc, Axes, CycleKind, CycleSpec, Direction, Event, Hole, Place, Plane, Sink};

thread_local!(static COUNT: Cell<u64> = const { Cell::new(0) });

/// Counts this thread's allocations.
struct Counting;

// only a global allocator can count allocations; it passes each call on to the system's allocator
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const FORM: &str = "Sequence#s N 10 10\nMinRad 0.01";
const CYCLES: &str =
    "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel\nPeck\nNone\nEnd\nRapidCode\nG0 X[h] Y[v] Z[d]\nEnd";

#[test]
fn events_do_not_allocate() {
    let checked = check(&mill(FORM, CYCLES));
    assert!(!checked.has_errors(), "{:?}", checked.diags);
    let program = compile(&checked.form);
    let mut renderer = Renderer::new(&program, Options::default());
    let head = "{\"start\":{\"program\":1,\"units\":\"inch\",\"tools\":[{\"number\":1}]}}\n\
        {\"operation\":{\"tool\":1,\"spindle\":{\"speed\":9,\"direction\":\"cw\"},\"feed\":5}}\n{\"rapid\":[0,0,1]}\n";
    // the head comes from a reader whose input ends early; only the events that it pushed are used
    _ = read_lines(head.as_bytes(), &mut renderer);
    let drill = CycleSpec { depth: Some(0.5), feed: Some(5.0), ..CycleSpec::new(CycleKind::Drill) };
    let deep = CycleSpec { step: Some(0.1), kind: CycleKind::Deep, ..drill.clone() };
    let mut round = |i: u32| {
        let x = f64::from(i % 300) * 0.013;
        let mut push = |event: Event<'_>| renderer.push(event, Place::default()).unwrap();
        push(Event::Line { to: Axes::new(&[x, 1.5, -0.1]), feed: Some(5.0 + f64::from(i % 7)) });
        push(Event::Line { to: Axes::new(&[x, 0.5, -0.1]), feed: None });
        let to = Axes::new(&[x + 1.0, 0.5]);
        let center = Some(Axes::new(&[x + 0.5, 0.5]));
        let arc = Arc { to, center, radius: None, direction: Direction::Cw, plane: Plane::Xy, turns: 0 };
        push(Event::Arc { arc: &arc, feed: None });
        let tiny = Arc { to: Axes::new(&[x + 1.004, 0.5]), center: Some(Axes::new(&[x + 1.002, 0.5])), ..arc };
        push(Event::Arc { arc: &tiny, feed: None });
        push(Event::Rapid(Axes::new(&[x, 0.5, 1.0])));
        for spec in [&drill, &deep] {
            push(Event::CycleBegin(spec));
            for y in 0..3 {
                push(Event::Hole(Hole { at: Axes::new(&[x, f64::from(y), 0.0]), depth: None }));
            }
            push(Event::CycleEnd);
        }
        renderer.text().clear();
    };
    for i in 0..100 {
        round(i);
    }
    let before = COUNT.with(Cell::get);
    for i in 0..1000 {
        round(i);
    }
    assert_eq!(COUNT.with(Cell::get) - before, 0, "allocations in 1000 rounds of 13 events");
}

#[test]
fn reading_moves_from_json_lines_does_not_allocate() {
    let checked = check(&mill("", ""));
    let program = compile(&checked.form);
    let count = |moves: usize| {
        let mut text = String::from(
            "{\"start\":{\"program\":1,\"units\":\"inch\",\"tools\":[{\"number\":1}]}}\n\
             {\"operation\":{\"tool\":1,\"spindle\":{\"speed\":9,\"direction\":\"cw\"},\"feed\":5}}\n{\"rapid\":[0,0,1]}\n",
        );
        for i in 0..moves {
            text += &format!("{{\"line\":[{}.25,1,-0.5]}}\n", i % 100);
        }
        text += "{\"end\":true}\n";
        let mut renderer = Renderer::new(&program, Options::default());
        renderer.text().reserve(1 << 20);
        let before = COUNT.with(Cell::get);
        read_lines(text.as_bytes(), &mut renderer).unwrap();
        COUNT.with(Cell::get) - before
    };
    assert_eq!(count(10_000), count(100), "reading more moves allocates more");
}
