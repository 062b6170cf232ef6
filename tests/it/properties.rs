//! Properties that must hold for every form and job.

use crate::support;
use std::io::Read;

use crate::support::{check, mill, render_checked};
use postform::internals::compile::compile;
use postform::internals::json::{read_document, read_lines};
use postform::internals::render::{Options, Renderer};
use postform::internals::syntax::{Head, Tail};
use proptest::prelude::*;

/// A reader that returns its bytes in pieces, as a pipe does.
struct Pieces<'a> {
    bytes: &'a [u8],
    size: usize,
}

impl Read for Pieces<'_> {
    fn read(&mut self, out: &mut [u8]) -> std::io::Result<usize> {
        let count = self.size.min(out.len()).min(self.bytes.len());
        out[..count].copy_from_slice(&self.bytes[..count]);
        self.bytes = &self.bytes[count..];
        Ok(count)
    }
}

/// Path items as JSON, each one line.
fn item() -> impl Strategy<Value = String> {
    let number = || (-5000i32..5000, 0u32..4).prop_map(|(n, places)| f64::from(n) / 10f64.powi(places as i32));
    let position = move || (number(), number(), number()).prop_map(|(x, y, z)| format!("[{x},{y},{z}]"));
    prop_oneof![
        position().prop_map(|p| format!("{{\"line\":{p}}}")),
        position().prop_map(|p| format!("{{\"rapid\":{p}}}")),
        (position(), 1u32..900).prop_map(|(p, f)| format!("{{\"line\":{p},\"feed\":{f}.5}}")),
        (position(), 1u32..900).prop_map(|(p, f)| format!("{{\"feed\": {f}, \"line\": {p}}}")),
        (0u32..100).prop_map(|t| format!("{{\"dwell\":{t}}}")),
        "[a-z ]{0,12}".prop_map(|t| format!("{{\"comment\":\"{t}\"}}")),
        (54u32..60).prop_map(|w| format!("{{\"work\":{w}}}")),
        prop::collection::vec(position(), 1..4).prop_map(|points| format!(
            "{{\"cycle\":{{\"kind\":\"drill\",\"depth\":1,\"clear\":0.5,\"feed\":5,\"points\":[{}]}}}}",
            points.join(",")
        )),
    ]
}

const START: &str = "\"postform\":1,\"program\":7,\"units\":\"inch\",\"tools\":[{\"number\":1}]";
const OPERATION: &str = "\"tool\":1,\"work\":54,\"spindle\":{\"speed\":9,\"direction\":\"cw\"},\"feed\":5";

