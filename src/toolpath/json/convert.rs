//! Converts the objects of a job to the types of events, and checks their values.

use super::objects::{ArcObject, CallObject, CycleObject, SpindleObject, ThreadObject, ToolObject};
use super::values::{Number, PeckMode, SpeedMode, StepFrom};
use crate::diag::{Code, Diag};
use crate::toolpath::CycleKind;
use crate::toolpath::{Arc, Call, CycleSpec, Orient, Peck, Plane, Spindle, Thread, Tool};

/// The error for a fault in the job. The reader adds the location.
pub(super) fn fault<T, E: From<Box<Diag>>>(
    code: Code,
    message: impl Into<String>,
    help: impl Into<String>,
) -> Result<T, E> {
    Err(Box::new(Diag::new(code, message).help(help)).into())
}

pub(super) fn positive(name: &str, Number(value): Number) -> Result<f64, Box<Diag>> {
    if value > 0.0 {
        return Ok(value);
    }
    fault(Code::PJ003, format!("`{name}` is {value}"), format!("`{name}` must be above zero"))
}

pub(super) fn not_negative(name: &str, Number(value): Number) -> Result<f64, Box<Diag>> {
    if value >= 0.0 {
        return Ok(value);
    }
    fault(Code::PJ003, format!("`{name}` is {value}"), format!("`{name}` can't be negative"))
}

pub(super) fn whole(name: &str, number: Number) -> Result<f64, Box<Diag>> {
    let value = not_negative(name, number)?;
    if value.fract() == 0.0 && value < 1e9 {
        return Ok(value);
    }
    fault(Code::PJ003, format!("`{name}` is {value}"), format!("`{name}` must be a whole number below 1000000000"))
}

pub(super) fn tool_of(object: ToolObject) -> Result<Tool, Box<Diag>> {
    let Some(number) = object.number else {
        return fault(Code::PJ004, "a tool without a number", "give each tool a \"number\"");
    };
    Ok(Tool {
        number: whole("number", number)?,
        diameter: object.diameter.map(|n| not_negative("diameter", n)).transpose()?,
        corner_radius: object.corner_radius.map(|n| not_negative("corner_radius", n)).transpose()?,
        length_offset: object.length_offset.map(|n| whole("length_offset", n)).transpose()?,
        diameter_offset: object.diameter_offset.map(|n| whole("diameter_offset", n)).transpose()?,
        turret: object.turret.map(|n| whole("turret", n)).transpose()?,
        name: object.name,
        comment: object.comment,
        data: object.data.map_or_else(Vec::new, |data| data.0),
    })
}

pub(super) fn spindle_of(object: &SpindleObject) -> Result<Spindle, Box<Diag>> {
    Ok(Spindle {
        speed: object.speed.map(|n| not_negative("speed", n)).transpose()?,
        turn: object.direction.map(|d| d.0),
        css: object.mode.map(|m| m.0 == SpeedMode::Css),
        max: object.max.map(|n| positive("max", n)).transpose()?,
    })
}

pub(super) fn arc_of(object: &ArcObject) -> Result<Arc, Box<Diag>> {
    let Some(to) = object.to else {
        return fault(Code::PJ004, "an arc without `to`", "give its end");
    };
    let Some(direction) = object.direction else {
        return fault(Code::PJ004, "an arc without `direction`", "write \"direction\": \"cw\" or \"ccw\"");
    };
    if object.center.is_some() == object.radius.is_some() {
        return fault(Code::PJ005, "an arc needs either `center` or `radius`", "give one of them");
    }
    if object.radius.is_some_and(|r| r.0 == 0.0) {
        return fault(Code::PJ003, "`radius` is 0", "give the arc's radius");
    }
    let turns = object.turns.map_or(Ok(0.0), |n| whole("turns", n))?;
    if turns > 10_000.0 {
        return fault(Code::PJ003, format!("`turns` is {turns}"), "an arc can have at most 10000 turns");
    }
    Ok(Arc {
        to: to.0,
        center: object.center.map(|c| c.0),
        radius: object.radius.map(|r| r.0),
        direction: direction.0,
        plane: object.plane.map_or(Plane::Xy, |p| p.0),
        turns: turns as u32,
    })
}

