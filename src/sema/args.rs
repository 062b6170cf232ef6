//! Arguments of commands: reading them and storing them in the settings.

use super::settings::{ArcCentre, Code, DwellWord, Prompt, SequenceNumbers, Settings, TravelLimit};
use crate::lang::{Args, CommandId, VarId};
use crate::span::Span;
use crate::syntax::Spanned;

/// What is wrong with an argument: the place, if it is one of the arguments, and what to say.
pub struct BadArg {
    /// The argument.
    pub span: Option<Span>,
    /// A sentence.
    pub message: String,
}

type Read<T> = Result<T, BadArg>;

fn bad<T>(arg: Option<&Spanned>, message: impl Into<String>) -> Read<T> {
    Err(BadArg { span: arg.map(|a| a.span), message: message.into() })
}

/// The arguments of one command.
struct Arguments<'a> {
    id: CommandId,
    all: &'a [Spanned],
}

impl Arguments<'_> {
    fn count(&self, least: usize, most: usize, what: &str) -> Read<()> {
        let given = self.all.len();
        if (least..=most).contains(&given) {
            return Ok(());
        }
        let wanted = if least == most { least.to_string() } else { format!("{least} to {most}") };
        bad(self.all.get(most), format!("{} takes {wanted} {what}, here are {given}", self.id.name()))
    }

    fn switch(&self) -> Read<bool> {
        self.count(1, 1, "argument, Y or N")?;
        match self.all[0].text.to_ascii_uppercase().as_str() {
            "Y" | "YES" => Ok(true),
            "N" | "NO" => Ok(false),
            _ => bad(self.all.first(), format!("{} is Y or N", self.id.name())),
        }
    }

    fn codes(&self, least: usize, most: usize, letter: u8) -> Read<Vec<Code>> {
        self.count(least, most, "codes")?;
        self.all.iter().map(|arg| code(arg, letter)).collect()
    }

    /// So many values, the later ones optional: those not given keep what they are.
    fn values<const N: usize>(&self, into: &mut [f64; N], least: usize, letter: u8) -> Read<()> {
        for (slot, code) in into.iter_mut().zip(self.codes(least, N, letter)?) {
            *slot = code.value;
        }
        Ok(())
    }

    /// Letters, apart or together: `X Y Z` or `XYZ`.
    fn letters(&self, least: usize, most: usize) -> Read<Vec<u8>> {
        let mut letters = Vec::new();
        for arg in self.all {
            if !arg.text.bytes().all(|b| b.is_ascii_alphabetic()) {
                return bad(Some(arg), format!("`{}` is no letter", arg.text));
            }
            letters.extend(arg.text.bytes());
        }
        if letters.len() < least || letters.len() > most {
            let wanted = if least == most { least.to_string() } else { format!("{least} to {most}") };
            let plural = if most == 1 { "letter" } else { "letters" };
            return bad(None, format!("{} takes {wanted} {plural}, here are {}", self.id.name(), letters.len()));
        }
        Ok(letters)
    }

    fn letter(&self) -> Read<u8> {
        Ok(self.letters(1, 1)?[0])
    }

    fn number(&self) -> Read<f64> {
        self.count(1, 1, "number")?;
        number(&self.all[0])
    }

    /// A length that is not negative.
    fn length(&self) -> Read<f64> {
        let value = self.number()?;
        if value < 0.0 {
            return bad(self.all.first(), format!("{} can't be negative", self.id.name()));
        }
        Ok(value)
    }

    fn text(&self) -> String {
        self.all.iter().map(|a| a.text.as_str()).collect::<Vec<_>>().join(" ")
    }
}

fn number(arg: &Spanned) -> Read<f64> {
    match arg.text.parse::<f64>() {
        Ok(value) if value.is_finite() && arg.text.bytes().all(|b| !b.is_ascii_alphabetic()) => Ok(value),
        _ => bad(Some(arg), format!("`{}` is no number", arg.text)),
    }
}

/// `G0`, `0`, `M19`: with its letter or without.
fn code(arg: &Spanned, letter: u8) -> Read<Code> {
    let first = arg.text.bytes().next().unwrap_or(b' ');
    let (given, digits) =
        if first.is_ascii_alphabetic() { (Some(first), &arg.text[1..]) } else { (None, arg.text.as_str()) };
    match digits.parse::<f64>() {
        Ok(value) if value >= 0.0 && digits.bytes().all(|b| b.is_ascii_digit() || b == b'.') => {
            Ok(Code { letter: given.unwrap_or(letter), text: given.map(|_| arg.text.clone()), value })
        }
        _ => bad(Some(arg), format!("`{}` is no code, as `{}{}` is", arg.text, char::from(letter), 0)),
    }
}

