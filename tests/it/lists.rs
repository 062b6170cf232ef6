//! Values from later parts of the job: lists of tools, operations and work offsets; extents, sums, the next tool;
//! errors.

use crate::support::{check, mill, program};
use postform::{ErrorKind, Job, NoFiles, Options, Post, Source};

/// A form whose StartCode prints these lines.
fn form(lines: &str) -> String {
    mill("Units both\nX->4.>4\nY->4.>4\nZ->4.>4", "").replacen("%0\n", &format!("%0\nG[unitmode]\n{lines}\n"), 1)
}

/// Options without a proof.
fn unproven() -> Options {
    let mut options = Options::default();
    options.proof = None;
    options
}

/// The error codes of a form, each once.
fn codes(form: &str) -> Vec<&'static str> {
    let mut codes: Vec<_> =
        check(form).diags.iter().filter(|diag| diag.is_error()).map(|diag| diag.code.name()).collect();
    codes.dedup();
    codes
}

/// A job of these operations: tool, work offset, path.
fn job(operations: &[(u32, u32, &str)]) -> String {
    let operations = operations.iter().enumerate().map(|(i, (tool, work, path))| {
        format!(
            "{{\"tool\":{tool},\"name\":\"op {i}\",\"work\":{work},\"spindle\":{{\"speed\":{tool}000,\"direction\":\"cw\"}},\
             \"feed\":60,\"path\":[{{\"rapid\":[0,0,5]}},{path}]}}"
        )
    });
    format!(
        "{{\"postform\":1,\"units\":\"mm\",\"tools\":[{{\"number\":1,\"name\":\"Mill\",\"diameter\":10}},\
         {{\"number\":2,\"name\":\"Drill\",\"diameter\":5}},{{\"number\":3}}],\"operations\":[{}]}}",
        operations.collect::<Vec<_>>().join(",")
    )
}

const LINE: &str = "{\"line\":[10,0,-1]}";
const HOLES: &str = "{\"cycle\":{\"kind\":\"drill\",\"depth\":8,\"clear\":2,\"feed\":30,\"points\":[[1,2,0],[5,2,0]]}}";

/// The output of these lines in StartCode.
fn lines(lines: &str, job: &str) -> Vec<String> {
    let printed = program(&form(lines), job);
    match printed.iter().position(|line| line == "T1 M6") {
        Some(end) => printed[2..end].to_vec(),
        None => printed,
    }
}

#[test]
fn lists_print_once_for_each() {
    let job = job(&[(1, 54, LINE), (2, 54, HOLES), (1, 54, LINE), (3, 54, LINE)]);
    assert_eq!(
        lines("@for tool\n  (T[tool] [toolname] D[toold] S[speed] [opcount])\n@end", &job),
        ["(T1 MILL D10 S1000 2)", "(T2 DRILL D5 S2000 1)"] // the third has no name: a comment with only empty texts is left out
    );
    assert_eq!(lines("@for tool\n(T[tool])\n@end", &job), ["(T1)", "(T2)", "(T3)"]);
    assert_eq!(
        lines("@for operation\n([opname] BY T[tool] H[lcomp] [holecount])\n@end", &job),
        ["(OP 0 BY T1 H1 0)", "(OP 1 BY T2 H2 2)", "(OP 2 BY T1 H1 0)", "(OP 3 BY T3 H3 0)"]
    );
    assert_eq!(
        lines("@for tool\n(T[tool])\n@for operation\n(- [opname])\n@end\n@end", &job),
        ["(T1)", "(- OP 0)", "(- OP 2)", "(T2)", "(- OP 1)", "(T3)", "(- OP 3)"]
    );
}

#[test]
fn conditions_inside_a_list_are_asked_for_each() {
    let job = job(&[(1, 54, LINE), (2, 54, HOLES), (3, 55, LINE)]);
    let text = "@set val1 = 0\n@for tool\n@if [holecount] > 0\n(DRILLS WITH [tool])\n@elif [toolname]\n(MILLS WITH [toolname])\n\
                @else\n@set val1 = [val1]+1\n@end\n@end\n([val1] WITHOUT A NAME)\n@if [opcount] = 3\nM99\n@end";
    assert_eq!(lines(text, &job), ["(MILLS WITH MILL)", "(DRILLS WITH 2)", "(1 WITHOUT A NAME)", "M99"]);
}

