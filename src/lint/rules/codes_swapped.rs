//! PF211: a command has the right codes, but in the wrong order. Missing codes are reported by PF316 and similar rules.

use crate::diag::{Code, Diag};
use crate::lang::{Args, CommandId};
use crate::lint::view::View;

/// Commands that set motion codes. Two commands for motion codes must not set the same code.
const MOTION: [CommandId; 4] = [CommandId::Rapid, CommandId::Feed, CommandId::CW, CommandId::CCW];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (id, statement) in view.commands() {
        let row = id.row();
        // which code selects which plane depends on the machine
        if !matches!(row.args, Args::Codes(..) | Args::Motion(..)) || id == CommandId::ArcPlane {
            continue;
        }
        let usual = row.without.arguments(view.settings.machine, view.settings.units);
        let usual_codes = codes(usual.split(' '));
        // an argument after the arc code is a spindle code and not a motion code
        let motion = MOTION.contains(&id);
        let args = if motion { &statement.args[..statement.args.len().min(1)] } else { &statement.args[..] };
        let said = codes(args.iter().map(|arg| arg.text.as_str()));
        if said.len() != args.len() {
            continue; // another finding reports an invalid code
        }
        let swapped = match motion {
            true => said != usual_codes && said.iter().all(|code| (0.0..4.0).contains(code)),
            false => said != usual_codes && sorted(&said) == sorted(&usual_codes),
        };
        if swapped {
            let what = row.meaning.rsplit_once(": ").map_or("", |(_, order)| order);
            let order = if what.is_empty() { String::new() } else { format!(" ({what})") };
            diags.push(
                Diag::new(Code::PF211, format!("the codes of {} are in the wrong order", row.name))
                    .at(statement.line.span, "each code would be used for the function of another code")
                    .help(format!("write `{} {usual}`{order}", row.name)),
            );
        }
    }
}

/// The numbers of the codes, which may be written with or without letters.
fn codes<'a>(words: impl Iterator<Item = &'a str>) -> Vec<f64> {
    words.filter_map(|word| word.trim_start_matches(|c: char| c.is_ascii_alphabetic()).parse().ok()).collect()
}

fn sorted(codes: &[f64]) -> Vec<f64> {
    let mut codes = codes.to_vec();
    codes.sort_by(f64::total_cmp);
    codes
}
