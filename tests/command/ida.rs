//! ida as a user calls it.

use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::{Float64Builder, ListBuilder};
use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use rockfrag::table::motions::MotionBatches;

use crate::common::{content, fail, rockfrag, succeed, write};

const FILES: [&str; 5] = [
    "ida.parquet",
    "ida.stripes.parquet",
    "ida.windows.parquet",
    "ida.shares.parquet",
    "ida.fragility.parquet",
];

/// A folder with eight motions of two suites.
fn with_motions() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), "sample-scenarios --mw 6.5,7 --re 10 --samples 2");
    succeed(folder.path(), "synthesize-motions --suite pulse,csgm --dt 0.01");
    folder
}

fn rows(path: &Path) -> RecordBatch {
    let file = std::fs::File::open(path).unwrap();
    ParquetRecordBatchReaderBuilder::try_new(file).unwrap().build().unwrap().next().unwrap().unwrap()
}

fn numbers(rows: &RecordBatch, column: &str) -> Vec<f64> {
    rows[column].as_primitive::<Float64Type>().values().to_vec()
}

/// The demands, and -1 where the structure overturns.
fn demands(rows: &RecordBatch) -> Vec<f64> {
    rows["edp"].as_primitive::<Float64Type>().iter().map(|edp| edp.unwrap_or(-1.0)).collect()
}

fn texts(rows: &RecordBatch, column: &str) -> Vec<String> {
    rows[column].as_string::<i32>().iter().map(|text| text.unwrap().to_string()).collect()
}

/// Motions numbered from 1, as another program might write them.
fn write_motions(path: &Path, motions: &[(f64, Vec<f64>)]) {
    let mut list = ListBuilder::new(Float64Builder::new());
    for (_, samples) in motions {
        list.values().append_slice(samples);
        list.append(true);
    }
    let columns: Vec<(&str, ArrayRef)> = vec![
        ("motion_id", Arc::new(Int64Array::from_iter_values(1..=motions.len() as i64))),
        ("dt_s", Arc::new(Float64Array::from_iter_values(motions.iter().map(|motion| motion.0)))),
        ("acceleration_m_s2", Arc::new(list.finish())),
    ];
    write(path, columns);
}

#[test]
fn a_stripe_is_what_simulate_makes_of_the_scaled_motions() {
    let folder = with_motions();
    let motions = MotionBatches::open(folder.path().join("motions.parquet"), 64).unwrap();
    let motions: Vec<(f64, Vec<f64>)> = motions
        .flat_map(Result::unwrap)
        .map(|motion| (motion.dt_s, motion.acceleration_m_s2.to_vec()))
        .collect();
    write_motions(&folder.path().join("as_is.parquet"), &motions);
    let scan = "--from 0.4 --to 3 --steps 5 --p 2.5 --alpha 0.2 --eta 0.9";
    succeed(folder.path(), &format!("ida --in as_is.parquet {scan}"));
    let stripes = rows(&folder.path().join("ida.stripes.parquet"));
    let (scale, intensity) = (numbers(&stripes, "scale"), numbers(&stripes, "intensity"));
    assert_eq!((stripes.num_rows(), &scale), (8 * 6, &intensity));
    let mut outcomes = 0;
    for (level, &factor) in scale.iter().take(6).enumerate() {
        let scaled: Vec<(f64, Vec<f64>)> =
            motions.iter().map(|(dt, samples)| (*dt, samples.iter().map(|a| factor * a).collect())).collect();
        write_motions(&folder.path().join("scaled.parquet"), &scaled);
        let call = "simulate --in scaled.parquet --p 2.5 --alpha 0.2 --eta 0.9";
        succeed(folder.path(), &format!("{call} --out responses.parquet"));
        let responses = rows(&folder.path().join("responses.parquet"));
        let at_level = |all: Vec<f64>| all.into_iter().skip(level).step_by(6).collect::<Vec<_>>();
        assert_eq!(at_level(demands(&stripes)), demands(&responses));
        let of_level: Vec<String> = texts(&stripes, "outcome").into_iter().skip(level).step_by(6).collect();
        assert_eq!(of_level, texts(&responses, "outcome"));
        outcomes += of_level.iter().filter(|outcome| *outcome == "overturning").count();
        for (a, b) in at_level(numbers(&stripes, "im5")).iter().zip(numbers(&responses, "im5")) {
            assert!((a / b - 1.0).abs() < 1e-12);
        }
    }
    assert!((8..40).contains(&outcomes), "{outcomes}");
}

