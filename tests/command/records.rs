//! Records as people bring them: in archives, with the tables that describe them.

use std::path::Path;

use serde_json::Value;

use super::packed::{gzip, zip};
use crate::common::{fail, folder, near, number, objects, succeed};

fn motions(folder: &Path) -> Vec<Value> {
    objects(folder, "motions.parquet")
}

/// AT2 of 4 s of a decaying sine whose peak is near `pga_g`.
fn at2(component: &str, pga_g: f64) -> String {
    let sample = |k: i32| {
        let t = 0.01 * f64::from(k) - 2.0;
        pga_g * (-t * t / 0.5).exp() * (9.0 * t).cos()
    };
    let rows: String = (0..400).map(|k| format!("{:15.7E}\n", sample(k))).collect();
    let head = "PEER NGA STRONG MOTION DATABASE RECORD\nImperial Valley, 10/15/1979, El Centro #4";
    format!("{head}, {component}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 400, DT= .0100 SEC\n{rows}")
}

#[test]
fn records_in_an_archive_are_imported_each() {
    let folder = folder(&[]);
    let (first, second, up) = (at2("140", 0.3), at2("230", 0.2), at2("UP", 0.1));
    let write = |name: &str, bytes: Vec<u8>| std::fs::write(folder.path().join(name), bytes).unwrap();
    let one = ("a/RSN1_140.AT2", first.as_bytes());
    write("r.zip", zip(&[one, ("a/RSN1_230.AT2", second.as_bytes()), ("a/RSN1-UP.AT2", up.as_bytes())]));
    let (text, _) = succeed(folder.path(), "import-motions r.zip");
    assert!(text.contains("1 vertical component"), "{text}");
    let found = motions(folder.path());
    for (motion, (id, peak_g)) in found.iter().zip([("r/RSN1_140", 0.3), ("r/RSN1_230", 0.2)]) {
        assert!(motion["motion_id"] == id && near(number(motion, "pga_m_s2"), peak_g * 9.81, 0.01));
    }
    assert_eq!(found.len(), 2);
    // Pairs are found within an archive.
    succeed(folder.path(), "import-motions r.zip --rotate 140 --force");
    assert_eq!(motions(folder.path()).len(), 1);
    // What is no record is named with its place, and left out if wanted.
    write("r.zip", zip(&[one, ("a/readme.txt", b"Dear colleague,\n")]));
    fail(folder.path(), "import-motions r.zip --force", 1, &["imported", "r.zip", "readme.txt"]);
    succeed(folder.path(), "import-motions r.zip --force --keep-going");
    assert_eq!(motions(folder.path()).len(), 1);
    // A single packed file keeps its name.
    write("one.AT2.gz", gzip(first.as_bytes()));
    succeed(folder.path(), "import-motions one.AT2.gz --force");
    assert!(near(number(&motions(folder.path())[0], "pga_m_s2"), 0.3 * 9.81, 0.01));
}

const SEARCH: &str = "PEER Ground Motion Database,,
Search criteria,,
Magnitude Min,5
 -- Summary of Metadata of Selected Records --
Result ID,Spectral Ordinate, Record Sequence Number, MSE, Scale Factor, Earthquake Name, Year, Station Name, Magnitude, Rjb (km), Rrup (km), Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename, Vertical Acc. Filename
1,SRSS,179,-,1,\"Imperial Valley-06\",1979,\"El Centro Array #4\",6.53,4.9,7.05,RSN179_IMPVALL.H_H-E04140.AT2,RSN179_IMPVALL.H_H-E04230.AT2,---
2,SRSS,180,-,1,\"Imperial Valley-06\",1979,\"El Centro Array #5\",6.53,1.8,3.95,RSN180_IMPVALL.H_H-E05140.AT2,RSN180_IMPVALL.H_H-E05230.AT2,---

 -- Scaled Spectra used in Search & Scaling --
Period (sec),RSN-179 Horizontal-1 pSa (g)
0.01,0.5
";

const FLATFILE: &str = "Record Sequence Number,EQID,Earthquake Name,Earthquake Magnitude,EpiD (km),ClstD (km),File Name (Horizontal 1),File Name (Horizontal 2)
178,50,Imperial Valley-06,-999,28.65,-999,IMPVALL\\H-E03140.AT2,-999
179,50,Imperial Valley-06,6.53,27.13,7.05,IMPVALL\\H-E04140.AT2,IMPVALL\\H-E04230.AT2
";

#[test]
fn tables_of_peer_describe_records() {
    let (first, second) = (at2("140", 0.3), at2("230", 0.2));
    for (about, names) in [
        (SEARCH, ["RSN179_IMPVALL.H_H-E04140.AT2", "RSN179_IMPVALL.H_H-E04230.AT2"]),
        (FLATFILE, ["H-E04140.AT2", "H-E04230.AT2"]),
        // By the number alone.
        (FLATFILE, ["RSN179_IMPVALL.H_H-E04140.AT2", "rsn179_other.at2"]),
        (SEARCH, ["rsn179_impvall.h_h-e04140.at2", "RSN179.AT2"]),
    ] {
        // The table lies among the records, as PEER packs it.
        let folder = folder(&[(names[0], &*first), (names[1], &second), ("_SearchResults.csv", about)]);
        succeed(folder.path(), "import-motions . --about _SearchResults.csv --out out/motions.parquet");
        for motion in motions(&folder.path().join("out")) {
            assert!(motion["mw"] == 6.53 && motion["re_km"] == 7.05, "{motion} of {names:?}");
            assert_eq!(motion["earthquake"], "Imperial Valley-06", "{motion}");
        }
    }
    let folder = folder(&[("other.AT2", &first), ("about.csv", SEARCH)]);
    fail(folder.path(), "import-motions other.AT2 --about about.csv", 2, &["about.csv"]);
}

/// Names of motions and structures in the responses.
fn responses(folder: &Path) -> Vec<(String, String)> {
    let name = |row: &Value, column: &str| row[column].as_str().unwrap().to_string();
    let rows = objects(folder, "responses.parquet");
    rows.iter().map(|row| (name(row, "motion_id"), name(row, "structure"))).collect()
}

#[test]
fn each_component_of_a_pair_shakes_its_direction_of_an_object() {
    let (first, second) = (at2("140", 0.3), at2("230", 0.2));
    let other = at2("140", 0.25).replace("El Centro #4", "Bonds Corner");
    let folder = folder(&[("a.AT2", &*first), ("b.AT2", &second), ("c.AT2", &other)]);
    succeed(folder.path(), "import-motions a.AT2 b.AT2 c.AT2");
    let (_, told) = succeed(folder.path(), "simulate --width 0.5 --depth 0.8 --height 1.9");
    let other = "structure, other direction";
    let expected = [("a", "structure"), ("b", other), ("c", "structure")];
    assert_eq!(responses(folder.path()), expected.map(|(a, b)| (a.to_string(), b.to_string())));
    assert!(!told.contains("weaker"), "{told}");
    // Without a pair, or a depth, each motion shakes the weaker direction.
    for options in [
        "--in motions.parquet --width 0.5 --height 1.9",
        "--in c.parquet --width 0.5 --depth 0.8 --height 1.9",
    ] {
        succeed(folder.path(), "import-motions c.AT2 --out c.parquet --force");
        succeed(folder.path(), &format!("simulate {options} --force"));
        assert!(responses(folder.path()).iter().all(|(_, name)| name == "structure"), "{options}");
    }
}
