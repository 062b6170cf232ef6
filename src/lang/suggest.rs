//! "Did you mean": the known name nearest to a wrong one.

/// The candidate nearest to `name` if it is near enough to be meant; case does not count.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wrong = name.to_ascii_lowercase();
    // one slip in a short name, a third of a long one
    let allowed = (wrong.chars().count() / 3).clamp(1, 4);
    candidates
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&wrong, &candidate.to_ascii_lowercase()), candidate))
        .filter(|&(distance, candidate)| distance <= allowed && distance < candidate.chars().count())
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// `did you mean `x`?`, ready for a help line.
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
    }
}
