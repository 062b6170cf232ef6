//! Finds the known name that is most similar to a wrong name, for suggestions such as "did you mean".

/// A name of this length or longer gets no suggestion, because all known names are shorter.
pub const LONGEST_NAME: usize = 64;

/// The candidate most similar to `name`, if it is similar enough for a typing error. Upper and lower case are equal.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() >= LONGEST_NAME {
        return None;
    }
    let wrong = name.to_ascii_lowercase();
    let (length, letters) = shape(&wrong);
    // allow one error in a short name, and errors in a third of the letters of a long name
    let allowed = (length / 3).clamp(1, 4);
    // one error changes the length by at most one, and the set of letters by at most two; this fact excludes most
    // candidates quickly
    let may_be = |candidate: &&str| {
        let (own_length, own_letters) = shape(candidate);
        own_length.abs_diff(length) <= allowed && (own_letters ^ letters).count_ones() as usize <= 2 * allowed
    };
    candidates
        .into_iter()
        .filter(may_be)
        .map(|candidate| (strsim::damerau_levenshtein(&wrong, &candidate.to_ascii_lowercase()), candidate))
        .filter(|&(distance, candidate)| {
            // for a one-letter name, accept only repetitions of the letter, such as `dd` for `d`
            let twice = || wrong.chars().all(|c| candidate.chars().any(|own| own.eq_ignore_ascii_case(&c)));
            distance <= allowed && (distance < candidate.chars().count() || twice())
        })
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// Whether `short` is `long` with letters left out, such as `OptStop` for `OptionalStop`. The first letters are equal, and
/// at least half of the letters are kept. Upper and lower case are equal.
pub fn abbreviates(short: &str, long: &str) -> bool {
    let mut rest = long.chars();
    let follows = |c: char| rest.any(|other| other.eq_ignore_ascii_case(&c));
    let begins =
        short.get(..1).is_some_and(|first| long.get(..1).is_some_and(|other| other.eq_ignore_ascii_case(first)));
    long.len() < LONGEST_NAME
        && short.len() > 2
        && 2 * short.len() >= long.len()
        && begins
        && short.chars().all(follows)
}

/// The number of letters in a name, and the set of its letters as bits. Several letters may have the same bit. Upper
/// and lower case are equal.
fn shape(name: &str) -> (usize, u64) {
    let bit = |c: char| 1_u64 << (u32::from(c.to_ascii_lowercase()) % 64);
    name.chars().fold((0, 0), |(length, letters), c| (length + 1, letters | bit(c)))
}

/// The text of a suggestion for a help line, such as `did you mean `x`?`.
pub fn did_you_mean<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(name, candidates).map(|candidate| format!("did you mean `{candidate}`?"))
}

/// Like [`did_you_mean`]. If no candidate is similar enough, the text lists all candidates.
pub fn did_you_mean_one_of<'a>(name: &str, candidates: impl Iterator<Item = &'a str> + Clone) -> String {
    did_you_mean(name, candidates.clone())
        .unwrap_or_else(|| format!("one of {}", candidates.collect::<Vec<_>>().join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_seen_and_other_words_are_not() {
        let names = ["vclear", "rplane", "frate", "h", "v"];
        assert_eq!(nearest("vlcear", names), Some("vclear"));
        assert_eq!(nearest("RPLAN", names), Some("rplane"));
        assert_eq!(nearest("feedrate", names), None);
        assert_eq!(nearest("z", names), None);
        assert_eq!([nearest("vv", names), nearest("zv", names)], [Some("v"), None]);
    }

    #[test]
    fn a_short_name_abbreviates_a_long_name() {
        for (short, long) in [("OptStop", "OptionalStop"), ("optstop", "OptionStop"), ("InchMm", "InchesMm")] {
            assert!(abbreviates(short, long), "{short} {long}");
        }
        for (short, long) in [("Tap", "ToolAppend"), ("Stop", "OptionalStop"), ("Tap", "Type"), ("é", "éé")] {
            assert!(!abbreviates(short, long), "{short} {long}");
        }
    }

    #[test]
    fn long_words_are_no_slips() {
        let name = "b".repeat(1_000_000);
        assert_eq!(nearest(&name, [name.as_str()]), None);
        // a similar name is still found
        assert_eq!(nearest("Sequence#", ["Sequence#s"]), Some("Sequence#s"));
        assert_eq!(nearest("fRAET", ["frate"]), Some("frate"));
    }
}