#[test]
fn sums_are_those_of_the_whole_program() {
    let job = job(&[(1, 54, LINE), (2, 54, HOLES)]);
    // from 0 0 5 to 10 0 -1, then two holes, each with 2 + 8 mm at 30 mm/min
    let length = (100.0_f64 + 36.0).sqrt() + 20.0;
    let seconds = ((100.0_f64 + 36.0).sqrt() / 60.0 + 20.0 / 30.0) * 60.0;
    let printed = lines("([toolcount] [opcount] [holecount] [round(cutlength*100)] [round(cuttime*100)])", &job);
    assert_eq!(printed, [format!("(2 2 2 {} {})", (length * 100.0).round(), (seconds * 100.0).round())]);
}

#[test]
fn extents_are_those_of_the_cuts_arcs_among_them() {
    let arc = "{\"line\":[10,0,0]},{\"arc\":{\"to\":[-10,0,0],\"center\":[0,0],\"direction\":\"ccw\"}},{\"rapid\":[-20,0,50]}";
    let extents = "X[hmin] X[hmax] Y[vmin] Y[vmax] Z[dmin] Z[dmax]";
    assert_eq!(lines(extents, &job(&[(1, 54, arc)])), ["X-10. X10. Y0 Y10. Z0 Z5."]);
    let moves = "X[rhmin] X[rhmax] Y[rvmin] Y[rvmax] Z[rdmin] Z[rdmax]";
    assert_eq!(lines(moves, &job(&[(1, 54, arc)])), ["X-20. X10. Y0 Y10. Z0 Z50."]);
    // the extents of a hole begin at its clearance plane
    assert_eq!(lines(extents, &job(&[(1, 54, HOLES)])), ["X1. X5. Y2. Y2. Z-8. Z2."]);
    // in the program's units
    let post = Post::compile(Source::from_text("form.pf", form(extents)), &NoFiles).unwrap();
    let mut options = unproven();
    options.units = Some(postform::toolpath::Units::Inch);
    let job = job(&[(1, 54, "{\"line\":[25.4,0,0]}")]);
    let program = post.render(Job::json(&job), &options).unwrap();
    assert_eq!(program.text().lines().nth(2), Some("X0 X1. Y0 Y0 Z0 Z.1969"));
}

#[test]
fn each_work_offset_has_extents_of_its_own() {
    let job = job(&[(1, 54, LINE), (1, 55, "{\"line\":[20,5,0]}")]);
    assert_eq!(
        lines("@for work\n(G[work] X[hmin] TO [hmax], [opcount])\n@end", &job),
        ["(G54 X0 TO 10, 1)", "(G55 X0 TO 20, 1)"]
    );
    let error = "PR052 [hmin] in a job with several work offsets";
    assert_eq!(lines("(X[hmin])", &job), [error]);
    assert_eq!(lines("X[hmin]", &job), [error]);
    assert_eq!(lines("@if [hmin]\n(X[hmin])\n@else\n(TWO PARTS)\n@end", &job), ["(TWO PARTS)"]);
    // the fixture number 1, its code 54 and the form's default are the same work offset
    let one = job.replacen("\"work\":54", "\"work\":1", 1).replacen("\"work\":55", "\"work\":54", 1);
    assert_eq!(lines("(X[hmin] TO [hmax])", &one), ["(X0 TO 20)"]);
    let none = job.replacen(",\"work\":54", "", 1).replacen("\"work\":55", "\"work\":54", 1);
    assert_eq!(lines("(X[hmin] TO [hmax])", &none), ["(X0 TO 20)"]);
}

#[test]
fn subprograms_count_where_they_are_called() {
    let job = job(&[(1, 54, "{\"call\":{\"sub\":7,\"times\":3,\"at\":[1,1]}}")]).replacen(
        "\"operations\"",
        "\"subprograms\":[{\"number\":7,\"path\":[{\"rapid\":[2,2,5]},{\"line\":[2,2,-5],\"feed\":10}]}],\"operations\"",
        1,
    );
    let subs = "SubStart\nO[sub]\nEnd\nSubEnd\nM99\nEnd\nSubCall\nM98 P[sub] L[times]\nEnd\n";
    let printed = program(&(form("([cutlength] X[hmin] TO [hmax], Z[dmin] TO [dmax])") + subs), &job);
    assert!(printed.contains(&"(30 X2 TO 2, Z-5 TO 5)".to_owned()), "{printed:?}");
}

