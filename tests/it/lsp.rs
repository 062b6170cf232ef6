//! `postform lsp` as an editor uses it: a test client checks each feature over standard input and output.

use std::fs;

use serde_json::{Value, json};

use crate::support::editor::{Editor, able, place, uri};
use crate::support::folder::Folder;
use crate::support::root;

const HAAS: &str = include_str!("../../postforms/haas.pf");
const BRACKET: &str = include_str!("../../samples/bracket/job.json");
const SETTINGS: &str = "form = \"my.pf\"\ncontrol = \"haas\"\njobs = [\"bracket/job.json\"]\n";

/// The folder of a shop: a form, a job, settings.
fn shop(name: &str) -> Folder {
    let folder = Folder::new(&format!("lsp-{name}"));
    folder.write("postform.toml", SETTINGS);
    folder.write("my.pf", HAAS);
    folder.write("bracket/job.json", BRACKET);
    folder
}

/// An editor with an open form in a shop's folder. The mark `|` in `to` is the cursor position.
struct Desk {
    editor: Editor,
    folder: Folder,
    text: String,
    cursor: Value,
    findings: Vec<Value>,
}

impl Desk {
    fn new(name: &str, from: &str, to: &str) -> Desk {
        let folder = shop(name);
        let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
        assert!(HAAS.contains(from), "{from}");
        let marked = HAAS.replacen(from, to, 1);
        let at = marked.find('|').unwrap_or(0);
        let text = marked.replacen('|', "", 1);
        let findings = editor.show("my.pf", "postform", &text);
        Desk { cursor: place(&text, at), editor, folder, text, findings }
    }

    fn at_cursor(&self) -> Value {
        json!({ "textDocument": { "uri": self.editor.uri("my.pf") }, "position": self.cursor })
    }

    fn ask(&mut self, method: &str) -> Value {
        let params = self.at_cursor();
        self.editor.ask(method, &params)
    }

    fn whole(&self) -> Value {
        json!({ "textDocument": { "uri": self.editor.uri("my.pf") } })
    }

    /// The text of a range in the form.
    fn text_of(&self, range: &Value) -> &str {
        slice(&self.text, range)
    }
}

fn slice<'a>(text: &'a str, range: &Value) -> &'a str {
    let at = |place: &Value| {
        let line = place["line"].as_u64().unwrap() as usize;
        let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        (start + place["character"].as_u64().unwrap() as usize).min(text.len())
    };
    &text[at(&range["start"])..at(&range["end"])]
}

fn codes(findings: &[Value]) -> Vec<&str> {
    findings.iter().map(|finding| finding["code"].as_str().unwrap_or("")).collect()
}

// ---- diagnostics

#[test]
fn a_form_is_linted_as_it_is_typed_with_the_levels_of_its_folder() {
    let mut desk = Desk::new("lint", "G90 G[work] X[h]", "G90G[work] X[h]");
    assert_eq!(codes(&desk.findings), ["PF102"]);
    let finding = &desk.findings[0];
    assert_eq!((desk.text_of(&finding["range"]), &finding["severity"]), ("G[work]", &json!(2)));
    assert!(finding["message"].as_str().unwrap().contains("put one space before the word"));
    assert!(desk.editor.change("my.pf", HAAS).is_empty());
    let found = desk.editor.change("my.pf", &HAAS.replacen("X[h]", "X[hh]", 1));
    assert_eq!((codes(&found), &found[0]["severity"]), (vec!["PF202"], &json!(1)));
    let asked = |message: &&Value| message["method"] == "client/registerCapability";
    assert!(desk.editor.others.iter().find(asked).is_some_and(|message| message.to_string().contains("**/*.toml")));
    // after postform.toml is saved with another level, the finding has this level
    desk.folder.write("postform.toml", format!("{SETTINGS}[rules]\nPF102 = \"error\"\n"));
    desk.editor.tell("workspace/didChangeWatchedFiles", &json!({ "changes": [] }));
    let uri = desk.editor.uri("my.pf");
    desk.editor.findings(&uri);
    let found = desk.editor.change("my.pf", &desk.text.clone());
    assert_eq!(found[0]["severity"], 1);
    desk.editor.quit();
}

#[test]
fn a_part_is_looked_at_where_it_is_called() {
    let folder = shop("parts");
    let (head, tail) = HAAS.split_at(HAAS.find("Custom1   Face").unwrap());
    folder.write("my.pf", format!("{}{tail}", head.replacen("Units both", "Units both\nCall cycles.pf", 1)));
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    folder.write("cycles.pf", "");
    // a called file is not a whole form: it needs no StartCode, and the open text of the calling form is used
    let found = editor.show("cycles.pf", "postform", "# cycles of all mills\n");
    assert_eq!(codes(&found), Vec::<&str>::new(), "{found:?}");
    folder.write("cycles.pf", "Q >3.>3\nX[h\n");
    let found = editor.show("my.pf", "postform", &folder.read("my.pf"));
    assert!(found.iter().all(|finding| finding["code"] != "PF005"), "{found:?}");
    editor.quit();
}

