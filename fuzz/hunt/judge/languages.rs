//! Converts programs for Siemens, Heidenhain and Okuma to the words of a Fanuc. Only words that the shipped forms print
//! are supported; any other word is an error. The rules come from the makers' texts, and this code shares nothing with
//! postform's readers.

use std::collections::BTreeMap;

/// A called cycle: the Fanuc code, heights, peck, dwell in seconds, and feed.
#[derive(Clone, Debug)]
struct Cycle {
    code: u16,
    r: f64,
    bottom: f64,
    back: f64,
    peck: Option<f64>,
    dwell: Option<f64>,
    feed: Option<f64>,
}

/// The state that the words of a block change.
#[derive(Default)]
struct Writer {
    text: String,
    at: [Option<f64>; 3],
    /// The tool in the spindle.
    tool: f64,
    /// The tool of the last T. This tool is in the spindle after M6; until then, D applies to the tool that was in the
    /// spindle before.
    next: f64,
    inch: bool,
    side: bool,
    cycle: Option<Cycle>,
    center: [f64; 2],
    /// The return level of an Okuma's G71.
    level: f64,
    speed: f64,
    /// G95 is active.
    per_turn: bool,
    /// G0 or G1 is active.
    straight: bool,
}

type Done<T = ()> = Result<T, String>;

/// Whether a control uses one of these languages.
pub fn is_one(control: &str) -> bool {
    matches!(control, "siemens" | "heidenhain" | "okuma")
}

/// The program in the words of a Fanuc.
///
/// # Errors
/// The line with an unknown word, and the word.
pub fn as_fanuc(program: &str, control: &str) -> Result<String, (usize, String)> {
    let mut writer = Writer::default();
    for (number, line) in program.lines().enumerate() {
        let done = match control {
            "siemens" => writer.siemens(line),
            "heidenhain" => writer.klartext(line),
            _ => writer.okuma(line),
        };
        done.map_err(|error| (number + 1, error))?;
    }
    Ok(writer.text)
}

/// The words with which a Fanuc selects the work offset of this number, from 1.
fn offset_words(number: f64) -> Vec<(char, f64)> {
    if number > 6.0 { vec![('G', 54.1), ('P', number - 6.0)] } else { vec![('G', 53.0 + number)] }
}

/// A number, or a quotient of two numbers.
fn number(text: &str) -> Option<f64> {
    match text.trim().split_once('/') {
        Some((a, b)) => Some(a.parse::<f64>().ok()? / b.parse::<f64>().ok()?),
        None => text.trim().parse().ok(),
    }
}

/// The words of a block as letters and numbers.
fn words(block: &str) -> Done<Vec<(char, f64)>> {
    let mut found = Vec::new();
    let mut rest = block.trim();
    while let Some(letter) = rest.chars().next() {
        if !letter.is_ascii_uppercase() {
            return Err(format!("`{rest}`"));
        }
        rest = &rest[1..];
        let end = rest.find(|c: char| !c.is_ascii_digit() && !"+-.".contains(c)).unwrap_or(rest.len());
        found.push((letter, rest[..end].parse().map_err(|_| format!("`{letter}{rest}`"))?));
        rest = rest[end..].trim_start();
    }
    Ok(found)
}

/// A line without its block number; the number begins with this letter.
fn numbered(line: &str, letter: &str) -> String {
    let line = line.trim();
    let rest = line.strip_prefix(letter).unwrap_or(line);
    let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
    let has = digits > 0 && (letter.is_empty() || line.starts_with(letter));
    if has { rest[digits..].trim_start().to_owned() } else { line.to_owned() }
}

impl Writer {
    fn say(&mut self, block: impl AsRef<str>) {
        self.text += block.as_ref();
        self.text.push('\n');
    }

