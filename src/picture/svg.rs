//! Draws a still picture: lines in a colour for each tool, dashed rapids, holes, and a legend.

use std::fmt::Write as _;

use super::{Kind, Picture, Strips, View};
use crate::terminal::{escaped, without_markup};

/// The settings of a drawing.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Title of the drawing.
    pub title: String,
    /// The view.
    pub view: View,
    /// Width of the drawing in pixels.
    pub width: f64,
}

/// The style class of the old program, which is drawn below the new program.
const OLD: &str = "was";

/// Pairs of colours for the tools: the first colour is for a white background, the second colour for a black
/// background.
const COLOURS: [[&str; 2]; 8] = [
    ["#0b63ce", "#78b1ff"],
    ["#c2410c", "#ff9d66"],
    ["#0f766e", "#5ad1c5"],
    ["#a21caf", "#e58af5"],
    ["#4d7c0f", "#a9d35a"],
    ["#9f1239", "#ff8fa8"],
    ["#6d28d9", "#bda4ff"],
    ["#854d0e", "#e3b269"],
];

const STYLE: &str = "\
svg{background:#fff;font:12px system-ui,sans-serif}text{fill:#5c636c}.h{fill:#1d2024;font-size:14px;font-weight:600}\
.floor{fill:#f1f0ec;stroke:#d9d8d3}path{fill:none;stroke-linejoin:round;stroke-linecap:round;stroke-width:1.5}\
.r{stroke:#d0443b;stroke-width:1;stroke-dasharray:4 3;opacity:.6}.axis{stroke:#8a9099;stroke-width:1.2}\
.was{stroke:#9aa1ab;stroke-width:4;opacity:.55}";
const DARK: &str = "\
svg{background:#1b1e22}text{fill:#a0a7b0}.h{fill:#e6e7e9}.floor{fill:#23272c;stroke:#353a41}.r{stroke:#e0736a}.axis{stroke:#7d848e}.was{stroke:#6b727b}";

/// Margin around the picture, in pixels.
const MARGIN: f64 = 28.0;
/// Height of the title and height of the legend, in pixels.
const BANDS: [f64; 2] = [40.0, 58.0];
/// The least and the greatest height of the drawing without title and legend, in pixels.
const HEIGHTS: [f64; 2] = [160.0, 900.0];
/// A point that is nearer to the last drawn point than this distance in pixels is left out.
const NEAREST: f64 = 0.1;

/// The picture as SVG text.
pub fn svg(picture: &Picture, sheet: &Sheet) -> String {
    svg_over(None, picture, sheet)
}

/// Draws a picture over the picture of an old program, which has wide grey lines.
pub fn svg_over(old: Option<&Picture>, picture: &Picture, sheet: &Sheet) -> String {
    let strips = picture.strips();
    let old = old.map(|old| (old, old.strips()));
    let mut around = floor(picture, &strips, sheet.view);
    let floor = around.clone();
    if let Some((_, strips)) = &old {
        around.extend(strips.pieces.iter().map(|piece| piece.to));
    }
    let scale = Scale::new(&strips, &around, sheet);
    let (width, height) = (sheet.width, scale.height + BANDS[0] + BANDS[1]);
    let mut out = String::new();
    _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{0}\" height=\"{1}\" role=\"img\" \
         aria-labelledby=\"title-{2} desc-{2}\">\n<title id=\"title-{2}\">{3}</title>\n<desc id=\"desc-{2}\">{4}</desc>\n",
        Short(width),
        Short(height),
        sheet.view.name(),
        safe(&sheet.title),
        safe(&described(picture, &strips))
    );
    style(&mut out);
    _ = writeln!(
        out,
        "<text class=\"h\" x=\"{MARGIN}\" y=\"26\">{}</text><text x=\"{}\" y=\"26\" text-anchor=\"end\">{} view</text>",
        safe(&sheet.title),
        Short(width - MARGIN),
        sheet.view.name()
    );
    if !floor.is_empty() {
        out.push_str("<path class=\"floor\" d=\"");
        floor.iter().zip("MLLL".chars()).for_each(|(at, command)| point(&mut out, command, scale.at(*at)));
        out.push_str("Z\"/>\n");
    }
    if let Some((old, strips)) = &old {
        path(old, strips, &scale, OLD, &|kind, _| kind != Kind::Jump, &mut out);
    }
    paths(picture, &strips, &scale, &mut out);
    holes(picture, &scale, &mut out);
    axes(&scale, scale.height + BANDS[0], &mut out);
    legend(picture, &strips, old.is_some(), [width, height], &mut out);
    out += "</svg>\n";
    out
}

/// Converts positions to pixels.
struct Scale {
    view: View,
    factor: f64,
    left: f64,
    top: f64,
    height: f64,
}

