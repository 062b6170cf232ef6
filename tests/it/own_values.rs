//! Properties of forms: the sources of their values, their output, and errors.

use crate::support::{check, mill};
use postform::internals::lint::lint;
use postform::{Error, ErrorKind, Job, NoFiles, Options, Post, Source};

const THROUGH: &str = "Property through choice(off,on,high) off Coolant through the spindle";

/// A form with these commands, whose tool changes print these lines.
fn form(head: &str, lines: &str) -> String {
    mill(head, "").replace("T[tool] M6\n", &format!("T[tool] M6\n{lines}\n"))
}

/// A job of two operations with two tools. The given keys are in its head and in its operations.
fn job(head: &str, operations: [&str; 2]) -> String {
    let operation = |i: usize| {
        format!(
            "{{\"tool\":{},{}\"work\":54,\"spindle\":{{\"speed\":1000,\"direction\":\"cw\"}},\"feed\":10,\
             \"path\":[{{\"rapid\":[0,0,1]}},{{\"line\":[1,0,0]}}]}}",
            i + 1,
            operations[i]
        )
    };
    format!(
        "{{\"postform\":1,{head}\"units\":\"inch\",\"tools\":[{{\"number\":1}},{{\"number\":2}}],\"operations\":[{},{}]}}",
        operation(0),
        operation(1)
    )
}

fn print(form: &str, job: &str, options: Options) -> Result<Vec<String>, Error> {
    let post = Post::compile(Source::from_text("form.pf", form), &NoFiles)?;
    let mut options = options;
    options.proof = None;
    let program = post.render(Job::json(job), &options)?;
    let change = |line: &&str| !["T", "S", "G0 G54", "%", "M30", "G1"].iter().any(|start| line.starts_with(start));
    Ok(program.text().lines().filter(change).map(str::to_owned).collect())
}

/// A value from the caller.
fn caller(name: &str, value: &str) -> Options {
    let mut options = Options::default();
    options.properties.push((name.to_owned(), value.to_owned()));
    options
}

/// A value from the shop.
fn shop(name: &str, value: &str) -> Options {
    let mut options = Options::default();
    options.shop_properties.push((name.to_owned(), value.to_owned()));
    options
}

#[test]
fn the_first_who_says_it_counts() {
    let form = form(THROUGH, "([through])");
    let plain = job("", ["", ""]);
    let of_job = job("\"set\":{\"through\":\"on\"},", ["", ""]);
    let of_operation = job("\"set\":{\"through\":\"on\"},", ["\"set\":{\"through\":\"high\"},", ""]);
    let print = |job: &str, options: Options| print(&form, job, options).unwrap();
    assert_eq!(print(&plain, Options::default()), ["(OFF)", "(OFF)"]);
    let of_shop = shop("through", "high");
    assert_eq!(print(&plain, of_shop.clone()), ["(HIGH)", "(HIGH)"]);
    assert_eq!(print(&of_job, of_shop), ["(ON)", "(ON)"]);
    // a value of an operation applies only to this operation
    assert_eq!(print(&of_operation, Options::default()), ["(HIGH)", "(ON)"]);
    let caller = caller("through", "OFF");
    assert_eq!(print(&of_operation, caller), ["(OFF)", "(OFF)"]);
    // a shop's value for a property that this form lacks is ignored
    let other = shop("header", "no");
    assert_eq!(print(&plain, other), ["(OFF)", "(OFF)"]);
}

#[test]
fn each_kind_prints_and_is_asked() {
    let table = [
        ("Property pause number 1.5 Seconds", "P[pause]", "P1.5"),
        ("Property pause number 1.5 Seconds", "P[pause*2]", "P3"),
        ("Property gap length .25 Gap", "Q[gap]", "Q.25"),
        ("Property tilt angle 30 Tilt", "(TILT [tilt])", "(TILT 30)"),
        ("Property note text \"see card\" Remark", "([note])", "(SEE CARD)"),
        ("Property note text \"\" Remark", "([note])\nM1", "M1"),
        ("Property note text a-b Remark", "`MSG(`[note]`)`", "MSG(a-b)"),
        ("Property slow yesno yes Slow", "@if [slow]\nM41\n@else\nM42\n@end", "M41"),
        ("Property slow yesno no Slow", "@if [slow] = yes\nM41\n@else\nM42\n@end", "M42"),
        ("Property mode choice(off,on,high) high Mode", "@if [mode] = high and [tool] > 0\nM41\n@end", "M41"),
        ("Property mode choice(off,on,high) high Mode", "@if [mode] <> off\nM41\n@end", "M41"),
        ("Property note text x Remark", "@if [note] like \"?\"\nM41\n@end", "M41"),
        ("Property note text x Remark", "@if [note]\nM41\n@end", "M41"),
        ("Property count number 0 Count", "@set count = [count]+[tool]\nP[count]", "P1"),
        ("Property slow yesno no Slow", "@set slow = [tool] = 1\n@if [slow]\nM41\n@end", "M41"),
    ];
    for (head, lines, printed) in table {
        let found = print(&form(head, lines), &job("", ["", ""]), Options::default()).unwrap();
        assert_eq!(found[0], printed, "{head} {lines}");
    }
}