    /// Writes words and follows the axis positions.
    fn block(&mut self, words: &[(char, f64)]) {
        let mut text = Vec::new();
        let machine = words.contains(&('G', 53.0));
        for &(letter, value) in words {
            match (letter, value) {
                ('S', speed) => self.speed = speed,
                ('G', 94.0) => self.per_turn = false,
                ('G', 95.0) => self.per_turn = true,
                _ => {}
            }
            if let Some(axis) = "XYZ".find(letter) {
                self.at[axis] = Some(value).filter(|_| !machine);
            }
            // a number without an exponent
            text.push(format!("{letter}{value:.9}"));
        }
        if !text.is_empty() {
            self.say(text.join(" "));
        }
    }

    /// Makes the hole of the active cycle at the tool's position.
    fn hole(&mut self) -> Done {
        let Some(cycle) = self.cycle.clone() else { return Err("no cycle".into()) };
        let back = self.at[2] == Some(cycle.back);
        let mut text = format!("G{} G{} Z{} R{}", if back { 98 } else { 99 }, cycle.code, cycle.bottom, cycle.r);
        if let (Some(x), Some(y)) = (self.at[0], self.at[1]) {
            text += &format!(" X{x} Y{y}");
        }
        if let Some(peck) = cycle.peck {
            text += &format!(" Q{peck}");
        }
        if let Some(dwell) = cycle.dwell {
            text += &format!(" P{}", (dwell * 1000.0).round());
        }
        if let Some(feed) = cycle.feed {
            text += &format!(" F{feed}");
        }
        self.say(text);
        self.say("G80");
        self.at[2] = Some(if back { cycle.back } else { cycle.r });
        if !back && cycle.back != cycle.r {
            self.block(&[('G', 0.0), ('Z', cycle.back)]);
        }
        Ok(())
    }

    /// A pecking cycle; it becomes one stroke if the peck is as long as the hole.
    fn drills(code: u16, r: f64, bottom: f64, back: f64) -> Cycle {
        Cycle { code, r, bottom, back, peck: None, dwell: None, feed: None }
    }

    fn siemens(&mut self, line: &str) -> Done {
        let line = line.split(';').next().unwrap_or_default().trim();
        if let Some(name) = line.strip_prefix("%_N_L") {
            self.say(format!("O{}", name.strip_suffix("_SPF").ok_or("a section")?));
            self.tool = f64::NAN; // the tool of the caller
            return Ok(());
        }
        let block = numbered(line, "N");
        if let Some(call) = block.strip_prefix("MCALL") {
            self.cycle = match call.trim() {
                "" => None,
                call => Some(self.siemens_cycle(call)?),
            };
            return Ok(());
        }
        if let Some(label) = block.strip_prefix('L') {
            self.say(format!("M98 P{label}"));
            return Ok(());
        }
        let machine = block.contains("SUPA");
        let mut list = words(&block.replace("SUPA", ""))?;
        if list.contains(&('M', 19.0)) && list.iter().any(|word| word.0 == 'R') {
            return Err("M19 with an angle".into());
        }
        let dwells = list.contains(&('G', 4.0));
        let tool = list.iter().find(|word| word.0 == 'T').map(|word| word.1);
        self.next = tool.unwrap_or(self.next);
        if list.contains(&('M', 6.0)) {
            self.tool = self.next;
        }
        let compensates = list.iter().any(|word| *word == ('G', 41.0) || *word == ('G', 42.0));
        let (mut length, mut extra) = (None, None);
        list.retain(|word| {
            length = if word.0 == 'D' { Some(word.1) } else { length };
            word.0 != 'D'
        });
        for word in &mut list {
            *word = match *word {
                // the fifth and sixth offset
                ('G', fifth @ 505.0..=506.0) => ('G', fifth - 447.0),
                ('G', more @ 507.0..=599.0) => {
                    extra = Some(more - 506.0);
                    ('G', 54.1)
                }
                ('G', 700.0) => ('G', 20.0),
                ('G', 710.0) => ('G', 21.0),
                ('M', 17.0) => ('M', 99.0),
                ('M', 98.0 | 99.0) => return Err("M98 and M99".into()),
                ('F', seconds) if dwells => ('P', (seconds * 1000.0).round()),
                other => other,
            };
        }
        if machine {
            list.insert(0, ('G', 53.0));
        }
        if let Some(number) = extra {
            list.push(('P', number));
        }
        if compensates {
            list.push(('D', self.tool));
        }
        let motion = list.iter().find(|word| word.0 == 'G' && word.1 <= 3.0).map(|word| word.1 <= 1.0);
        self.straight = motion.unwrap_or(self.straight);
        // under MCALL, a block with only G0 or G1 also drills; while G0 or G1 is active, a block with only S or F
        // drills, too
        let alone = !list.is_empty() && list.iter().all(|word| "GSF".contains(word.0));
        let again = alone && self.straight && (motion.is_some() || list.iter().all(|word| word.0 != 'G'));
        let moves = (again || list.iter().any(|word| "XYZ".contains(word.0))) && !machine;
        self.block(&list);
        match length {
            Some(0.0) => self.say("G49"),
            Some(_) if self.tool.is_nan() => {}
            Some(_) => self.say(format!("G43 H{}", self.tool)),
            None => {}
        }
        if moves && self.cycle.is_some() { self.hole() } else { Ok(()) }
    }