pub(super) fn thread_of(object: &ThreadObject) -> Result<Thread, Box<Diag>> {
    let (Some(from), Some(to), Some(pitch), Some(depth)) = (object.from, object.to, object.pitch, object.depth) else {
        return fault(Code::PJ004, "a thread needs `from`, `to`, `pitch` and `depth`", "give all four");
    };
    if depth.0 == 0.0 {
        return fault(Code::PJ003, "`depth` is 0", "give the height of the thread");
    }
    let above_zero = |name, n: Option<Number>| n.map(|n| positive(name, n)).transpose();
    let count = |name, n: Option<Number>| n.map(|n| whole(name, n).and_then(|n| positive(name, Number(n)))).transpose();
    let starts = count("starts", object.starts)?;
    if starts.is_some_and(|starts| starts > 100.0) {
        return fault(Code::PJ003, "`starts` is above 100", "give the number of starts of the thread");
    }
    Ok(Thread {
        from: from.0,
        to: to.0,
        pitch: positive("pitch", pitch)?,
        depth: depth.0,
        first_depth: above_zero("first_depth", object.first_depth)?,
        min_depth: object.min_depth.map(|n| not_negative("min_depth", n)).transpose()?,
        taper: object.taper.map(|n| n.0),
        angle: object.angle.map(|n| not_negative("angle", n)).transpose()?,
        passes: count("passes", object.passes)?,
        chamfer: object.chamfer.map(|n| not_negative("chamfer", n)).transpose()?,
        starts,
    })
}

pub(super) fn call_of(object: &CallObject) -> Result<Call, Box<Diag>> {
    let Some(sub) = object.sub else {
        return fault(Code::PJ004, "a call without `sub`", "give the number of the subprogram");
    };
    let times = object.times.map_or(Ok(1.0), |n| whole("times", n))?;
    if times == 0.0 {
        return fault(Code::PJ003, "`times` is 0", "remove the call, or let it run once");
    }
    Ok(Call {
        sub: whole("sub", sub)?,
        times,
        at: object.at.unwrap_or_default().0,
        work: object.work.map(|w| not_negative("work", w)).transpose()?,
    })
}

pub(super) fn spec_of(object: &CycleObject) -> Result<CycleSpec, Box<Diag>> {
    let Some(kind) = object.kind else {
        return fault(Code::PJ004, "a cycle without `kind`", "write \"kind\": \"drill\"");
    };
    let plain = |n: Option<Number>| n.map(|n| n.0);
    let above_zero = |name, n: Option<Number>| n.map(|n| positive(name, n)).transpose();
    let from_zero = |name, n: Option<Number>| n.map(|n| not_negative(name, n)).transpose();
    let mut pecks = Vec::new();
    for peck in object.pecks.iter().flat_map(|pecks| &pecks.0) {
        let Some(to) = peck.to else {
            return fault(Code::PJ004, "a peck without `to`", "give its depth");
        };
        pecks.push(Peck { to: to.0, feed: above_zero("feed", peck.feed)? });
    }
    Ok(CycleSpec {
        depth: plain(object.depth),
        clear: plain(object.clear),
        return_height: plain(object.return_height),
        feed: above_zero("feed", object.feed)?,
        plunge: above_zero("plunge", object.plunge)?,
        step: above_zero("step", object.step)?,
        first_step: above_zero("first_step", object.first_step)?,
        back: from_zero("back", object.back)?,
        dwell: from_zero("dwell", object.dwell)?,
        revs: from_zero("revs", object.revs)?,
        rapto: from_zero("rapto", object.rapto)?,
        orient: plain(object.orient).map(Orient::At),
        offset: from_zero("offset", object.offset)?,
        ratio: above_zero("ratio", object.ratio)?,
        starts: above_zero("starts", object.starts)?,
        rigid: object.rigid,
        times: above_zero("times", object.times)?,
        decr: from_zero("decr", object.decr)?,
        min_step: from_zero("min_step", object.min_step)?,
        diameter: above_zero("diameter", object.diameter)?,
        angle: above_zero("angle", object.angle)?,
        hole_diameter: above_zero("hole_diameter", object.hole_diameter)?,
        webs: object.webs.iter().flat_map(|webs| &webs.0).map(|n| n.0).collect(),
        pecks,
        mode: object.mode.map(|m| match m.0 {
            PeckMode::Deep => CycleKind::Deep,
            PeckMode::Chipbreak => CycleKind::Chipbreak,
        }),
        norevr: object.norevr.unwrap_or(false),
        rapout: object.rapout.unwrap_or(false),
        jog: from_zero("jog", object.jog)?,
        offset_y: plain(object.offset_y),
        steps_from_point: object.step_from.is_some_and(|from| from.0 == StepFrom::Point),
        emulate: object.emulate.unwrap_or(false),
        ..CycleSpec::new(kind.0)
    })
}
