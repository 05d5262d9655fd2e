//! The Python package: the stages of rockfrag with tables that come and go as Arrow.
//!
//! ```text
//! stages    any stage: options as JSON, tables or paths in, a table or a path out
//! tools     the commands that are no stage, and the command itself
//! response  one structure and one motion, as NumPy arrays; probability: the universal surface
//! curves    the fits for plain arrays
//! table     tables between Python and the stages, without a copy
//! run       the GIL released, threads, progress, Ctrl-C
//! error     errors as Python's exceptions
//! ```

use pyo3::prelude::*;
use rockfrag::fragility::MANY_CLUSTERS;
use rockfrag::fragility::overturning::LEAST_EVENTS;
use rockfrag::table::store::guarded::quiet_damage;

mod curves;
mod error;
mod probability;
mod response;
mod run;
mod stages;
mod table;
mod tools;

#[pymodule]
mod _rockfrag {
    use super::*;

    #[pymodule_export]
    use crate::curves::{
        exceeding, f_upper_tail, failure_limits, fit_curve, fit_line, normal_quantile, probabilities,
        profile_limits, t_quantile,
    };
    #[pymodule_export]
    use crate::probability::probability;
    #[pymodule_export]
    use crate::response::{response, structure};
    #[pymodule_export]
    use crate::stages::{call, partition_file, stages};
    #[pymodule_export]
    use crate::table::{PyTable, restored};
    #[pymodule_export]
    use crate::tools::{command, inspect_file, run_pipeline, seed_spread};

    #[pymodule_init]
    fn init(module: &Bound<PyModule>) -> PyResult<()> {
        quiet_damage();
        module.add("LEAST_EVENTS", LEAST_EVENTS)?;
        module.add("MANY_CLUSTERS", MANY_CLUSTERS)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