    fn siemens_cycle(&self, call: &str) -> Done<Cycle> {
        let (name, arguments) = call.split_once('(').ok_or("no arguments")?;
        let arguments = arguments.strip_suffix(')').ok_or("no bracket")?;
        let list: Vec<Option<f64>> = arguments.split(',').map(number).collect();
        let value = |at: usize| list.get(at).copied().flatten();
        let need = |at: usize| value(at).ok_or(format!("argument {at} of {name}"));
        let r = need(1)? + need(2)?;
        let mut cycle = Writer::drills(81, r, need(3)?, need(0)?);
        match name.trim() {
            "CYCLE81" => {}
            "CYCLE82" => (cycle.code, cycle.dwell) = (82, Some(value(5).unwrap_or(0.0))),
            "CYCLE83" => {
                cycle.code = if need(11)? == 0.0 { 73 } else { 83 };
                cycle.peck = Some(need(6)?);
            }
            "CYCLE84" => {
                let pitch = need(8)?;
                cycle.code = if pitch > 0.0 { 84 } else { 74 };
                cycle.feed = Some(pitch.abs() * if self.per_turn { 1.0 } else { need(10)? });
            }
            "CYCLE85" => (cycle.code, cycle.feed) = (85, Some(need(6)?)),
            other => return Err(other.to_owned()),
        }
        Ok(cycle)
    }

    fn klartext(&mut self, line: &str) -> Done {
        let line = line.split(';').next().unwrap_or_default();
        let block = numbered(line, "");
        let list: Vec<&str> = block.split_whitespace().collect();
        match list.as_slice() {
            [] => Ok(()),
            ["BEGIN", "PGM", .., units] => {
                self.inch = *units == "INCH";
                self.say(if self.inch { "G20 G17 G40 G80 G90 G94" } else { "G21 G17 G40 G80 G90 G94" });
                Ok(())
            }
            ["END", ..] | ["TOOL", "DEF", ..] | ["CYCL", "DEF", "9.0", ..] => Ok(()),
            ["TOOL", "CALL", rest @ ..] => self.tool_call(rest),
            ["CYCL", "DEF", "247", .., datum] => {
                let datum: f64 = datum.strip_prefix("Q339=").and_then(|n| n.parse().ok()).ok_or("a datum")?;
                self.block(&offset_words(datum));
                Ok(())
            }
            ["CYCL", "DEF", "9.1", .., seconds] => {
                let seconds: f64 = seconds.parse().map_err(|_| "a dwell")?;
                self.block(&[('G', 4.0), ('P', (seconds * 1000.0).round())]);
                Ok(())
            }
            ["CYCL", "DEF", number, rest @ ..] => {
                let cycle = self.tnc_cycle(number, rest)?;
                self.cycle = Some(cycle);
                Ok(())
            }
            ["LBL", "0"] => {
                self.say("M99");
                Ok(())
            }
            ["LBL", label] => {
                self.say(format!("O{label}"));
                Ok(())
            }
            ["CALL", "LBL", label] => {
                self.say(format!("M98 P{label}"));
                Ok(())
            }
            ["CC", x, y] => {
                let number = |text: &str| text[1..].parse::<f64>().map_err(|_| format!("`{text}`"));
                self.center = [number(x)?, number(y)?];
                Ok(())
            }
            ["L" | "C", ..] => self.path(&list),
            _ if list.iter().all(|word| word.starts_with('M')) => {
                let found = words(&list.join(" "))?;
                self.block(&found);
                Ok(())
            }
            _ => Err(block),
        }
    }

