//! The forms that ship, as text.

/// Fanuc mill.
pub const FANUC: &str = include_str!("../../postforms/fanuc.pf");
/// Haas mill.
pub const HAAS: &str = include_str!("../../postforms/haas.pf");
/// Haas mill with a rotary axis.
pub const HAAS_4AXIS: &str = include_str!("../../postforms/haas-4axis.pf");
/// Fadal mill.
pub const FADAL: &str = include_str!("../../postforms/fadal.pf");
/// Fadal mill with subprograms.
pub const FADAL_SUBS: &str = include_str!("../../postforms/fadal-subs.pf");
/// LinuxCNC mill.
pub const LINUXCNC: &str = include_str!("../../postforms/linuxcnc.pf");
/// Grbl router.
pub const GRBL: &str = include_str!("../../postforms/grbl.pf");
/// Fanuc lathe.
pub const FANUC_LATHE: &str = include_str!("../../postforms/fanuc-lathe.pf");
/// Haas lathe.
pub const HAAS_LATHE: &str = include_str!("../../postforms/haas-lathe.pf");
/// Siemens 840D mill.
pub const SIEMENS: &str = include_str!("../../postforms/siemens.pf");
/// Heidenhain TNC mill.
pub const HEIDENHAIN: &str = include_str!("../../postforms/heidenhain.pf");
/// Okuma OSP mill.
pub const OKUMA: &str = include_str!("../../postforms/okuma.pf");
/// Wire EDM machine.
pub const WIRE_EDM: &str = include_str!("../../postforms/wire-edm.pf");
