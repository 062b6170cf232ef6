//! Tool paths of NX: the tool that each names, and the setup that it is in.

use super::reader::{Done, Reader, fault};
use super::words::Word;
use crate::diag::Code;

/// Largest tool number.
const LARGEST: u32 = 99_999_999;

/// Numbers of tools that a file does not load.
#[derive(Clone, Debug, PartialEq)]
pub enum Assumed {
    /// Of its only tool.
    One(f64),
    /// Of each tool that it names.
    Named(Vec<(String, f64)>),
}

impl Assumed {
    /// As `--assume-tool` says them: `1`, or `FACE_MILL=1,DRILL=2`.
    ///
    /// # Errors
    /// What to write instead.
    pub fn parse(text: &str) -> Result<Assumed, String> {
        let number = |text: &str| text.trim().parse::<u32>().ok().filter(|n| *n <= LARGEST).map(f64::from);
        // statements have no blanks and no small letters
        let name = |text: &str| text.split_whitespace().collect::<String>().to_ascii_uppercase();
        let pair = |text: &str| text.split_once('=').and_then(|(tool, n)| Some((name(tool), number(n)?)));
        let named = || text.split(',').map(pair).collect::<Option<Vec<_>>>().map(Assumed::Named);
        let read = number(text).map(Assumed::One).or_else(named);
        read.ok_or_else(|| format!("write a number up to {LARGEST}, or NAME=1,OTHER=2"))
    }

    /// The number, where one is said for all.
    pub fn one(&self) -> Option<f64> {
        if let Assumed::One(number) = self { Some(*number) } else { None }
    }

    fn of(&self, tool: &str) -> Option<f64> {
        match self {
            Assumed::One(_) => None,
            Assumed::Named(list) => list.iter().find(|(name, _)| name == tool).map(|(_, number)| *number),
        }
    }
}

impl Reader<'_> {
    /// TOOL PATH/name,TOOL,tool: a tool other than the one in use must be loaded, or have an assumed number.
    pub(super) fn tool_path(&mut self, words: &[Word]) -> Done {
        let tool = match words {
            [_, word, tool, ..] if word.is("TOOL") => tool.to_string(),
            _ => return Ok(()),
        };
        if self.tool_name.as_ref() == Some(&tool) {
            return Ok(());
        }
        self.tool_name = Some(tool);
        self.another_tool(None)
    }

    /// The number of a tool that is not loaded; `None`: nobody says it, which the renderer tells.
    pub(super) fn assumed_tool(&mut self, first: bool) -> Done<Option<f64>> {
        let assumed = self.options.tool.as_ref();
        let one = assumed.and_then(Assumed::one).filter(|_| first);
        let Some(name) = &self.tool_name else { return Ok(one) };
        if !self.not_loaded.contains(name) {
            self.not_loaded.push(name.clone());
        }
        let number = one.or_else(|| assumed.and_then(|list| list.of(name)));
        let only = first && !matches!(assumed, Some(Assumed::Named(_)));
        if number.is_some() || only {
            return Ok(number);
        }
        let mut next = self.greatest_tool;
        let all = self.not_loaded.iter().map(|name| {
            let number = assumed.and_then(|list| list.of(name)).unwrap_or_else(|| {
                next += 1.0;
                next
            });
            format!("{name}={number}")
        });
        let help = format!("say the number of each with `--assume-tool {}`", all.collect::<Vec<_>>().join(","));
        fault(Code::PJ006, format!("the file names the tool {name} and does not load it"), help)
    }

    /// MSYS: where positions count from. One work offset can't stand for two.
    pub(super) fn msys(&mut self, words: &[Word]) -> Done {
        match &self.msys {
            None => self.msys = Some((words.to_vec(), self.place.line)),
            Some((before, _)) if before.as_slice() == words => {}
            Some((_, line)) => {
                let message = format!("this MSYS is not that of line {line}: its positions count from another place");
                let help = "let NX write the operations of each MSYS into a file of their own: each is a setup";
                return fault(Code::PL004, message, help);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_assumed_for_one_tool_or_for_each() {
        assert_eq!(Assumed::parse("7"), Ok(Assumed::One(7.0)));
        let named = Assumed::parse("MILL=1,face mill = 2").unwrap();
        assert_eq!((named.of("MILL"), named.of("FACEMILL"), named.of("DRILL")), (Some(1.0), Some(2.0), None));
        for wrong in ["", "MILL", "MILL=", "MILL=1,DRILL", "100000000", "-1"] {
            assert!(Assumed::parse(wrong).is_err(), "{wrong}");
        }
    }
}