    fn tool_call(&mut self, list: &[&str]) -> Done {
        let mut said = Vec::new();
        for word in list {
            match word.chars().next() {
                Some('Z') => {}
                Some('S') => said.extend(words(word)?),
                _ => {
                    self.tool = word.parse().map_err(|_| format!("the tool {word}"))?;
                    self.block(&[('T', self.tool), ('M', 6.0)]);
                    self.block(&[('G', 43.0), ('H', self.tool)]);
                    self.at = [None; 3];
                }
            }
        }
        self.block(&said);
        Ok(())
    }

    fn path(&mut self, list: &[&str]) -> Done {
        let (mut rapid, mut calls, mut machine) = (false, false, false);
        let (mut said, mut turn) = (Vec::new(), None);
        for word in &list[1..] {
            match *word {
                "FMAX" => rapid = true,
                "M99" => calls = true,
                "M91" => machine = true,
                "DR+" => turn = Some(3.0),
                "DR-" => turn = Some(2.0),
                "R0" if self.side => {
                    self.side = false;
                    said.push(('G', 40.0));
                }
                "R0" => {}
                "RL" | "RR" => {
                    self.side = true;
                    said.extend([('G', if *word == "RL" { 41.0 } else { 42.0 }), ('D', self.tool)]);
                }
                word => {
                    let [(letter, value)] = words(word)?[..] else { return Err(word.to_owned()) };
                    said.push((letter, if letter == 'F' && self.inch { value / 10.0 } else { value }));
                }
            }
        }
        if let Some(turn) = turn {
            let from = [self.at[0], self.at[1]].map(|value| value.ok_or("an arc from nowhere"));
            let [x, y] = [from[0]?, from[1]?];
            said.extend([('I', self.center[0] - x), ('J', self.center[1] - y), ('G', turn)]);
        } else if said.iter().any(|word| "XYZABC".contains(word.0)) {
            said.push(('G', if rapid { 0.0 } else { 1.0 }));
        }
        if machine {
            said.push(('G', 53.0));
        }
        self.block(&said);
        if calls { self.hole() } else { Ok(()) }
    }

    fn tnc_cycle(&self, number: &str, list: &[&str]) -> Done<Cycle> {
        let mut q = BTreeMap::new();
        for word in list {
            if let Some((name, value)) = word.strip_prefix('Q').and_then(|word| word.split_once('=')) {
                let value = value.parse::<f64>().map_err(|_| format!("`{word}`"))?;
                q.insert(name.parse::<u16>().map_err(|_| format!("`{word}`"))?, value);
            }
        }
        let need = |name: u16| q.get(&name).copied().ok_or(format!("Q{name}"));
        let surface = need(203)?;
        let r = surface + need(200)?;
        let mut cycle = Writer::drills(81, r, surface + need(201)?, (surface + need(204)?).max(r));
        let feed = |name: u16| need(name).map(|feed| if self.inch { feed / 10.0 } else { feed });
        match number {
            "200" => {
                cycle.feed = Some(feed(206)?);
                let dwell = need(211)?;
                // a single plunge over the whole depth is drilling, not pecking
                if (need(202)? + need(201)?).abs() > 1e-9 {
                    (cycle.code, cycle.peck) = (83, Some(need(202)?));
                } else if dwell > 0.0 {
                    (cycle.code, cycle.dwell) = (82, Some(dwell));
                }
            }
            "201" => (cycle.code, cycle.feed) = (85, Some(feed(206)?)),
            "207" => {
                cycle.code = if need(239)? > 0.0 { 84 } else { 74 };
                cycle.feed = Some(need(239)?.abs() * if self.per_turn { 1.0 } else { self.speed });
            }
            other => return Err(format!("cycle {other}")),
        }
        Ok(cycle)
    }