/// `I J K`, `IJK`, `R`, `R-`.
fn centre(args: &Arguments) -> Read<ArcCentre> {
    let given: String = args.all.iter().map(|a| a.text.trim_matches('-')).collect();
    match given.as_bytes() {
        [r @ (b'R' | b'r')] => Ok(ArcCentre::Radius(*r)),
        letters if (1..=3).contains(&letters.len()) && letters.iter().all(u8::is_ascii_alphabetic) => {
            Ok(ArcCentre::Letters(letters.to_vec()))
        }
        _ => bad(args.all.first(), format!("{} takes centre letters as `I J K`, or `R`", args.id.name())),
    }
}

impl Settings {
    /// Stores one command. Includes (`Call`) are not settings and do nothing here.
    pub fn apply(&mut self, id: CommandId, all: &[Spanned], span: Span) -> Read<()> {
        use CommandId as C;
        let args = Arguments { id, all };
        if !matches!(id.row().args, Args::Switch) && all.is_empty() && id != C::Name && id != C::Eob {
            return bad(None, format!("{} needs {}", id.name(), wants(id)));
        }
        match id {
            C::Name => self.name = args.text(),
            C::Machine | C::Units => _ = choice(&args)?, // read ahead of all others: defaults depend on them
            C::Control => self.control = choice(&args)?.to_owned(),
            C::Rapid => self.rapid = args.codes(1, 1, b'G')?.remove(0),
            C::Feed => self.feed = args.codes(1, 1, b'G')?.remove(0),
            C::CW => self.cw = args.codes(1, 1, b'G')?.remove(0),
            C::CCW => self.ccw = args.codes(1, 1, b'G')?.remove(0),
            C::FeedCode => self.feed_code = args.letter()?,
            C::SpeedCode => self.speed_code = args.letter()?,
            C::FeedType => args.values(&mut self.feed_type, 2, b'G')?,
            C::SpeedType => args.values(&mut self.speed_type, 2, b'G')?,
            C::Spindle => args.values(&mut self.spindle, 3, b'M')?,
            C::Coolant => args.values(&mut self.coolant, 2, b'M')?,
            C::Flush => args.values(&mut self.flush, 2, b'M')?,
            C::CDC => args.values(&mut self.cdc, 3, b'G')?,
            C::CDCCode => self.cdc_code = args.letter()?,
            C::Dwell => {
                args.count(2, 3, "words: code, letter, unit")?;
                let milliseconds = match all.get(2) {
                    None => false,
                    Some(unit) if unit.text.eq_ignore_ascii_case("s") => false,
                    Some(unit) if unit.text.eq_ignore_ascii_case("ms") => true,
                    Some(unit) => return bad(Some(unit), "the unit of a dwell is `s` or `ms`"),
                };
                let letter = Arguments { id, all: &all[1..2] }.letter()?;
                self.dwell = DwellWord { code: code(&all[0], b'G')?, letter, milliseconds };
            }
            C::Orient => {
                args.count(2, 2, "words: code and letter")?;
                self.orient = (code(&all[0], b'M')?, Arguments { id, all: &all[1..2] }.letter()?);
            }
            C::StopCode => args.values(&mut self.stop_code, 2, b'M')?,
            C::LComp => self.lcomp = args.number()?,
            C::DComp => self.dcomp = args.number()?,
            C::Work => self.work = args.codes(1, 1, b'G')?[0].value,
            C::WorkDefault => self.work_default = args.codes(1, 1, b'G')?[0].value,
            C::IncAbs => args.values(&mut self.inc_abs, 2, b'G')?,
            C::InchMm => args.values(&mut self.inch_mm, 2, b'G')?,
            C::ReturnPlane => args.values(&mut self.return_plane, 2, b'G')?,
            C::HCode => self.axes[0] = args.letter()?,
            C::VCode => self.axes[1] = args.letter()?,
            C::DCode => self.axes[2] = args.letter()?,
            C::HCode2 => self.axes2[0] = args.letter()?,
            C::VCode2 => self.axes2[1] = args.letter()?,
            C::DCode2 => self.axes2[2] = args.letter()?,
            C::ByDiameter => self.by_diameter = args.switch()?,
            C::RevSigns => self.rev_signs.extend(args.letters(1, 15)?),
            C::Incremental => self.incremental = args.switch()?,
            C::CtrCode => self.centre = centre(&args)?,
            C::CtrCode180 => self.centre_over_180 = Some(centre(&args)?),
            C::CtrCode360 => match centre(&args)? {
                ArcCentre::Radius(_) => {
                    return bad(all.first(), "a full circle has no radius word: give centre letters");
                }
                letters => self.centre_full = Some(letters),
            },
            C::CtrIncremental => self.centre_incremental = args.switch()?,
            C::ByQuadrants => self.by_quadrants = args.switch()?,
            C::ArcPlane => self.planes = args.codes(1, 3, b'G')?,
            C::Helical => self.helical = args.switch()?,
            C::MinRad => self.min_radius = args.length()?,
            C::MaxRad => self.max_radius = args.length()?,
            C::Tolerance => {
                self.tolerance = args.length()?;
                if self.tolerance == 0.0 {
                    return bad(all.first(), "Tolerance must be above zero");
                }
            }
            C::ArcWithLine => self.arc_with_line = args.switch()?,
            C::ArcWithSame => self.arc_with_same = args.switch()?,
            C::CircDir => {
                args.count(2, 2, "words: clockwise and counter-clockwise")?;
                self.circle_direction = Some([all[0].text.clone(), all[1].text.clone()]);
            }
            C::SecondCircle => self.second_circle = Some(args.text()),
            C::Modality => self.modality = args.switch()?,
            C::ModalLetters => self.modal_letters = Some(args.letters(1, 26)?),
            C::ModalGs => self.modal_codes = args.codes(1, 15, b'G')?.iter().map(|c| c.value).collect(),
            C::Force => self.force = args.letters(1, 15)?,
            C::SequenceNumbers => self.numbers = numbers(&args)?,
            C::First => self.number_first = args.switch()?,
            C::Last => self.number_last = args.switch()?,
            C::SpacesSwitch => self.blanks = args.switch()?,
            C::Spaces => {
                args.count(1, 15, "columns")?;
                self.columns = all.iter().map(|a| whole(a, 1, 200).map(|n| n as usize)).collect::<Read<_>>()?;
                if self.columns.windows(2).any(|w| w[0] >= w[1]) {
                    return bad(all.first(), "columns must increase");
                }
            }
            C::LeadingZeros => self.leading_zeros = args.switch()?,
            C::Eob => self.eob = args.text(),
            C::Comment => {
                args.count(1, 2, "marks: opening and closing")?;
                self.comment = [all[0].text.clone(), all.get(1).map_or(String::new(), |a| a.text.clone())];
            }
            C::UpperComments => self.upper_comments = args.switch()?,
            C::Replace => {
                args.count(2, 2, "texts, old and new")?;
                if all[0].text.is_empty() {
                    return bad(all.first(), "the old text is empty");
                }
                self.replace.push((all[0].text.clone(), all[1].text.clone()));
            }
            C::Rename => {
                let letters = args.letters(2, 2)?;
                self.rename.push((letters[0], letters[1]));
            }
            C::Dummy => self.dummy.extend(args.letters(1, 15)?),
            C::Mod => self.mod_text.push(args.text()),
            C::Each | C::Ask => self.prompts.push(prompt(&args, span)?),
            C::SubsFirst => self.subs_first = args.switch()?,
            C::RenumSubs => self.renumber_subs = args.switch()?,
            C::VRapid => self.depth_rapid = Some(args.codes(1, 1, b'G')?.remove(0)),
            C::ZRestart => self.restart_depth = args.switch()?,
            C::RevTurret2 => self.reverse_turret_2 = args.switch()?,
            C::Limits => {
                args.count(3, 3, "words: letter, least, greatest")?;
                let letter = Arguments { id, all: &all[..1] }.letter()?;
                let (least, greatest) = (number(&all[1])?, number(&all[2])?);
                if least >= greatest {
                    return bad(Some(&all[2]), "the greatest position is not above the least");
                }
                self.limits.push(TravelLimit { letter, least, greatest, span });
            }
            C::Thread => self.thread = Some(args.codes(1, 1, b'G')?.remove(0)),
            C::ThreadPasses => self.thread_full = choice(&args)? == "full",
            C::CycleClear => self.cycle_clear = args.length()?,
            C::CycleStep => self.cycle_step = Some(args.length()?),
            C::CycleMinStep => self.cycle_min_step = args.length()?,
            C::CycleBack => {
                args.count(2, 2, "words: kind and length")?;
                let length = Arguments { id, all: &all[1..] }.length()?;
                match all[0].text.to_ascii_lowercase().as_str() {
                    "deep" => self.cycle_back_deep = length,
                    "chipbreak" => self.cycle_back_chipbreak = length,
                    "thru" => self.cycle_back_thru = length,
                    _ => return bad(all.first(), "CycleBack is for `deep`, `chipbreak` or `thru`"),
                }
            }
            C::CycleDwell => self.cycle_dwell = args.length()?,
            C::CycleDwellAt => {
                for arg in all {
                    match arg.text.to_ascii_lowercase().as_str() {
                        "steps" => self.cycle_dwell_steps = true,
                        "retracts" => self.cycle_dwell_retracts = true,
                        _ => return bad(Some(arg), "CycleDwellAt takes `steps`, `retracts` or both"),
                    }
                }
            }
            C::CycleOrient => self.cycle_orient = args.number()?,
            C::CycleJog => self.cycle_jog = args.length()?,
            C::CycleSinkClear => self.cycle_sink_clear = Some(args.length()?),
            C::RigidTap => self.rigid_tap = args.switch()?,
            C::Call | C::CallMe | C::Tools | C::Drive | C::WindowSize => {}
        }
        Ok(())
    }
}

