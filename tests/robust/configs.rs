//! Pipeline, structures and hazard files with parts changed.

use std::path::Path;

use proptest::prelude::*;
use rockfrag::stages::registry::Config;
use rockfrag::stages::shared::hazard;
use rockfrag::stages::shared::structures::Structures;
use rockfrag::stages::synthesize_motions::{SynthesizeMotions, SynthesizeMotionsOptions};
use rockfrag::table::paper;
use rockfrag::table::schema::headings::Headings;

const PIECES: [&str; 28] = [
    "seed: 1",
    "out: x",
    "sample-scenarios: {",
    "mw: \"5:7:0.5\"",
    "re: \"1e308:1e309:1e-300\"",
    "samples: 99999999999",
    "}",
    "[",
    "]",
    "simulate:",
    "  structures:",
    "    - { name: a, p: 1.0, alpha: .nan, eta: 1e400 }",
    "- { width: 1, height: .inf }",
    "&a [*a, *a]",
    "<<: *a",
    "? x",
    "!!binary aGk=",
    "\t",
    "\"",
    "'",
    "# é",
    "name,p,alpha,eta",
    "a,1,0.2,0.9",
    "a,,\"",
    "pga_g,annual_rate_of_exceedance",
    "0.1,0.01",
    "1e-320,1e300",
    "nan,-1",
];

proptest! {
    #[test]
    fn any_configuration_is_read_or_explained(pieces in prop::collection::vec(prop::sample::select(PIECES.to_vec()), 0..12)) {
        let text = pieces.join("\n");
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, &text).unwrap();
            path
        };
        let mut outcomes = vec![
            ("structures.yaml", Structures::File(file("structures.yaml")).resolve().map(drop)),
            ("structures.csv", Structures::File(file("structures.csv")).resolve().map(drop)),
            ("hazard.csv", hazard::read(&file("hazard.csv"), &Headings::default()).map(drop)),
        ];
        let config = Config::read(&file("pipeline.yaml"));
        let checked = config.and_then(|config| config.stages(folder.path()).map(drop));
        outcomes.push(("pipeline", checked));
        for (_, outcome) in outcomes {
            let words = outcome.err().map(|error| format!("{error:#}"));
            prop_assert!(words.is_none_or(|words| !words.is_empty()));
        }
    }
}

#[test]
fn nesting_and_repetition_without_end_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipeline.yaml");
    let laughs = (0..30).fold("a0: &a0 [x]\n".to_string(), |text, k| {
        format!("{text}a{}: &a{} [{}]\n", k + 1, k + 1, [format!("*a{k}"), format!("*a{k}")].join(", "))
    });
    for text in ["[".repeat(100_000), "a: ".repeat(50_000), laughs, "- ".repeat(100_000)] {
        std::fs::write(&path, text).unwrap();
        assert!(Config::read(&path).is_err());
        let structures = folder.path().join("structures.yaml");
        std::fs::copy(&path, &structures).unwrap();
        assert!(Structures::File(structures).resolve().is_err());
    }
}

/// What reads each kind of file, and the MiB of the largest that it reads.
type Reader = (&'static str, u64, fn(&Path) -> anyhow::Result<()>);

const READERS: [Reader; 6] = [
    ("pipeline.yaml", 1, |path| Config::read(path).map(drop)),
    ("structures.yaml", 16, |path| Structures::File(path.into()).resolve().map(drop)),
    ("structures.csv", 16, |path| Structures::File(path.into()).resolve().map(drop)),
    ("hazard.csv", 64, |path| hazard::read(path, &Headings::default()).map(drop)),
    ("spread.csv", 1, |path| paper::spread(Some(path)).map(drop)),
    ("site.csv", 1, |path| {
        let options = SynthesizeMotionsOptions { site: path.display().to_string(), ..Default::default() };
        SynthesizeMotions::new(&options, path, path.to_path_buf()).map(drop)
    }),
];

#[test]
fn files_of_any_size_are_read_up_to_a_bound() {
    let folder = tempfile::tempdir().unwrap();
    for (name, most_mib, read) in READERS {
        let path = folder.path().join(name);
        let file = std::fs::File::create(&path).unwrap();
        let words = |more: u64| {
            file.set_len((most_mib << 20) + more).unwrap();
            // A file of zeros may be a table without rows.
            read(&path).map_or_else(|error| format!("{error:#}"), |()| String::new())
        };
        let (largest, larger) = (words(0), words(1));
        assert!(!largest.contains("larger than"), "{name}: {largest}");
        assert!(larger.contains(name), "{larger}");
        assert!(larger.contains(&format!("larger than {most_mib} MiB")), "{name}: {larger}");
    }
}

#[test]
fn what_has_no_end_is_read_up_to_a_bound() {
    let words = format!("{:#}", hazard::read(Path::new("/dev/zero"), &Headings::default()).unwrap_err());
    assert!(
        words.contains("/dev/zero: larger than 64 MiB") && words.contains("expected a hazard"),
        "{words}"
    );
}