#[test]
fn a_program_is_read_as_its_control_reads_it() {
    let folder = shop("programs");
    folder.write("postform.toml", "control = \"grbl\"\n");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    let program = "G21 G90\nG1 X1 F100\nG81 X3 Z-1 R1\nM30\n";
    let found = editor.show("part.nc", "plaintext", program);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((&found[0]["severity"], &found[0]["source"]), (&json!(1), &json!("postform (grbl)")));
    assert_eq!(found[0]["range"]["start"]["line"], 2);
    // the control that the program names is used, for other file extensions too
    let found = editor.show("part.tap", "plaintext", &format!("(postform: control haas)\n{program}"));
    assert_eq!((codes(&found), &found[0]["severity"]), (vec!["PN017"], &json!(2)), "a Haas has G81, and minds points");
    let found = editor.show("part.ngc", "plaintext", &format!("(postform: control hass)\n{program}"));
    assert!(found[0]["message"].as_str().unwrap().contains("there is no control `hass`"), "{found:?}");
    let lens = editor.ask("textDocument/codeLens", &json!({ "textDocument": { "uri": editor.uri("part.nc") } }));
    assert_eq!(lens[0]["command"]["title"], "grbl (of postform.toml) refuses 1 block");
    // the editor's setting applies if no other source names a control
    folder.write("postform.toml", "");
    editor.tell("workspace/didChangeConfiguration", &json!({ "settings": { "postform": { "control": "linuxcnc" } } }));
    let uri = editor.uri("part.nc");
    editor.findings(&uri);
    let lens = editor.ask("textDocument/codeLens", &json!({ "textDocument": { "uri": uri } }));
    assert!(lens[0]["command"]["title"].as_str().unwrap().starts_with("linuxcnc (of the settings) runs "), "{lens}");
    editor.quit();
}

/// If postform.toml names a machine, the programs of its folder must fit into this machine.
#[test]
fn a_program_must_fit_into_the_machine_of_its_folder() {
    let folder = shop("machine");
    folder.write("postform.toml", "control = \"haas\"\nmachine = \"vf2.toml\"\n");
    folder.write("vf2.toml", "[axes.X]\ntravel = [-300, 0]\n[offsets]\nG54 = [-200, 0, 0]\n");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    let program = "G21 G90 G54\nG0 X10.\nG0 X250.\nM30\n";
    let found = editor.show("part.nc", "plaintext", program);
    assert_eq!((codes(&found), &found[0]["severity"]), (vec!["PM001"], &json!(1)), "{found:?}");
    assert_eq!((&found[0]["range"]["start"]["line"], &found[0]["source"]), (&json!(2), &json!("vf2.toml")));
    assert!(editor.change("part.nc", &program.replace("250", "150")).is_empty());
    folder.write("vf2.toml", "[axes.X]\ntravel = 7\n");
    let found = editor.change("part.nc", program);
    assert!(found[0]["message"].as_str().unwrap().contains("the travel of X must be two numbers"), "{found:?}");
    editor.quit();
}

#[test]
fn a_job_of_the_folder_is_read_and_printed() {
    let folder = shop("jobs");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    assert!(editor.show("bracket/job.json", "json", BRACKET).is_empty());
    let wrong = BRACKET.replacen("\"feed\"", "\"fed\"", 1);
    let found = editor.change("bracket/job.json", &wrong);
    assert_eq!(found[0]["severity"], 1, "{found:?}");
    let line = found[0]["range"]["start"]["line"].as_u64().unwrap() as usize;
    assert!(wrong.lines().nth(line).unwrap().contains("\"fed\""), "{found:?}");
    // a file that postform.toml does not name is not checked as a job
    assert!(editor.show("other.json", "json", "{").is_empty());
    editor.quit();
}

#[test]
fn postform_toml_is_looked_at() {
    let folder = shop("settings");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    assert!(editor.show("postform.toml", "toml", SETTINGS).is_empty());
    let found = editor.change("postform.toml", &format!("{SETTINGS}contrl = \"haas\"\n"));
    assert_eq!(found[0]["range"]["start"]["line"], 3, "{found:?}");
    // the form shows the error too
    folder.write("postform.toml", "contrl = 1\n");
    let found = editor.show("my.pf", "postform", HAAS);
    assert!(found[0]["message"].as_str().unwrap().contains("postform.toml"), "{found:?}");
    editor.quit();
}

// ---- completion, hover, signature

fn item<'a>(list: &'a Value, label: &str) -> Option<&'a Value> {
    list.as_array().unwrap().iter().find(|item| item["label"] == label)
}

#[test]
fn commands_that_are_not_there_yet_come_with_their_shape() {
    let mut desk = Desk::new("commands", "\nSequence#s", "\nCoo|\nSequence#s");
    let list = desk.ask("textDocument/completion");
    let coolant = item(&list, "Coolant").unwrap();
    assert_eq!(coolant["textEdit"]["newText"], "Coolant ${1:8} ${2:9} ${3:7}");
    assert_eq!((&coolant["insertTextFormat"], desk.text_of(&coolant["textEdit"]["range"])), (&json!(2), "Coo"));
    assert!(item(&list, "EndRow").is_some() && item(&list, "ArcPlane").is_none() && item(&list, "Drill").is_none());
    desk.editor.quit();
}

