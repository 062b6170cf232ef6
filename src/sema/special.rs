//! Reads the arguments of commands that need special treatment.

use super::args::{Arguments, Read, bad, number, whole};
use super::code::Code;
use super::settings::{
    ArcCentre, CoolantKind, DwellWord, LineEnd, MoreWork, Prompt, Replacement, SequenceNumbers, Settings, TravelLimit,
};
use super::store::Setting;
use crate::lang::{Beam, Coolant, Origin, VarId};
use crate::syntax::Spanned;

/// The arguments of `Dwell`, such as `G4 P s`.
impl Setting for DwellWord {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let milliseconds = match args.all.get(2) {
            None => false,
            Some(unit) if unit.text.eq_ignore_ascii_case("s") => false,
            Some(unit) if unit.text.eq_ignore_ascii_case("ms") => true,
            Some(unit) => return bad(Some(unit), "the unit of a dwell must be `s` or `ms`"),
        };
        *self = DwellWord { code: args.code(&args.all[0], 'G')?, letter: args.letter(&args.all[1])?, milliseconds };
        Ok(())
    }
}

/// A code and a letter, such as `M19 R`.
impl Setting for (Code, u8) {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = (args.code(&args.all[0], 'M')?, args.letter(&args.all[1])?);
        Ok(())
    }
}

/// The arguments for the centre of arcs, such as `I J K`, `IJK`, `R` or `R-`.
impl Setting for ArcCentre {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let given: String = args.all.iter().map(|a| a.text.trim_matches('-')).collect();
        *self = match given.as_bytes() {
            [r @ (b'R' | b'r')] => ArcCentre::Radius(*r),
            letters if (1..=3).contains(&letters.len()) && letters.iter().all(u8::is_ascii_alphabetic) => {
                ArcCentre::Letters(letters.to_vec())
            }
            _ => {
                let message = format!("{} takes centre letters, as `I J K`, or `R`", args.id.name());
                return bad(args.all.first(), message);
            }
        };
        Ok(())
    }
}

/// The arguments for block numbers, such as `N 10 10`, `- 0 1`, `None` or `None 100 10`. After `None`, the numbers apply to `[block]`.
impl Setting for SequenceNumbers {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let letter = match &args.all[0].text {
            none if none.eq_ignore_ascii_case("None") => None,
            bare if bare == "-" => Some(SequenceNumbers::BARE),
            letter if letter.len() == 1 && letter.as_bytes()[0].is_ascii_alphabetic() => Some(letter.as_bytes()[0]),
            _ => {
                return bad(
                    args.all.first(),
                    "Sequence#s takes a letter, or `-` for numbers without a letter, or None",
                );
            }
        };
        let start = args.all.get(1).map_or(Ok(10), |a| whole(a, 0, 99_999_999))?;
        let step = args.all.get(2).map_or(Ok(10), |a| whole(a, 1, 99_999_999))?;
        *self = SequenceNumbers { letter, start, step };
        Ok(())
    }
}

/// The arguments of `MoreWork`, such as `7 G54.1 P1`, `5 G505` or `7 G54.1 P1 48`.
impl Setting for Vec<MoreWork> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let first = whole(&args.all[0], 2, 999)? as u16;
        if self.last().is_some_and(|last| last.first >= first) {
            return bad(args.all.first(), "the fixtures of MoreWork must increase from line to line");
        }
        let is_last = |arg: &Spanned| arg.text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
        let (words, last) = match &args.all[1..] {
            [words @ .., last] if !words.is_empty() && is_last(last) => (words, Some(number(last)?)),
            words => (words, None),
        };
        let (code, word) = match words {
            [word] => (None, word),
            [code, word] => (Some(args.code(code, 'G')?.code), word),
            _ => return bad(args.all.last(), "the last number of MoreWork is a number without a letter, such as `48`"),
        };
        let mut rest = word.text.chars();
        let letter = rest.next().filter(char::is_ascii_alphabetic);
        let digits = rest.as_str();
        let number =
            digits.parse::<f64>().ok().filter(|_| digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.'));
        let (Some(letter), Some(number)) = (letter, number) else {
            return bad(Some(word), format!("`{}` is not a word such as `G505` or `P1`", word.text));
        };
        if last.is_some_and(|last| last < number) {
            return bad(args.all.last(), format!("the last number must be {number} or more"));
        }
        self.push(MoreWork { first, code, letter: letter.to_ascii_uppercase() as u8, number, last });
        Ok(())
    }
}

/// The arguments of `CoolantKind`, such as `through M88 M89`.
impl Setting for Vec<CoolantKind> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let kind = match Coolant::parse(&args.all[0].text) {
            Some(kind) if Coolant::FURTHER.contains(&kind) => kind,
            Some(_) => return bad(args.all.first(), "define flood coolant and its end with `Coolant M8 M9`"),
            None => return bad(args.all.first(), "a kind of coolant must be through, air, mist or high"),
        };
        if self.iter().any(|other| other.kind == kind) {
            return bad(args.all.first(), format!("{} has a code already", kind.name()));
        }
        let code =
            |index: usize| args.all.get(index).map(|arg| args.code(arg, 'M').map(|code| code.value())).transpose();
        let Some(on) = code(1)? else { return bad(None, "CoolantKind needs a code") };
        self.push(CoolantKind { kind, on, off: code(2)? });
        Ok(())
    }
}

/// The end of lines: `lf` or `crlf`.
impl Setting for LineEnd {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = if args.choice()? == "crlf" { LineEnd::CrLf } else { LineEnd::Lf };
        Ok(())
    }
}