#[test]
fn the_files_agree_with_each_other_and_feed_the_fits() {
    let folder = with_motions();
    std::fs::write(folder.path().join("s.csv"), "name,p,alpha,eta\nsmall,3.5,0.2,0.9\nlarge,0.9,0.2,0.9\n")
        .unwrap();
    let call = "ida --structures s.csv --measure im5 --from 0.3 --to 12";
    let output = rockfrag(folder.path()).args(call.split(' ')).output().unwrap();
    let (table, told) =
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(table.contains("theta") && table.contains("small") && table.contains("csgm"), "{table}");
    assert!(told.contains("8 motions and 2 structure(s) at 61 levels in ratios of 1.0634"), "{told}");
    let [capacities, stripes, windows, shares, fragility] = FILES.map(|file| rows(&folder.path().join(file)));
    assert_eq!((capacities.num_rows(), stripes.num_rows(), fragility.num_rows()), (16, 16 * 61, 4));
    assert_eq!(shares.num_rows(), 4 * 61);
    // The intensity is the measure that the stripe itself has.
    for (intensity, im5) in numbers(&stripes, "intensity").iter().zip(numbers(&stripes, "im5")) {
        assert!((intensity / im5 - 1.0).abs() < 1e-12);
    }
    // Each change of outcome among the stripes of a case is an overturning intensity or the edge of a window.
    let overturns: Vec<bool> = texts(&stripes, "outcome").iter().map(|word| word == "overturning").collect();
    let first = capacities["overturning_intensity"].as_primitive::<Float64Type>();
    let counts = capacities["safe_windows"].as_primitive::<arrow_array::types::Int64Type>();
    for (case, stripe) in overturns.chunks(61).enumerate() {
        let seen = stripe.iter().position(|&overturns| overturns).map(|k| numbers(&stripes, "intensity")[k]);
        assert!(seen.is_none_or(|seen| first.value(case) <= seen), "{case}");
        let returns = stripe.windows(2).filter(|pair| pair[0] && !pair[1]).count();
        assert!(returns as i64 <= counts.value(case), "{case}");
    }
    assert_eq!(counts.values().iter().sum::<i64>(), windows.num_rows() as i64);
    let seen: usize = overturns.iter().filter(|&&overturns| overturns).count();
    let counted: i64 =
        shares["overturned"].as_primitive::<arrow_array::types::Int64Type>().values().iter().sum();
    assert_eq!(seen as i64, counted);
    let told = succeed(folder.path(), "fit-pro --in ida.stripes.parquet");
    assert!(told.contains("curves ok"), "{told}");
    succeed(folder.path(), "fit-pex --in ida.stripes.parquet");
    assert!(succeed(folder.path(), call).contains("up to date"));
}

#[test]
fn neither_threads_nor_other_motions_matter() {
    let folder = with_motions();
    let mut contents = Vec::new();
    for threads in [1, 2] {
        succeed(
            folder.path(),
            &format!("ida --measure pga --to 3 --force --threads {threads} --p 2.5 --alpha 0.2 --eta 0.92"),
        );
        contents.push(FILES.map(|file| content(&folder.path().join(file))));
    }
    assert_eq!(contents[0], contents[1]);
    let motions = MotionBatches::open(folder.path().join("motions.parquet"), 64).unwrap();
    let motions: Vec<(f64, Vec<f64>)> = motions
        .flat_map(Result::unwrap)
        .map(|motion| (motion.dt_s, motion.acceleration_m_s2.to_vec()))
        .collect();
    write_motions(&folder.path().join("all.parquet"), &motions);
    write_motions(&folder.path().join("last.parquet"), &motions[7..]);
    let of = |name: &str| {
        succeed(
            folder.path(),
            &format!(
                "ida --in {name}.parquet --out {name}.ida.parquet --to 4 --p 2.5 --alpha 0.2 --eta 0.92"
            ),
        );
        rows(&folder.path().join(format!("{name}.ida.parquet")))
    };
    let (all, last) = (of("all"), of("last"));
    assert_eq!(all["overturning_intensity"].slice(7, 1).as_ref(), last["overturning_intensity"].as_ref());
}