#[test]
fn the_order_inside_a_list_is_that_of_its_items() {
    let job = job(&[(1, 54, LINE), (2, 54, HOLES), (1, 54, LINE), (3, 54, LINE)]);
    let text =
        "@for tool\n@if [isfirsttool]\n(FIRST)\n@end\n(T[tool] THEN T[nexttool])\n@if [islasttool]\n(LAST)\n@end\n@end";
    assert_eq!(lines(text, &job), ["(FIRST)", "(T1 THEN T2)", "(T2 THEN T3)", "(T3 THEN T1)", "(LAST)"]);
    let text = "@for operation\n(T[tool] BEHIND T[lasttool], [isfirsttool] [islasttool])\n@end";
    assert_eq!(
        lines(text, &job),
        ["(T1 BEHIND T-, 1 0)", "(T2 BEHIND T1, 0 0)", "(T1 BEHIND T2, 0 0)", "(T3 BEHIND T1, 0 1)"]
    );
    // also in a tool change, if the program has its own units
    let form = mill("Units both", "")
        .replace("T[tool] M6\n", "T[tool] M6\n@for tool\n@if [islasttool]\n(LAST IS T[tool])\n@end\n@end\n");
    let printed = program(&form.replace("%0\nEnd", "%0\nG[unitmode]\nEnd"), &job);
    assert_eq!(printed.iter().filter(|line| *line == "(LAST IS T3)").count(), 4, "{printed:?}");
}

/// A job in work offset 54 with these subprograms, and this path of its operation.
fn job_with(subprograms: &str, path: &str) -> String {
    job(&[(1, 54, path)]).replacen("\"operations\"", &format!("\"subprograms\":[{subprograms}],\"operations\""), 1)
}

/// The output of these lines in StartCode, by a form with subprograms.
fn lines_with_subs(lines: &str, job: &str) -> Vec<String> {
    let subs = "SubStart\nO[sub]\nEnd\nSubEnd\nM99\nEnd\nSubCall\nM98 P[sub] L[times]\nEnd\n";
    let printed = program(&(form(lines) + subs), job);
    let remarks: Vec<String> = printed.iter().filter(|line| line.starts_with('(')).cloned().collect();
    if remarks.is_empty() { printed } else { remarks }
}

#[test]
fn a_work_offset_that_a_subprogram_says_is_its_own() {
    let sub = "{\"number\":5,\"path\":[{\"work\":56},{\"rapid\":[0,0,5]},{\"line\":[7,7,-1],\"feed\":10}]}";
    let path = "{\"call\":{\"sub\":5}},{\"rapid\":[0,0,5]},{\"line\":[100,0,-1]}";
    let each = "@for work\n(G[work]: X[hmin] TO [hmax] Y[vmin] TO [vmax], [opcount])\n@end";
    let own = job_with(sub, path);
    assert_eq!(lines_with_subs(each, &own), ["(G54: X0 TO 100 Y0 TO 0, 1)", "(G56: X0 TO 7 Y0 TO 7, 1)"]);
    assert_eq!(lines_with_subs("(X[hmin])", &own), ["PR052 [hmin] in a job with several work offsets"]);
    // the work offset is given in a nested subprogram, in a call, or in a call inside a subprogram
    let plain = sub.replace("{\"work\":56},", "");
    let calls = |before: &str| format!("{{\"number\":6,\"path\":[{before}{{\"call\":{{\"sub\":5}}}}]}}");
    let (knows, through) = (calls("{\"work\":54},"), path.replace("\"sub\":5", "\"sub\":6"));
    for (subs, path) in [
        (format!("{sub},{knows}"), through.clone()),
        (plain.clone(), path.replace("\"sub\":5", "\"sub\":5,\"work\":56")),
        (format!("{plain},{}", calls("")), through.replace("\"sub\":6", "\"sub\":6,\"work\":56")),
    ] {
        let job = job_with(&subs, &path);
        assert_eq!(
            lines_with_subs(each, &job),
            ["(G54: X0 TO 100 Y0 TO 0, 1)", "(G56: X0 TO 7 Y0 TO 7, 1)"],
            "{subs} {path}"
        );
    }
}

#[test]
fn subprograms_that_call_each_other_are_counted_once_each() {
    // each of twelve subprograms calls the next one thirty times: the last one runs 30^11 times
    let sub = |number: u32| {
        let call = format!("{{\"call\":{{\"sub\":{}}}}}", number + 1);
        let path = if number == 12 {
            "{\"rapid\":[0,0,5]},{\"line\":[0,0,4],\"feed\":60}".to_owned()
        } else {
            [call.as_str(); 30].join(",")
        };
        format!("{{\"number\":{number},\"path\":[{path}]}}")
    };
    let subs = (1..=12).rev().map(sub).collect::<Vec<_>>().join(",");
    let job = job_with(&subs, "{\"call\":{\"sub\":1}},{\"rapid\":[0,0,5]}");
    assert_eq!(
        lines_with_subs("([cutlength/(30*30*30*30)/(30*30*30*30)] Z[dmin] TO [dmax])", &job),
        ["(27000 Z4 TO 5)"]
    );
}

