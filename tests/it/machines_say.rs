//! Features of machines that the manual does not describe. Each is tested with two posts: one with G codes and one in
//! Klartext.

use crate::support::{check, render_checked};
use postform::internals::render::{Clock, Options};

const JOB: &str = r#"{"postform": 1, "name": "flange-7", "part": "Flange", "units": "mm",
  "tools": [{"number": 1, "name": "DRILL_8", "diameter": 8, "comment": "HSS"}, {"number": 2, "name": "MILL_10", "diameter": 10}],
  "operations": [
    {"tool": 1, "name": "Holes", "comment": "through", "work": 54, "spindle": {"speed": 1200, "direction": "cw"}, "coolant": "mist", "feed": 100,
     "path": [{"rapid": [10, 10, 30]},
              {"cycle": {"kind": "drill", "depth": 15, "clear": 2, "return": 20, "feed": 100, "points": [[10, 10, 0], [30, 10, -5]]}}]},
    {"tool": 2, "name": "Contour", "spindle": {"speed": 3000, "direction": "cw"}, "coolant": "on", "feed": 400,
     "path": [{"rapid": [0, 0, 30]}, {"rapid": [0, 0, 2]}, {"line": [0, 0, -2]}, {"arc": {"to": [0, 0, -2], "center": [20, 0], "direction": "ccw"}}]}
  ]}"#;

/// A post with G codes. The lines are inserted in its head, in StartCode, in its tool changes and after all sequences.
fn codes(head: &str, start: &str, change: &str, more: &str) -> String {
    let change =
        format!("T[tool] M6\n{change}\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]\nEnd\n");
    format!(
        "Control fanuc\nUnits mm\nX->5.>3\nY->5.>3\nZ->5.>3\nR->5.>3\nF >5\nH >3\nT >3\n{head}\nStartCode\n%0\n{start}\nEnd\n\
         1stToolChange\n{change}ToolChange\nG91 G28 Z0 M5\nG90\n{change}EndCode\nM30\n%0\nEnd\n{more}\n"
    )
}

/// A post in Klartext.
fn klartext(head: &str, start: &str, change: &str, more: &str) -> String {
    let change = format!(
        "`TOOL CALL `[tool]` Z S`[speed]\n{change}\nL X[h] Y[v] `R0 FMAX` M[direct]\nL Z[d] `R0 FMAX` M[cool]\nEnd\n"
    );
    format!(
        "Units mm\nComment ;\nX+>5~>3\nY+>5~>3\nZ+>5~>3\nF >5\nUpperCaseComments? N\n{head}\nStartCode\n`BEGIN PGM `[progname]` MM`\n{start}\nEnd\n\
         1stToolChange\n{change}ToolChange\n{change}RapidCode\nL X[h] Y[v] Z[d] `FMAX`\nEnd\nLineCode\nL X[h] Y[v] Z[d] F[frate]\nEnd\n\
         EndCode\nM30\n`END PGM `[progname]` MM`\nEnd\n{more}\n"
    )
}

fn print(form: &str) -> Vec<String> {
    let checked = check(form);
    let errors: Vec<_> = checked.diags.iter().filter(|diag| diag.is_error()).collect();
    assert!(errors.is_empty(), "{form}\n{errors:?}");
    let clock = Some(Clock { date: "2026-03-31".into(), time: "14:05".into() });
    let options = Options { clock, ..Options::default() };
    let rendered =
        render_checked(&checked, JOB.as_bytes(), false, options).unwrap_or_else(|diag| panic!("{form}\n{diag:?}"));
    rendered.text.lines().map(str::to_owned).collect()
}

/// Checks that each of these forms prints its lines.
fn say(cases: [(String, &[&str]); 2]) {
    for (form, lines) in cases {
        let printed = print(&form);
        for line in lines {
            assert!(printed.iter().any(|own| own == line), "`{line}` is not in\n{}", printed.join("\n"));
        }
    }
}

#[test]
fn the_programs_name_and_the_day() {
    say([
        (codes("", "O0007 ([progname] [date])", "", ""), &["O0007 (FLANGE-7 2026-03-31)"]),
        (
            klartext("", "; [partname] [date] [time]", "", ""),
            &["BEGIN PGM flange-7 MM", "; Flange 2026-03-31 14:05", "END PGM flange-7 MM"],
        ),
    ]);
}

#[test]
fn tools_by_their_names() {
    say([
        (codes("", "", "`T=\"`[toolname]`\"` M6", ""), &["T=\"DRILL_8\" M6", "T=\"MILL_10\" M6"]),
        (klartext("", "", "; [toolname] [tooltext]", ""), &["; DRILL_8 HSS", "; MILL_10 "]),
    ]);
}

#[test]
fn lists_of_tools_and_operations() {
    let list = "@for tool\n  (T[tool] [toolname] D[toold])\n  @for operation\n    (- [opname])\n  @end\n@end";
    let talk = "@for tool\n  ; TOOL [tool] [toolname] R[toold/2]\n@end";
    say([
        (codes("", list, "", ""), &["(T1 DRILL_8 D8)", "(- HOLES)", "(T2 MILL_10 D10)", "(- CONTOUR)"]),
        (klartext("", talk, "", ""), &["; TOOL 1 DRILL_8 R4", "; TOOL 2 MILL_10 R5"]),
    ]);
}

