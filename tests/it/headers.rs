//! The headers that shipped posts print at the beginning of a program for the machinist. Without the header, the
//! program must be the same.

use std::fs;

use crate::support::{
    Kind, Rendered, assert_same, check, ready, render_ready, root, sample_job, samples, without_header,
};
use postform::internals::compile::Program;
use postform::internals::render::Options;
use postform::internals::sema::PropertyValue;
use postform::{Job, NoFiles, Post, Source};

/// The shipped posts, by their names.
fn posts() -> Vec<(String, String)> {
    let files = fs::read_dir(root().join("postforms")).unwrap().map(|entry| entry.unwrap().path());
    let name = |path: &std::path::Path| path.file_stem().unwrap().to_string_lossy().into_owned();
    files.map(|path| (name(&path), fs::read_to_string(&path).unwrap())).collect()
}

fn compiled(form: &str) -> Program {
    ready(&check(form)).unwrap()
}

fn print(form: &Program, job: &[u8], kind: Kind, header: Option<bool>) -> Result<Rendered, String> {
    let properties = header.map(|on| (0, PropertyValue::YesNo(on))).into_iter().collect();
    let options = Options { program: Some(1), properties, ..Options::default() };
    render_ready(form, job, kind, options).map_err(|diag| diag.message)
}

#[test]
fn without_its_header_a_program_is_byte_for_byte_what_it_was() {
    let mut programs = 0;
    for (name, form) in posts() {
        let (plain, form) = (compiled(&without_header(&form)), compiled(&form));
        for folder in samples() {
            let (path, kind) = sample_job(&folder);
            let job = fs::read(path).unwrap();
            let what = format!("{name} with {}", folder.display());
            // a job may turn off the header itself
            let bare = String::from_utf8_lossy(&job).replace("\"set\": {\"header\": false},", "");
            match (print(&plain, bare.as_bytes(), kind, None), print(&form, &job, kind, Some(false))) {
                (Ok(plain), Ok(off)) => assert_same(&what, &plain.text, &off.text),
                (plain, off) => assert_eq!(plain.map(|r| r.text), off.map(|r| r.text), "{what}"),
            }
            programs += 1;
        }
    }
    assert!(programs > 500, "{programs}");
}

/// With the header, a program has more comments, but no additional word.
#[test]
fn a_header_is_comments_alone() {
    let words = |text: &str, mark: char| -> Vec<String> {
        let block = |line: &str| {
            let block = line.split(mark).next().unwrap_or_default().trim_end();
            // the comments of the header change the block numbers, so the numbers are not compared
            let is_number = |word: &str| word.starts_with('N') || word.bytes().all(|byte| byte.is_ascii_digit());
            let words = block.split(' ').skip_while(|word| is_number(word));
            words.collect::<Vec<_>>().join(" ")
        };
        text.lines().map(block).filter(|block| !block.is_empty()).collect()
    };
    let mut longer = 0;
    for (name, form) in posts() {
        let mark = if form.contains("\nComment ;") { ';' } else { '(' };
        let form = compiled(&form);
        for folder in samples() {
            let (path, kind) = sample_job(&folder);
            let job = fs::read(path).unwrap();
            let both = [true, false].map(|on| print(&form, &job, kind, Some(on)));
            let [Ok(on), Ok(off)] = both else { continue };
            assert_eq!(words(&on.text, mark), words(&off.text, mark), "{name} with {}", folder.display());
            longer += usize::from(on.text.len() > off.text.len());
        }
    }
    assert!(longer > 200, "{longer}");
}

const JOB: &str = r#"{"postform": 1, "program": 7, "name": "HINGE (REV B)", "part": "Türband", "material": "S235", "units": "mm",
  "tools": [{"number": 1, "name": "DRILL 8", "diameter": 8}, {"number": 2, "diameter": 10, "comment": "END MILL"}, {"number": 3, "diameter": 6}],
  "operations": [
    {"tool": 1, "name": "Holes", "work": 54, "spindle": {"speed": 1200, "direction": "cw"}, "feed": 100,
     "path": [{"rapid": [10, 10, 30]}, {"cycle": {"kind": "drill", "depth": 15, "clear": 2, "return": 20, "feed": 100, "points": [[10, 10, 0]]}}]},
    {"tool": 2, "name": "Contour", "spindle": {"speed": 3000, "direction": "cw"}, "feed": 400,
     "path": [{"rapid": [0, 0, 30]}, {"rapid": [0, 0, 2]}, {"line": [0, 0, -2]}, {"line": [40, 20, -2]}, {"rapid": [40, 20, 30]}]},
    {"tool": 2, "comment": "SPRING CUT", "feed": 400, "path": [{"rapid": [0, 0, 30]}, {"rapid": [0, 0, 2]}, {"line": [40, 20, -2]}]},
    {"tool": 3, "work": 55, "spindle": {"speed": 3000, "direction": "cw"}, "feed": 400, "path": [{"rapid": [0, 0, 30]}, {"line": [0, 0, -1]}]}
  ]}"#;

#[test]
fn a_machinist_reads_what_comes() {
    let (_, form) = posts().into_iter().find(|(name, _)| name == "haas").unwrap();
    let printed = print(&compiled(&form), JOB.as_bytes(), Kind::Document, None).unwrap().text;
    let comments = printed.lines().filter_map(|line| Some(&line[line.find('(')?..])).collect::<Vec<_>>();
    let header = [
        "(HINGE [REV B])",
        "(PART TUERBAND)",
        "(MATERIAL S235)",
        "(G54 X0 TO 40, Y0 TO 20, Z-15 TO 2)",
        "(G55 X0 TO 0, Y0 TO 0, Z-1 TO 30)",
        "(T1 DRILL 8, D8)",
        "(- HOLES)",
        "(T2 END MILL, D10)",
        "(- CONTOUR)",
        "(- SPRING CUT)",
        "(T3 D6)",
    ];
    assert_eq!(comments[..header.len()], header);
    // and the comment at the beginning of each operation
    assert_eq!(comments[header.len()..], ["(HOLES)", "(CONTOUR)", "(SPRING CUT)"]);
}

#[test]
fn a_header_keeps_nobody_from_streaming() {
    for (name, form) in posts() {
        let post = Post::compile(Source::from_text(&name, &form), &NoFiles).unwrap();
        let mut options = postform::Options::default();
        assert!(post.reads_ahead(&options).unwrap(), "{name}");
        assert_eq!(post.reads_once_with().as_deref(), Some("header=no"), "{name}");
        options.properties.push(("header".into(), "off".into()));
        assert!(!post.reads_ahead(&options).unwrap(), "{name}");
        // a form with `T[nexttool]` may need to read the job twice, but not because of the header
        assert_eq!(post.may_read_twice(&options).unwrap(), form.contains("T[nexttool]"), "{name}");
        options.one_pass = true;
        options.proof = None;
        let mut on = options.clone();
        on.properties.clear();
        assert!(post.render(Job::json(JOB), &on).unwrap_err().to_string().contains("read only once"), "{name}");
        if name == "haas" {
            assert!(!post.render(Job::json(JOB), &options).unwrap().text().contains("DRILL"), "{name}");
        }
    }
}