#[test]
fn a_point_without_its_height_is_as_high_as_the_one_before() {
    let cycle = |more: &str, points: &str| {
        format!("{{\"cycle\":{{\"kind\":\"drill\",\"depth\":5,\"clear\":2,\"feed\":30{more},\"points\":[{points}]}}}}")
    };
    let heights = |more: &str, points: &str| {
        lines("([dmin] TO [dmax], [rdmax], [cutlength])", &job(&[(1, 54, &cycle(more, points))]))
    };
    assert_eq!(heights("", "[0,0,0],[10,0],[20,0]"), ["(-5 TO 2, 5, 21)"]);
    // the return plane of the first point applies to all points
    assert_eq!(heights(",\"return\":20", "[0,0,0],[10,0,10]"), ["(-5 TO 12, 20, 14)"]);
}

/// A form for a lathe whose StartCode prints these lines; X is a diameter.
fn lathe(lines: &str) -> String {
    format!(
        "Machine Lathe\nUnits both\nX->4.>4\nZ->4.>4\nI->4.>4\nK->4.>4\n\nStartCode\n%0\nG[unitmode] G18\n{lines}\nEnd\n\
         1stToolChange\nT[comp]\nG[speedtype] S[speed] M[direct]\nEnd\nToolChange\nT[comp]\nEnd\nEndCode\nM30\nEnd\n\
         CanThread 1\nG92 X[v] Z[h] I[taper] F[frate]\nX[v]\nEnd\n"
    )
}

#[test]
fn a_time_that_is_unknown_is_none() {
    let job = job(&[(1, 54, LINE)])
        .replacen("\"direction\":\"cw\"", "\"direction\":\"cw\",\"mode\":\"css\"", 1)
        .replace("\"feed\":60", "\"feed\":0.1,\"feed_mode\":\"per_rev\"");
    let text = "@if [cuttime]\n([cuttime] S)\n@else\n(LONG)\n@end\n([round(cutlength)] MM IN [cuttime] S)";
    let job = job.replace("\"units\"", "\"machine\":\"lathe\",\"units\"").replace("0,0,5", "0,0");
    let remarks = |to: &str| -> Vec<String> {
        let printed = program(&lathe(text), &job.replace("10,0,-1", to));
        printed.into_iter().filter(|line| line.starts_with('(')).collect()
    };
    // at radius 0, a surface speed gives no spindle speed, unless the job has a limit
    assert_eq!(remarks("10,0"), ["(LONG)", "(10 MM IN - S)"]);
    assert_eq!(remarks("10,5"), ["(.1054 S)", "(11 MM IN .1054 S)"]);
}