#[test]
fn lengths_are_in_the_forms_units() {
    let text = form("Units mm\nProperty gap length 25.4 Gap\nX->4.>4", "G[unitmode] Q[gap]");
    let printed = print(&text, &job("", ["", ""]), Options::default()).unwrap();
    assert_eq!(printed[0], "G20 Q1.");
}

#[test]
fn json_has_texts_numbers_and_yes_or_no() {
    let text = form("Property slow yesno no Slow\nProperty pause number 1 Seconds", "@if [slow]\nM41\n@end\nP[pause]");
    let said = job("\"set\":{\"slow\":true,\"pause\":2},", ["", ""]);
    assert_eq!(print(&text, &said, Options::default()).unwrap(), ["M41", "P2", "M41", "P2"]);
    for (set, code) in [
        ("\"slow\":2", "PR053"),
        ("\"slow\":\"perhaps\"", "PR053"),
        ("\"pause\":\"long\"", "PR053"),
        ("\"slwo\":true", "PR016"),
        ("\"val1\":\"two\"", "PR016"),
        ("\"val1\":null", "PJ003"),
        ("\"val1\":[1]", "PJ003"),
    ] {
        let error = print(&text, &job(&format!("\"set\":{{{set}}},"), ["", ""]), Options::default()).unwrap_err();
        assert_eq!(error.findings().diags.last().unwrap().code.name(), code, "{set}");
    }
    let wrong = [("slow", "2"), ("pause", "two"), ("other", "1")];
    for (name, value) in wrong {
        let options = caller(name, value);
        assert_eq!(print(&text, &said, options).unwrap_err().kind(), ErrorKind::Usage, "{name}");
    }
}

#[test]
fn wrong_properties_are_refused() {
    let table = [
        ("Property slow", "PF302"),
        ("Property slow yesno", "PF302"),
        ("Property slow yesno maybe Slow", "PF302"),
        ("Property slow switch yes Slow", "PF302"),
        ("Property mode choice() a Mode", "PF302"),
        ("Property mode choice(a) a Mode", "PF302"),
        ("Property mode choice(a,a) a Mode", "PF302"),
        ("Property mode choice(a,b) c Mode", "PF302"),
        ("Property mode choice(a, b) a Mode", "PF302"),
        ("Property Mode number 1 Mode", "PF302"),
        ("Property 2nd number 1 Mode", "PF302"),
        ("Property a-b number 1 Mode", "PF302"),
        ("Property speed number 1 Speed", "PF302"),
        ("Property toolname text x Name", "PF302"),
        ("Property and number 1 And", "PF302"),
        ("Property gap number inf Gap", "PF302"),
        ("Property gap number 1 Gap\nProperty gap number 2 Gap", "PF302"),
    ];
    for (head, code) in table {
        let found: Vec<&str> =
            check(&mill(head, "")).diags.iter().filter(|diag| diag.is_error()).map(|diag| diag.code.name()).collect();
        assert!(found.contains(&code), "{head}: {found:?}");
    }
    let uses = [
        ("@if [through] = hihg\nM1\n@end", "PF706"),
        ("@if [thruogh] = high\nM1\n@end", "PF202"),
        ("M[through]", "PF701"),
        ("[through]", "PF701"),
        ("Q[through+1]", "PF704"),
        ("@if [through] > 1\nM1\n@end", "PF704"),
        ("@set through = 1", "PF704"),
    ];
    for (lines, code) in uses {
        let checked = check(&form(THROUGH, lines));
        assert!(checked.diags.iter().any(|diag| diag.code.name() == code), "{lines}: {:?}", checked.diags);
    }
    let checked = check(&form("Property slow yesno no Slow", "Q[slow]\n(IS [slow])"));
    assert_eq!(checked.diags.iter().filter(|diag| diag.code.name() == "PF704").count(), 4, "{:?}", checked.diags);
}

#[test]
fn a_property_that_nothing_asks_is_a_warning() {
    let found = |text: &str| {
        let checked = check(text);
        lint(&checked, &Default::default()).diags.iter().filter(|diag| diag.code.name() == "PF710").count()
    };
    assert_eq!(found(&form(THROUGH, "M1")), 1);
    assert_eq!(found(&form(THROUGH, "@set val1 = 1\n@if [through] = on\nM1\n@end")), 0);
    assert_eq!(found(&form(THROUGH, "([through])")), 0);
}