#[test]
fn variables_come_with_unit_meaning_and_value_in_the_current_job() {
    // the word is incomplete: the values are those of the last printed program
    let mut desk = Desk::new("variables", "", "");
    let half = HAAS.replacen("Z[d] R[vclear] F[frate]", "Z[d] R[vc", 1);
    desk.editor.ask("textDocument/codeLens", &desk.whole());
    desk.editor.change("my.pf", &half);
    desk.cursor = place(&half, half.find("R[vc").unwrap() + 4);
    let list = desk.ask("textDocument/completion");
    let vclear = item(&list, "vclear").unwrap();
    assert_eq!(
        vclear["detail"],
        "length = 0.1 in bracket: clearance plane (R plane): the height where the feed begins"
    );
    assert_eq!(vclear["textEdit"]["newText"], "vclear]");
    assert!(item(&list, "h2").is_none(), "a variable of wire EDM");
    let known = desk.editor.ask("completionItem/resolve", vclear);
    assert!(known["documentation"]["value"].as_str().unwrap().starts_with("**[vclear] (variable)**"), "{known}");
    desk.editor.quit();
}

#[test]
fn texts_of_the_job_are_completed_and_explained() {
    let mut desk = Desk::new("texts", "T[tool] M6", "(NEXT [tool|name:12]) `#1 = 0` T[tool] M6");
    assert_eq!(codes(&desk.findings), Vec::<&str>::new());
    let list = desk.ask("textDocument/completion");
    assert_eq!(item(&list, "toolname").unwrap()["detail"], "text: the tool's name");
    let known = desk.editor.ask("completionItem/resolve", item(&list, "toolname").unwrap());
    assert!(known["documentation"]["value"].as_str().unwrap().starts_with("**[toolname] (text)**"), "{known}");
    let hover = desk.ask("textDocument/hover");
    assert!(hover["contents"]["value"].as_str().unwrap().starts_with("**[toolname] (text)**"), "{hover}");
    assert_eq!(desk.text_of(&hover["range"]), "[toolname:12]");
    desk.cursor = place(&desk.text, desk.text.find("`#1").unwrap() + 2);
    let hover = desk.ask("textDocument/hover");
    assert!(hover["contents"]["value"].as_str().unwrap().starts_with("**text in backquotes**"), "{hover}");
    desk.editor.quit();
}

#[test]
fn what_may_be_allowed_is_completed() {
    let mut desk = Desk::new("allowances", "Z[d] R[vclear] F[frate]\nEnd Cancel", "Z[d] R[vclear] F[frate]\nEnd");
    let text = desk.text.replacen("G[retplane] G81", "# postform: allow \nG[retplane] G81", 1);
    desk.editor.change("my.pf", &text);
    desk.cursor = place(&text, text.find("allow \n").unwrap() + "allow ".len());
    let list = desk.ask("textDocument/completion");
    assert!(item(&list, "PF409").is_some(), "what is found: {list}");
    desk.editor.quit();
}

#[test]
fn codes_of_the_control_and_the_end_of_a_cycle() {
    let mut desk = Desk::new("codes", "G53 Z0 M5", "G53 Z0 M5 G18|");
    let list = desk.ask("textDocument/completion");
    assert!(item(&list, "G187").is_some(), "a code of Haas: {list}");
    let text = HAAS.replacen("End Cancel", "End ", 1);
    desk.editor.change("my.pf", &text);
    desk.cursor = place(&text, text.find("F[frate]\nEnd \n").unwrap() + "F[frate]\nEnd ".len());
    let list = desk.ask("textDocument/completion");
    assert_eq!(list.as_array().unwrap().len(), 1);
    assert_eq!(list[0]["label"], "Cancel");
    desk.editor.show("part.nc", "nc", "G90 M\n");
    let at =
        json!({ "textDocument": { "uri": desk.editor.uri("part.nc") }, "position": { "line": 0, "character": 5 } });
    let list = desk.editor.ask("textDocument/completion", &at);
    assert!(item(&list, "M8").is_some() && item(&list, "G81").is_none());
    desk.editor.quit();
}

#[test]
fn an_editor_without_snippets_gets_plain_text() {
    let folder = shop("plain");
    let mut editor = Editor::open(&folder.0, &json!({}), &Value::Null);
    let text = HAAS.replacen("\nSequence#s", "\nCoo\nSequence#s", 1);
    editor.show("my.pf", "postform", &text);
    let at = text.find("\nCoo\n").unwrap() + 4;
    let params = json!({ "textDocument": { "uri": editor.uri("my.pf") }, "position": place(&text, at) });
    let list = editor.ask("textDocument/completion", &params);
    assert_eq!(item(&list, "Coolant").unwrap()["textEdit"]["newText"], "Coolant");
    editor.quit();
}

