//! Recorded motions through the command: what is imported, what is refused, what runs again.

use std::path::Path;

use crate::common::{fail, rockfrag, succeed};
use rockfrag::table::motions::{Motion, MotionBatches};

/// A CSV of times and accelerations in g: a sine of `cycles` cycles.
fn write_csv(folder: &Path, name: &str, cycles: f64) {
    let row = |k: usize| {
        let t = k as f64 * 0.01;
        format!("{t:.2},{:.6}\n", 0.5 * (2.0 * std::f64::consts::PI * cycles * t / 2.0).sin())
    };
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, (0..=200).map(row).collect::<String>()).unwrap();
}

fn imported(path: &Path) -> Vec<Motion> {
    MotionBatches::open(path, 64).unwrap().flat_map(Result::unwrap).collect()
}

fn ids(path: &Path) -> Vec<String> {
    imported(path).iter().map(|motion| motion.motion_id.to_string()).collect()
}

#[test]
fn folders_are_walked_and_simulate_reads_what_comes() {
    let folder = tempfile::tempdir().unwrap();
    write_csv(folder.path(), "records/b.csv", 2.0);
    write_csv(folder.path(), "records/a/x.csv", 1.0);
    write_csv(folder.path(), "records/a/.hidden.csv", 1.0);
    write_csv(folder.path(), "x.csv", 3.0);
    write_csv(folder.path(), "c.NS", 3.0);
    write_csv(folder.path(), "c.EW", 3.0);
    let told = succeed(folder.path(), "import-motions records x.csv x.csv c.NS c.EW --unit g");
    assert!(told.contains("5 motions of 5 files"), "{told}");
    // Of two files of one name the ending or the path tells which is which.
    let expected = ["records/a/x.csv", "b", "x.csv", "c.NS", "c.EW"];
    assert_eq!(ids(&folder.path().join("motions.parquet")), expected);
    let told =
        succeed(folder.path(), "simulate --in motions.parquet --trace b --p 2.5 --alpha 0.2 --eta 0.92");
    assert!(told.contains("5 responses"), "{told}");
    // What it wrote is no record, even where it lies among them.
    let told = succeed(folder.path(), "import-motions records --out records/out.parquet --unit g");
    assert!(told.contains("2 motions of 2 files"), "{told}");
    let told = succeed(folder.path(), "import-motions records --out records/out.parquet --unit g");
    assert!(told.contains("up to date"), "{told}");
    // What was imported can be imported again.
    succeed(folder.path(), "import-motions motions.parquet --out again.parquet");
    let (first, second) = ("motions.parquet", "again.parquet");
    let samples = |name: &str| imported(&folder.path().join(name)).remove(1).columns.acceleration_m_s2;
    assert_eq!(samples(first), samples(second));
    assert_eq!(ids(&folder.path().join(second))[1], "motions:b");
}

#[test]
fn a_bad_file_is_named_and_the_rest_imported() {
    let folder = tempfile::tempdir().unwrap();
    for k in 0..150 {
        write_csv(folder.path(), &format!("records/{k:03}.csv"), 1.0);
    }
    std::fs::write(folder.path().join("records/077.csv"), "0.00,0.1\n0.01,oops\n").unwrap();
    std::fs::write(folder.path().join("records/099.csv"), b"PAR1 and no more").unwrap();
    let call = "import-motions records none.csv --unit g";
    let expected = [
        "3 of 151 files refused",
        "records/077.csv: line 2: 'oops' is not a number",
        "records/099.csv: not a readable Parquet file",
        "none.csv: No such file",
        "148 motions of the others are imported",
        "--keep-going",
    ];
    fail(folder.path(), call, 1, &expected[1..]);
    assert_eq!(ids(&folder.path().join("motions.parquet")).len(), 148);
    // It fails again as long as the files are bad, unless that is no failure.
    fail(folder.path(), call, 1, &expected);
    let told = succeed(folder.path(), &format!("{call} --keep-going"));
    assert!(told.contains("warning: 3 of 151 files refused") && told.contains("oops"), "{told}");
    assert!(succeed(folder.path(), &format!("{call} --keep-going")).contains("up to date"));
    fail(folder.path(), "import-motions none.csv", 1, &["no motion is imported", "none.csv"]);
    let huge = std::fs::File::create(folder.path().join("huge.csv")).unwrap();
    huge.set_len(600 << 20).unwrap();
    fail(folder.path(), "import-motions huge.csv", 1, &["huge.csv: larger than 512 MiB"]);
    fail(folder.path(), "import-motions", 2, &["no files"]);
    fail(folder.path(), "import-motions records --format at3", 2, &["did you mean 'at2'"]);
    fail(folder.path(), "import-motions records --unit furlong", 2, &["expected g, mg, m/s2"]);
}