/// In a form for both units, a number beside a length is in another unit than the default of the length.
#[test]
fn a_number_beside_a_length_is_a_warning() {
    let both = "Units both\nProperty lift length 2 Height\nProperty count number 2 Count";
    let cases = [
        ("@set lift = 2", true),
        ("@set lift = -2", true),
        ("@set lift = 0", false),
        ("@set lift = [lift]*2", false),
        ("@set count = 3", false),
        ("@if [lift] > 2\nM1\n@end", true),
        ("@if [tool] = 1 or 2 < [lift]\nM1\n@end", true),
        ("@if [tool] > 1\n@set lift = 3\n@end", true),
        ("@if [unitmode] = mm\n@set lift = 50\n@else\n@set lift = 2\n@end", false),
    ];
    let found = |head: &str, lines: &str| {
        let checked = check(&form(head, &format!("{lines}\nQ[lift] P[count]")));
        lint(&checked, &Default::default()).diags.iter().any(|diag| diag.code.name() == "PF717")
    };
    for (lines, expected) in cases {
        assert_eq!(found(both, lines), expected, "{lines}");
        assert!(!found(&both.replace("both", "mm"), lines), "{lines}");
    }
}

#[test]
fn a_form_keeps_texts_in_properties() {
    let head =
        "Property note text - What it is\nProperty mode choice(fine,rough) fine How\nProperty on yesno no Anything";
    let job = job("", ["\"name\":\"Pocket 1\",", "\"name\":\"Holes\","]);
    let lines = "@if [opname] like \"pocket*\"\n  @set note = [opname]\n  @set mode = rough\n  @set on = yes\n@end\n\
                 @if [mode] = rough and [on]\n  (NOTE [note])\n@else\n  (PLAIN)\n@end\n@set mode = \"FINE\"";
    let printed = self::print(&form(head, lines), &job, Options::default()).unwrap();
    // the first tool change prints the values that it sets; in the second, `mode` is `fine` again
    assert_eq!(printed, ["(NOTE POCKET 1)", "(PLAIN)"]);
    let refused = |line: &str| {
        let found = lint(&check(&form(head, line)), &Default::default()).diags;
        // reported once for each tool change
        let mut codes: Vec<_> = found.iter().filter(|diag| diag.is_error()).map(|diag| diag.code.name()).collect();
        codes.dedup();
        codes
    };
    assert_eq!(refused("@set mode = raw"), ["PF706"]);
    assert_eq!(refused("@set mode = [opname]"), ["PF706"]);
    assert_eq!(refused("@set note = 5"), ["PF704"]);
    assert_eq!(refused("@set val1 = \"A\""), ["PF704"]);
}

#[test]
fn a_choice_is_one_of_its_words() {
    let refused = |condition: &str| {
        let lines = format!("@if {condition}\n  M88\n@end");
        let found = lint(&check(&form(THROUGH, &lines)), &Default::default()).diags;
        let mut codes: Vec<_> = found.iter().filter(|diag| diag.is_error()).map(|diag| diag.code.name()).collect();
        codes.dedup();
        codes
    };
    assert_eq!(refused("[through] = \"HIGH\""), [""; 0]);
    assert_eq!(refused("[through] = \"hihg\""), ["PF706"]);
    assert_eq!(refused("[through] < high"), ["PF704"]);
    let job = job("", ["", ""]);
    let lines = "@if [through] = \"HIGH\"\n  M88\n@end";
    assert_eq!(print(&form(THROUGH, lines), &job, caller("through", "high")).unwrap(), ["M88", "M88"]);
}

/// The form's default is in the units of the form, which are inches for a form of both units. Values from the caller
/// and from the shop are in the units of the program.
#[test]
fn lengths_of_a_form_for_both_units() {
    let form = form("Units both\nProperty gap length .25 Gap\nX->4.>4\nQ->4.>3", "Q[gap]");
    let metric = job("", ["", ""]).replace("\"inch\"", "\"mm\"");
    let of = |job: &str, options: Options| print(&form, job, options).unwrap()[1].clone();
    assert_eq!(of(&metric, Options::default()), "Q6.35");
    assert_eq!(of(&metric, caller("gap", "5")), "Q5.");
    assert_eq!(of(&metric, shop("gap", "5")), "Q5.");
    let of_job = metric.replacen("\"units\"", "\"set\":{\"gap\":5},\"units\"", 1);
    assert_eq!(of(&of_job, Options::default()), "Q5.");
    // lengths in a job are in its own units, whatever the program's units are
    let mut inches = Options::default();
    inches.units = Some(postform::toolpath::Units::Inch);
    assert_eq!(of(&of_job.replace("\"gap\":5", "\"gap\":25.4"), inches), "Q1.");
    let inch = job("", ["", ""]);
    assert_eq!(of(&inch, Options::default()), "Q.25");
    assert_eq!(of(&inch, caller("gap", "5")), "Q5.");
}
