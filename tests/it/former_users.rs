//! Forms for the older compiler have the same meaning in postform. tests/data/cycles.json contains CL statements from
//! users of the older compiler. texts.rs and file_names.rs test files with several posts.

use crate::support::{check, program};

const FORM: &str = "Name Former
Control fanuc
Modality Y
X->4.>4
Y->4.>4
Z->4.>4
R->4.>4
F >5.>3
P >5
Sequence#s None
Dwell G4 P ms
Ask [program#] \"Program number\" 12
StartCode
%<0>
O[program#]
G[unitmode] G17 G40 G49 G80 G90 G94
End
1stToolChange
T<tool> M6  FADAL changer
G<work> G0 X<h> Y[v] S[speed] M[direct]
G43 H[lcomp] Z[d]
End
ToolChange
T[tool] M6
G[work] G0 X[h] Y[v] S[speed] M[direct]
G43 H[lcomp] Z[d]
End
Upon [d]
(DOWN TO [d])
End
Cancel
G80
End
Drill
G[etplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]
End Cancel
Custom1   Face
G[retplane] G82 X[h] Y[v] Z[d] R[vclear] P[dwell] F[frate]
End Cancel
EndCode
M30
%
End
";

#[test]
fn a_form_of_the_older_compiler_prints() {
    // angle brackets count as brackets, text after two blanks is a comment, and the form has no error
    let found = check(FORM);
    let serious: Vec<_> = found.diags.iter().filter(|diag| diag.is_error()).collect();
    assert!(serious.is_empty(), "{serious:?}");
    let hole = |dwell: &str, points: &str| {
        format!(
            "{{\"postform\":1,\"program\":3,\"units\":\"mm\",\"tools\":[{{\"number\":1}}],\"operations\":[{{\"tool\":1,\"work\":54,\"spindle\":\
             {{\"speed\":900,\"direction\":\"cw\"}},\"path\":[{{\"rapid\":[0,0,5]}},{{\"cycle\":{{\"kind\":\"drill\",\"depth\":5,\"clear\":1,\
             \"feed\":100{dwell},\"points\":{points}}}}}]}}]}}"
        )
    };
    // Upon [d] prints inside a cycle too: the cycle ends and is started again
    let printed = program(FORM, &hole("", "[[1,1,0],{\"at\":[3,3,0],\"depth\":7}]"));
    let holes: Vec<&str> = printed
        .iter()
        .map(String::as_str)
        .filter(|line| !line.starts_with(['G', 'T']) || line.contains("G81"))
        .collect();
    assert_eq!(
        holes,
        [
            "%",
            "O3",
            "(DOWN TO -5)",
            "Z1.",
            "G99 G81 X1. Y1. Z-5. R1. F100.",
            "(DOWN TO -7)",
            "G99 G81 X3. Y3. Z-7. R1. F100.",
            "M30",
            "%"
        ],
        "{printed:?}"
    );
    // a drill cycle with a dwell is printed as a facing cycle, if the form has one
    let printed = program(FORM, &hole(",\"dwell\":1", "[[1,1,0]]"));
    assert!(printed.iter().any(|line| line == "G99 G82 X1. Y1. Z-5. R1. P1000 F100."), "{printed:?}");
}

/// Abbreviated and additional variable names of the older compiler.
#[test]
fn variables_of_the_older_compiler_are_known() {
    for name in ["endh", "endv", "hcdc", "vcdc", "lastrotang", "etplane", "arcrad", "endang", "depth", "cool"] {
        let form = FORM.replace("M30\n", &format!("(AT [{name}])\nM30\n"));
        let unknown: Vec<_> = check(&form).diags.into_iter().filter(|diag| diag.code.name() == "PF202").collect();
        assert!(unknown.is_empty(), "[{name}]: {unknown:?}");
    }
}
