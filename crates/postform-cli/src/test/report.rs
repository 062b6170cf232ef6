//! Shows the result: as text, as JSON, as JUnit XML, or as annotations on GitHub.

use std::fmt::Write as _;

use postform::internals::report::{github_property, github_text};
use postform::internals::terminal::{escaped, escaped_lines};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};
use serde_json::json;

use super::super::files;
use super::super::output;
use super::super::report::count;
use super::case::{Case, End, Tried};
use super::coverage::Covered;
use super::posts::Posts;

/// The results of all cases.
pub struct Report<'a> {
    /// The cases.
    pub tried: &'a [Tried],
    /// Files that can't be a case.
    pub problems: &'a [String],
    /// The forms.
    pub posts: &'a Posts,
    /// The lines that no case prints, if requested.
    pub covered: Option<&'a [Covered]>,
}

impl Report<'_> {
    /// Whether there were no problems and all results are acceptable.
    pub fn is_clean(&self) -> bool {
        self.problems.is_empty() && self.tried.iter().all(|tried| tried.end.is_right())
    }

    /// The counts: `142 cases, 3 forms: 426 programs, 2 differ`.
    pub fn sentence(&self) -> String {
        let number = |list: Vec<String>| list.into_iter().collect::<std::collections::BTreeSet<_>>().len();
        let jobs = number(self.tried.iter().map(|tried| files::name(&tried.case.job)).collect());
        let forms = number(self.tried.iter().map(|tried| self.posts.first_of(tried.case.form).to_string()).collect());
        let of = |name: &str| self.tried.iter().filter(|tried| tried.end.name() == name).count();
        let mut text =
            format!("{}, {}: {}", count(jobs, "case"), count(forms, "form"), count(self.tried.len(), "program"));
        let differ = of("differs");
        for (number, what) in [
            (differ, if differ == 1 { "differs" } else { "differ" }),
            (of("failed"), "failed"),
            (of("written"), "written"),
            (self.tried.iter().filter(|tried| tried.unproven.is_some()).count(), "not proven"),
        ] {
            if number > 0 {
                _ = write!(text, ", {number} {what}");
            }
        }
        if !self.problems.is_empty() {
            _ = write!(text, "; {}", count(self.problems.len(), "problem"));
        }
        if self.is_clean() && of("written") == 0 {
            text += ", all as expected";
        }
        text
    }

    /// The text for people.
    pub fn pretty(&self) -> String {
        let mut text = String::new();
        for (form, entry) in self.posts.all().iter().enumerate() {
            let own = self.tried.iter().filter(|tried| tried.case.form == form).count();
            if let (Err(why), true) = (&entry.ready, own > 0) {
                _ = writeln!(
                    text,
                    "{}\nnone of the {} of this form is printed",
                    escaped_lines(why.trim_start_matches("error: ")),
                    count(own, "program")
                );
            }
            let is_tried = |tried: &Tried| self.posts.first_of(tried.case.form) == form;
            if self.posts.single.contains(&form) && !self.tried.iter().any(is_tried) {
                _ = writeln!(text, "{}: no job has an expected program of this form", files::name(&entry.path));
            }
        }
        for tried in self.tried.iter().filter(|tried| self.posts.get(tried.case.form).ready.is_ok()) {
            let head = self.head(&tried.case);
            match &tried.end {
                End::Passed => {}
                End::Differs { text: shown, .. } => _ = writeln!(text, "{shown}"),
                End::Failed(why) => _ = writeln!(text, "{head}:\n{}", escaped_lines(why.trim_end())),
                End::Written { text: why, file } => {
                    let (why, file) = (why.trim_end(), files::name(file));
                    let gone = if file == files::name(&tried.case.expected) {
                        String::new()
                    } else {
                        format!(" in place of {}", files::name(&tried.case.expected))
                    };
                    _ = match why {
                        "" => writeln!(text, "{file}: written{gone}"),
                        why => writeln!(text, "{head}:\n{why}\n{file}: written{gone}\n"),
                    };
                }
            }
        }
        for problem in self.problems {
            _ = writeln!(text, "{}", escaped_lines(problem));
        }
        let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
        for tried in self.tried {
            let Some(why) = tried.unproven.as_deref() else { continue };
            let head = self.head(&tried.case);
            match reasons.iter_mut().find(|(own, _)| *own == why) {
                Some((_, list)) => list.push(head),
                None => reasons.push((why, vec![head])),
            }
        }
        for (why, list) in reasons {
            let more = if list.len() > 1 { format!(" and {} more", list.len() - 1) } else { String::new() };
            _ = writeln!(text, "not proven: {}{more}: {}", list[0], escaped(why));
        }
        for covered in self.covered.unwrap_or_default() {
            let missing = covered.missing.len();
            let printed = covered.lines - missing;
            _ = writeln!(text, "{}: the cases print {printed} of {} lines", covered.form, covered.lines);
            for (file, line, shown) in &covered.missing {
                _ = writeln!(text, "  {file}:{line}: {}", escaped(shown));
            }
        }
        text + &self.sentence() + "\n"
    }

    /// One JSON document.
    pub fn json(&self) -> String {
        let programs: Vec<_> = self
            .tried
            .iter()
            .map(|tried| {
                let (message, line) = said(&tried.end);
                json!({
                    "job": files::name(&tried.case.job),
                    "form": self.form(&tried.case),
                    "expected": files::name(&tried.case.expected),
                    "result": tried.end.name(),
                    "not_proven": tried.unproven,
                    "message": message,
                    "line": line,
                })
            })
            .collect();
        let coverage = self.covered.map(|covered| {
            let form = |covered: &Covered| {
                let missing = covered.missing.iter();
                let missing: Vec<_> =
                    missing.map(|(file, line, text)| json!({ "file": file, "line": line, "text": text })).collect();
                json!({ "form": covered.form, "lines": covered.lines, "missing": missing })
            };
            covered.iter().map(form).collect::<Vec<_>>()
        });
        output::json(&json!({
            "programs": programs,
            "problems": self.problems,
            "coverage": coverage,
            "summary": self.sentence(),
        }))
    }

    /// JUnit XML, for CI systems.
    pub fn junit(&self) -> String {
        self.xml().map(|bytes| String::from_utf8_lossy(&bytes).into_owned() + "\n").unwrap_or_default()
    }

    fn xml(&self) -> std::io::Result<Vec<u8>> {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        let failed = self.tried.iter().filter(|tried| !tried.end.is_right()).count() + self.problems.len();
        let total = (self.tried.len() + self.problems.len()).to_string();
        let mut suite = BytesStart::new("testsuite");
        suite.push_attribute(("name", "postform"));
        suite.push_attribute(("tests", total.as_str()));
        suite.push_attribute(("failures", failed.to_string().as_str()));
        writer.write_event(Event::Start(suite))?;
        for tried in self.tried {
            let message = match &tried.end {
                end if end.is_right() => None,
                end => Some(said(end).0),
            };
            case(&mut writer, &self.form(&tried.case), &files::name(&tried.case.expected), message.as_deref())?;
        }
        for problem in self.problems {
            let name = problem.split(':').next().unwrap_or_default();
            case(&mut writer, "postform", name, Some(problem))?;
        }
        writer.write_event(Event::End(BytesEnd::new("testsuite")))?;
        Ok(writer.into_inner())
    }

    /// Commands for GitHub's runners; each marks a line of a file.
    pub fn github(&self) -> String {
        let mut text = String::new();
        for tried in self.tried.iter().filter(|tried| !tried.end.is_right()) {
            let (message, line) = said(&tried.end);
            let file = github_property(&files::name(&tried.case.expected));
            let message = github_text(&format!("{}\n{message}", self.head(&tried.case)));
            _ = writeln!(text, "::error file={file},line={}::{message}", line.unwrap_or(1));
        }
        for problem in self.problems {
            _ = writeln!(text, "::error::{}", github_text(problem));
        }
        text
    }

    fn form(&self, case: &Case) -> String {
        files::name(&self.posts.get(case.form).path)
    }

    fn head(&self, case: &Case) -> String {
        format!("{} by {}", files::name(&case.expected), self.form(case))
    }
}

/// The text of a result without colour, and the line of the expected program.
fn said(end: &End) -> (String, Option<usize>) {
    match end {
        End::Passed => (String::new(), None),
        End::Differs { text, line } => (text.clone(), Some(*line)),
        End::Failed(why) | End::Written { text: why, .. } => (why.trim_end().to_owned(), None),
    }
}

fn case(writer: &mut Writer<Vec<u8>>, form: &str, name: &str, failure: Option<&str>) -> std::io::Result<()> {
    let mut start = BytesStart::new("testcase");
    start.push_attribute(("classname", form));
    start.push_attribute(("name", name));
    let Some(message) = failure else { return writer.write_event(Event::Empty(start)) };
    writer.write_event(Event::Start(start))?;
    let mut failure = BytesStart::new("failure");
    let short = message.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or_default();
    failure.push_attribute(("message", short));
    writer.write_event(Event::Start(failure))?;
    // characters that XML does not allow are escaped
    writer.write_event(Event::Text(BytesText::new(&escaped_lines(message))))?;
    writer.write_event(Event::End(BytesEnd::new("failure")))?;
    writer.write_event(Event::End(BytesEnd::new("testcase")))
}