#[test]
fn a_pipeline_may_end_in_capacities() {
    let folder = with_motions();
    let pipeline = "import-motions: { files: [motions.parquet], pulses: skip }\n\
                    ida: { measure: pgv, to: 3, steps: 10, structures: [{ width: 0.5, height: 2 }] }\n";
    std::fs::write(folder.path().join("pipeline.yaml"), pipeline).unwrap();
    let told = succeed(folder.path(), "run");
    assert!(told.contains("8 motions and 1 structure(s) at 11 levels"), "{told}");
    assert!(succeed(folder.path(), "run").matches("up to date").count() == 2);
    assert_eq!(rows(&folder.path().join("out/ida.parquet")).num_rows(), 8);
    succeed(folder.path(), "ida --config pipeline.yaml --p 3 --alpha 0.2 --eta 0.9 --out flags.parquet");
    let flags = rows(&folder.path().join("flags.parquet"));
    assert_eq!((numbers(&flags, "p_rad_s")[0], texts(&flags, "measure")[0].as_str()), (3.0, "pgv"));
}

#[test]
fn what_cannot_be_scaled_or_scanned_is_told_so() {
    let folder = tempfile::tempdir().unwrap();
    let ground = |k: usize| (k as f64 * 0.3).sin();
    write_motions(
        &folder.path().join("motions.parquet"),
        &[(0.01, (0..300).map(ground).collect()), (0.01, vec![0.0; 300])],
    );
    for (flags, expected) in [
        ("--from 0", "from is 0; expected an intensity above 0"),
        ("--from 2 --to 1", "to is 1; expected an intensity above 2"),
        ("--to inf", "to"),
        ("--steps 0", "steps is 0; expected 1 to 10000"),
        ("--halvings 40", "halvings is 40"),
        ("--tolerance 0", "tolerance is 0"),
        ("--measure pgvv", "did you mean 'pgv'"),
        ("--alpha 2", "alpha is 2"),
        ("--structures none.yaml", "none.yaml"),
    ] {
        fail(folder.path(), &format!("ida {flags}"), 2, &[expected]);
    }
    let dead = ["row 1", "motion '2' has no pga above 0", "--measure scale"];
    fail(folder.path(), "ida --measure pga --p 2.5 --alpha 0.2 --eta 0.92", 1, &dead);
    fail(
        folder.path(),
        "ida --in none.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["none.parquet: no such file"],
    );
    succeed(folder.path(), "ida --steps 3 --p 2.5 --alpha 0.2 --eta 0.92");
    let capacities = rows(&folder.path().join("ida.parquet"));
    assert_eq!(texts(&capacities, "capacity")[1], "safe");
    assert_eq!(numbers(&capacities, "safe_below")[1], 10.0);
    let missing = ["made by ida; expected the output of synthesize-motions or import-motions"];
    fail(
        folder.path(),
        "ida --in ida.parquet --out other.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &missing,
    );
    fail(
        folder.path(),
        "fit-pro --in ida.parquet",
        1,
        &["no column", "of the files of ida, ida.stripes.parquet"],
    );
    // Too large a factor is named, not simulated.
    fail(
        folder.path(),
        "ida --from 1 --to 1e300 --steps 1 --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["row 0", "motion '1'", "by a lower --to"],
    );
    assert!(!folder.path().join("other.parquet").exists());
}
