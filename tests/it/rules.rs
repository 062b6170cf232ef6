//! The pages of docs/rules as tests. The example has the finding, the corrected form is clean, and the fix has the
//! described effect. Fixes and suppressions are tested with all shipped forms.

use crate::support;
use std::collections::BTreeSet;
use std::fs;

use crate::support::pages::{Fence, Page, after_fixes, checked, codes, found};
use crate::support::{mill, root, sample_form, samples};
use postform::diag::{CODES, Code, CodeRow, Diag, Severity};
use postform::internals::compile::Program;
use postform::internals::lint::{Level, Levels, RULES, lint};
use postform::internals::render::Options;
use proptest::prelude::*;

fn forms() -> impl Iterator<Item = &'static CodeRow> {
    CODES.iter().filter(|row| row.name.starts_with("PF"))
}

/// The rules to test: all, or only the one in the variable RULE, for use while a rule is written.
fn tested() -> Vec<&'static CodeRow> {
    let only = std::env::var("RULE").ok();
    let rows: Vec<_> = forms().filter(|row| only.as_deref().is_none_or(|only| only == row.name)).collect();
    assert!(!rows.is_empty(), "RULE={} is no rule", only.unwrap_or_default());
    rows
}

fn files(folder: &str, extension: &str) -> BTreeSet<String> {
    let names = fs::read_dir(root().join(folder)).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    names.filter_map(|name| Some(name.strip_suffix(extension)?.to_owned())).collect()
}

#[test]
fn codes_pages_and_files_are_one_to_one() {
    let pages = forms().map(|row| row.name.to_owned()).chain(["README".to_owned()]).collect();
    assert_eq!(files("docs/rules", ".md"), pages);
    let own = RULES.iter().map(|rule| rule.file.to_owned()).chain(["mod".to_owned()]).collect();
    assert_eq!(files("src/lint/rules", ".rs"), own);
    let numbered: BTreeSet<Code> = RULES.iter().map(|rule| rule.code).collect();
    assert_eq!(numbered.len(), RULES.len(), "a code with two rules");
    assert!(RULES.len() >= 45);
    assert!(RULES.windows(2).all(|pair| pair[0].code < pair[1].code), "in the order of the codes");
}

#[test]
fn pages_have_their_headings_and_titles() {
    for row in tested() {
        let page = Page::read(row.name);
        assert_eq!(page.title, format!("# {}: {}", row.name, row.title));
        let headings: Vec<&str> = page.sections.iter().map(|(heading, _)| heading.as_str()).collect();
        assert_eq!(
            headings,
            ["What it finds", "Why it matters at the machine", "Example", "Better", "Fix"],
            "{}",
            row.name
        );
    }
}

