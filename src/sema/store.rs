//! How a field of the settings is set from the arguments of a command, for each type of field.

use super::args::{Arguments, Read, bad, bad_with, whole};
use super::code::Code;
use crate::control::{self, Control};
use crate::lang::Args;
use crate::suggest::nearest;

/// A field of the settings that a command sets.
pub trait Setting {
    /// Sets the field from the arguments. The number of arguments is already checked.
    fn set(&mut self, args: &Arguments) -> Read<()>;
}

/// A field that has no value if its command is missing.
impl<T: Setting + Default> Setting for Option<T> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let mut value = T::default();
        value.set(args)?;
        *self = Some(value);
        Ok(())
    }
}

impl Setting for bool {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = args.switch()?;
        Ok(())
    }
}

/// A control, by its name. If a file describes the control, the control is stored before the commands are read.
impl Setting for Option<&'static Control> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let name = args.text().to_ascii_lowercase();
        if args.all.len() == 1 && control::is_file(&name) {
            return Ok(());
        }
        let Some(control) = Control::named(&name) else {
            // a model after the name, as in `Fanuc 0i-MD`
            let first = &args.all[0].text.to_ascii_lowercase();
            let own = control::names().find(|known| known == first);
            if let Some(near) = own.or_else(|| nearest(&name, control::names())) {
                let help = format!(
                    "write `Control {near}`; for a control with differences, `postform new --control-file {near} -o \
                     my-control.toml` makes a file"
                );
                return bad_with(args.all.first(), format!("there is no control `{}`", args.text()), help);
            }
            let known = control::names().collect::<Vec<_>>().join(", ");
            let message = format!(
                "there is no control `{name}`: use {known}, or a file, as `my-vf2.toml`; most other controls are \
                 similar to `fanuc`: `postform new --control-file fanuc -o {}.toml` makes a file to start from",
                name.replace(' ', "-")
            );
            return bad(args.all.first(), message);
        };
        *self = Some(control);
        Ok(())
    }
}

/// Text.
impl Setting for String {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = args.text();
        Ok(())
    }
}

/// The texts of a command that may be repeated.
impl Setting for Vec<String> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        self.push(args.text());
        Ok(())
    }
}

/// A number, or the number of a code.
impl Setting for f64 {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = match args.id.row().args {
            Args::Codes(..) => args.codes()?[0].code.value(),
            _ => args.number()?,
        };
        Ok(())
    }
}

/// Numbers of codes. If there are fewer codes than numbers, the last numbers keep their values.
impl<const N: usize> Setting for [f64; N] {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        for (slot, code) in self.iter_mut().zip(args.codes()?) {
            *slot = code.code.value();
        }
        Ok(())
    }
}

/// Codes, which may be written with or without letters.
impl Setting for Vec<control::Code> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = args.codes()?.iter().map(|code| code.code).collect();
        Ok(())
    }
}

impl Setting for Code {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = args.codes()?.swap_remove(0);
        Ok(())
    }
}

impl Setting for Vec<Code> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = args.codes()?;
        Ok(())
    }
}

impl Setting for u8 {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = args.letters()?[0];
        Ok(())
    }
}

/// Letters. If the command is repeated, its letters are added.
impl Setting for Vec<u8> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        self.extend(args.letters()?);
        Ok(())
    }
}

/// A pair of letters. If the command is repeated, another pair is added.
impl Setting for Vec<(u8, u8)> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let letters = args.letters()?;
        self.push((letters[0], letters[1]));
        Ok(())
    }
}

/// Columns of a line, in ascending order.
impl Setting for Vec<usize> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        *self = args.all.iter().map(|arg| whole(arg, 1, 200).map(|n| n as usize)).collect::<Read<_>>()?;
        if self.windows(2).any(|pair| pair[0] >= pair[1]) {
            return bad(args.all.first(), "columns must increase");
        }
        Ok(())
    }
}
