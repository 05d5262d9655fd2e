//! The library that decodes Parquet stops in the middle on some damage that it did not expect. Here that is an error like any
//! other.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

use parquet::errors::{ParquetError, Result};

thread_local! {
    static DECODING: Cell<bool> = const { Cell::new(false) };
}

/// Decodes what may be damaged.
pub(super) fn guarded<T>(decode: impl FnOnce() -> Result<T>) -> Result<T> {
    let before = DECODING.replace(true);
    let decoded = catch_unwind(AssertUnwindSafe(decode));
    DECODING.set(before);
    decoded.unwrap_or_else(|_| Err(ParquetError::General("damaged where it was not expected".to_string())))
}

/// Keeps to itself what goes wrong in the library while it decodes: it is told as an error.
pub fn quiet_damage() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !DECODING.get() {
            usual(panic);
        }
    }));
}
