//! Bytes as each Parquet file that a stage reads.
#![no_main]

#[path = "../../tests/robust/readers.rs"]
mod readers;

use std::path::Path;
use std::sync::Once;

use libfuzzer_sys::fuzz_target;
use rockfrag::table::store::guarded::quiet_damage;

static START: Once = Once::new();

fuzz_target!(|bytes: &[u8]| {
    // Damage that stops the decoder is an error, and no crash.
    START.call_once(quiet_damage);
    let path = Path::new("/dev/shm").join(format!("rockfrag-fuzz-{}.parquet", std::process::id()));
    std::fs::write(&path, bytes).unwrap();
    drop(readers::read_as_everything(&path));
});