/// What a command wants, for a message.
fn wants(id: CommandId) -> String {
    match id.row().args {
        Args::Text => "text".into(),
        Args::Switch => "Y or N".into(),
        Args::Codes(a, b) if a == b && a == 1 => "a code".into(),
        Args::Codes(a, b) if a == b => format!("{a} codes"),
        Args::Codes(a, b) => format!("{a} to {b} codes"),
        Args::Letters(1, 1) => "a letter".into(),
        Args::Letters(a, b) if a == b => format!("{a} letters"),
        Args::Letters(..) => "letters".into(),
        Args::Numbers(1, 1) => "a number".into(),
        Args::Numbers(..) => "numbers".into(),
        Args::Choice(words) => format!("one of {}", words.join(", ")),
        Args::Words(what) => what.into(),
    }
}

/// The word of a choice, as the table writes it.
pub fn choice_of(id: CommandId, text: &str) -> Option<&'static str> {
    match id.row().args {
        Args::Choice(words) => words.iter().find(|w| w.eq_ignore_ascii_case(text)).copied(),
        _ => None,
    }
}

fn choice(args: &Arguments) -> Read<&'static str> {
    args.count(1, 1, "word")?;
    match choice_of(args.id, &args.all[0].text) {
        Some(word) => Ok(word),
        None => bad(args.all.first(), format!("{} needs {}", args.id.name(), wants(args.id))),
    }
}