#[test]
fn hover_explains_and_says_what_the_line_printed() {
    let mut desk = Desk::new("hover", "Z[d] R[vclear]", "Z[d] R[v|clear]");
    let hover = desk.ask("textDocument/hover");
    let text = hover["contents"]["value"].as_str().unwrap();
    assert!(
        text.starts_with("**[vclear] (variable)**\n\nclearance plane (R plane): the height where the feed begins"),
        "{text}"
    );
    assert!(
        text.contains("in bracket: **0.1**") && text.contains("in bracket this line prints 4 blocks\n```nc\n"),
        "{text}"
    );
    assert_eq!(desk.text_of(&hover["range"]), "R[vclear]");
    let mut about = |thing: &str, into: usize| {
        desk.cursor = place(HAAS, HAAS.find(thing).unwrap() + into);
        desk.ask("textDocument/hover")["contents"]["value"].as_str().unwrap_or("").to_owned()
    };
    assert!(about("Y->4.>4", 3).contains("12.5     → Y12.5\n-0.25    → Y-.25\n3        → Y3."));
    assert!(about("G81", 1).starts_with("**G81** on haas\n\n"));
    assert!(about("ArcPlane", 3).starts_with("**ArcPlane (command)**"));
    desk.editor.show("part.nc", "nc", "G90 G187 P1\n");
    let at =
        json!({ "textDocument": { "uri": desk.editor.uri("part.nc") }, "position": { "line": 0, "character": 6 } });
    let hover = desk.editor.ask("textDocument/hover", &at);
    assert!(hover["contents"]["value"].as_str().unwrap().starts_with("**G187** on haas"), "{hover}");
    desk.editor.quit();
}

#[test]
fn signature_help_names_the_word_that_is_written() {
    let mut desk = Desk::new("signature", "RigidTap? Y", "Coolant 8 |");
    let help = desk.ask("textDocument/signatureHelp");
    let signature = &help["signatures"][0];
    assert_eq!(signature["label"], "Coolant on off mist");
    let word = &signature["parameters"][help["activeParameter"].as_u64().unwrap() as usize]["label"];
    assert_eq!(*word, json!([11, 14]), "off");
    desk.editor.quit();
}

// ---- hints, lenses

#[test]
fn hints_show_what_words_print_and_lenses_the_verdict() {
    let mut desk = Desk::new("hints", "", "");
    let lens = desk.editor.ask("textDocument/codeLens", &desk.whole());
    assert_eq!(lens.as_array().unwrap().len(), 1);
    let title = lens[0]["command"]["title"].as_str().unwrap();
    assert!(title.starts_with("bracket: ") && title.ends_with(" blocks, proven"), "{title}");
    let line = HAAS.lines().position(|line| line.contains("G81")).unwrap();
    let range = json!({ "start": { "line": line, "character": 0 }, "end": { "line": line, "character": 60 } });
    let params = json!({ "textDocument": { "uri": desk.editor.uri("my.pf") }, "range": range });
    let hints = desk.editor.ask("textDocument/inlayHint", &params);
    let labels: Vec<&str> = hints.as_array().unwrap().iter().map(|hint| hint["label"].as_str().unwrap()).collect();
    assert_eq!(labels, ["→ G98", "→ X1.5", "→ Y.3", "→ Z-.15", "→ R.1", "→ F6."]);
    assert_eq!(hints[1]["position"], json!({ "line": line, "character": "G[retplane] G81 X[h]".len() }));
    // hints are off in a long form unless the setting is `on`
    let long = format!("{}{HAAS}", "# a comment\n".repeat(500));
    desk.editor.change("my.pf", &long);
    let range = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 9999, "character": 0 } });
    let params = json!({ "textDocument": { "uri": desk.editor.uri("my.pf") }, "range": range });
    assert_eq!(desk.editor.ask("textDocument/inlayHint", &params), json!([]));
    desk.editor.tell("workspace/didChangeConfiguration", &json!({ "settings": { "inlayHints": "on" } }));
    assert!(desk.editor.ask("textDocument/inlayHint", &params).as_array().unwrap().len() > 50);
    // for a form with errors, the lens shows that the form has errors
    desk.editor.change("my.pf", &HAAS.replacen("X[h]", "X[hh]", 1));
    let lens = desk.editor.ask("textDocument/codeLens", &desk.whole());
    assert_eq!(lens[0]["command"]["title"], "1 error: prints nothing");
    desk.editor.quit();
}

// ---- actions, layout, names

/// The text after an edit of one file.
fn edited(text: &str, edits: &Value) -> String {
    let mut edits: Vec<&Value> = edits.as_array().unwrap().iter().collect();
    edits.sort_by_key(|edit| {
        std::cmp::Reverse((edit["range"]["start"]["line"].as_u64(), edit["range"]["start"]["character"].as_u64()))
    });
    let mut text = text.to_owned();
    for edit in edits {
        let old = slice(&text, &edit["range"]);
        let at = old.as_ptr() as usize - text.as_ptr() as usize;
        text.replace_range(at..at + old.len(), edit["newText"].as_str().unwrap());
    }
    text
}

