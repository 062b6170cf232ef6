//! Commands stored in the settings.

use super::args::{Arguments, Read, bad, centre, choice, code, number, numbers, prompt, wants, whole};
use super::settings::{ArcCentre, DwellWord, Replacement, Settings, TravelLimit};
use crate::control::Control;
use crate::lang::{Args, CommandId};
use crate::span::Span;
use crate::syntax::Spanned;

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
            C::Control => self.control = Control::named(choice(&args)?),
            C::Rapid => self.rapid = args.g_codes(1, 1)?.remove(0),
            C::Feed => self.feed = args.g_codes(1, 1)?.remove(0),
            C::CW => self.cw = args.turn(&mut self.spindle[0])?,
            C::CCW => self.ccw = args.turn(&mut self.spindle[1])?,
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
            C::ArcPlane => self.planes = args.g_codes(1, 3)?,
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
                let [old, new] = [&all[0], &all[1]].map(|arg| arg.text.clone());
                self.replace.push(Replacement { old, new, span });
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
            C::VRapid => self.depth_rapid = Some(args.g_codes(1, 1)?.remove(0)),
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
            C::Thread => self.thread = Some(args.g_codes(1, 1)?.remove(0)),
            C::ThreadPasses => self.thread_full = choice(&args)? == "full",
            C::CycleClear => self.cycle_clear = Some(args.length()?),
            C::CycleStep => self.cycle_step = Some(args.length()?),
            C::CycleMinStep => self.cycle_min_step = args.length()?,
            C::CycleBack => {
                args.count(2, 2, "words: kind and length")?;
                let length = Arguments { id, all: &all[1..] }.length()?;
                match all[0].text.to_ascii_lowercase().as_str() {
                    "deep" => self.cycle_back_deep = Some(length),
                    "chipbreak" => self.cycle_back_chipbreak = Some(length),
                    "thru" => self.cycle_back_thru = Some(length),
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
            C::CycleJog => self.cycle_jog = Some(args.length()?),
            C::CycleSinkClear => self.cycle_sink_clear = Some(args.length()?),
            C::RigidTap => self.rigid_tap = args.switch()?,
            C::Call | C::CallMe | C::Tools | C::Drive | C::WindowSize => {}
        }
        Ok(())
    }
}