fn whole(arg: &Spanned, least: i64, most: i64) -> Read<i64> {
    match arg.text.parse::<i64>() {
        Ok(n) if (least..=most).contains(&n) => Ok(n),
        _ => bad(Some(arg), format!("`{}` is no whole number from {least} to {most}", arg.text)),
    }
}

/// `N 10 10`, `None`, `None 100 10`: with None, start and step are those of `[block]`.
fn numbers(args: &Arguments) -> Read<SequenceNumbers> {
    args.count(1, 3, "words: letter, start, step")?;
    let letter = match &args.all[0].text {
        none if none.eq_ignore_ascii_case("None") => None,
        letter if letter.len() == 1 && letter.as_bytes()[0].is_ascii_alphabetic() => Some(letter.as_bytes()[0]),
        _ => return bad(args.all.first(), "Sequence#s begins with a letter, or is None"),
    };
    let start = args.all.get(1).map_or(Ok(10), |a| whole(a, 0, 99_999_999))?;
    let step = args.all.get(2).map_or(Ok(10), |a| whole(a, 1, 99_999_999))?;
    Ok(SequenceNumbers { letter, start, step })
}

/// `Ask val1 "Fixture height" 2.5`.
fn prompt(args: &Arguments, span: Span) -> Read<Prompt> {
    args.count(1, 3, "words: variable, prompt in quotes, default")?;
    let name = args.all[0].text.trim_matches(['[', ']', '<', '>']);
    let Some(var) = VarId::parse(name) else {
        return bad(args.all.first(), format!("`{name}` is no variable"));
    };
    if var.row().origin == crate::lang::Origin::Computed {
        return bad(
            args.all.first(),
            format!("[{name}] comes from the toolpath and can't be asked for: use val1 to val10"),
        );
    }
    let text = args.all.get(1).map_or_else(|| var.row().meaning.to_owned(), |a| a.text.clone());
    let default = args.all.get(2).map(number).transpose()?;
    Ok(Prompt { var, text, default, span })
}