#[test]
fn how_far_the_cuts_reach() {
    let stock = "`BLK FORM 0.1 Z` X[hmin] Y[vmin] Z[dmin]\n`BLK FORM 0.2` X[hmax] Y[vmax] Z[dmax]";
    say([
        (codes("", "(X[hmin] TO [hmax], Z[dmin])", "", ""), &["(X0 TO 40, Z-20)"]),
        (klartext("", stock, "", ""), &["BLK FORM 0.1 Z X0 Y-20 Z-20", "BLK FORM 0.2 X+40 Y+20 Z+2"]),
    ]);
}

#[test]
fn a_block_for_each_operation() {
    let smooth = "Operation\n@if [opname] like \"cont*\"\n  `G5.1 Q1`\n@else\n  `G5.1 Q0`\n@end\nEnd";
    let tolerance = "Operation\n; [opname]: [optext]\n`CYCL DEF 32.0 TOLERANZ`\nEnd";
    say([
        (codes("", "", "", smooth), &["G5.1 Q0", "G5.1 Q1"]),
        (klartext("", "", "", tolerance), &["; Holes: through", "CYCL DEF 32.0 TOLERANZ"]),
    ]);
}

#[test]
fn the_tool_that_comes_next() {
    say([
        (codes("", "", "T[nexttool]", ""), &["T2", "T1"]),
        (klartext("", "", "@if not [islasttool]\n`TOOL DEF `[nexttool]\n@end", ""), &["TOOL DEF 2"]),
    ]);
}

#[test]
fn coolant_by_its_kind() {
    let kinds = "@if [cool] = mist\nM51 (AIR)\n@elif [through]\nM88\n@end";
    let head = "Property through yesno yes Coolant through the spindle";
    say([
        (codes(head, "", kinds, ""), &["M51 (AIR)", "M88"]),
        (klartext(head, "", &kinds.replace("(AIR)", "; AIR"), ""), &["M51 ; AIR", "M88"]),
    ]);
}

#[test]
fn conditions_and_arithmetic() {
    let lines = "@if [toold] > 9\n`M41`\n@else\n`M42`\n@end";
    say([
        (codes("", "", &format!("{lines}\n`#500=`[speed*2]"), ""), &["M42", "M41", "#500=2400", "#500=6000"]),
        (klartext("", "", &format!("{lines}\n`Q1=`[toold/2]"), ""), &["M42", "M41", "Q1=4", "Q1=5"]),
    ]);
}

#[test]
fn heights_as_distances() {
    let siemens = "Drill 2\nF[frate]\n`MCALL CYCLE81(`[rplane]`,`[pointd]`,`[vclear-pointd]`,`[d]`)`\nX[h] Y[v]\nEnd\n";
    let tnc = "Drill 1\n`CYCL DEF 200 Q200=`[vclear-pointd]` Q201=`[-depth]` Q206=`[frate]` Q203=`[pointd]` Q204=`[rplane-pointd]\nL X[h] Y[v] M99\nEnd\n";
    say([
        (codes("Comment ;", "", "", siemens), &["MCALL CYCLE81(20,0,2,-15)", "MCALL CYCLE81(20,-5,2,-20)"]),
        (
            klartext("", "", "", tnc),
            &[
                "CYCL DEF 200 Q200=2 Q201=-15 Q206=100 Q203=0 Q204=20",
                "CYCL DEF 200 Q200=2 Q201=-15 Q206=100 Q203=-5 Q204=25",
            ],
        ),
    ]);
}

#[test]
fn block_numbers_with_and_without_a_letter() {
    say([
        (codes("Sequence#s N 10 10", "", "", ""), &["N20 T1 M6"]),
        (klartext("Sequence#s - 0 1", "", "", ""), &["0 BEGIN PGM flange-7 MM", "2 TOOL CALL 1 Z S1200"]),
    ]);
}

#[test]
fn properties_by_name() {
    let head = "Property cover yesno yes Close the cover\nProperty table text left Table";
    let lines = "@if [cover]\n`M80`\n@end";
    say([
        (codes(head, "([table])", lines, ""), &["(LEFT)", "M80"]),
        (klartext(head, "; [table]", lines, ""), &["; left", "M80"]),
    ]);
}

#[test]
fn comments_stops_and_dwells_in_their_own_words() {
    let job_words = "CommentLine\n`; `_[text]\nEnd";
    say([
        (codes("", "", "", "Operation\n([optext])\nEnd"), &["(THROUGH)"]),
        (klartext("", "", "", job_words), &["; _through"]),
    ]);
}

#[test]
fn macro_text_stands_in_backquotes() {
    let okuma = "`VC1=`[tool]\n`IF [VC1 EQ 2] N500`\n`CALL O100 PX=1`";
    let fanuc = "`#500=1`\n`IF [#1 GT 2] GOTO 5`\n`#<_x>=[#5221+1.]`";
    say([
        (
            codes("", fanuc, okuma, ""),
            &["#500=1", "IF [#1 GT 2] GOTO 5", "#<_x>=[#5221+1.]", "VC1=1", "IF [VC1 EQ 2] N500", "CALL O100 PX=1"],
        ),
        (
            klartext("", "`FN 9: IF +Q1 EQU +2 GOTO LBL 5`\n`$P[1]=R1`", "", ""),
            &["FN 9: IF +Q1 EQU +2 GOTO LBL 5", "$P[1]=R1"],
        ),
    ]);
}
