//! CYCLE statements as they are written: types, options and their numbers.

use super::cycle_words::{OPTIONS, Opt, TYPES};
use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::feed_unit::Feed;
use super::report::Notes;
use super::words::Word;
use crate::diag::Code;
use crate::suggest::did_you_mean;
use crate::toolpath::CycleKind;

/// The depths and steps that share one feed.
#[derive(Clone, Debug, Default)]
pub(super) struct Group {
    pub depths: Vec<f64>,
    pub steps: Vec<f64>,
    pub feed: Option<(String, f64)>,
}

/// The content of a CYCLE statement before it is converted to a cycle. CYCLE/ON uses the content again.
#[derive(Clone, Debug, Default)]
pub(super) struct Coded {
    pub kind: Option<CycleKind>,
    pub mode: Option<CycleKind>,
    pub groups: Vec<Group>,
    /// The options and their numbers. DEPTH, STEP and feeds are not in this list.
    pub options: Vec<(Opt, Vec<f64>)>,
}

impl Coded {
    pub fn numbers(&self, option: Opt) -> Option<&[f64]> {
        self.options.iter().find(|(found, _)| *found == option).map(|(_, numbers)| numbers.as_slice())
    }

    pub fn has(&self, option: Opt) -> bool {
        self.numbers(option).is_some()
    }

    pub fn number(&self, option: Opt) -> Option<f64> {
        self.numbers(option)?.first().copied()
    }
}

/// Reads the type of a cycle and the word that modifies it, as in DRILL,DEEP or TAP,BRKCHP or BORE,BACK.
pub(super) fn cycle_type(words: &[Word]) -> Done<(Coded, &[Word])> {
    let name = words.first().and_then(Word::name).unwrap_or("");
    let Some((_, mut kind)) = TYPES.iter().find(|(word, _)| *word == name).copied() else {
        let names = TYPES.iter().map(|(word, _)| *word);
        let help = did_you_mean(name, names).unwrap_or_else(|| {
            "the cycle is one of DRILL, FACE, TAP, BORE, REAM, DEEP, BRKCHP, THRU, CSINK, MANUAL".into()
        });
        return fault(Code::PC001, format!("`{name}` is an unknown cycle"), help);
    };
    let mut rest = &words[1..];
    let mut mode = None;
    let next_is_number = rest.get(1).is_some_and(|word| word.number().is_some());
    let second = match (kind, rest.first().and_then(Word::name)) {
        (CycleKind::Drill | CycleKind::Tap, Some("DEEP")) => Some(CycleKind::Deep),
        (CycleKind::Drill | CycleKind::Tap, Some("BRKCHP")) => Some(CycleKind::Chipbreak),
        (CycleKind::Bore, Some("BACK")) if !next_is_number => Some(CycleKind::Back),
        _ => None,
    };
    if let Some(second) = second {
        rest = &rest[1..];
        if kind == CycleKind::Tap { mode = Some(second) } else { kind = second }
    }
    Ok((Coded { kind: Some(kind), mode, ..Coded::default() }, rest))
}

/// Reads the options of a CYCLE statement. `whole` is false for CYCLE/ON, which may have only some of the options.
pub(super) fn read_options(
    notes: &mut Notes<'_>,
    before: &Coded,
    words: &[Word],
    whole: bool,
    feed: Option<Feed>,
) -> Done<Coded> {
    let kind = before.kind.unwrap_or(CycleKind::Drill);
    let mut coded = Coded { kind: before.kind, mode: before.mode, ..Coded::default() };
    let mut at = 0;
    while at < words.len() {
        let name = match &words[at] {
            Word::Name(name) => name,
            Word::Null => {
                notes.warn(Code::PC056, "CYCLE has two commas with no value between them", "remove one comma");
                at += 1;
                continue;
            }
            Word::Number(value) if at == 0 && whole => return positional(notes, coded, words, *value, feed),
            number @ (Word::Number(_) | Word::Parted(_)) => {
                let help = "put a word before the number, as DEPTH, STEP or MMPM";
                return fault(Code::PC037, format!("{number} has no word before it"), help);
            }
        };
        let Some(row) = OPTIONS.iter().find(|row| row.word == name) else {
            let help = did_you_mean(name, OPTIONS.iter().map(|row| row.word))
                .unwrap_or_else(|| "remove it, or name the system that wrote the file with `--dialect`".into());
            return fault(Code::PC018, format!("`{name}` is not an option of a cycle"), help);
        };
        let start = at + 1;
        at = start;
        let room = if row.most > 0 { row.most + 1 } else { 1 };
        while at < words.len() && words[at].number().is_some() && at - start < room {
            at += 1;
        }
        let numbers: Vec<f64> = words[start..at].iter().filter_map(Word::number).collect();
        if let (Opt::Dwell, true, Some(next)) = (row.option, numbers.is_empty(), words.get(at)) {
            // CATIA writes DWELL,DWELL,2 or DWELL,REV,2 or DWELL,, instead of DWELL,2
            if next.is("DWELL") || next.is("REV") || *next == Word::Null {
                continue;
            }
        }
        check_numbers(row.word, &numbers, (row.least, row.most), row.signed)?;
        let allowed = if row.types.is_empty() { kind != CycleKind::Manual } else { row.types.contains(&kind) };
        let pecking_tap =
            before.mode.is_some() && matches!(row.option, Opt::Step | Opt::Back | Opt::Decr | Opt::Minstp);
        if !allowed && !pecking_tap {
            let name = TYPES.iter().find(|(_, k)| *k == kind).map_or("BORE,BACK", |(word, _)| word);
            return fault(Code::PC017, format!("{name} has no {}", row.word), "take it out");
        }
        match row.option {
            Opt::Depth => group_for(&mut coded.groups, |g| !g.depths.is_empty()).depths = numbers,
            Opt::Step => group_for(&mut coded.groups, |g| !g.steps.is_empty()).steps = numbers,
            Opt::Feed => {
                if name == "TPI" && kind != CycleKind::Tap {
                    return fault(Code::PC008, "threads per inch in a cycle that is not a tap", "write IPR or MMPR");
                }
                if numbers[0] <= 0.0 {
                    return fault(Code::PC006, format!("a feed of {}", numbers[0]), "give a feed above zero");
                }
                let group = group_for(&mut coded.groups, |g| g.feed.is_some());
                group.feed = Some((name.clone(), numbers[0]));
            }
            Opt::Side => notes.warn(
                Code::PL008,
                "the effect of SIDE in CYCLE/TAP is unknown: SIDE is ignored",
                "check the tap in the program",
            ),
            option if coded.has(option) => {
                return fault(Code::PC019, format!("{name} is given twice"), "keep one");
            }
            option => coded.options.push((option, numbers)),
        }
    }
    Ok(coded)
}