#[test]
fn actions_mend_allow_and_show_what_they_do_to_the_program() {
    let mut desk = Desk::new("actions", "Z[d] R[vclear] F[frate]\nEnd Cancel", "Z[d] R[vclear] F[frate]\nEnd");
    assert_eq!(codes(&desk.findings), ["PF409"]);
    let context = json!({ "diagnostics": desk.findings });
    let uri = desk.editor.uri("my.pf");
    let params = json!({ "textDocument": { "uri": uri }, "range": desk.findings[0]["range"], "context": context });
    let actions = desk.editor.ask("textDocument/codeAction", &params);
    let named = |actions: &Value, name: &str| {
        let all = actions.as_array().unwrap();
        all.iter()
            .find(|action| action["title"].as_str().unwrap().starts_with(name))
            .unwrap_or_else(|| panic!("{name}"))
            .clone()
    };
    let unsafe_fix = named(&actions, "Cancel the cycle");
    assert_eq!(unsafe_fix["title"], "Cancel the cycle (changes 4 blocks of the program) [PF409]");
    let annotation = &unsafe_fix["edit"]["changeAnnotations"]["program"];
    assert_eq!(annotation["needsConfirmation"], true);
    assert!(annotation["description"].as_str().unwrap().contains("\n+G80"), "{annotation}");
    let after = edited(&desk.text, &unsafe_fix["edit"]["documentChanges"][0]["edits"]);
    assert!(desk.editor.change("my.pf", &after).is_empty());
    for name in ["Allow PF409 here", "Allow PF409 in the whole file"] {
        let after = edited(&desk.text, &named(&actions, name)["edit"]["changes"][&uri]);
        assert!(desk.editor.change("my.pf", &after).is_empty(), "{name}");
    }
    // safe fixes, one at a time and all at once
    let text = HAAS.replace("X[h] Y[v]", "X[h]Y[v]");
    let found = desk.editor.change("my.pf", &text);
    assert!(found.len() > 5);
    let params =
        json!({ "textDocument": { "uri": uri }, "range": found[0]["range"], "context": { "diagnostics": [] } });
    let safe = desk.editor.ask("textDocument/codeAction", &params)[0].clone();
    assert_eq!(safe["isPreferred"], true);
    assert_eq!(edited(&text, &safe["edit"]["changes"][&uri]), text.replacen("X[h]Y[v]", "X[h] Y[v]", 1));
    let context = json!({ "diagnostics": [], "only": ["source.fixAll"] });
    let params = json!({ "textDocument": { "uri": uri }, "range": found[0]["range"], "context": context });
    let all = desk.editor.ask("textDocument/codeAction", &params);
    assert_eq!(edited(&text, &all[0]["edit"]["changes"][&uri]), HAAS);
    desk.editor.quit();
}

#[test]
fn formats_are_organised_and_forms_laid_out() {
    let folder = shop("layout");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    let text = HAAS.replacen("X->4.>4\nY->4.>4\n", "Y->4.>4 # across\nX->4.>4\n", 1);
    editor.show("my.pf", "postform", &text);
    let uri = editor.uri("my.pf");
    let whole = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 999, "character": 0 } });
    let context = json!({ "diagnostics": [], "only": ["source.organizeFormats"] });
    let params = json!({ "textDocument": { "uri": uri }, "range": whole, "context": context });
    let actions = editor.ask("textDocument/codeAction", &params);
    let after = edited(&text, &actions[0]["edit"]["changes"][&uri]);
    assert_eq!(after, HAAS.replacen("Y->4.>4\n", "Y->4.>4 # across\n", 1));
    let text = HAAS.replace("Machine Mill", "machine   Mill");
    editor.change("my.pf", &text);
    let params = json!({ "textDocument": { "uri": uri }, "options": { "tabSize": 4, "insertSpaces": true } });
    let edits = editor.ask("textDocument/formatting", &params);
    let laid_out = edited(&text, &edits);
    assert_eq!(laid_out, postform::internals::fmt::format(&postform::Source::from_text("my.pf", text)));
    editor.change("my.pf", &laid_out);
    assert_eq!(editor.ask("textDocument/formatting", &params), json!([]));
    // two lines need another layout; only the line in the range changes
    let twice = laid_out.replacen("Machine   Mill", "machine   Mill", 1).replacen("End Cancel", "end Cancel", 1);
    editor.change("my.pf", &twice);
    let line = twice.lines().position(|line| line == "machine   Mill").unwrap();
    let of = |from: usize, to: usize| {
        let range = json!({ "start": { "line": from, "character": 0 }, "end": { "line": to, "character": 0 } });
        json!({ "textDocument": { "uri": uri }, "range": range, "options": { "tabSize": 4, "insertSpaces": true } })
    };
    let edits = editor.ask("textDocument/rangeFormatting", &of(line, line + 1));
    assert_eq!(edited(&twice, &edits), laid_out.replacen("End Cancel", "end Cancel", 1));
    assert_eq!(editor.ask("textDocument/rangeFormatting", &of(0, line)), json!([]));
    editor.quit();
}

