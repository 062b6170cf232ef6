//! The source map, in both directions.

use crate::support;
use crate::support::{check_file, render_sample, root};
use postform::internals::trace::Trace;

#[test]
fn a_program_line_leads_to_its_form_line_and_item_and_back() {
    let folder = root().join("samples/drill-machine");
    let form = folder.join("form.pf");
    let rendered = render_sample(&folder, &form).unwrap();
    let checked = check_file(&form);
    let source = &checked.files[0];
    let text: Vec<&str> = rendered.text.lines().collect();
    let trace = Trace::new(rendered.trace);
    let second_hole = text.iter().position(|line| *line == "X2. Y3.").unwrap() as u64 + 1;
    let line = trace.line(second_hole).unwrap();
    assert_eq!(line.place.path(), "operations[0].path[0].cycle.points[1]");
    let span = line.form.unwrap();
    assert_eq!(source.slice(span), "G81 X[h] Y[v] Z[d] R[vclear] F[frate]");
    assert_eq!(trace.printed_by_form(span).collect::<Vec<_>>(), [second_hole - 1, second_hole, second_hole + 1]);
    // Cancel is printed at the end of the item
    assert_eq!(trace.line(second_hole + 2).unwrap().place.path(), "operations[0].path[0]");
    assert_eq!(trace.line(10_000), None);
}

#[test]
fn generated_blocks_have_no_form_line() {
    let lines = support::render(&support::mill("", ""), &support::job("{\"line\":[1,1,0]}")).unwrap();
    let generated: Vec<_> = lines.trace.iter().filter(|line| line.form.is_none()).collect();
    assert_eq!(generated.len(), 1);
    assert_eq!(generated[0].place.path(), "operations[0].path[1]");
}