    fn okuma(&mut self, line: &str) -> Done {
        let line = line.split('(').next().unwrap_or_default().trim();
        if line.starts_with('$') || line.starts_with('%') {
            return Ok(());
        }
        let block = numbered(line, "N");
        if block == "RTS" {
            self.say("M99");
            return Ok(());
        }
        if let Some(label) = block.strip_prefix("CALL O") {
            self.say(format!("M98 P{label}"));
            return Ok(());
        }
        let mut list = words(&block)?;
        let has = |list: &[(char, f64)], word| list.contains(&word);
        let value = |list: &[(char, f64)], letter: char| list.iter().find(|word| word.0 == letter).map(|word| word.1);
        if has(&list, ('M', 19.0)) && value(&list, 'R').is_some() {
            return Err("M19 with an angle".into());
        }
        if has(&list, ('G', 71.0)) {
            self.level = value(&list, 'Z').ok_or("G71 without Z")?;
            return Ok(());
        }
        let dwells = has(&list, ('G', 4.0));
        let code =
            list.iter().find(|word| word.0 == 'G' && matches!(word.1 as u16, 73 | 74 | 76 | 81..=89 | 274 | 284));
        let code = code.map(|word| word.1 as u16);
        for word in &mut list {
            *word = match *word {
                ('G', 56.0) => ('G', 43.0),
                ('F' | 'P', seconds) if dwells => ('P', (seconds * 1000.0).round()),
                other => other,
            };
        }
        if has(&list, ('G', 15.0)) {
            let offset = value(&list, 'H').ok_or("G15 without H")?;
            list.retain(|word| *word != ('G', 15.0) && word.0 != 'H');
            list.splice(0..0, offset_words(offset));
        }
        if has(&list, ('G', 16.0)) {
            list.retain(|word| *word != ('G', 16.0) && word.0 != 'H');
            list.insert(0, ('G', 53.0));
        }
        if has(&list, ('G', 80.0)) {
            self.cycle = None;
        }
        if let Some(code) = code {
            let code = match code {
                274 => 74,
                284 => 84,
                other => other,
            };
            self.cycle = Some(Writer::drills(code, f64::NAN, f64::NAN, f64::NAN));
        }
        let moves = list.iter().any(|word| "XYZR".contains(word.0));
        let Some(mut cycle) = self.cycle.clone().filter(|_| moves || code.is_some()) else {
            self.block(&list);
            return Ok(());
        };
        cycle.r = value(&list, 'R').unwrap_or(cycle.r);
        cycle.bottom = value(&list, 'Z').unwrap_or(cycle.bottom);
        cycle.peck = value(&list, 'Q').or(cycle.peck);
        cycle.feed = value(&list, 'F').or(cycle.feed);
        if has(&list, ('M', 53.0)) {
            cycle.back = self.level;
        }
        if has(&list, ('M', 54.0)) {
            cycle.back = cycle.r;
        }
        let at: Vec<(char, f64)> = list.iter().filter(|word| "XY".contains(word.0)).copied().collect();
        if !at.is_empty() {
            let mut rapid = vec![('G', 0.0)];
            rapid.extend(at);
            self.block(&rapid);
        }
        self.cycle = Some(cycle);
        self.hole()
    }
}