#[test]
fn free_values_are_renamed_wherever_they_stand() {
    let mut desk = Desk::new("rename", "S[speed] M[direct]", "S[speed] M[direct] (H [val1]) P[va|l1]");
    let place = desk.ask("textDocument/prepareRename");
    assert_eq!((desk.text_of(&place["range"]), &place["placeholder"]), ("val1", &json!("val1")));
    let mut params = desk.at_cursor();
    params["newName"] = json!("val7");
    let edit = desk.editor.ask("textDocument/rename", &params);
    let after = edited(&desk.text, &edit["changes"][desk.editor.uri("my.pf")]);
    assert_eq!(after, desk.text.replace("val1", "val7"));
    params["newName"] = json!("height");
    let refused = desk.editor.answer("textDocument/rename", &params);
    assert!(refused["error"]["message"].as_str().unwrap().contains("val1 to val10"), "{refused}");
    params["position"] = crate::support::editor::place(&desk.text, desk.text.find("[speed]").unwrap() + 2);
    let refused = desk.editor.answer("textDocument/prepareRename", &params);
    assert!(refused["error"]["message"].as_str().unwrap().contains("words of the language"), "{refused}");
    desk.editor.quit();
}

#[test]
fn references_highlights_and_symbols() {
    let mut desk = Desk::new("symbols", "Z[d] R[vclear]", "Z[d] R[v|clear]");
    let mut params = desk.at_cursor();
    params["context"] = json!({ "includeDeclaration": true });
    let all = desk.editor.ask("textDocument/references", &params);
    assert_eq!(all.as_array().unwrap().len(), HAAS.matches("[vclear]").count());
    assert!(all.as_array().unwrap().iter().all(|place| desk.text_of(&place["range"]).ends_with("[vclear]")));
    let marks = desk.ask("textDocument/documentHighlight");
    assert_eq!(marks.as_array().unwrap().len(), HAAS.matches("[vclear]").count());
    let symbols = desk.editor.ask("textDocument/documentSymbol", &desk.whole());
    let drill = symbols.as_array().unwrap().iter().find(|symbol| symbol["name"] == "Drill").unwrap();
    assert!(desk.text_of(&drill["range"]).starts_with("Drill\nG[retplane] G81"));
    let found = desk.editor.ask("workspace/symbol", &json!({ "query": "custom1" }));
    assert_eq!(found[0]["name"], "Custom1 Face");
    assert_eq!(found[0]["location"]["uri"], desk.editor.uri("my.pf"));
    desk.editor.quit();
}

#[test]
fn folding_and_colours() {
    let mut desk = Desk::new("colours", "", "");
    let folds = desk.editor.ask("textDocument/foldingRange", &desk.whole());
    let start = HAAS.lines().position(|line| line == "StartCode").unwrap();
    let end = start + HAAS.lines().skip(start).position(|line| line == "End").unwrap();
    assert!(folds.as_array().unwrap().contains(&json!({ "startLine": start, "endLine": end })), "{folds}");
    let tokens = desk.editor.ask("textDocument/semanticTokens/full", &desk.whole());
    let data: Vec<usize> = tokens["data"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap() as usize).collect();
    let lines: Vec<&str> = HAAS.lines().collect();
    let (mut line, mut column, mut words) = (0, 0, Vec::new());
    for token in data.chunks(5) {
        column = if token[0] == 0 { column + token[1] } else { token[1] };
        line += token[0];
        words.push((&lines[line][column..column + token[2]], token[3]));
    }
    for (word, kind) in
        [("Machine", 0), ("Mill", 1), ("X->4.>4", 2), ("Drill", 3), ("R[vclear]", 4), ("G81", 5), ("Z0", 6)]
    {
        assert!(words.contains(&(word, kind)), "{word}");
    }
    let range = json!({ "start": { "line": start, "character": 0 }, "end": { "line": start, "character": 1 } });
    let params = json!({ "textDocument": { "uri": desk.editor.uri("my.pf") }, "range": range });
    let some = desk.editor.ask("textDocument/semanticTokens/range", &params);
    assert_eq!(some["data"], json!([start, 0, 9, 3, 0]));
    desk.editor.quit();
}

// ---- from a line of the form to its blocks and back

#[test]
fn a_line_leads_to_its_blocks_and_a_block_to_its_line_and_its_item() {
    let mut desk = Desk::new("blocks", "G[retplane] G81", "G[retplane] G8|1");
    let blocks = desk.ask("textDocument/implementation");
    assert_eq!(blocks.as_array().unwrap().len(), 4);
    let name = blocks[0]["uri"].as_str().unwrap().to_owned();
    let path = name.strip_prefix("file://").unwrap().to_owned();
    let program = fs::read_to_string(&path).unwrap();
    let number = blocks[0]["range"]["start"]["line"].as_u64().unwrap() as usize;
    assert!(program.lines().nth(number).unwrap().contains("G98 G81 X1.5 Y.3"), "{program}");
    // the command of the lens opens the same file: the server asks the editor to show this file
    let params = json!({ "command": "postform.openProgram", "arguments": [desk.editor.uri("my.pf"), 0] });
    assert_eq!(desk.editor.ask("workspace/executeCommand", &params), json!(name));
    assert!(desk.editor.others.iter().any(|message| message["method"] == "window/showDocument"));
    // from the block back to the form
    let item = json!({ "uri": name, "languageId": "nc", "version": 1, "text": program });
    desk.editor.tell("textDocument/didOpen", &json!({ "textDocument": item }));
    assert!(desk.editor.findings(&name).is_empty());
    let at = json!({ "textDocument": { "uri": name }, "position": blocks[0]["range"]["start"] });
    let lines = desk.editor.ask("textDocument/definition", &at);
    assert!(desk.text_of(&lines[0]["range"]).starts_with("G[retplane] G81"), "{lines}");
    let items = desk.editor.ask("textDocument/implementation", &at);
    assert!(items[0]["uri"].as_str().unwrap().ends_with("bracket/job.json"), "{items}");
    // a program that was printed into the folder is also linked to the form
    let name = desk.editor.uri("bracket.nc");
    desk.editor.show("bracket.nc", "nc", &program);
    let at = json!({ "textDocument": { "uri": name }, "position": blocks[0]["range"]["start"] });
    let lines = desk.editor.ask("textDocument/definition", &at);
    assert!(desk.text_of(&lines[0]["range"]).starts_with("G[retplane] G81"), "{lines}");
    desk.editor.quit();
    assert!(!std::path::Path::new(&path).exists(), "the server's files go with it");
}