impl Scale {
    fn new(strips: &Strips, around: &[[f64; 3]], sheet: &Sheet) -> Scale {
        let mut least = [f64::INFINITY; 2];
        let mut greatest = [f64::NEG_INFINITY; 2];
        let drawn = strips.pieces.iter().map(|piece| piece.to).chain(around.iter().copied());
        for at in drawn.chain([strips.start]) {
            for (axis, value) in sheet.view.project(at).into_iter().enumerate() {
                least[axis] = least[axis].min(value);
                greatest[axis] = greatest[axis].max(value);
            }
        }
        let [wide, high] = [greatest[0] - least[0], greatest[1] - least[1]];
        let room = sheet.width - 2.0 * MARGIN;
        let [shortest, highest] = HEIGHTS.map(|height| height - 2.0 * MARGIN);
        let fits = [(wide, room), (high, highest)].into_iter().filter(|(size, _)| *size > 0.0);
        let factor = fits.map(|(size, room)| room / size).fold(f64::INFINITY, f64::min);
        let factor = if factor.is_finite() { factor } else { 1.0 };
        let inner = (high * factor).max(shortest);
        Scale {
            view: sheet.view,
            factor,
            left: MARGIN + (room - wide * factor) / 2.0 - least[0] * factor,
            top: BANDS[0] + MARGIN + (inner - high * factor) / 2.0 + greatest[1] * factor,
            height: inner + 2.0 * MARGIN,
        }
    }

    fn at(&self, place: [f64; 3]) -> [f64; 2] {
        let [right, up] = self.view.project(place);
        [self.left + right * self.factor, self.top - up * self.factor]
    }
}

/// A number that is written with at most two decimals.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}

fn style(out: &mut String) {
    let rules = |which: usize| -> String {
        let rules = COLOURS.iter().enumerate();
        rules.map(|(i, colours)| format!(".t{i}{{stroke:{0}}}.f{i}{{fill:{0}}}", colours[which])).collect()
    };
    _ = writeln!(out, "<style>{STYLE}{}@media(prefers-color-scheme:dark){{{DARK}{}}}</style>", rules(0), rules(1));
}

/// The bottom corners of the box around the cuts, for views that show the bottom of the box.
fn floor(picture: &Picture, strips: &Strips, view: View) -> Vec<[f64; 3]> {
    let plain = picture.turned.is_empty() && picture.letters == "XYZ";
    let shown = matches!(view, View::Iso | View::Top) && picture.tally.units == picture.units && plain;
    match picture.tally.extents.filter(|_| shown && !strips.pieces.is_empty()) {
        Some([x, y, z]) => [[x.0, y.0], [x.1, y.0], [x.1, y.1], [x.0, y.1]].map(|[x, y]| [x, y, z.0]).to_vec(),
        None => Vec::new(),
    }
}

fn point(out: &mut String, command: char, at: [f64; 2]) {
    _ = write!(out, "{command}{} {}", Short(at[0]), Short(at[1]));
}

/// Writes one path for the rapids, and one path for the cuts of each tool.
fn paths(picture: &Picture, strips: &Strips, scale: &Scale, out: &mut String) {
    path(picture, strips, scale, "r", &|kind, _| kind == Kind::Rapid, out);
    for tool in 0..picture.tools.len() {
        let class = format!("t{}", colour(tool));
        path(picture, strips, scale, &class, &|kind, by| matches!(kind, Kind::Feed | Kind::Arc) && by == tool, out);
    }
}

fn path(
    picture: &Picture,
    strips: &Strips,
    scale: &Scale,
    class: &str,
    belongs: &dyn Fn(Kind, usize) -> bool,
    out: &mut String,
) {
    let mut text = String::new();
    let mut from = scale.at(strips.start);
    // the last point written to the path, and the last point that was left out
    let (mut at, mut left): (Option<[f64; 2]>, Option<[f64; 2]>) = (None, None);
    for piece in &strips.pieces {
        let of = &picture.moves[piece.of as usize];
        let to = scale.at(piece.to);
        if belongs(of.kind, usize::from(of.tool)) {
            let begin = *at.get_or_insert_with(|| {
                point(&mut text, 'M', from);
                from
            });
            if (to[0] - begin[0]).hypot(to[1] - begin[1]) < NEAREST {
                left = Some(to);
            } else {
                point(&mut text, 'L', to);
                (at, left) = (Some(to), None);
            }
        } else {
            at = None;
            if let Some(left) = left.take() {
                point(&mut text, 'L', left);
            }
        }
        from = to;
    }
    if let Some(left) = left {
        point(&mut text, 'L', left);
    }
    if !text.is_empty() {
        _ = writeln!(out, "<path class=\"{class}\" d=\"{text}\"/>");
    }
}

