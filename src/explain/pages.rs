//! The texts about codes. A code for forms has its own page. Every other code has a section of a page.

use crate::diag::{Code, CodeRow};

macro_rules! pages {
    ($($code:ident)*) => {
        /// The pages of docs/rules.
        const RULES: &[(Code, &str)] =
            &[$((Code::$code, include_str!(concat!("../../docs/rules/", stringify!($code), ".md")))),*];
    };
}

pages! {
    PF001 PF002 PF003 PF004 PF005 PF006 PF007 PF008 PF009 PF010 PF011 PF012 PF013 PF014 PF015 PF016 PF017 PF018 PF019
    PF020 PF021
    PF101 PF102 PF103 PF104 PF105 PF106 PF107 PF108 PF109 PF110 PF111 PF112 PF201 PF202 PF203 PF204 PF205 PF206
    PF207 PF208 PF209 PF210 PF211 PF301 PF302 PF303 PF304 PF305 PF306 PF307 PF308 PF309 PF310 PF311 PF312 PF313
    PF314 PF315 PF316 PF317 PF318 PF401 PF402 PF403 PF404 PF405 PF406 PF407 PF408 PF409 PF410 PF411 PF412 PF413 PF414
    PF415 PF416 PF417 PF418 PF419 PF420 PF421 PF422 PF423 PF424 PF425 PF426 PF427 PF428 PF429 PF430 PF431 PF432
    PF433 PF434 PF435 PF436 PF437 PF438 PF439 PF440 PF441 PF442 PF443 PF444 PF445 PF446 PF501 PF502 PF503 PF504 PF505 PF506 PF507 PF601 PF602 PF603 PF604
    PF605 PF606 PF607 PF608 PF609 PF701 PF702 PF703 PF704 PF705 PF706 PF707 PF708 PF709 PF710 PF711 PF712 PF713 PF714
    PF715 PF716 PF717 PF718 PF719
}

/// Pages with a section for each code. The heading of a section begins with the code.
const SECTIONS: [&str; 5] = [
    include_str!("../../docs/cycles.md"),
    include_str!("../../docs/programs.md"),
    include_str!("../../docs/verify.md"),
    include_str!("../../docs/machine.md"),
    include_str!("../../docs/errors.md"),
];

/// The text about a code, without its heading.
pub fn of(row: &CodeRow) -> String {
    if let Some((_, page)) = RULES.iter().find(|(code, _)| *code == row.code) {
        return page.split_once("\n").map_or("", |(_, body)| body).trim().to_owned();
    }
    let head = format!("### {} ", row.name);
    let Some(at) = SECTIONS.iter().find_map(|page| page.split_once(&head)) else { return String::new() };
    let body = at.1.split_once('\n').map_or("", |(_, body)| body);
    let end = body.find("\n##").unwrap_or(body.len());
    body[..end].trim().to_owned()
}