#[test]
fn a_record_in_another_unit_than_its_heading_and_one_that_comes_twice_are_named() {
    let folder = tempfile::tempdir().unwrap();
    write_csv(folder.path(), "records/a.csv", 20.0);
    let text = std::fs::read_to_string(folder.path().join("records/a.csv")).unwrap();
    std::fs::write(folder.path().join("records/b.csv"), &text).unwrap();
    let in_m_s2 = text.lines().map(|row| {
        let (time, acceleration) = row.split_once(',').unwrap();
        format!("{time},{}\n", 9.81 * acceleration.parse::<f64>().unwrap())
    });
    std::fs::write(folder.path().join("records/c.csv"), in_m_s2.collect::<String>()).unwrap();
    let told = succeed(folder.path(), "import-motions records --unit g");
    for said in [
        "3 records: columns (3)",
        " g (c), PGV",
        "warning: c: PGA 4.",
        "is it in m/s2",
        "warning: the same file under two names counts twice; leave one out: records/b.csv is records/a.csv",
    ] {
        assert!(told.contains(said), "{said}: {told}");
    }
}

#[test]
fn a_pipeline_may_start_from_records() {
    let folder = tempfile::tempdir().unwrap();
    for k in 1..9 {
        write_csv(folder.path(), &format!("here/records/{k}.csv"), f64::from(k));
    }
    let pipeline = "import-motions: { files: [records], unit: g, column: 2 }\nsimulate: { p: 2.5, alpha: 0.2, eta: 0.92 }\n";
    std::fs::write(folder.path().join("here/pipeline.yaml"), pipeline).unwrap();
    let told = succeed(folder.path(), "run here/pipeline.yaml");
    assert!(told.contains("8 motions of 8 files") && told.contains("8 responses"), "{told}");
    let again = succeed(folder.path(), "run here/pipeline.yaml");
    assert_eq!(again.matches("up to date").count(), 2, "{again}");
    write_csv(folder.path(), "here/records/4.csv", 4.5);
    let plan = rockfrag(folder.path()).args(["run", "here/pipeline.yaml", "--dry-run"]).output().unwrap();
    let plan = String::from_utf8(plan.stdout).unwrap();
    assert!(plan.contains("would run: the files changed"), "{plan}");
    let both = pipeline.to_string() + "synthesize-motions: {}\n";
    std::fs::write(folder.path().join("here/pipeline.yaml"), both).unwrap();
    fail(folder.path(), "run here/pipeline.yaml", 2, &["leave one of them out"]);
}

#[test]
fn motions_do_not_depend_on_threads() {
    let folder = tempfile::tempdir().unwrap();
    for k in 1..=70 {
        write_csv(folder.path(), &format!("records/{k:03}.csv"), f64::from(k));
    }
    succeed(folder.path(), "import-motions records --unit g --out one.parquet --threads 1");
    succeed(folder.path(), "import-motions records --unit g --out two.parquet --threads 2");
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("one.parquet") == bytes("two.parquet"));
}

/// An AT2 file of one component (azimuth or `UP`) of a pulse of 2 s in direction N30E, with PGA in the header.
fn write_at2(folder: &Path, name: &str, component: &str) {
    let along = component.parse().map_or(0.1, |azimuth: f64| (30.0 - azimuth).to_radians().cos());
    let velocity = |t: f64| {
        let x = std::f64::consts::PI * (t - 8.0);
        if x.abs() > 2.0 * std::f64::consts::PI { 0.0 } else { 0.5 * (1.0 + (x / 2.0).cos()) * x.cos() }
    };
    let acceleration = |k: usize| {
        let t = k as f64 * 0.01;
        along * (velocity(t + 5e-3) - velocity(t - 5e-3)) / 0.01 / 9.81
    };
    let samples: Vec<f64> = (0..3000).map(acceleration).collect();
    let peak = samples.iter().fold(0.0_f64, |peak, a| a.abs().max(peak));
    let rows: String = samples
        .chunks(5)
        .map(|row| row.iter().map(|a| format!("{a:15.7E}")).collect::<String>() + "\n")
        .collect();
    let text = format!(
        "PEER STRONG MOTION DATABASE RECORD\nTestville 1/1/2001, Somewhere, {component}\n\
         ACCELERATION TIME HISTORY IN UNITS OF G,  PGA= {peak:.5} G\nNPTS=  3000, DT= .01000 SEC\n{rows}"
    );
    std::fs::write(folder.join(name), text).unwrap();
}

fn records() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, component) in [("n.at2", "000"), ("e.at2", "090"), ("v.at2", "UP")] {
        write_at2(folder.path(), name, component);
    }
    folder
}

