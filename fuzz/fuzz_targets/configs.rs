//! Bytes as pipeline.yaml, as structures (YAML or CSV), a hazard, a site or the spread over seeds, by the first byte.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use rockfrag::stages::registry::Config;
use rockfrag::stages::shared::hazard;
use rockfrag::stages::shared::structures::Structures;
use rockfrag::stages::synthesize_motions::{SynthesizeMotions, SynthesizeMotionsOptions};
use rockfrag::table::paper;
use rockfrag::table::schema::headings::Headings;

fuzz_target!(|bytes: &[u8]| {
    let Some((&first, text)) = bytes.split_first() else { return };
    let folder = Path::new("/dev/shm").join(format!("rockfrag-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = |name: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    match first % 6 {
        0 => {
            if let Ok(mut config) = Config::read(&file("pipeline.yaml")) {
                // Its files would be searched for all over the machine.
                config.import_motions = None;
                let _ = config.stages(&folder);
            }
        }
        1 => drop(Structures::File(file("structures.yaml")).resolve()),
        2 => drop(Structures::File(file("structures.csv")).resolve()),
        3 => drop(hazard::read(&file("hazard.csv"), &Headings::default())),
        4 => {
            let site = file("site.csv").display().to_string();
            let options = SynthesizeMotionsOptions { site, ..SynthesizeMotionsOptions::default() };
            drop(SynthesizeMotions::new(&options, folder.clone(), folder));
        }
        _ => drop(paper::spread(Some(&file("spread.csv")))),
    }
});
