//! floor-motions: motions in, motions out.

use rockfrag::table::keys::key_of;

use super::common::{SMALL, fail, folder_with, made, objects, succeed, write_motions};

/// What a floor changes.
const MEASURES: &str = "suite acceleration_m_s2 pga_m_s2 pgv_m_s pgd_m tm_s arias_m_s cav_m_s d5_75_s \
     d5_95_s sa_0p50_m_s2 floor_level floor_period_s";

#[test]
fn a_floor_keeps_what_is_not_measured() {
    let folder = folder_with(SMALL);
    let here = folder.path();
    succeed(here, "sample-scenarios --mw 6.5 --re 5 --samples 40 --out scenarios.parquet");
    succeed(here, "synthesize-motions --in scenarios.parquet --sa 0.5 --out motions.parquet");
    succeed(here, "floor-motions --in motions.parquet --period 0.8 --level 1");
    let [ground, roof] = ["motions.parquet", "floor.parquet"].map(|table| objects(here, table));
    let is_kept = |name: &str| MEASURES.split(' ').all(|changed| changed != name);
    for (ground, roof) in ground.iter().zip(&roof) {
        assert_ne!(ground["pga_m_s2"], roof["pga_m_s2"]);
        for (name, value) in ground.as_object().unwrap().iter().filter(|(name, _)| is_kept(name)) {
            assert_eq!(roof[name], *value, "{name}");
        }
    }
    for part in 0..3 {
        succeed(here, &format!("floor-motions --period 0.8 --level 1 --partition {part}/3 --out parts"));
    }
    assert!(roof == objects(here, "parts"));
}

#[test]
fn a_run_with_a_floor_simulates_on_it() {
    let pipeline = format!("{SMALL}floor-motions: {{ period: 0.8, level: 1 }}\n");
    let folder = folder_with(&pipeline);
    fail(folder.path(), "run", 2, &["simulate", "in: out/floor.parquet"]);
    let wired = pipeline.replace("simulate:\n", "simulate:\n  in: out/floor.parquet\n");
    std::fs::write(folder.path().join("pipeline.yaml"), wired).unwrap();
    succeed(folder.path(), "run");
    let at = |name: &str| folder.path().join(format!("out/{name}.parquet"));
    assert_eq!(made(&at("responses")).input("in"), key_of(&at("floor")).ok());
    let frame = "--p 1 --alpha 0.15 --eta 0.92 --period 0.8 --level 1";
    let call = format!("evaluate --fits out --suite csgm {frame} --pga 0.5 --pgv 0.5");
    fail(folder.path(), &call, 2, &["out", "floor"]);
}

#[test]
fn what_is_no_motion_of_the_ground_is_refused() {
    let folder = folder_with(SMALL);
    let here = folder.path();
    write_motions(&here.join("motions.parquet"), 0.01, &[&[0.0, 1.0, 0.0]]);
    succeed(here, "floor-motions --period 0.8 --level 0.5");
    let again = "floor-motions --in floor.parquet --out again.parquet --period 0.8 --level 0.5";
    fail(here, again, 1, &["floor.parquet"]);
    fail(here, "floor-motions --period 0.8 --level 3", 2, &["--level", "0 to 1"]);
    fail(here, "floor-motions --period 0.8 --level 1 --damping 5", 2, &["--damping", "percent"]);
}