#[test]
fn definitions_lead_to_what_says_a_thing() {
    let mut desk = Desk::new("definitions", "End Cancel", "End Ca|ncel");
    let said = desk.ask("textDocument/definition");
    assert_eq!(desk.text_of(&said[0]["range"]), "Cancel");
    desk.folder.write("common.pf", "Q >3.>3\n");
    let text = HAAS.replacen("Units both", "Units both\nCall common.pf", 1).replacen("Q >4.>4\n", "", 1);
    desk.editor.change("my.pf", &text);
    desk.cursor = place(&text, text.find("common.pf").unwrap() + 2);
    let said = desk.ask("textDocument/definition");
    assert_eq!(said[0]["uri"], uri(&desk.folder.0.join("common.pf")));
    desk.editor.quit();
}

#[test]
fn an_extension_asks_for_programs_itself() {
    let folder = shop("virtual");
    let mut editor = Editor::open(&folder.0, &able(), &json!({ "virtualPrograms": true }));
    editor.show("my.pf", "postform", HAAS);
    let program = editor.ask("postform/program", &json!({ "uri": editor.uri("my.pf"), "job": 0 }));
    assert_eq!(program["name"], "bracket");
    let whole = json!({ "textDocument": { "uri": editor.uri("my.pf") } });
    assert_eq!(editor.ask("postform/jobs", &whole), json!([editor.uri("bracket/job.json")]));
    let old = json!({ "uri": editor.uri("my.pf"), "job": 0, "text": HAAS.replace("T[tool] M6", "T[tool] M06") });
    let before = editor.ask("postform/program", &old);
    assert!(before["text"].as_str().unwrap().contains(" M06\n"), "what another text of the form prints: {before}");
    assert!(program["text"].as_str().unwrap().starts_with("%\nO"), "{program}");
    assert!(program["outcome"].as_str().unwrap().ends_with("proven"));
    let params = json!({ "command": "postform.openProgram", "arguments": [editor.uri("my.pf"), 0] });
    let opened = editor.ask("workspace/executeCommand", &params);
    assert!(opened.as_str().unwrap().starts_with("postform-program:/"), "{opened}");
    editor.quit();
}

// ---- unexpected input

#[test]
fn places_count_utf_16_units() {
    let folder = shop("utf16");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    let text = HAAS.replacen("Name Haas VF", "Name Fräse 😀", 1).replacen(
        "M[coolantoff]\nG0 G53",
        "(ä😀) G90G[work]\nG0 G53",
        1,
    );
    let found = editor.show("my.pf", "postform", &text);
    let blank = found.iter().find(|finding| finding["code"] == "PF102").unwrap();
    assert_eq!(blank["range"]["start"]["character"], "(ä😀) G90".encode_utf16().count());
    editor.quit();
}

#[test]
fn a_text_without_a_file_and_a_name_that_is_not_utf_8_are_served() {
    let folder = shop("names");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    for name in
        ["untitled:Untitled-1".to_owned(), format!("{}/fr%E4se.pf", uri(&folder.0)), "file:///a%zz.pf".to_owned()]
    {
        let item = json!({ "uri": name, "languageId": "postform", "version": 1, "text": "Machine Mill\nDril\n" });
        editor.tell("textDocument/didOpen", &json!({ "textDocument": item }));
        let found = editor.findings(&name);
        assert!(!found.is_empty(), "{name}");
        let at = json!({ "textDocument": { "uri": name }, "position": { "line": 0, "character": 2 } });
        assert!(editor.ask("textDocument/hover", &at)["contents"]["value"].as_str().unwrap().starts_with("**Machine"));
        editor.tell("textDocument/didClose", &json!({ "textDocument": { "uri": name } }));
        assert!(editor.findings(&name).is_empty(), "what is closed has no findings");
    }
    editor.quit();
}

