//! Reads a line like Grbl: word by word, without spaces, slashes and comments. At the first wrong word, the line is refused.

use super::error::error;
use crate::control::{Code, Control, Meaning};
use crate::nc::block::Block;
use crate::nc::codes::{bit, group, letters, m_code, m_group};
use crate::nc::fault::{Done, Fault};
use crate::nc::scan::{Kind, tokens};

/// Letters whose values must not be negative.
const UNSIGNED: u32 = letters("FNPST");
/// The highest tool number.
const MOST_TOOL: f64 = 255.0;
/// The number of digits of a number that Grbl reads.
const MOST_DIGITS: usize = 8;
/// G codes with fractions, such as 38 for G38.2: Grbl reports an unknown fraction as an unknown code.
const WITH_FRACTIONS: [u16; 8] = [28, 30, 38, 43, 61, 90, 91, 92];

/// Reads a line.
///
/// # Errors
/// Grbl refuses the line when it reads it.
pub(in crate::nc) fn read(block: &mut Block, line: &[u8], control: &'static Control) -> Done {
    block.clear();
    let mut text = std::mem::take(&mut block.text);
    text.clear();
    text.extend_from_slice(line);
    let done = words(block, &mut text, control);
    block.text = text;
    done
}

fn words(block: &mut Block, line: &mut [u8], control: &'static Control) -> Done {
    let whole = line.trim_ascii_end().len();
    let (kept, comment) = clear(line)?;
    block.comment = comment;
    check_length(whole, kept, control)?;
    if line.trim_ascii_start().first() == Some(&b'$') {
        return Err(error(0, None));
    }
    let mut m_groups = 0;
    for token in tokens(line) {
        let about = || std::str::from_utf8(&line[token.start..token.end]).unwrap_or_default().trim_end();
        let fault = |number: u8| error(number, Some((about(), token.start)));
        match token.kind {
            Kind::Word(b'G', number) => {
                g_word(block, number.value, control).map_err(fault)?;
            }
            Kind::Word(b'M', number) => {
                m_word(block, number.value, &mut m_groups, control).map_err(fault)?;
            }
            Kind::Word(letter @ b'A'..=b'Z', number) => {
                word(block, letter, value(&line[token.start..token.end], number.value), control).map_err(fault)?;
            }
            Kind::Letter(b'A'..=b'Z') | Kind::Name => return Err(fault(2)),
            Kind::Blank | Kind::LineEnd => {}
            _ => return Err(fault(1)),
        }
    }
    Ok(())
}

/// Refuses a line that is too long. `whole` is the length of the line with comments. `kept` is the length of the line
/// without spaces, slashes and comments, which some controls do not count.
fn check_length(whole: usize, kept: usize, control: &'static Control) -> Done {
    let Some(longest) = control.traits().longest_line else { return Ok(()) };
    if control.traits().bare_line {
        return if kept >= longest { Err(error(11, None)) } else { Ok(()) };
    }
    if whole >= longest {
        let message = format!("more than {} characters, including comments and spaces", longest - 1);
        return Err(Fault::new(
            crate::diag::Code::PN001,
            message,
            "break the block into several blocks, or shorten its comment",
        ));
    }
    Ok(())
}

/// Replaces the characters that do not reach the parser by spaces. Returns the number of other characters, and the
/// columns of the first comment.
fn clear(line: &mut [u8]) -> Done<(usize, Option<(usize, usize)>)> {
    let (mut kept, mut comment, mut inside) = (0, None, None);
    let end = line.trim_ascii_end().len();
    for (at, byte) in line[..end].iter_mut().enumerate() {
        match (inside, *byte) {
            (_, b'!' | 0x18) => {
                let help =
                    "remove the character, even from comments: senders pass it to Grbl before the waiting blocks";
                return Err(Fault::at(crate::diag::Code::PN001, at, "a character that stops Grbl at once", help));
            }
            (_, b'\r') => {
                let help = "end lines with LF, or with CR and LF";
                return Err(Fault::at(crate::diag::Code::PN001, at, "a line end inside the line", help));
            }
            (None, mark @ (b'(' | b';')) => {
                inside = Some(mark);
                comment.get_or_insert((at + 1, end));
            }
            (Some(b'('), b')') => {
                inside = None;
                if let Some((_, close)) = comment.as_mut().filter(|(_, close)| *close == end) {
                    *close = at;
                }
            }
            (Some(_), _) => {}
            (None, b'/' | b'?' | b'~' | ..=b' ' | 0x7f..) => {}
            (None, _) => {
                kept += 1;
                continue;
            }
        }
        *byte = b' ';
    }
    Ok((kept, comment))
}

