//! Finds the forms that are only parts of other forms.

use std::collections::HashMap;
use std::hash::Hash;

/// Finds the forms that are parts. A part is a form that another form calls. Each form is given with the names of the
/// forms that it calls. A part is checked together with the calling form, and with the settings of the calling form. If
/// two forms call each other, the first form is not a part.
pub fn parts<K: Eq + Hash>(forms: &[(K, Vec<K>)]) -> Vec<bool> {
    let mut callers: HashMap<&K, Vec<usize>> = HashMap::new();
    for (at, (_, called)) in forms.iter().enumerate() {
        called.iter().for_each(|part| callers.entry(part).or_default().push(at));
    }
    let is_part = |i: usize| {
        let (own, called) = &forms[i];
        let mut others = callers.get(own).into_iter().flatten().filter(|&&other| other != i);
        others.any(|&other| other < i || !called.contains(&forms[other].0))
    };
    (0..forms.len()).map(is_part).collect()
}

#[cfg(test)]
mod tests {
    use super::parts;

    #[test]
    fn what_another_form_calls_is_a_part() {
        let forms = [("a", vec!["b"]), ("b", vec![]), ("c", vec!["d"]), ("d", vec!["c"]), ("e", vec!["e"])];
        assert_eq!(parts(&forms), [false, true, false, true, false]);
    }
}