/// At a constant surface speed, the spindle has the speed that belongs to the middle of the cut. A later operation with a
/// speed without a mode is in revolutions per minute. Lists, totals and the row of each operation agree.
#[test]
fn a_surface_speed_gives_the_time_of_a_cut() {
    let operation = |spindle: &str, path: &str| {
        format!(
            r#"{{"tool":1,"work":54,"spindle":{spindle},"feed":0.2,"feed_mode":"per_rev","path":[{{"rapid":[2,30]}},{path}]}}"#
        )
    };
    let text = |path: &str| {
        let first = operation(r#"{"speed":200,"direction":"cw","mode":"css"}"#, path);
        let second = operation(r#"{"speed":500,"direction":"ccw"}"#, r#"{"line":[-20,30]}"#);
        format!(
            r#"{{"postform":1,"units":"mm","machine":"lathe","tools":[{{"number":1}}],"operations":[{first},{second}]}}"#
        )
    };
    let rows = "@for operation\n(G[speedtype] S[speed] M[direct] [round(cuttime * 10)])\n@end\n([round(cuttime * 10)])";
    let form = lathe(rows).replace("EndCode\n", "EndCode\n([round(totalcuttime * 10)] [totalcutdist])\n");
    let remarks = |path: &str| -> Vec<String> {
        program(&form, &text(path)).into_iter().filter(|line| line.starts_with('(') || line.starts_with("PR")).collect()
    };
    // 22 mm at 0.2 mm a turn: 110 turns at 200 m/min on the radius 30 take 6.2 s, and at 500 rpm 13.2 s
    assert_eq!(remarks(r#"{"line":[-20,30]}"#), ["(G96 S200 M3 62)", "(G97 S500 M4 132)", "(194)", "(194 44)"]);
    // a cut in the axis has no speed, and therefore no time
    let across = r#"{"line":[2,0]},{"line":[-20,0]}"#;
    assert_eq!(remarks(across), ["(G96 S200 M3 -)", "(G97 S500 M4 132)", "(-)", "(- 74)"]);
}

#[test]
fn a_thread_reaches_down_to_its_root() {
    let thread = "{\"thread\":{\"from\":[0.2,5],\"to\":[-9],\"pitch\":1,\"depth\":0.6,\"first_depth\":0.2}}";
    let job = job(&[(1, 54, thread)]).replace("\"units\"", "\"machine\":\"lathe\",\"units\"").replace("0,0,5", "1,6");
    let printed = program(&lathe("(X[vmin] TO [vmax])"), &job);
    assert!(printed.contains(&"(X8.8 TO 10)".to_owned()), "{printed:?}");
    let inside = job.replace("\"depth\":0.6", "\"depth\":-0.6").replace("1,6", "1,4");
    let printed = program(&lathe("(X[vmin] TO [vmax])"), &inside);
    assert!(printed.contains(&"(X10 TO 11.2)".to_owned()), "{printed:?}");
}

#[test]
fn the_next_tool_is_known_for_every_job() {
    let text = mill("", "").replace("T[tool] M6\n", "T[tool] M6\nT[nexttool]\n@if [islasttool]\nM99\n@end\n");
    let operations =
        job(&[(1, 54, LINE), (2, 54, HOLES), (1, 54, LINE)]).replace("\"units\":\"mm\"", "\"units\":\"inch\"");
    let tools = |job: &str| -> Vec<String> {
        program(&text, job)
            .into_iter()
            .filter(|line| line.starts_with('T') || line.starts_with('P') || line == "M99")
            .collect()
    };
    let all = ["T1 M6", "T2", "T2 M6", "T1", "T1 M6", "T1", "M99"];
    assert_eq!(tools(&operations), all);
    let said = operations.replacen("\"tools\"", "\"tool_order\":[1,2,1],\"tools\"", 1);
    assert_eq!(tools(&said), all);
}

#[test]
fn a_job_is_read_twice_only_where_the_form_asks() {
    let compile = |form: String| Post::compile(Source::from_text("form.pf", form), &NoFiles).unwrap();
    let job = job(&[(1, 54, LINE)]);
    let count = |post: &Post, options: &Options| {
        let mut readings = 0;
        let events = Job::events(|sink| {
            readings += 1;
            postform::internals::json::read_document(job.as_bytes(), sink)
        });
        let printed = post.render(events, options);
        (readings, printed)
    };
    assert_eq!(count(&compile(form("(PLAIN)")), &unproven()).0, 1);
    assert_eq!(count(&compile(form("([opcount])")), &unproven()).0, 2);
    let mut once = unproven();
    once.one_pass = true;
    let (readings, refused) = count(&compile(form("([opcount])")), &once);
    assert_eq!((readings, refused.unwrap_err().kind()), (0, ErrorKind::Usage));
    // a stream is kept in memory
    let post = compile(form("([opcount])"));
    let stream = Job::stream(postform::Format::Json, job.as_bytes());
    assert!(post.render(stream, &Options::default()).unwrap().text().contains("(1)"));
}

#[test]
fn wrong_lists_are_refused() {
    for text in [
        "@for\n(A)\n@end",
        "@for tools\n(A)\n@end",
        "@for each tool\n(A)\n@end",
        "@for tool\n(A)",
        "@for tool\n@for tool\n(A)\n@end\n@end",
        "@for operation\n@for operation\n(A)\n@end\n@end",
        "@for operation\n@for tool\n(A)\n@end\n@end",
        "@for tool\n(A)\n@else\n(B)\n@end",
    ] {
        assert_eq!(codes(&form(text)), ["PF707"], "{text}");
    }
    for sequence in [
        "LineCode\nG1 X[h] Y[v] Z[d] F[frate]\n@for tool\nM1\n@end\nEnd",
        "Peck\nG0 X[h] Y[v]\n@for work\nM1\n@end\nG1 Z[d] F[frate]\nEnd",
    ] {
        assert_eq!(codes(&mill("", sequence)), ["PF707"], "{sequence}");
    }
}

/// An operation with only a comment has the work offset in which it begins.
#[test]
fn an_operation_without_moves_has_its_offset() {
    let job = job(&[(1, 55, LINE)]);
    let job = job.strip_suffix("]}").unwrap();
    let job = format!("{job},{{\"tool\":1,\"name\":\"note\",\"work\":56,\"path\":[{{\"comment\":\"LOOK\"}}]}}]}}");
    assert_eq!(lines("@for operation\n([opname] G[work])\n@end", &job), ["(OP 0 G55)", "(NOTE G56)"]);
}

/// A form that uses the next tools gives an error if the job is read only once and does not list its tools. It never
/// prints another program.
#[test]
fn tools_ahead_are_not_guessed() {
    let text = mill(
        "Property short yesno no Short",
        "EndOperation\n@if not [short] and [islasttool]\nM9\n@else\nM1\n@end\nEnd",
    );
    let post = Post::compile(Source::from_text("form.pf", text), &NoFiles).unwrap();
    let plain = job(&[(1, 54, LINE), (2, 54, LINE)]).replace("\"units\":\"mm\"", "\"units\":\"inch\"");
    let mut once = unproven();
    once.one_pass = true;
    let error = post.render(Job::json(&plain), &once).unwrap_err().to_string();
    assert!(error.contains("the next tools are unknown"), "{error}");
    let listed = plain.replacen("\"tools\"", "\"tool_order\":[1,2],\"tools\"", 1);
    let printed = post.render(Job::json(&listed), &once).unwrap();
    assert_eq!(printed.text(), post.render(Job::json(&plain), &unproven()).unwrap().text());
    once.properties.push(("short".into(), "yes".into()));
    assert!(!post.render(Job::json(&plain), &once).unwrap().text().contains("M9"));
}

/// The time of a rigid tap includes both the feed in and the feed out.
#[test]
fn a_rigid_tap_has_its_time() {
    let tap = "{\"cycle\":{\"kind\":\"tap\",\"rigid\":true,\"depth\":8,\"clear\":2,\"feed\":600,\"points\":[[0,0,0]]}}";
    let text = form("([cuttime])")
        .replace("Cancel\nG80", "Tap\nG84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel\nCancel\nG80");
    let text = format!("RigidTap? Y\n{text}");
    assert!(
        program(&text, &job(&[(1, 54, tap)])).contains(&"(2)".to_owned()),
        "{:?}",
        program(&text, &job(&[(1, 54, tap)]))
    );
}

/// `[tool.holder]` is the value of `holder` under `data` of the tool. For a tool without this value, the variable is
/// empty, even after a tool with the value.
#[test]
fn fields_of_tools_are_those_of_the_tool() {
    let jobs = [LINE, LINE, LINE].map(|path| path.to_owned());
    let job = job(&[(1, 54, &jobs[0]), (1, 54, &jobs[1]), (2, 54, &jobs[2])]);
    let data = "\"data\":{\"holder\":\"ER32\",\"stickout\":38.5},";
    let job = job.replacen("{\"number\":1,", &format!("{{\"number\":1,{data}"), 1);
    assert!(job.contains("ER32"), "{job}");
    // a comment with only empty texts is left out
    let list = "@for tool\n  (T[tool] [tool.holder] [Tool.Stickout])\n@end";
    assert_eq!(lines(list, &job), ["(T1 ER32 38.5)"]);
    let asked = "@for tool\n@if [tool.holder] = \"ER32\"\n  (T[tool] IN ER32)\n@elif [tool.holder]\n  (OTHER)\n@else\n  (T[tool] IN WHAT)\n@end\n@end";
    assert_eq!(lines(asked, &job), ["(T1 IN ER32)", "(T2 IN WHAT)"]);
    // in each operation, also in the second one of a tool
    let form = mill("Units both\nX->4.>4\nY->4.>4\nZ->4.>4", "Operation\n(AT [tool.holder] [opname])\nEnd\n");
    let printed = program(&form, &job);
    let said: Vec<&String> = printed.iter().filter(|line| line.starts_with("(AT")).collect();
    assert_eq!(said, ["(AT ER32 OP 0)", "(AT ER32 OP 1)", "(AT  OP 2)"], "{printed:?}");
    // an invalid name is still reported
    let wrong = crate::support::check("StartCode\n(X [tool.])\nEnd\n");
    assert!(wrong.diags.iter().any(|diag| diag.message.contains("`tool.` is not a variable")), "{:?}", wrong.diags);
}
