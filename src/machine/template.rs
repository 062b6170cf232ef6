//! The machine file that `postform new --machine` writes.

use crate::control::Control;

/// A commented machine file for a machine with this control.
pub fn template(control: &Control) -> String {
    let offset = super::offsets::name(control, 1);
    let further = super::offsets::name(control, 10);
    let whole = format!(
        "# A machine. Only values in this file are checked: `postform machine check FILE` lists the missing ones.
# Take the # from a line and write your machine's own value; the values here are examples.
name = \"my machine\"
control = \"{name}\"
units = \"mm\"                        # units of all lengths in this file: mm or inch

# machine coordinates, as the control shows them after homing
[axes.X]
# travel = [-762.0, 0.0]
# rapid = 25400                      # per minute
# feed = 16500                       # the fastest feed, per minute
# acceleration = 2500                # per second squared; used for times
[axes.Y]
# travel = [-406.0, 0.0]
[axes.Z]
# travel = [-508.0, 0.0]
# [axes.A]
# travel = \"endless\"                 # or [-120, 30]
# turns = \"table\"                    # or \"head\"
# about = [1, 0, 0]

[corners]                            # used for times
# deviation = 0.01                   # largest distance of the path from a corner; $11 of Grbl
# ahead = 200                        # blocks that the control plans ahead; Grbl has 15

[reference]
# G28 = [0, 0, 0]
# G30 = [0, -100, 0]

[spindle]
# speed = [30, 8100]
# acceleration = 2.0                 # seconds to the highest speed

[tools]
# places = 20
# change = 4.2                       # seconds from the end of a cut to the next cut
# file = \"tools.csv\"                 # number,length,diameter,name; or tool.tbl of LinuxCNC, or a list of G10
# [tools.5]
# length = 123.4
# diameter = 10
# name = \"drill 10\"

# [offsets]                          # zero points of the part, in machine coordinates
# {offset} = [-400.0, -210.0, -350.0]
# \"{further}\" = [-600.0, -210.0, -350.0]

[coolant]
# kinds = [\"flood\", \"through\"]       # flood, mist, through, air, high

[memory]
# bytes = 1000000
# numbers = [1, 9999]

# [[fixtures]]                       # a box in a work offset that no rapid may enter
# name = \"the left clamp\"
# work = \"{offset}\"
# box = [[-20, -20, -40], [0, 120, 15]]
",
        name = control.name()
    );
    if !control.is_lathe() {
        return whole;
    }
    // on a lathe X is a diameter, and there is no Y
    let whole = whole.replace("[axes.Y]\n# travel = [-406.0, 0.0]\n", "");
    let whole = whole.replace(
        "[axes.X]\n",
        "[axes.X]                             # in diameters: travel, rapid, feed, acceleration\n",
    );
    let lists = [("[0, -100, 0]", "[0, 0, -100]"), ("[-400.0, -210.0, -350.0]", "[-400.0, 0.0, -350.0]")];
    lists.into_iter().fold(whole, |text, (mill, lathe)| text.replace(mill, lathe))
}