/// Reads the format of 1978: numbers without words. The order of the numbers differs between systems, so only files of
/// CATIA are accepted.
fn positional(notes: &Notes<'_>, mut coded: Coded, words: &[Word], depth: f64, in_force: Option<Feed>) -> Done<Coded> {
    if notes.dialect() != Dialect::Catia {
        let help = "write CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2, or name CATIA with `--dialect catia`";
        return fault(Code::PC032, "numbers without words: their order differs between CAM systems", help);
    }
    let unit = |name: &str, value| Some((name.to_owned(), value));
    let (clear, feed) = match words {
        [_, Word::Number(clear), Word::Number(feed), Word::Name(name)] => (*clear, unit(name, *feed)),
        // the statement has no feed, so the active feed applies
        [_, Word::Number(clear)] => match in_force {
            Some(Feed::Minute(feed)) => (*clear, unit("PERMIN", feed)),
            Some(Feed::Revolution(feed)) => (*clear, unit("PERREV", feed)),
            None => return fault(Code::PC005, "the cycle has no feed", "put FEDRAT before the cycle"),
        },
        _ => {
            let help = "write CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2";
            return fault(Code::PC032, "numbers without words, in an unknown order", help);
        }
    };
    coded.groups.push(Group { depths: vec![depth], steps: Vec::new(), feed });
    coded.options.push((Opt::Clear, vec![clear]));
    Ok(coded)
}

/// Combines the last CYCLE statement with the options of CYCLE/ON. The options of CYCLE/ON have priority.
pub(super) fn over(mut last: Coded, said: Coded) -> Coded {
    for (option, numbers) in said.options {
        last.options.retain(|(found, _)| *found != option);
        last.options.push((option, numbers));
    }
    let depths: Vec<f64> = said.groups.iter().flat_map(|group| group.depths.iter().copied()).collect();
    let steps: Vec<f64> = said.groups.iter().flat_map(|group| group.steps.iter().copied()).collect();
    let feed = said.groups.iter().rev().find_map(|group| group.feed.clone());
    if said.groups.len() > 1 || (last.groups.len() > 1 && !depths.is_empty()) {
        // the depths or steps are replaced; new groups without a feed get the feed of the first old group
        let old = last.groups.first().and_then(|group| group.feed.clone());
        last.groups = said.groups;
        for group in &mut last.groups {
            group.feed = group.feed.take().or_else(|| old.clone());
        }
        return last;
    }
    if last.groups.len() > 1 && !steps.is_empty() {
        let depth = last.groups.iter().rev().find_map(|group| group.depths.last().copied());
        let feed = last.groups.first().and_then(|group| group.feed.clone());
        last.groups = vec![Group { depths: depth.into_iter().collect(), steps: Vec::new(), feed }];
    }
    if last.groups.is_empty() {
        last.groups.push(Group::default());
    }
    for (i, group) in last.groups.iter_mut().enumerate() {
        if i == 0 && !depths.is_empty() {
            group.depths.clone_from(&depths);
        }
        if i == 0 && !steps.is_empty() {
            group.steps.clone_from(&steps);
        }
        if feed.is_some() {
            group.feed = feed.clone().filter(|_| i == 0);
        }
    }
    last
}

/// The group to which the next word belongs. A group with a feed is complete, so a word after the feed begins another
/// group.
fn group_for(groups: &mut Vec<Group>, taken: impl Fn(&Group) -> bool) -> &mut Group {
    let new = groups.last().is_none_or(|group| taken(group) || (group.feed.is_some() && !group.depths.is_empty()));
    if new {
        groups.push(Group::default());
    }
    let last = groups.len() - 1;
    &mut groups[last]
}

fn check_numbers(word: &str, numbers: &[f64], (least, most): (usize, usize), signed: bool) -> Done {
    if numbers.len() < least {
        return fault(Code::PC033, format!("{word} without its number"), format!("write {word},1"));
    }
    if numbers.len() > most {
        let message = format!("{} numbers after {word}", numbers.len());
        return fault(Code::PC034, message, format!("{word} takes at most {most}"));
    }
    match numbers.iter().find(|number| !signed && **number < 0.0) {
        Some(number) => fault(Code::PC035, format!("{word} of {number}"), "it can't be negative"),
        None => Ok(()),
    }
}