fn colour(tool: usize) -> usize {
    (tool + COLOURS.len() - 1) % COLOURS.len()
}

fn holes(picture: &Picture, scale: &Scale, out: &mut String) {
    let mut last = None;
    for hole in &picture.holes {
        let at = scale.at(hole.on_part()[0]);
        // holes at the same pixels are drawn once
        if last.is_some_and(|last: [f64; 2]| (at[0] - last[0]).hypot(at[1] - last[1]) < 1.0) {
            continue;
        }
        last = Some(at);
        let class = colour(usize::from(hole.tool));
        _ = writeln!(out, "<circle class=\"f{class}\" cx=\"{}\" cy=\"{}\" r=\"2.6\"/>", Short(at[0]), Short(at[1]));
    }
}

/// Draws the directions of the axes.
fn axes(scale: &Scale, bottom: f64, out: &mut String) {
    let length = 26.0;
    let origin = [MARGIN + 14.0, bottom - 22.0];
    for (axis, name) in ["X", "Y", "Z"].iter().enumerate() {
        let mut along = [0.0; 3];
        along[axis] = 1.0;
        let [right, up] = scale.view.project(along);
        if right.hypot(up) < 0.1 {
            continue;
        }
        let tip = [origin[0] + right * length, origin[1] - up * length];
        let text = [origin[0] + right * (length + 9.0), origin[1] - up * (length + 9.0)];
        out.push_str("<path class=\"axis\" d=\"");
        point(out, 'M', origin);
        point(out, 'L', tip);
        _ = writeln!(
            out,
            "\"/><text x=\"{}\" y=\"{}\" text-anchor=\"middle\" dominant-baseline=\"central\">{name}</text>",
            Short(text[0]),
            Short(text[1])
        );
    }
}

fn legend(picture: &Picture, strips: &Strips, over_old: bool, [width, height]: [f64; 2], out: &mut String) {
    let y = height - 34.0;
    let mut x = MARGIN;
    let mut entry = |class: &str, name: &str, out: &mut String| {
        let wide = 34.0 + 7.5 * name.len() as f64;
        if x + wide > width - MARGIN {
            return;
        }
        _ = writeln!(
            out,
            "<path class=\"{class}\" d=\"M{} {y}h22\"/><text x=\"{}\" y=\"{}\">{name}</text>",
            Short(x),
            Short(x + 28.0),
            Short(y + 4.0)
        );
        x += wide + 10.0;
    };
    if picture.moves.iter().any(|found| found.kind == Kind::Rapid) {
        entry("r", "rapid", out);
    }
    for (i, number) in picture.tools.iter().enumerate() {
        let cuts = |found: &super::Move| usize::from(found.tool) == i && matches!(found.kind, Kind::Feed | Kind::Arc);
        if picture.moves.iter().any(cuts) {
            let name = if i == 0 { "no tool".to_owned() } else { picture.tool_text(*number) };
            entry(&format!("t{}", colour(i)), &name, out);
        }
    }
    if over_old {
        entry(OLD, "before", out);
    }
    _ = writeln!(
        out,
        "<text x=\"{MARGIN}\" y=\"{}\">{}</text>",
        Short(height - 12.0),
        safe(&measured(picture, strips))
    );
}

/// The line of text with number of blocks, time and extents.
fn measured(picture: &Picture, strips: &Strips) -> String {
    let [least, greatest] = strips.extents;
    let mut text = format!("{} blocks, {}", picture.blocks, crate::nc::clock(picture.tally.minutes()));
    for (axis, name) in ["X", "Y", "Z"].iter().enumerate() {
        _ = write!(text, ", {name} {} to {}", Short(least[axis]), Short(greatest[axis]));
    }
    _ = write!(text, " {}", picture.units.name());
    if let Some((diag, line)) = &picture.refused {
        _ = write!(text, "; refused at line {line}: {}", diag.message);
    }
    text
}

fn described(picture: &Picture, strips: &Strips) -> String {
    let count = |kind: Kind| picture.moves.iter().filter(|found| found.kind == kind).count();
    let counts = [
        (count(Kind::Rapid), "rapid"),
        (count(Kind::Feed), "straight cut"),
        (count(Kind::Arc), "arc"),
        (picture.holes.len(), "hole"),
        (picture.tools.len() - 1, "tool"),
    ];
    let counts = counts.map(|(number, what)| format!("{number} {what}{}", if number == 1 { "" } else { "s" }));
    format!("Backplot: {}; {}", counts.join(", "), measured(picture, strips))
}

/// A text for use in a picture, escaped so that it contains no markup.
fn safe(text: &str) -> String {
    without_markup(&escaped(text))
}
