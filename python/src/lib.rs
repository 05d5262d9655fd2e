//! The Python package: the same parser, stages and files as the command.
//!
//! ```text
//! stages    any stage: options as JSON in, paths out; runs, inspect and the command itself
//! objects   objects and sites of the library: probabilities, rates, fragilities
//! arrays    motions through objects
//! table     Arrow streams of Python to and from Parquet files
//! run       the GIL released, threads, progress, Ctrl-C
//! error     errors as Python's exceptions
//! ```

use pyo3::prelude::*;
use rockfrag::source::silence_decoder_panics;

mod arrays;
mod error;
mod objects;
mod run;
mod stages;
mod table;

#[pymodule]
mod _rockfrag {
    use super::*;

    #[pymodule_export]
    use crate::arrays::{simulate_motion, simulate_motions};
    #[pymodule_export]
    use crate::objects::{PyObject, Site};
    #[pymodule_export]
    use crate::stages::{call, command, describe, inspect, run_pipeline};
    #[pymodule_export]
    use crate::table::{read_columns, read_table, write_table};

    #[pymodule_init]
    fn init(module: &Bound<PyModule>) -> PyResult<()> {
        silence_decoder_panics();
        module.add("Error", module.py().get_type::<error::Error>())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
