//! After each code of each control, the renderer must assume the same state as the simulator. A sequence prints the
//! code between two cuts. In the simulator, the blocks after the code must make the motions of the job. The only
//! allowed findings are effects of the code itself: a stop, a dwell, a moved frame.

use postform::diag::Code;
use postform::internals::control::{Control, Meaning, names};
use postform::internals::verify::Finding;
use postform::{Job, NoFiles, Options, Post, Source, Verdict};

/// Cuts, a row that begins with the code, an arc, two holes and a rapid.
const JOB: &str = r#"{"postform":1,"program":100,"units":"inch","tools":[{"number":1,"length_offset":1,"diameter_offset":1}],
"operations":[{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":10,"path":[
{"rapid":[0,0,1]},{"rapid":[0,0,0.1]},{"line":[0,0,-0.1]},{"line":[1,0,-0.1]},{"begin":"row"},{"line":[1,1,-0.1]},{"end":"row"},
{"line":[2,1,-0.1]},{"arc":{"to":[3,2],"center":[2,2],"direction":"ccw"}},{"line":[3,2,1]},
{"cycle":{"kind":"drill","clear":0.1,"return":1,"feed":8,"depth":0.5,"points":[[4,4,0],[5,4,0]]}},{"rapid":[6,6,1]}]}]}"#;

/// A form for a control that prints this block at the beginning of each row.
fn form(control: &Control, typed: &str) -> String {
    let grbl = control.is_like("grbl");
    let length = if grbl { "" } else { "G43 H[lcomp] " };
    let cycle = "Drill\nG98 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel\nCancel\nG80\nEnd\n";
    let (tape, change, cycle) = if grbl { ("", "", "") } else { ("%0\n", "T[tool] M6\n", cycle) };
    format!(
        "Control {}\nStartCode\n{tape}G17 G20 G40 G80 G90 G94\nEnd\n1stToolChange\n{change}G0 G90 G[work] X[h] Y[v]\n\
         S[speed] M[direct]\n{length}Z[d]\nEnd\nToolChange\n{change}End\nBeginRow\n{typed}\nEnd\n{cycle}EndCode\nM30\n{tape}End\n",
        control.name()
    )
}

/// The findings that a code of this meaning causes by itself, and that later blocks can't prevent.
fn own_doing(meaning: Meaning) -> &'static [Code] {
    use Meaning as M;
    match meaning {
        M::Dwell => &[Code::PV010],
        M::StopProgram | M::StopOptional | M::Pallet => &[Code::PV019],
        // Grbl continues after this code, with all modal states reset
        M::End | M::Return => &[Code::PV017, Code::PV011],
        // the code moves the axes of its axis words; this move is not in the job's path
        M::Reference | M::Machine | M::ToolChange => &[Code::PV001],
        // after this code, the job's positions are in another frame
        M::Frame | M::Preset | M::Data => &[Code::PV021, Code::PV001],
        M::LengthOn | M::LengthOff | M::LengthData => &[Code::PV014, Code::PV001],
        // a cycle is not allowed after this code
        M::SideLeft | M::SideRight => &[Code::PV018, Code::PV015],
        _ => &[],
    }
}

/// Whether the finding is a refusal of the typed block itself.
fn refuses(finding: &Finding, block: &str) -> bool {
    finding.code == Code::PV015 && finding.message.contains(&format!("in `{block}"))
}

/// After a typed block: the first finding that is not an effect of the code itself.
fn disagreement(control: &Control, meaning: Meaning, typed: &str) -> Option<String> {
    let text = form(control, typed);
    let post = Post::compile(Source::from_text("form.pf", &text), &NoFiles).ok()?;
    // an error of the renderer is accepted
    let program = post.render(Job::json(JOB), &Options::default()).ok()?;
    let verdict = post.verify(Job::json(JOB), program.text()).unwrap();
    let Verdict::Different(findings) = verdict else { return None };
    let block = typed.replace("[h]", "1.");
    if refuses(&findings[0], &block) {
        return None;
    }
    let wrong = findings.iter().find(|finding| !own_doing(meaning).contains(&finding.code))?;
    Some(format!("{} {typed}: {} {}", control.name(), wrong.code.name(), wrong.message))
}

#[test]
fn renderer_and_simulator_believe_the_same_of_every_code() {
    let (mut wrong, mut tried) = (Vec::new(), 0);
    for control in names().filter_map(Control::named) {
        for row in control.rows() {
            let code = row.code.to_string();
            // on a Fadal, E selects a work offset
            let words = (b'A'..=b'Z').filter(|&letter| letter != b'E' && row.words.has(letter));
            let all: String = words.map(|letter| format!(" {}1", char::from(letter))).collect();
            for typed in [code.clone(), format!("{code}{all}"), format!("{code} X[h]")] {
                tried += 1;
                wrong.extend(disagreement(control, row.meaning, &typed));
            }
        }
    }
    assert!(tried > 1000, "{tried}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
