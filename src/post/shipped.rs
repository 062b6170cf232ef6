//! The forms that are shipped with postform, as text.

/// A form in the folder `postforms/`.
pub struct Shipped {
    /// Name of the form's file, without the extension.
    pub name: &'static str,
    /// The machine that the form is for.
    pub about: &'static str,
    /// Other names under which the form is found.
    pub also: &'static [&'static str],
    /// Text of the form.
    pub text: &'static str,
}

macro_rules! shipped {
    ($($name:literal $about:literal $($also:literal)*;)*) => {
        /// All shipped forms, in the order of the reference.
        pub const FORMS: &[Shipped] = &[$(Shipped {
            name: $name,
            about: $about,
            also: &[$($also),*],
            text: include_str!(concat!("../../postforms/", $name, ".pf")),
        }),*];
    };
}

shipped! {
    "fanuc" "Fanuc 0i-M, vertical mill";
    "haas" "Haas VF";
    "haas-4axis" "Haas VF with a rotary table";
    "fadal" "Fadal, format 1";
    "fadal-subs" "Fadal, with subprograms";
    "linuxcnc" "LinuxCNC, mill";
    "pathpilot" "Tormach PathPilot, mill";
    "mach3" "Mach3, mill";
    "centroid" "Centroid CNC12, mill";
    "mazak" "Mazak Matrix and Smooth, EIA programs";
    "brother" "Brother Speedio";
    "grbl" "Grbl 1.1";
    "grblhal" "grblHAL, with cycles and tool changes";
    "plasma" "Plasma table with LinuxCNC";
    "laser" "Laser with Grbl 1.1";
    "fanuc-lathe" "Fanuc 0i-T, lathe" "lathe";
    "haas-lathe" "Haas ST, lathe";
    "siemens" "Siemens 840D and 828D, mill";
    "heidenhain" "Heidenhain TNC in Klartext, mill";
    "okuma" "Okuma OSP, mill";
    "wire-edm" "Wire EDM with four axes" "edm" "fanuc-wire";
}