#[test]
fn wrong_requests_are_answered_and_the_session_goes_on() {
    let folder = shop("wrong");
    let mut editor = Editor::start(&folder.0);
    assert_eq!(editor.answer("textDocument/hover", &json!({}))["error"]["code"], -32002, "before initialize");
    editor.ask("initialize", &json!({ "processId": null, "rootUri": null, "capabilities": {} }));
    assert_eq!(editor.answer("textDocument/rubbish", &json!({}))["error"]["code"], -32601);
    assert_eq!(editor.answer("textDocument/hover", &json!({ "position": 3 }))["error"]["code"], -32602);
    assert_eq!(editor.answer("workspace/executeCommand", &json!({ "command": "rm" }))["error"]["code"], -32602);
    let closed = json!({ "textDocument": { "uri": "file:///nothing.pf" }, "position": { "line": 9, "character": 9 } });
    assert_eq!(editor.ask("textDocument/hover", &closed), Value::Null);
    editor.tell("textDocument/didChange", &json!({ "textDocument": { "uri": "file:///nothing.pf", "version": 2 } }));
    editor.tell("$/cancelRequest", &json!({ "id": 1 }));
    editor.send(b"Content-Length: 9\r\n\r\nnot json!");
    assert_eq!(editor.next()["error"]["code"], -32700);
    editor.quit();
}

#[test]
fn a_cut_off_message_and_a_lost_editor_end_the_server() {
    let folder = shop("ends");
    let end = |bytes: &[u8], initialized: bool| {
        let mut editor =
            if initialized { Editor::open(&folder.0, &able(), &Value::Null) } else { Editor::start(&folder.0) };
        editor.send(bytes);
        editor.hang_up();
        let (status, said) = editor.end();
        (status.code(), said)
    };
    let (code, said) = end(b"Content-Length: 500\r\n\r\n{\"jsonrpc\"", true);
    assert_eq!((code, said.contains("ended inside a message")), (Some(2), true), "{said}");
    let (code, said) = end(b"Content-Length: 99999999999999\r\n\r\n", true);
    assert_eq!((code, said.contains("the limit is 64 MB")), (Some(2), true), "{said}");
    let (code, said) = end(b"hello\r\n", false);
    assert_eq!((code, said.contains("not a header")), (Some(2), true), "{said}");
    let (code, said) = end(b"", true);
    assert_eq!((code, said.contains("without `shutdown`")), (Some(1), true), "{said}");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    editor.tell("exit", &Value::Null);
    let (status, _) = editor.end();
    assert_eq!(status.code(), Some(1), "exit without shutdown");
}

#[test]
fn a_huge_form_and_an_endless_program_are_answered() {
    let folder = shop("huge");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    let found = editor.show("huge.pf", "postform", &"G0 X1 Y2 Z3 rubbish\n".repeat(20_000));
    assert!(!found.is_empty() && found.len() <= 1000);
    let found = editor.show("endless.nc", "nc", "G21 G90\nG1 X1 F100\nM99\n");
    assert!(found.len() < 300, "{}", found.len());
    let mut long = String::from("G21 G90 G94\n");
    (0..300_000).for_each(|i| long += &format!("G1 X{} F100\n", i % 7));
    editor.show("long.nc", "nc", &long);
    editor.quit();
}

#[test]
fn every_form_that_ships_is_served() {
    let folder = shop("all");
    let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
    let mut forms: Vec<_> =
        fs::read_dir(root().join("postforms")).unwrap().map(|entry| entry.unwrap().path()).collect();
    forms.sort();
    for form in forms.iter().filter(|path| path.extension().is_some_and(|end| end == "pf")) {
        let name = form.file_name().unwrap().to_string_lossy().into_owned();
        let text = fs::read_to_string(form).unwrap();
        editor.show(&name, "postform", &text);
        let document = json!({ "textDocument": { "uri": editor.uri(&name) } });
        for method in ["documentSymbol", "foldingRange", "semanticTokens/full", "codeLens"] {
            assert!(!editor.ask(&format!("textDocument/{method}"), &document).is_null(), "{name}: {method}");
        }
        // at many positions; every request must get an answer
        for at in (0..text.len()).step_by(211).filter(|at| text.is_char_boundary(*at)) {
            let params = json!({ "textDocument": { "uri": editor.uri(&name) }, "position": place(&text, at) });
            for method in ["hover", "completion", "signatureHelp", "definition", "references"] {
                editor.ask(&format!("textDocument/{method}"), &params);
            }
        }
    }
    editor.quit();
}

/// The shop's property values apply in the editor as in `render`.
#[test]
fn properties_of_the_shop_hold() {
    let blocks = |name: &str, settings: &str| {
        let folder = shop(name);
        folder.write("postform.toml", format!("{SETTINGS}{settings}"));
        let mut editor = Editor::open(&folder.0, &able(), &Value::Null);
        editor.show("my.pf", "postform", HAAS);
        let lens = editor.ask("textDocument/codeLens", &json!({ "textDocument": { "uri": editor.uri("my.pf") } }));
        let title = lens[0]["command"]["title"].as_str().unwrap().to_owned();
        editor.quit();
        title.split(' ').find_map(|word| word.parse::<u32>().ok()).unwrap_or_else(|| panic!("{title}"))
    };
    let (with, without) = (blocks("header", ""), blocks("no-header", "[properties]\nheader = \"off\"\n"));
    assert!(without + 5 < with, "{without} blocks without the header, {with} with it");
}
