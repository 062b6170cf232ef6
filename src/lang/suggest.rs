//! "Did you mean": finds the known name nearest to a wrong one.

/// Names of this length or longer get no suggestion. No known name is so long.
pub const LONGEST_NAME: usize = 64;

/// The candidate nearest to `name`, in any case, if it is near enough to be a typing mistake.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() >= LONGEST_NAME {
        return None;
    }
    let wrong = name.to_ascii_lowercase();
    let (length, letters) = shape(&wrong);
    // one mistake in a short name, a third of its letters in a long one
    let allowed = (length / 3).clamp(1, 4);
    // one mistake changes the length by at most one and the set of letters by at most two, so few candidates remain
    let may_be = |candidate: &&str| {
        let (own_length, own_letters) = shape(candidate);
        own_length.abs_diff(length) <= allowed && (own_letters ^ letters).count_ones() as usize <= 2 * allowed
    };
    candidates
        .into_iter()
        .filter(may_be)
        .map(|candidate| (strsim::damerau_levenshtein(&wrong, &candidate.to_ascii_lowercase()), candidate))
        .filter(|&(distance, candidate)| {
            // accept `dd` for `d`: the same letter twice
            let twice = || wrong.chars().all(|c| candidate.chars().any(|own| own.eq_ignore_ascii_case(&c)));
            distance <= allowed && (distance < candidate.chars().count() || twice())
        })
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// The number of letters of a name, and its set of letters as bits. Some letters share a bit. Upper and lower case are
/// equal.
fn shape(name: &str) -> (usize, u64) {
    let bit = |c: char| 1_u64 << (u32::from(c.to_ascii_lowercase()) % 64);
    name.chars().fold((0, 0), |(length, letters), c| (length + 1, letters | bit(c)))
}

/// `did you mean `x`?`, as text for a help line.
pub fn did_you_mean<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(name, candidates).map(|candidate| format!("did you mean `{candidate}`?"))
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
    fn long_words_are_no_slips() {
        let name = "b".repeat(1_000_000);
        assert_eq!(nearest(&name, [name.as_str()]), None);
        // a near name is still found
        assert_eq!(nearest("Sequence#", ["Sequence#s"]), Some("Sequence#s"));
        assert_eq!(nearest("fRAET", ["frate"]), Some("frate"));
    }
}