/// The value of a word. Grbl reads the first eight digits of a number, including leading zeros. All further digits
/// become zero.
fn value(word: &[u8], value: f64) -> f64 {
    let digits = || word.iter().filter(|byte| byte.is_ascii_digit());
    if digits().count() <= MOST_DIGITS {
        return value;
    }
    let read = digits().take(MOST_DIGITS).fold(0.0, |read, digit| read * 10.0 + f64::from(digit - b'0'));
    let before_point = word.iter().take_while(|&&byte| byte != b'.').filter(|byte| byte.is_ascii_digit()).count();
    let scale = 10f64.powi((before_point as i32 - MOST_DIGITS as i32).abs());
    (if before_point < MOST_DIGITS { read / scale } else { read * scale }).copysign(value)
}

fn g_word(block: &mut Block, value: f64, control: &'static Control) -> Result<(), u8> {
    let hundredths = ((value - value.trunc()) * 100.0).round();
    let mut number = value.trunc();
    if number == 49.0 || hundredths < 0.0 {
        // G49 with a fraction has already been read as G49
    } else if hundredths % 10.0 == 0.0 {
        number += hundredths / 100.0;
    } else {
        return Err(unknown_fraction(number, control));
    }
    let row = Code::of(b'G', number).filter(|_| value >= 0.0).and_then(|code| control.row(code));
    let Some(row) = row else {
        return Err(if hundredths == 0.0 { 20 } else { unknown_fraction(number.trunc(), control) });
    };
    let takes_axes = takes_axes(row.meaning);
    if takes_axes && block.axes_are_taken() {
        return Err(24);
    }
    let its_group = group(row, control.rules());
    if block.put_g(row, its_group, takes_axes) { Ok(()) } else { Err(21) }
}

/// The error for a code with a fraction that does not exist.
fn unknown_fraction(number: f64, control: &'static Control) -> u8 {
    let whole = Code::of(b'G', number).filter(|code| !WITH_FRACTIONS.contains(&(code.tenths / 10)));
    if whole.and_then(|code| control.row(code)).is_some() { 23 } else { 20 }
}

/// Whether a code uses the axis words of its block. A block may contain only one code that uses axis words.
fn takes_axes(meaning: Meaning) -> bool {
    use Meaning as M;
    matches!(meaning, M::Rapid | M::Line | M::ArcCw | M::ArcCcw | M::Probe)
        || matches!(meaning, M::SetOffsets | M::Reference | M::Preset | M::LengthData | M::LengthOff)
}

fn m_word(block: &mut Block, value: f64, groups: &mut u16, control: &'static Control) -> Result<(), u8> {
    if (value.fract() * 100.0).round() > 0.0 {
        return Err(23);
    }
    let code = if (0.0..=999.0).contains(&value) { value.trunc() as u16 } else { return Err(20) };
    let Some(row) = m_code(control, code) else { return Err(20) };
    let group = 1 << m_group(row);
    if *groups & group != 0 {
        return Err(21);
    }
    *groups |= group;
    if block.put_m(code, row) { Ok(()) } else { Err(21) }
}

fn word(block: &mut Block, letter: u8, value: f64, control: &'static Control) -> Result<(), u8> {
    let at = bit(letter);
    if !control.reads(letter) {
        return Err(20);
    }
    if letter == b'T' && value > MOST_TOOL {
        return Err(38);
    }
    if block.given & at != 0 {
        return Err(25);
    }
    if UNSIGNED & at != 0 && value < 0.0 {
        return Err(4);
    }
    // fractions in the values of L, N and T are dropped
    block.put(letter, if matches!(letter, b'L' | b'N' | b'T') { value.trunc() } else { value });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_eight_digits() {
        assert_eq!(value(b"X-12.5", -12.5), -12.5);
        assert_eq!(value(b"X0000000001", 1.0), 0.0);
        assert_eq!(value(b"X-1234567891", -1234567891.0), -1234567800.0);
        assert_eq!(value(b"X123.456789012", 123.456789012), 123.45678);
    }

    fn cleared(text: &str) -> (String, usize, Option<String>) {
        let mut line = text.as_bytes().to_vec();
        let (kept, comment) = clear(&mut line).unwrap();
        let comment = comment.map(|(start, end)| text[start..end].to_owned());
        (String::from_utf8(line).unwrap(), kept, comment)
    }

    #[test]
    fn blanks_slashes_and_comments_never_reach_the_parser() {
        assert_eq!(cleared("/G0 X1\r\n"), (" G0 X1\r\n".into(), 4, None));
        assert_eq!(cleared("G0(a;b)X1"), ("G0     X1".into(), 4, Some("a;b".into())));
        assert_eq!(cleared("G0 X1 (open Y5"), ("G0 X1         ".into(), 4, Some("open Y5".into())));
        assert_eq!(cleared("(a (b) c)"), ("       c)".into(), 2, Some("a (b".into())));
        assert_eq!(cleared("G0 X1? Y2~ ; (c)"), ("G0 X1  Y2       ".into(), 6, Some(" (c)".into())));
        assert!(clear(&mut b"(stop!)".to_vec()).is_err());
        assert!(clear(&mut b"G0 X1\rY2\n".to_vec()).is_err());
    }
}
