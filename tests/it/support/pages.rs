//! Makes tests from the pages in docs/rules: inserts the fragments of the pages into whole forms.
#![allow(dead_code)]

use std::fs;

use postform::diag::Diag;
use postform::internals::lang::{CommandId, SequenceId};
use postform::internals::lint::{Changed, Found, Levels, fix, lint};
use postform::internals::sema::{Checked, Limits, analyse};
use postform::internals::source::Source;
use postform::internals::syntax::{Form, Head, parse};

use super::{plain_post, root};

/// A page: its sections by their headings.
pub struct Page {
    pub code: String,
    pub title: String,
    pub sections: Vec<(String, String)>,
}

/// A code block: the words after `pf`, and the lines.
pub struct Fence {
    pub kind: String,
    pub text: String,
}

impl Page {
    pub fn read(code: &str) -> Page {
        let path = root().join(format!("docs/rules/{code}.md"));
        let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let (title, rest) = text.split_once('\n').unwrap();
        let sections = rest.split("\n## ").skip(1).map(|section| {
            let (heading, body) = section.split_once('\n').unwrap();
            (heading.to_owned(), body.trim_matches('\n').to_owned())
        });
        Page { code: code.to_owned(), title: title.to_owned(), sections: sections.collect() }
    }

    pub fn section(&self, heading: &str) -> &str {
        let found = self.sections.iter().find(|(own, _)| own == heading);
        found.unwrap_or_else(|| panic!("{} has no section `{heading}`", self.code)).1.as_str()
    }

    /// The single code block of a section.
    pub fn fence(&self, heading: &str) -> Fence {
        let body = self.section(heading).strip_prefix("```pf").unwrap_or_else(|| panic!("{} {heading}", self.code));
        let (kind, rest) = body.split_once('\n').unwrap();
        let text = rest.strip_suffix("\n```").unwrap_or_else(|| panic!("{} {heading}: no end", self.code));
        Fence { kind: kind.trim().to_owned(), text: text.to_owned() }
    }
}

impl Fence {
    /// The whole form: a shipped post in which the fragment replaces the items with the same names.
    pub fn form(&self) -> Vec<u8> {
        let fragment = repeated(&self.text);
        if self.kind == "whole" {
            return (fragment + "\n").into_bytes();
        }
        let post = if ["lathe", "grbl"].contains(&self.kind.as_str()) { self.kind.as_str() } else { "fanuc" };
        let post = if post == "lathe" { "fanuc-lathe" } else { post };
        let base = plain_post(&format!("{post}.pf"));
        let text = merged(&base, &fragment);
        match self.kind.as_str() {
            "windows-1252" => text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect(),
            _ => text.into_bytes(),
        }
    }

    pub fn checked(&self) -> Checked {
        checked(&self.form())
    }
}

/// A line that ends with `×90` is repeated 90 times.
fn repeated(text: &str) -> String {
    let lines = text.lines().map(|line| match line.rsplit_once(" ×") {
        Some((line, times)) => vec![line; times.parse().unwrap()].join("\n"),
        None => line.to_owned(),
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// A form with a fragment in it. Items of the form with the same names as in the fragment are removed.
fn merged(base: &str, fragment: &str) -> String {
    let tree = |text: &str| parse(&Source::from_text("f", text), 0);
    let own = names(&tree(fragment));
    let mut out = String::new();
    let (head, tail) = split(fragment, &tree(fragment));
    let mut head = Some(head);
    for item in &tree(base).items {
        let is_sequence = matches!(item, Head::Sequence(_));
        if is_sequence && let Some(head) = head.take() {
            out += &head;
        }
        if name(item).is_some_and(|name| own.contains(&name)) {
            continue;
        }
        let (start, end) = extent(item);
        out += &base[start..end];
        out.push('\n');
    }
    out + &tail
}

/// The lines before the first sequence and its comments, and the lines from there on.
fn split(text: &str, tree: &Form) -> (String, String) {
    let Some(first) = tree.sequences().next() else { return (format!("{text}\n"), String::new()) };
    let lines: Vec<&str> = text.lines().collect();
    let mut at = text[..first.name.line.span.start as usize].lines().count();
    while at > 0 && lines[at - 1].starts_with('#') {
        at -= 1;
    }
    (lines[..at].join("\n") + "\n", format!("\n{}\n", lines[at..].join("\n")))
}

fn names(tree: &Form) -> Vec<String> {
    tree.items.iter().filter_map(name).collect()
}

/// The name that an item defines.
fn name(item: &Head) -> Option<String> {
    match item {
        Head::Format { letter, .. } => Some(format!("format {}", letter.text)),
        Head::Statement(statement) => Some(format!("command {}", CommandId::parse(&statement.name.text)?.name())),
        Head::Sequence(node) => {
            let name = &node.name.name.text;
            let upon = node.name.args.iter().map(|arg| arg.text.as_str()).collect::<Vec<_>>().join(" ");
            Some(match SequenceId::parse(name) {
                Some(id) => format!("sequence {}", id.name()),
                None => format!("sequence {name} {upon}"),
            })
        }
        _ => None,
    }
}

fn extent(item: &Head) -> (usize, usize) {
    let span = match item {
        Head::Blank(line) | Head::Format { line, .. } | Head::StrayEnd(line) => line.span,
        Head::Statement(statement) => statement.line.span,
        Head::Sequence(node) => node.span(),
    };
    (span.start as usize, span.end as usize)
}

/// Checks a form from bytes; it calls no other form.
pub fn checked(bytes: &[u8]) -> Checked {
    analyse(Source::from_bytes("form.pf", bytes), Limits::Classic, &mut |_| Err("can't be found".into()))
}

pub fn found(checked: &Checked) -> Found {
    lint(checked, &Levels::default())
}

/// The codes of findings, each once.
pub fn codes(diags: &[Diag]) -> Vec<&'static str> {
    let mut codes: Vec<&str> = diags.iter().map(|diag| diag.code.name()).collect();
    codes.sort_unstable();
    codes.dedup();
    codes
}

/// A form after all fixes; `None`: there was nothing to fix.
pub fn after_fixes(form: &Checked, unsafe_too: bool) -> Option<Checked> {
    let text = &form.files[0].text;
    let mut read = |changed: &Changed| checked(changed.get("form.pf").unwrap_or(text).as_bytes());
    let fixed = fix(&Levels::default(), unsafe_too, &mut read);
    let left = fixed.findings.diags.iter().filter_map(|diag| diag.fix.as_ref()).any(|fix| fix.safe || unsafe_too);
    assert!(!left, "fixes without an end: {:?}", fixed.changed);
    (!fixed.made.is_empty()).then_some(fixed.checked)
}
