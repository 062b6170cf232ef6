//! Pages that are made from tables are up to date, and every name has an explanation. `SAMPLES=overwrite cargo test
//! reference::` writes the pages again.

use crate::support;
use std::fs;

use crate::support::root;
use postform::diag::CODES;
use postform::internals::control::{self, Control};
use postform::internals::explain::{controls, explain, list, reference};
use postform::internals::lang::{COMMANDS, SEQUENCES, VARIABLES};

#[test]
fn generated_pages_are_current() {
    let pages = [
        ("commands.md", reference::commands()),
        ("variables.md", reference::variables()),
        ("sequences.md", reference::sequences()),
        ("rules/README.md", reference::rules()),
        ("controls/README.md", controls::index()),
    ];
    let controls = control::names().filter_map(Control::named);
    let controls = controls.map(|control| (format!("controls/{}.md", control.name()), controls::page(control)));
    let pages = pages.map(|(name, text)| (name.to_owned(), text)).into_iter().chain(controls);
    for (name, text) in pages {
        let path = root().join("docs").join(&name);
        if std::env::var("SAMPLES").is_ok_and(|v| v == "overwrite") {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, &text).unwrap();
        }
        let written = fs::read_to_string(&path).unwrap_or_default();
        assert!(written == text, "docs/{name} is not what the tables say: `just overwrite`");
    }
}

/// The lines of the example that `explain` shows for a command.
fn example(command: &str) -> String {
    let text = explain(command).unwrap();
    let example = text.split("Example, ").nth(1).unwrap_or_else(|| panic!("{command} has no example"));
    let lines = example.lines().skip(1).take_while(|line| line.starts_with("  "));
    let lines: String = lines.map(|line| format!("{}\n", line.trim())).collect();
    assert!(!lines.is_empty(), "{example}");
    lines
}

#[test]
fn everything_is_explained() {
    let all = list();
    for row in CODES {
        let text = explain(row.name).unwrap();
        let says_what_to_do = text.contains("Instead:") || text.contains("Better");
        assert!(says_what_to_do, "{} says too little: {text}", row.name);
        assert!(all.contains(row.name));
    }
    for row in COMMANDS {
        let text = explain(&row.name.to_uppercase()).unwrap();
        assert!(text.contains(row.meaning) && text.contains("standing"), "{}", row.name);
        // the example is valid: a form with it has no additional error
        let lines = example(row.name);
        let machine = if row.meaning.contains("torch") { "Machine Torch\n" } else { "" };
        let form = support::check(&format!("{machine}{lines}{}", support::mill("", "")));
        let errors: Vec<_> = form.diags.iter().filter(|diag| diag.is_error()).map(|diag| diag.code.name()).collect();
        let elsewhere = ["PF005", "PF009", "PF019", "PF021", "PF603", "PF604"]; // a missing file, another machine
        assert!(errors.iter().all(|code| elsewhere.contains(code)), "{}: {errors:?}\n{lines}", row.name);
    }
    for (code, function, control) in
        [("G81", "makes a hole", "haas"), ("m0", "stops the program", "grbl"), ("G41", "left", "fanuc")]
    {
        let text = explain(code).unwrap();
        assert!(text.contains(function) && text.contains(control), "{text}");
    }
    assert!(explain("G81").unwrap().lines().all(|line| !line.contains("siemens,")), "a Siemens has no G81 of its own");
    for row in VARIABLES {
        let text = explain(&format!("[{}]", row.name)).unwrap();
        assert!(text.contains(row.meaning) && text.contains("Example"), "{}", row.name);
        assert!(explain(row.name).unwrap().contains(row.meaning));
    }
    for row in SEQUENCES {
        let text = explain(row.name).unwrap();
        assert!(text.contains(row.meaning) && text.contains("Example"), "{}: {text}", row.name);
    }
    for (name, _) in postform::toolpath::CycleKind::NAMES {
        assert!(explain(name).unwrap().contains("cycle of a job"), "{name}");
    }
    for line in ["Back 3", "Force X Z", "Drill 7"] {
        assert_eq!(explain(line), explain(line.split(' ').next().unwrap()));
    }
    for upon in ["Upon", "upon every", "Upon [work]"] {
        assert!(explain(upon).unwrap().contains("when a variable changes"), "{upon}");
    }
    assert_eq!(explain("X[h]"), explain("[h]"));
    assert!(explain("End Cancel").unwrap().contains("End (of a sequence)"));
    assert!(explain("None").unwrap().contains("prints no block"));
}

