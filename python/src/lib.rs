//! The Python package: the same parser, stages and files as the command.
//!
//! ```text
//! stages    any stage: options as JSON in, paths out; runs, inspect and the command itself
//! arrays    one motion, one structure; the lognormal curve of given outcomes
//! table     Arrow streams of Python to and from Parquet files
//! run       the GIL released, threads, progress, Ctrl-C
//! error     errors as Python's exceptions
//! ```

use pyo3::prelude::*;
use rockfrag::source::silence_decoder_panics;

mod arrays;
mod error;
mod run;
mod stages;
mod table;

#[pymodule]
mod _rockfrag {
    use super::*;

    #[pymodule_export]
    use crate::arrays::{fit_curve, normal_cdf, simulate_motion};
    #[pymodule_export]
    use crate::stages::{call, command, describe, inspect, run_pipeline};
    #[pymodule_export]
    use crate::table::{read_numbers, read_table, write_numbers, write_table};

    #[pymodule_init]
    fn init(module: &Bound<PyModule>) -> PyResult<()> {
        silence_decoder_panics();
        module.add("Error", module.py().get_type::<error::Error>())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