#[test]
fn a_pair_is_rotated_and_what_has_no_partner_is_named() {
    let folder = records();
    let told = succeed(folder.path(), "import-motions n.at2 e.at2 v.at2 --rotate 30");
    assert!(told.contains("1 motions are vertical or without a partner") && told.contains(": v"), "{told}");
    assert!(told.contains("1 motions of 3 files"), "{told}");
    let rotated = imported(&folder.path().join("motions.parquet")).remove(0);
    assert_eq!(rotated.motion_id.to_string(), "n+e");
    assert!((rotated.tp_s.unwrap() / 2.0 - 1.0).abs() < 0.01, "{:?}", rotated.tp_s);
    succeed(folder.path(), "import-motions n.at2 e.at2 --rotate strongest-pulse --out strongest.parquet");
    let strongest = imported(&folder.path().join("strongest.parquet")).remove(0);
    assert!((strongest.pgv_m_s.unwrap() / rotated.pgv_m_s.unwrap() - 1.0).abs() < 1e-5);
    let text = rockfrag(folder.path()).args(["inspect", "strongest.parquet"]).output().unwrap();
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("rotd100_pgv_m_s") && text.contains("azimuth_deg"), "{text}");
    fail(folder.path(), "import-motions n.at2 v.at2 --rotate 30", 1, &["no motion is imported"]);
    fail(folder.path(), "import-motions n.at2 --rotate north", 2, &["expected an azimuth"]);
}

#[test]
fn factors_make_several_motions_and_peaks_one() {
    let folder = records();
    succeed(folder.path(), "import-motions n.at2 e.at2 --scale 0.5:2:0.5 --sa 0.2,1 --residual");
    let path = folder.path().join("motions.parquet");
    assert_eq!(ids(&path)[..3], ["n x0.5", "n x0.5 residual", "n x1"]);
    assert_eq!(imported(&path).len(), 16);
    let pga: Vec<f64> = imported(&path).iter().filter_map(|motion| motion.pga_m_s2).collect();
    assert!((pga[2] / pga[0] - 2.0).abs() < 1e-6);
    let residual = &imported(&path)[3];
    assert_eq!((residual.suite.as_deref(), residual.tp_s), (Some("residual"), None));
    assert!(residual.pgv_m_s.unwrap() < 0.02, "the pulse is the whole record: {residual:?}");
    succeed(folder.path(), "simulate --p 2.5 --alpha 0.2 --eta 0.92");
    succeed(folder.path(), "import-motions n.at2 e.at2 --scale-pga 0.4 --force");
    assert!(imported(&path).iter().all(|motion| (motion.pga_m_s2.unwrap() / 9.81 - 0.4).abs() < 1e-6));
    succeed(
        folder.path(),
        "import-motions n.at2 --scale-pgv 0.7 --baseline linear --high-pass 0.02 --resample 0.02",
    );
    let motion = imported(&path).remove(0);
    assert!((motion.pgv_m_s.unwrap() - 0.7).abs() < 1e-5 && motion.dt_s == 0.02, "{motion:?}");
    for (flags, expected) in [
        ("--scale 0,1", "factors above 0"),
        ("--scale-pga 0", "above 0 g"),
        ("--high-pass 0", "above 0 Hz"),
        ("--resample 7", "from 0.0001 to 0.1 s"),
        ("--residual --pulses skip", "residual motions need their pulses"),
        ("--sa 0,1", "periods from 0.01 to 20 s"),
        ("--baseline cubic", "none, mean, linear"),
    ] {
        fail(folder.path(), &format!("import-motions n.at2 {flags}"), 2, &[expected]);
    }
    let both = "import-motions: { files: [n.at2], scale: 2, scale-pga: 0.3 }\n";
    std::fs::write(folder.path().join("pipeline.yaml"), both).unwrap();
    fail(folder.path(), "run", 2, &["exclude each other"]);
}

#[test]
fn spectral_accelerations_become_columns_of_both_kinds_of_motions() {
    let folder = records();
    succeed(folder.path(), "import-motions n.at2 --sa 0.075,0.2,1 --out r.parquet --pulses skip --housner");
    succeed(folder.path(), "sample-scenarios --samples 1 --mw 6 --re 10");
    succeed(folder.path(), "synthesize-motions --in scenarios.parquet --sa 0.2,1");
    for (file, columns) in [
        ("r.parquet", &["sa_0p075_m_s2", "sa_0p20_m_s2", "sa_1p00_m_s2"][..]),
        ("motions.parquet", &["sa_0p20_m_s2"]),
    ] {
        let text = rockfrag(folder.path()).args(["inspect", file]).output().unwrap();
        let text = String::from_utf8(text.stdout).unwrap();
        columns.iter().for_each(|column| assert!(text.contains(column), "{text}"));
    }
}
