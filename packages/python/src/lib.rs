//! postform as a Python module: posts, programs, findings.

mod findings;
mod jobs;
mod post;

use pyo3::prelude::*;

/// The module.
#[pymodule]
mod _postform {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::findings::{Error, Finding, Refused};
    #[pymodule_export]
    use crate::post::{Post, Program, lint};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}

/// A value from a dictionary as text. `True` and `False` become `yes` and `no`, as in forms.
fn spelt(value: &Bound<'_, PyAny>) -> PyResult<String> {
    match value.cast::<pyo3::types::PyBool>() {
        Ok(flag) => Ok(if flag.is_true() { "yes" } else { "no" }.to_owned()),
        Err(_) => value.str()?.extract(),
    }
}