/// A wrong text replaces an argument of a command, stands before it, or replaces one of its parts. The check gives
/// findings and never a panic.
#[test]
fn every_argument_of_a_command_may_be_wrong() {
    let wrong = ["\u{a1}", "", "\"", "1e999", "-1", "99999999999999999999", ".", "\u{1f529}", "NaN"];
    let mut tried = 0;
    for example in COMMANDS.iter().map(|row| example(row.name)) {
        for line in example.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            for (at, word) in words.iter().enumerate().skip(1) {
                let first = word.chars().next().map_or(0, char::len_utf8);
                let (first, rest) = word.split_at(first);
                let lines: Vec<String> = wrong
                    .iter()
                    .flat_map(|wrong| {
                        [wrong.to_string(), [wrong, *word].concat(), [wrong, rest].concat(), [first, wrong].concat()]
                    })
                    .map(|wrong| [&words[..at], &[&wrong], &words[at + 1..]].concat().join(" "))
                    .collect();
                tried += lines.len();
                support::check(&lines.join("\n"));
            }
        }
    }
    assert!(tried > 36 * COMMANDS.len(), "{tried}");
}

/// The defaults in the reference and in `explain` are correct: if a form contains them as commands, nothing changes.
#[test]
fn defaults_are_those_of_the_reference() {
    let page = fs::read_to_string(root().join("docs/commands.md")).unwrap();
    let rows: Vec<Vec<&str>> = page.lines().skip_while(|l| !l.starts_with("| ---")).skip(1).map(cells).collect();
    assert_eq!(rows.len(), COMMANDS.len());
    for row in &rows {
        let nothing = if row[2] == "-" { "nothing" } else { row[2] };
        assert!(explain(row[0]).unwrap().contains(&format!("without   {nothing}\n")), "{row:?}");
    }
    for (machine, units) in ["Mill", "Lathe", "EDM"].iter().flat_map(|m| ["inch", "mm", "both"].map(|u| (*m, u))) {
        let head = format!("Machine {machine}\nUnits {units}\n");
        let said: String = rows.iter().flat_map(|row| commands_of(row[0], row[2], machine, units)).collect();
        assert!(said.contains("Rapid G0\n") && said.lines().count() > 55, "{said}");
        let settings = |text: &str| {
            let form = support::check(text);
            let wrong: Vec<_> = form.diags.iter().filter(|diag| diag.code == postform::diag::Code::PF302).collect();
            assert!(wrong.is_empty(), "{machine} {units}: {wrong:?}");
            without_typed(&format!("{:?}", form.form.settings)).replace(", ", ",\n")
        };
        same_lines(&settings(&head), &settings(&format!("{head}{said}")), &format!("{machine} {units}"));
    }
}

/// The cells of a row in a table, without code marks.
fn cells(line: &str) -> Vec<&str> {
    line.trim_matches('|').split(" | ").map(|cell| cell.trim().trim_matches('`')).collect()
}

/// The commands for a cell of defaults, such as `X; lathe Z`, `inch deep 1, thru 1; mm deep 2, thru 2`.
fn commands_of(name: &str, cell: &str, machine: &str, units: &str) -> Vec<String> {
    // the defaults of these commands are described in words, or depend on other commands
    if ["Machine", "Units", "Control", "ModalLetters", "CycleSinkClear"].contains(&name) || cell == "-" {
        return vec![];
    }
    let columns: Vec<&str> = cell.split("; ").collect();
    let of = |column: &str| columns.iter().find_map(|said| said.strip_prefix(column)?.strip_prefix(' '));
    let usual = columns[0];
    let others = ["inch ", "mm "].iter().any(|column| usual.starts_with(column));
    let arguments = of(&machine.to_lowercase()).or(of(units)).or((!others).then_some(usual)).unwrap_or("");
    arguments.split(", ").filter(|said| !said.is_empty()).map(|said| format!("{name} {said}\n")).collect()
}

/// Settings as text, without the original spelling of codes.
fn without_typed(settings: &str) -> String {
    let mut parts = settings.split("text: Some(");
    let first = parts.next().unwrap_or("").to_owned();
    parts.fold(first, |all, part| all + "text: None" + part.split_once(')').unwrap().1)
}

fn same_lines(left: &str, right: &str, what: &str) {
    let differing: Vec<_> = left.lines().zip(right.lines()).filter(|(left, right)| left != right).collect();
    assert!(left == right, "{what}: {differing:#?}");
}

#[test]
fn near_misses_are_suggested() {
    assert_eq!(explain("vlcear").unwrap_err(), "did you mean `vclear`?");
    assert_eq!(explain("Dril").unwrap_err(), "did you mean `Drill`?");
    assert_eq!(explain("cycle.depth.mising").unwrap_err(), "did you mean `cycle.depth.missing`?");
    assert!(explain("zzzzzzzzzz").unwrap_err().contains("--list"));
    assert!(explain("").is_err());
}