#[test]
fn examples_are_found_and_better_forms_are_clean() {
    let mut wrong = Vec::new();
    for row in tested() {
        let page = Page::read(row.name);
        let example = found(&page.fence("Example").checked()).diags;
        if codes(&example) != [row.name] {
            wrong.push(format!("{} example: {:?}", row.name, codes(&example)));
        }
        let better = found(&page.fence("Better").checked());
        if !better.diags.is_empty() {
            wrong.push(format!("{} better: {:?}", row.name, codes(&better.diags)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn fixes_do_what_their_pages_say() {
    for row in tested() {
        let page = Page::read(row.name);
        let form = page.fence("Example").checked();
        let kinds: Vec<&str> = found(&form)
            .diags
            .iter()
            .filter(|diag| diag.code == row.code)
            .map(|diag| match &diag.fix {
                None => "There is no automatic fix.",
                Some(fix) if fix.safe => "Safe:",
                Some(_) => "Unsafe:",
            })
            .collect();
        let none = "There is no automatic fix.";
        let fix = page.section("Fix");
        let said = if fix.starts_with(none) { none } else { fix.split(' ').next().unwrap() };
        assert!(kinds.iter().all(|kind| *kind == said), "{}: the page says {said}, the rule {kinds:?}", row.name);
        if said != none {
            let after = after_fixes(&form, true).unwrap();
            assert_eq!(codes(&found(&after).diags), Vec::<&str>::new(), "{}\n{}", row.name, after.files[0].text);
        }
    }
}

/// The program of a sample by a form, or the error.
fn program(folder: &std::path::Path, form: &Result<Program, Box<Diag>>) -> Result<String, String> {
    let options = Options { program: Some(1), ..Options::default() };
    match support::render_ready_sample(folder, form, options) {
        Ok(rendered) => Ok(rendered.text),
        Err(diag) => Err(format!("{} {}", diag.code.name(), diag.message)),
    }
}

/// All shipped forms and all forms on the pages.
fn all_forms() -> Vec<(String, Vec<u8>)> {
    let mut forms: Vec<(String, Vec<u8>)> = Vec::new();
    let posts = fs::read_dir(root().join("postforms")).unwrap().map(|e| e.unwrap().path());
    for path in posts.chain(samples().iter().filter_map(|folder| sample_form(folder))) {
        forms.push((path.display().to_string(), fs::read(&path).unwrap()));
    }
    for row in self::forms() {
        let page = Page::read(row.name);
        forms.extend(["Example", "Better"].map(|part| (format!("{} {part}", row.name), page.fence(part).form())));
    }
    forms
}

#[test]
fn safe_fixes_remove_their_findings_and_change_no_byte_of_any_sample() {
    let mut fixed = 0;
    for (name, bytes) in all_forms() {
        let form = checked(&bytes);
        let Some(after) = after_fixes(&form, false) else { continue };
        fixed += 1;
        assert!(found(&after).diags.iter().all(|diag| diag.fix.as_ref().is_none_or(|fix| !fix.safe)), "{name}");
        let (form, after) = (support::ready(&form), support::ready(&after));
        for folder in samples() {
            let (before, now) = (program(&folder, &form), program(&folder, &after));
            // locations in messages change with the text, codes and programs do not
            assert_eq!(before, now, "{name} with {}", folder.display());
        }
    }
    assert!(fixed >= 10, "only {fixed} forms had something to fix");
}

#[test]
fn unsafe_fixes_remove_their_findings() {
    let mut fixed = 0;
    for (name, bytes) in all_forms() {
        let form = checked(&bytes);
        let Some(after) = after_fixes(&form, true) else { continue };
        fixed += 1;
        assert!(found(&after).diags.iter().all(|diag| diag.fix.is_none()), "{name}");
    }
    assert!(fixed >= 15, "only {fixed} forms had something to fix");
}

/// The rules find the manual's misprints in forms, and its five dangerous examples.
#[test]
fn misprints_and_dangerous_examples_of_the_manual_have_their_rules() {
    let table = [
        ("Z[d]F[plunge] without a blank", "Bore\nG0 X[h] Y[v] Z[rplane]\nG1 Z[d]F[plunge]\nZ[rplane]\nEnd", "PF102"),
        ("Y[v]. with a stray point", "LineCode\nG1 X[h] Y[v]. Z[d] F[frate]\nEnd", "PF001"),
        ("F[speed] in LTap", "LTap\nG84 X[h] Y[v] Z[d] R[vclear] F[speed]\nEnd Cancel", "PF313"),
        ("CwCode with G3", "CwCode\nG3 X[h] Y[v] I[ival] J[jval] F[frate]\nEnd", "PF432"),
        ("CwCode with four blanks", "CwCode\nG2 X[h] Y[v]    I[ival] J[jval] F[frate]\nEnd", "PF101"),
        (
            "Bore's example headed Back 4",
            "Back 4\nF[frate]\nG306 Z0\nG308 Z[d]\nG323 P.5\nG85 X[h] Y[v]\nEnd Cancel",
            "PF414",
        ),
        (
            "both under one name",
            "Back 3\nF[frate]\nG306 Z0\nG308 Z[d]\nG85 X[h] Y[v]\nEnd Cancel\nBack 4\nF[frate]\nG306 Z0\nG308 Z[d]\nG323 P.5\nG85 X[h] Y[v]\nEnd Cancel",
            "PF004",
        ),
        (
            "Custom1's example without its count",
            "Custom1\nG83 G99 R[vclear] Z[d] X[h] Y[v] F[frate]\nZ[d] R[vclear] X[h] Y[v]\nEnd Cancel",
            "PF404",
        ),
        (
            "Back emulated with End Cancel",
            "Back\nG0 X[h] Y[v]\nZ[rplane]\nG1 Z[d] F[plunge]\nG0 Z[rplane]\nEnd Cancel",
            "PF403",
        ),
        (
            "Bore emulated with End Cancel",
            "Bore\nG0 X[h] Y[v]\nZ[rplane]\nG1 Z[d] F[plunge]\nZ[rplane]\nEnd Cancel",
            "PF403",
        ),
        // the dangerous examples
        (
            "Upon [work] prints X Y Z while G91 is on",
            "Upon [work]\nG91 G28 Z0\nG[work]\nX[h] Y[v] Z[d]\nG90\nEnd",
            "PF423",
        ),
        (
            "Index: G28 without G91",
            "Index\nG0 G28 G49 Z0\nG[work] X[h] Y[v] A[rotangle]\nG43 H[lcomp] Z[d]\nEnd",
            "PF422",
        ),
        (
            "Unwind: G28 without G91",
            "Unwind\nG0 G28 G49 Z0\nG0 G90 A0\nG43 H[lcomp] Z[d]\nG0 X[lasth] Y[lastv] A[lastrotangle]\nG1 Z[lastd]\nEnd",
            "PF422",
        ),
        (
            "Unwind goes down before it positions",
            "Unwind\nG0 G28 G49 Z0\nG0 G90 A0\nG43 H[lcomp] Z[d]\nG0 X[lasth] Y[lastv] A[lastrotangle]\nG1 Z[lastd]\nEnd",
            "PF421",
        ),
        (
            "emulated LTap feeds out without reversing the spindle",
            "LTap\nG0 X[h] Y[v] Z[rplane]\nG1 Z[d] F[frate]\nZ[rplane]\nEnd",
            "PF419",
        ),
    ];
    for (what, sequences, code) in table {
        let diags = found(&checked(mill("", sequences).as_bytes())).diags;
        assert!(codes(&diags).contains(&code), "{what}: {:?}", codes(&diags));
    }
    // the fifth dangerous example: a tool change that prints H without G43
    let text = mill("", "").replace("X[h] Y[v] Z[d]", "X[h] Y[v]\nZ[d] H[Lcomp]");
    assert!(codes(&found(&checked(text.as_bytes())).diags).contains(&"PF426"));
}

#[test]
fn comments_allow_findings_where_they_stand() {
    let allowed = |text: &str| {
        let findings = found(&checked(mill("", text).as_bytes()));
        let own = |code: &&str| ["PF108", "PF109", "PF418", "PF001"].contains(code);
        (codes(&findings.diags).into_iter().filter(own).collect::<Vec<_>>(), findings.suppressed)
    };
    let line = "G1 X[h] Y[v] Z[d]";
    assert_eq!(allowed(&format!("LineCode\n{line}\nEnd")), (vec!["PF418"], 0));
    assert_eq!(allowed(&format!("LineCode\n{line} # postform: allow PF418\nEnd")), (vec![], 1));
    assert_eq!(allowed(&format!("LineCode\n# postform: allow PF418\n\n{line}\nEnd")), (vec![], 1));
    assert_eq!(allowed(&format!("# POSTFORM: Allow pf303, PF418\nLineCode\n{line} B[rotangle]\nEnd")), (vec![], 2));
    assert_eq!(
        allowed(&format!("# postform: allow PF418\n\nRapidCode\nG0 X[h] Y[v] Z[d]\nEnd\nLineCode\n{line}\nEnd")).0,
        ["PF108", "PF418"]
    );
    assert_eq!(allowed(&format!("# postform: allow PF41\nLineCode\n{line}\nEnd")).0, ["PF109", "PF418"]);
    assert_eq!(allowed(&format!("LineCode\n{line} # postform: allow PF418 one feed for all\nEnd")), (vec![], 1));
    assert_eq!(allowed(&format!("LineCode\n{line} # postform allow PF418\nEnd")).0, ["PF109", "PF418"]);
    assert_eq!(allowed("LineCode\nG1 X[h] Y[v]. Z[d] F[frate] # postform: allow PF001\nEnd").0, ["PF001", "PF108"]);
}

#[test]
fn a_comment_at_the_head_allows_findings_of_the_whole_file() {
    let allowed = |head: &str, sequence: &str| {
        let findings = found(&checked(format!("{head}{}", mill("", sequence)).as_bytes()));
        let own = |code: &&str| ["PF108", "PF109", "PF418", "PF001"].contains(code);
        (codes(&findings.diags).into_iter().filter(own).collect::<Vec<_>>(), findings.suppressed)
    };
    let twice = "LineCode\nG1 X[h] Y[v] Z[d]\nG1 X[h] Y[v] Z[d]\nEnd";
    let plain = allowed("", twice);
    assert!(plain.0.contains(&"PF418") && plain.1 == 0, "{plain:?}");
    let head = "# our router\n\n# postform: allow-file PF418 its feed is set by hand\n";
    assert_eq!(allowed(head, twice), (vec![], plain.0.len()));
    // an additional allowance for one line is not reported as unused
    assert_eq!(allowed(head, &format!("# postform: allow PF418\n{twice}")), (vec![], plain.0.len()));
    // three wrong allowances: without a finding, for an error, and at a wrong position
    assert_eq!(allowed(head, "").0, ["PF108"]);
    let error = "LineCode\nG1 X[h] Y[v]. Z[d] F[frate]\nEnd";
    assert_eq!(allowed("# postform: allow-file PF001\n", error).0, ["PF001", "PF108"]);
    assert_eq!(allowed("Name A\n# postform: allow-file PF418\n", twice).0, [vec!["PF109"], plain.0].concat());
}

#[test]
fn levels_change_what_findings_count_as() {
    let form = Page::read("PF418").fence("Example").checked();
    let with = |rule: &str, level: &str| {
        let mut levels = Levels::default();
        levels.set(rule, Level::parse(level).unwrap()).unwrap();
        let found = lint(&form, &levels);
        found.diags.iter().map(|diag| diag.severity).collect::<Vec<_>>()
    };
    assert_eq!(with("PF418", "off"), []);
    assert_eq!(with("PF4", "error"), [Severity::Error]);
    assert_eq!(with("PF418", "note"), [Severity::Note]);
}

static FORMS: std::sync::LazyLock<Vec<(String, Vec<u8>)>> = std::sync::LazyLock::new(all_forms);

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    /// For randomly changed shipped forms, lint, fixes and layout all end without a panic. The fuzz target tests
    /// millions of changed forms.
    #[test]
    fn mutated_forms_are_looked_at_to_their_end(
        which in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0..6u8, any::<char>(), any::<prop::sample::Index>()), 1..8),
    ) {
        let (_, bytes) = which.get(FORMS.as_slice());
        let mut text: Vec<char> = String::from_utf8_lossy(bytes).chars().collect();
        for (at, kind, c, other) in changes {
            if text.is_empty() { break }
            let (at, other) = (at.index(text.len()), other.index(text.len()));
            match kind {
                0 => _ = text.remove(at),
                1 => text.insert(at, c),
                2 => text.insert(at, [' ', '\t', '\n', '[', ']', '(', ')', '#', '<', '%'][other % 10]),
                3 => text.swap(at, other),
                4 => text.truncate(at),
                _ => { let piece: Vec<char> = text[at..text.len().min(at + 30)].to_vec(); text.splice(other..other, piece); }
            }
        }
        let text: String = text.into_iter().collect();
        let form = checked(text.as_bytes());
        for diag in found(&form).diags {
            for label in &diag.labels {
                let source = &form.files[label.span.file as usize];
                prop_assert!(source.text.get(label.span.range()).is_some(), "{:?}", diag);
            }
        }
        after_fixes(&form, true);
        postform::internals::fmt::format(&form.files[0]);
    }
}

/// Correct but unusual forms have no warnings, so that authors can trust a warning.
#[test]
fn right_forms_are_left_alone() {
    let cycle = "G[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]";
    let table = [
        ("lathe", "Peck\nG83 Z[d] R[vclear] Q[vbite*10000] F[frate]\nEnd Cancel\nCancel\nG80\nEnd".to_owned()),
        ("", "EndCode\nM9\nM5\nG91 G28 Z0.\nG28 X0. Y0.\nM30\n%0\nEnd".into()),
        ("", "EndCode\nM9\nG91 G28 Z0 M5\nG90\nM30\n(END)\n%0\nEnd".into()),
        ("", "1stToolChange\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43.4 H[lcomp] Z[d] M[cool]\nEnd".into()),
        ("", "1stToolChange\nT[tool] T[nexttool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd".into()),
        ("", "StartCode\n%0\nO[program#]\nG[unitmode] G0 G17 G40 G49 G54 G80 G90\nG10 L2 P1 X0 Y0 Z0\nEnd".into()),
        ("", format!("Drill\n{cycle}\nG80\nEnd")),
        ("", "Tap\nG0 X[h] Y[v]\nZ[vclear]\nG33.1 Z[d] K[pitch]\nEnd".into()),
        ("", "Tap 1\nG[retplane] G84.2 X[h] Y[v] Z[d] R[vclear] F[frate]\nX[h] Y[v] Z[d]\nEnd Cancel".into()),
        ("", "SubStart\nO[sub]\nEnd\nSubCall\nM98 P[sub]\nEnd\nSubEnd\nO[sub] endsub\nEnd".into()),
        ("", "InFeed\nG1 G[side] D[tool] X[h] Y[v] F[frate]\nEnd".into()),
        ("", "Drill 1\nG66 P9010 Z[d] R[vclear] F[frate]\nX[h] Y[v]\nEnd Cancel\nCancel\nG67\nEnd".into()),
        ("", "Ask val1 \"Height over the part\" 2\n\n1stToolChange\nT[tool] M6\nG[work] G0 X[h] Y[v] A[rotangle] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd\nToolChange\nM9\nG91 G28 Z0 M5\nG90\nT[tool] M6\nG[work] G0 X[h] Y[v] A[rotangle] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd\nIndex\nG0 Z[val1]\nA[rotangle]\nX[h] Y[v]\nZ[d]\nEnd".into()),
        ("", "Comment ;\n\nStartCode\n%0\nO[program#]\nG[unitmode] G17 G40 G49 G80 G90\n; G28 Z0 first\nEnd".into()),
        ("", "Comment ;\n\nBeginRow\nM8 ; not M9, X1 X2 G54 G55 GO M3O Z[d]F[frate]\nEnd\nEndCode\nM9\nM30\n; END OF [program#]\n%0\nEnd".into()),
        ("", "StartCode\n%0\nO[program#]\nG[unitmode] G17 G40 G49 G80 G90\nG4 X1.\nEnd".into()),
        ("", "Drill\nG0 X[h] Y[v]\nZ[vclear]\nG1 Z[d] F[frate]\nG0 G53 Z0\nEnd".into()),
        ("", "Drill\nG0 X[h] Y[v]\nG308 Z[d] F[frate]\nG0 Z[rplane]\nEnd".into()),
        ("", "Rename d D\nd >3\n\nInFeed\nG1 G[side] d[dcomp] X[h] Y[v] F[frate]\nEnd".into()),
        ("grbl", "EndCode\nM9\nM5\nG28.1\nM2\nEnd".into()),
        ("", "Drill\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate] K2\nEnd Cancel".into()),
        ("", "Drill   straight holes\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel".into()),
        ("", "BeginRow\nTOOL CALL [tool] Z\nEnd".into()),
        ("", "Drill 1\nG[retplane] G81 Z[d] R[vclear] F[frate] K0\nX[h] Y[v]\nEnd Cancel".into()),
        ("", "Tap\nG0 X[h] Y[v]\nZ[vclear]\nG1 Z[d] F[frate]\nM4\nZ[vclear]\nM3\nG0 Z[rplane]\nEnd".into()),
        ("", "EndCode\nM9 M5\nG65 P1000\nG53 G0 X-10. Y0.\nM30\n%0\nEnd".into()),
        ("", "EndCode\nM9 M5\nG91 G0 Z0.\nG28 Z0\nG28 X0 Y0\nG90\nM30\n%0\nEnd".into()),
        ("lathe", "CwCode\nG2 X[v] Z[h] I[jval] K[ival] F[frate]\nEnd".into()),
        ("", "EndCode\nM9\n/G91 G28 Z0 M5\nG90\nM30\n%0\nEnd".into()),
        ("", "StartCode\n%0\nO[program#]\nG[unitmode] G17 G40 G49 G80 G90\nG65 P9810 Z0.5\nG68 X0 Y0 R0\nG50.1 X0\nG05.1 Q1 R1\nR1 = [toold]\nEnd".into()),
        ("", "1stToolChange\nG65 P9020 T[tool]\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H#518 Z[d] M[cool]\nEnd".into()),
        ("", "Tap\nG77 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd".into()),
        ("", "Tap\nG95 G[retplane] G84 X[h] Y[v] Z[d] R[vclear] F[pitch]\nEnd Cancel\nCancel\nG80 G94\nEnd".into()),
        ("", "Drill   118 deg\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel".into()),
        ("", "Custom1   Own way of Kim\nG[retplane] G82 X[h] Y[v] Z[d] R[vclear] P[dwell] F[frate]\nEnd Cancel".into()),
        ("", "BeginRow\nIF GO TO 5\nCALL OO88\nEnd".into()),
        ("lathe", "Peck\nG74 R0.02\nG74 Z[d] Q[vbite*10000] F[frate]\nEnd".into()),
        ("", "Spindle M3 M4 M5\nRapid G00\n\nBeginRow\nM8\nEnd".into()),
        ("grbl", "ToolChange\nM9\nM5\nG0 G53 Z0\nT[tool]\nM0\nG[work]\nS[speed] M[direct]\nM[cool]\nG0 X[h] Y[v]\nZ[d]\nEnd".into()),
        ("", "Drill\nG0 X[h] Y[v]\nZ[vclear]\nG1 Z[d] F[frate]\nG0 Z[rplane]\nEnd".into()),
        // the form prints the code of its units
        ("", "Units inch\n\nStartCode\n%0\nO[program#]\nG20 G17 G40 G49 G80 G90\nEnd".into()),
        ("", "Units mm\n\nStartCode\n%0\nO[program#]\nG[unitmode] G17 G40 G49 G80 G90\nEnd".into()),
        // the old tool retracts in a macro, by a code of the machine's builder, or at the end of its operation
        ("", "ToolChange\nM9\nG65 P9001\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd".into()),
        ("", "ToolChange\nM9\nM425\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd".into()),
        ("", "ToolChange\nM9\nG91 G28 Z0 T[tool] M6\nG90\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd".into()),
        ("", "ToolChange\nM9\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd\nEndOperation\nG0 G53 Z0\nEnd".into()),
        // each branch starts the spindle after its own tool change
        ("", "1stToolChange\n@if [tool] > 100\nG65 P[tool]\nS[speed] M[direct]\n@else\nT[tool] M6\nS[speed] M[direct]\n@end\nG[work] G0 X[h] Y[v]\nG43 H[lcomp] Z[d] M[cool]\nEnd".into()),
    ];
    for (kind, text) in table {
        let fence = Fence { kind: kind.to_owned(), text };
        let mut found = found(&fence.checked()).diags;
        found.retain(|diag| diag.code != Code::PF608); // a code that is not described anywhere may be correct
        assert!(
            found.is_empty(),
            "{}\n{:?}",
            fence.text,
            found.iter().map(|d| (d.code, &d.message)).collect::<Vec<_>>()
        );
    }
}

/// If DwellBlock prints the dwells, the letter of `Dwell` needs no decimals.
#[test]
fn a_dwell_by_its_sequence_needs_no_format() {
    let fanuc = fs::read_to_string(root().join("postforms/fanuc.pf")).unwrap();
    let plain = fanuc.replace(" P[dwell]", "").replace("Dwell G4 P ms", "Dwell G4 F s").replace("F >5.>4", "F >5.>1");
    let seconds = |text: &str| {
        let found = found(&support::check(text)).diags;
        found.iter().any(|diag| diag.code == Code::PF306 && diag.message.contains("a dwell in seconds"))
    };
    assert!(seconds(&plain) && !seconds(&format!("{plain}\nDwellBlock\n(WAIT [dwell])\nEnd\n")));
}

/// If the unit of the dwell is not that of the control, only this is reported, not the missing decimals of seconds.
#[test]
fn a_dwell_in_the_wrong_unit_needs_no_decimals() {
    let fanuc = fs::read_to_string(root().join("postforms/fanuc.pf")).unwrap();
    let found = found(&support::check(&fanuc.replace("Dwell G4 P ms", "Dwell G04 P s"))).diags;
    assert_eq!(found.iter().map(|diag| diag.code).collect::<Vec<_>>(), [Code::PF311]);
}

/// The rules also find variants of the mistakes on the pages.
#[test]
fn mistakes_are_found_in_other_words_too() {
    let table = [
        ("PF415", "Drill\nX[h] Y[v]\nZ[d] F[frate]\nG0 Z[rplane]\nEnd"),
        ("PF407", "Drill 1\nG[retplane] G81 X[h] Y[v] R[vclear] F[frate]\nX[h] Y[v] Z[d]\nEnd Cancel"),
        ("PF411", "Drill 1\nG[retplane] G81 X[h] Y[v] Z[d] F[frate]\nX[h] Y[v] R[vclear]\nEnd Cancel"),
        ("PF416", "Drill\nG0 X[h] Z[vclear]\nY[v]\nG1 F[frate] Z[d]\nG0 Z[rplane]\nEnd"),
        ("PF420", "Index\nG1 Z-5. F[frate]\nG0 A[rotangle]\nX[h] Y[v]\nZ[d]\nEnd"),
        ("PF423", "Index\nG91 G28 Z0\nA[rotangle]\nG90\nX[h] Y[v]\nZ[d]\nEnd"),
        (
            "PF425",
            "1stToolChange\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 Z[d]\nH[lcomp] M[cool]\nEnd",
        ),
        (
            "PF427",
            "1stToolChange\n@if [speed] > 0\nS[speed] M[direct]\n@end\nT[tool] M6\nG[work] G0 X[h] Y[v]\nG43 H[lcomp] Z[d]\nEnd",
        ),
        (
            "PF427",
            "1stToolChange\nT[tool] M6\nS[speed] M[direct]\n@if [work] > 54\nM5\n@end\nG[work] G0 X[h] Y[v]\nG43 H[lcomp] Z[d]\nEnd",
        ),
        ("PF427", "1stToolChange\nS[speed] M13\nT[tool] M06\nG[work] G0 X[h] Y[v]\nG43 H[lcomp] Z[d]\nEnd"),
        ("PF429", "1stToolChange\nT1 M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd"),
        ("PF431", "CwCode\nG2 X[h] Y[v] I[ival] F[frate]\nEnd"),
        ("PF436", "CcwCode\nG1 X[h] Y[v] I[ival] J[jval] F[frate]\nEnd"),
        ("PF505", "BeginRow\nM8 M9\nEnd"),
        ("PF313", "BeginRow\nS[tool]\nEnd"),
        ("PF306", "BeginRow\nL[toold]\nEnd"),
        ("PF408", "Drill 1\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nX[h]\nEnd Cancel"),
        ("PF012", "Upon [cool]\nEnd"),
        ("PF413", "Custom1   Deep\nG[retplane] G83 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel"),
        ("PF414", "Custom1   Deep\nG[retplane] G84 X[h] Y[v] Z[d] R[vclear] Q[vbite] F[frate]\nEnd Cancel"),
        ("PF418", "Index\nG0 G53 Z0\nA[rotangle]\nX[h] Y[v]\nG1 Z[d]\nEnd"),
        ("PF112", "BeginRow\nFF[frate]\nEnd"),
        ("PF112", "StartCode\n%0\n0[program#]\nG[unitmode] G17 G40 G49 G80 G90\nEnd"),
        ("PF112", "Drill\nG81 X[h] Y[v] Z[d] R[vclear] [frate]\nEnd Cancel"),
        ("PF112", "LineCode\nG 1 X[h] Y[v] Z[d] F[frate]\nEnd"),
        ("PF001", "1stToolChange\nT0[tool] M6\nG[work] G0 X[h] Y[v]\nG43 H[lcomp] Z[d]\nEnd"),
        ("PF001", "1stToolChange\nT[tool]\u{a0}M6\nG[work] G0 X[h] Y[v]\nG43 H[lcomp] Z[d]\nEnd"),
        ("PF020", "BeginRow\nRapid G00\nM8\nEnd"),
        ("PF002", "BeginRow\nM8\nEndCancel\nEndRow\nM9\nEnd"),
        ("PF002", "BeginRow\nM8\nEndRow   the end of it\nM9\nEnd"),
        ("PF002", "BeginRow\nM8\nEndRow # the end of it\nM9\nEnd"),
        ("PF007", "BeginRow\nM8\nEnd\nEnd Row\nM9\nEnd"),
        ("PF101", "BeginRow\n(  ROW [times]  )\nEnd"),
        ("PF101", "BeginRow\n#101=5\nEnd"),
        ("PF101", "CtrCode I J  K\n\nBeginRow\nM8\nEnd"),
        ("PF101", "Tap  2\nM29 S[speed]\nG84 X[h] Y[v] Z[d] R[vclear] F[frate]\nX[h] Y[v]\nEnd Cancel"),
        ("PF101", "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd  Cancel"),
        ("PF304", "p >4\n\nBeginRow\np[times]\nEnd"),
        ("PF318", "Control fanuc\nS >4.>1\n\nBeginRow\nM8\nEnd"),
        ("PF318", "Control fanuc\n\nBeginRow\nS3000.0\nEnd"),
        ("PF318", "Control fanuc\n\nBeginRow\nM3.\nEnd"),
        ("PF211", "Rapid G1\n\nBeginRow\nM8\nEnd"),
        ("PF211", "ReturnPlane 98 99\n\nBeginRow\nM8\nEnd"),
        ("PF311", "Dwell G4 X s\nP >4.>4\n\nBeginRow\nM8\nEnd"),
        ("PF314", "Drill\nG[retplane] G81 X[h] Y[v] Z[vclear] R[d] F[frate]\nEnd Cancel"),
        ("PF406", "Drill 1\nG[retplane] G81 Z[d] R[vclear] F[frate]\nX[h] Y[v]\nEnd Cancel"),
        ("PF414", "LTap\nG[retplane] G84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel"),
        ("PF415", "Custom1   Deep\nG0 X[h] Y[v]\nZ[d]\nG1 Z[vclear] F[frate]\nEnd"),
        ("PF416", "1stToolChange\nT[tool] M6\nG[work] G0 S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd"),
        ("PF419", "Tap\nG0 X[h] Y[v]\nZ[vclear]\nG1 Z[d] F[frate]\nM3\nZ[vclear]\nG0 Z[rplane]\nEnd"),
        ("PF419", "Tap\nG0 X[h] Y[v]\nZ[vclear]\nG1 Z[d] F[frate]\nM4\nG0 Z[vclear]\nM3\nEnd"),
        ("PF434", "InFeed\nG1 G[side] D[lcomp] X[h] Y[v] F[frate]\nEnd"),
        ("PF435", "RapidCode\nX[h] Y[v] Z[d]\nEnd"),
        ("PF436", "LineCode\nX[h] Y[v] Z[d] F[frate]\nEnd"),
        ("PF436", "InFeed\nG[side] D[dcomp] X[h] Y[v] F[frate]\nEnd"),
        ("PF437", "1stToolChange\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[dcomp] Z[d] M[cool]\nEnd"),
        (
            "PF437",
            "1stToolChange\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nZ[d] M[cool]\nEnd\nToolChange\nM9\nG91 G28 Z0 M5\nG90\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nZ[d] M[cool]\nEnd",
        ),
        ("PF503", "Drill\nG0 X[h] Y[v]\nZ[vclear]\nG1 Z[depth] F[frate]\nG0 Z[rplane]\nEnd"),
        ("PF505", "Drill\nG[retplane] G80 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel"),
        ("PF015", "EndCode\nM9\n%0\nM30\nEnd"),
        // words in a comment that goes to the end of the block have no effect
        ("PF014", "Comment ;\n\nEndCode\nM9\n; no M30 here\nEnd"),
        ("PF017", "Comment ;\n\nSubStart\nO[sub]\nEnd\nSubCall\nM98 P[sub]\nEnd\nSubEnd\n; end of sub\nEnd"),
        (
            "PF429",
            "Comment ;\n\n1stToolChange\nT[tool] ; M6 by hand\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d]\nEnd",
        ),
        ("PF316", "Units inch\n\nStartCode\n%0\nO[program#]\nG17 G40 G49 G80 G90\nEnd"),
        ("PF316", "Units mm\n\nStartCode\n%0\nO[program#]\nG17 G40 G49 G80 G90\nEnd"),
        (
            "PF445",
            "ToolChange\nM9\nM5\nM1\nT[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd",
        ),
        ("PF101", "  Limits X 0 20"),
        ("PF101", "\tMachineFile m.toml"),
        ("PF101", "  Y->4.>4"),
        ("PF101", "  F >5.>1"),
        ("PF101", "  MoveHome\nG90"),
        ("PF410", "Comment ;\n\nCancel\nM9 ; no G80\nEnd"),
        ("PF407", "Comment ;\n\nDrill\nG[retplane] G81 X[h] Y[v] R[vclear] F[frate] ; to Z[d]\nEnd Cancel"),
        ("PF406", "Drill 1\n(AT [h] [v])\nG81 Z[d] R[vclear] F[frate]\nEnd Cancel"),
        (
            "PF208",
            "Custom1   Custom2\nG[retplane] G82 X[h] Y[v] Z[d] R[vclear] P[dwell] F[frate]\nEnd Cancel\nCustom2\nG[retplane] G82 X[h] Y[v] Z[d] R[vclear] P[dwell] F[frate]\nEnd Cancel",
        ),
    ];
    for (code, text) in table {
        let fence = Fence { kind: String::new(), text: text.to_owned() };
        let found = found(&fence.checked()).diags;
        assert!(codes(&found).contains(&code), "{code}: {:?}\n{text}", codes(&found));
    }
}

/// A very long line and a comment with very many values are processed. benches/growth.py measures how the time grows.
#[test]
fn long_lines_are_answered() {
    let parts = ["M0 ", "X[h] ", "[h]", "(a) ", "a#b ", "G ", "S[speed] "];
    let mut lines: Vec<String> = parts.iter().map(|part| part.repeat(50_000)).collect();
    lines.push("M3 ".repeat(25_000) + &"G1 ".repeat(25_000));
    for line in &lines {
        let form = mill("Control fanuc", "").replacen("%0\n", &format!("%0\n{line}\n"), 1);
        let found = lint(&support::check(&form), &Levels::default());
        assert!(!found.diags.is_empty());
    }
}