fn form() -> postform::internals::sema::Checked {
    check(&mill(
        "Sequence#s N 1 1\nX->9.>4\nY->9.>4\nZ->9.>4\nP->9.>3",
        "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel\nWorkChange\nG0 G53 Z0\nG[work]\nEnd",
    ))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// A JSON document and JSON Lines of the same job print the same program, whatever the sizes of the pieces.
    #[test]
    fn both_readers_print_the_same(items in prop::collection::vec(item(), 1..30), size in 1usize..60) {
        let checked = form();
        let first = "{\"rapid\":[0,0,9]}";
        let document = format!("{{{START},\"operations\":[{{{OPERATION},\"path\":[{first},{}]}}]}}", items.join(","));
        let lines = format!("{{\"start\":{{{START}}}}}\n{{\"operation\":{{{OPERATION}}}}}\n{first}\n{}\n{{\"end\":true}}\n", items.join("\n"));
        let whole = render_checked(&checked, document.as_bytes(), false, Options::default()).unwrap().text;
        let by_line = render_checked(&checked, lines.as_bytes(), true, Options::default()).unwrap().text;
        prop_assert_eq!(&whole, &by_line);
        let program = compile(&checked.form);
        for (text, is_lines) in [(&document, false), (&lines, true)] {
            let mut renderer = Renderer::new(&program, Options::default());
            let pieces = Pieces { bytes: text.as_bytes(), size };
            if is_lines { read_lines(pieces, &mut renderer).unwrap() } else { read_document(pieces, &mut renderer).unwrap() }
            prop_assert_eq!(&whole.as_bytes(), &renderer.text().as_slice());
        }
    }

    /// Taking the text during rendering gives the same program as taking it at the end.
    #[test]
    fn text_taken_in_pieces_is_the_same(items in prop::collection::vec(item(), 1..30)) {
        let checked = form();
        let program = compile(&checked.form);
        let document = format!("{{{START},\"operations\":[{{{OPERATION},\"path\":[{{\"rapid\":[0,0,9]}},{}]}}]}}", items.join(","));
        let whole = render_checked(&checked, document.as_bytes(), false, Options::default()).unwrap().text;
        struct Taking<'p>(Renderer<'p>, Vec<u8>);
        impl postform::toolpath::Sink for Taking<'_> {
            fn event(&mut self, event: postform::toolpath::Event<'_>, place: postform::toolpath::Place) -> postform::toolpath::Flow {
                self.0.event(event, place)?;
                self.1.append(self.0.text());
                postform::toolpath::Flow::Continue(())
            }
        }
        let mut taking = Taking(Renderer::new(&program, Options::default()), Vec::new());
        read_document(document.as_bytes(), &mut taking).unwrap();
        prop_assert_eq!(whole.as_bytes(), &taking.1);
    }

    /// Any text can be read as a form with findings: nothing panics, every line is in the tree, every location is
    /// inside the text.
    #[test]
    fn any_text_is_read_to_its_end(text in "(([A-Za-z0-9#;%:()\\[\\]<>.+~ \t\"-]{0,20}|End|Drill|StartCode|X->3.>4|Rapid G0|End Cancel|X\\[h\\] Y\\[v\\])\n){0,30}") {
        let checked = check(&text);
        let mut lines = 0;
        for item in &checked.trees[0].items {
            lines += match item {
                Head::Sequence(node) => 1 + node.body.len() + usize::from(node.end.is_some()),
                _ => 1,
            };
            if let Head::Statement(statement) = item && let Tail::Lost(lost) = &statement.line.tail {
                prop_assert_eq!(checked.files[0].slice(lost.span), &lost.text);
            }
        }
        prop_assert_eq!(lines, text.lines().count().max(usize::from(text.is_empty())));
        for diag in postform::internals::lint::lint(&checked, &Default::default()).diags {
            for label in diag.labels {
                prop_assert!(text.get(label.span.range()).is_some(), "{:?}", label);
            }
        }
    }

    /// A form with one changed byte gives findings or a program, and never a panic.
    #[test]
    fn mutated_posts_do_not_panic(at in 0usize..3000, byte: u8, post in 0usize..5) {
        let names = ["fanuc", "haas", "fadal", "linuxcnc", "grbl"];
        let path = support::root().join(format!("postforms/{}.pf", names[post]));
        let mut bytes = std::fs::read(path).unwrap();
        let at = at % bytes.len();
        bytes[at] = byte;
        let source = postform::internals::source::Source::from_bytes("f.pf", &bytes);
        let checked = postform::internals::sema::analyse(source, Default::default(), &mut |_| Err("no".into()));
        postform::internals::lint::lint(&checked, &Default::default());
        if !checked.has_errors() {
            let job = std::fs::read(support::root().join("samples/bracket/job.json")).unwrap();
            _ = render_checked(&checked, &job, false, Options::default());
        }
    }
}

/// An error of the input is reported. It must not look like the end of the job.
#[test]
fn read_errors_are_no_empty_jobs() {
    struct Failing;
    impl std::io::Read for Failing {
        fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("the disk"))
        }
    }
    let read = postform::internals::json::read_document(Failing, &mut postform::toolpath::Summary::default());
    assert!(matches!(read, Err(postform::toolpath::ReadError::Io(_))), "{read:?}");
}