/// Two texts, of which the second may be empty.
impl Setting for [String; 2] {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = [0, 1].map(|i| args.all.get(i).map_or_else(String::new, |arg| arg.text.clone()));
        Ok(())
    }
}

/// The arguments of `Replace`: the old and the new text.
impl Setting for Vec<Replacement> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        if args.all[0].text.is_empty() {
            return bad(args.all.first(), "the old text is empty");
        }
        let [old, new] = [0, 1].map(|i| args.all[i].text.clone());
        self.push(Replacement { old, new, span: args.span });
        Ok(())
    }
}

/// The travel of an axis, such as `X -20 20`.
impl Setting for Vec<TravelLimit> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let letter = args.letter(&args.all[0])?;
        let (least, greatest) = (number(&args.all[1])?, number(&args.all[2])?);
        if least >= greatest {
            return bad(Some(&args.all[2]), "the greatest position must be above the least position");
        }
        self.push(TravelLimit { letter, least, greatest, span: args.span });
        Ok(())
    }
}

/// The arguments of `Ask`, such as `val1 "Fixture height" 2.5`.
impl Setting for Vec<Prompt> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let name = args.all[0].text.trim_matches(['[', ']', '<', '>']);
        let Some(var) = VarId::parse(name) else {
            let message = format!(
                "`{name}` is not a variable: use val1 to val10 with Ask; for a name of your own write `Property \
                 {name} number 0 ..`"
            );
            return bad(args.all.first(), message);
        };
        if var.row().origin == Origin::Computed {
            let message = format!("[{name}] comes from the toolpath and can't be used with Ask: use val1 to val10");
            return bad(args.all.first(), message);
        }
        let text = args.all.get(1).map_or_else(|| var.row().meaning.to_owned(), |a| a.text.clone());
        let default = args.all.get(2).map(number).transpose()?;
        self.push(Prompt { var, text, default, span: args.span });
        Ok(())
    }
}

impl Settings {
    /// Checks the word of `Machine` or `Units`. `Machine` and `Units` were read before all other commands, because
    /// other defaults depend on these two commands.
    pub(super) fn known_word(&mut self, args: &Arguments) -> Read<()> {
        args.choice().map(|_| ())
    }

    /// Stores the torch or laser of `Machine`. The type of machine was read before.
    pub(super) fn machine_word(&mut self, args: &Arguments) -> Read<()> {
        self.beam = Beam::parse(args.choice()?);
        Ok(())
    }

    pub(super) fn ignored_axis(&mut self, args: &Arguments) -> Read<()> {
        if !args.letters()?[0].eq_ignore_ascii_case(&self.axes[2]) {
            let message = format!("only the depth axis, {}, can be ignored", char::from(self.axes[2]));
            return bad(args.all.first(), message);
        }
        if self.beam.is_none() {
            return bad(
                args.all.first(),
                "Ignore is for torches and lasers: write `Machine Torch` or `Machine Laser` above it",
            );
        }
        self.is_flat = true;
        Ok(())
    }

    pub(super) fn clockwise(&mut self, args: &Arguments) -> Read<()> {
        self.cw = turn(args, &mut self.spindle[0])?;
        Ok(())
    }

    pub(super) fn counter_clockwise(&mut self, args: &Arguments) -> Read<()> {
        self.ccw = turn(args, &mut self.spindle[1])?;
        Ok(())
    }

    pub(super) fn centre_of_circles(&mut self, args: &Arguments) -> Read<()> {
        let mut centre = ArcCentre::default();
        centre.set(args)?;
        if let ArcCentre::Radius(_) = centre {
            return bad(args.all.first(), "a full circle can't have a radius word: give centre letters");
        }
        self.centre_full = Some(centre);
        Ok(())
    }

    pub(super) fn thread_passes(&mut self, args: &Arguments) -> Read<()> {
        self.thread_full = args.choice()? == "full";
        Ok(())
    }

    pub(super) fn cycle_back(&mut self, args: &Arguments) -> Read<()> {
        let length = args.length(&args.all[1])?;
        let field = match args.all[0].text.to_ascii_lowercase().as_str() {
            "deep" => &mut self.cycle_back_deep,
            "chipbreak" => &mut self.cycle_back_chipbreak,
            "thru" => &mut self.cycle_back_thru,
            _ => return bad(args.all.first(), "CycleBack is for `deep`, `chipbreak` or `thru`"),
        };
        *field = Some(length);
        Ok(())
    }

    pub(super) fn cycle_dwell_at(&mut self, args: &Arguments) -> Read<()> {
        for arg in args.all {
            match arg.text.to_ascii_lowercase().as_str() {
                "steps" => self.cycle_dwell_steps = true,
                "retracts" => self.cycle_dwell_retracts = true,
                _ => return bad(Some(arg), "CycleDwellAt takes `steps`, `retracts` or both"),
            }
        }
        Ok(())
    }
}

/// Reads the G code of an arc and, if present, the M code of the spindle in the same direction.
fn turn(args: &Arguments, spindle: &mut f64) -> Read<Code> {
    let (arc, turn) = args.all.split_at(1);
    let code = Arguments { all: arc, ..*args }.codes()?.swap_remove(0);
    if let [second] = turn {
        let turn = args.code(second, 'M')?;
        if !turn.letter().eq_ignore_ascii_case(&b'M') {
            return bad(Some(second), format!("`{}` is not an M code of the spindle", second.text));
        }
        *spindle = turn.value();
    }
    Ok(code)
}
