//! What stood and what fell, from a list to probabilities; and blocks of FEMA P-58.

use crate::common::{evaluated, fail, folder, near, number, numbers, succeed, texts, write};

const TOWN: &str = "\
name;width (cm);height (cm);PGA (g);PGV (m/s);magnitude;earthquake;remarks;fell
a;20;80;0,4;0,5;6,5;Main;old;yes
b;20;60;0,4;0,5;6,5;Main;;stood
c;30;90;0,5;0,3;6,5;Main;;no
d;15;90;0,3;0,4;6,5;Main;;fell
";

#[test]
fn a_list_of_what_fell_calibrates_other_objects() {
    let folder = folder(&[("town.csv", TOWN), ("others.csv", "name,width,height\nx,0.2,0.7\ny,0.25,0.8\n")]);
    let path = folder.path();
    let (_, warnings) = succeed(path, "fit-pro --in town.csv --out csv/pro.parquet");
    assert!(warnings.contains("'remarks'") && !warnings.contains("magnitude"), "{warnings}");
    // The same as Parquet.
    let columns = vec![
        ("width_m", numbers(&[0.2, 0.2, 0.3, 0.15])),
        ("height_m", numbers(&[0.8, 0.6, 0.9, 0.9])),
        ("pga_g", numbers(&[0.4, 0.4, 0.5, 0.3])),
        ("pgv_m_s", numbers(&[0.5, 0.5, 0.3, 0.4])),
        ("mw", numbers(&[6.5; 4])),
        ("fell", texts(&["yes", "stood", "no", "fell"])),
    ];
    write(&path.join("town.parquet"), columns);
    succeed(path, "fit-pro --in town.parquet --out parquet/pro.parquet");
    let motion = "--structures others.csv --pga 0.4 --pgv 0.5 --magnitude 6.5";
    let of = |fits: &str| -> Vec<f64> {
        evaluated(path, &format!("{motion} {fits}")).iter().map(|row| number(row, "p_ro")).collect()
    };
    let [csv, parquet, shipped] = ["--fits csv", "--fits parquet", ""].map(of);
    assert_eq!(csv, parquet);
    assert!(csv.iter().zip(&shipped).all(|(one, other)| !near(*one, *other, 0.01)), "{csv:?} {shipped:?}");
}

#[test]
fn impossible_lists_of_outcomes_are_refused() {
    let changed = |from: &str, to: &str| TOWN.replacen(from, to, 1);
    let (heading, rest) = TOWN.split_once('\n').unwrap();
    let folder = folder(&[]);
    for (list, named) in [
        (heading.to_string(), "no rows"),
        (changed(";fell\n", ";notes\n"), "notes"),
        (changed("stood", "perhaps"), "perhaps"),
        (changed("a;20;80", "a;#N/A;80"), "#N/A"),
        (changed(";fell\n", ";Outcome\n"), "fell or stood"),
        (TOWN.replace(";fell\n", ";fell;stood\n").replace(";yes\n", ";yes;yes\n"), "columns fell, stood"),
        (changed("6,5;Main;;no", "7,5;Main;;no"), "line 4: magnitude 7.5; expected 6.5"),
        (TOWN.replacen(";fell\n", ";fell;count\n", 1).replace(";yes\n", ";yes;3\n"), "several"),
        (TOWN.replace(";0,5;6", ";50;6").replace(";0,3;6", ";30;6"), "cm/s"),
        (format!("{heading}\n{}", rest.replacen("0,4;0,5", "0,1;0,1", 1)), "line 2"),
    ] {
        std::fs::write(folder.path().join("town.csv"), list).unwrap();
        fail(folder.path(), "fit-pro --in town.csv", 1, &["town.csv", named]);
        assert!(!folder.path().join("pro.parquet").exists());
    }
}

#[test]
fn blocks_of_fema_p58_overturn_at_these_velocities() {
    // Unanchored components that fall over, E.20.22.102a to 125a; ours_m_s is by an independent run.
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/core/tests/reference/fits/p58.csv");
    let components = csv::Reader::from_path(path).unwrap().into_deserialize();
    let components: Vec<(String, f64, f64, f64, f64)> = components.map(Result::unwrap).collect();
    assert_eq!(components.len(), 9);
    let folder = folder(&[]);
    for (_, depth_in, height_in, _, ours_m_s) in components {
        let [below, above] = [0.97, 1.03].map(|factor| {
            let (width, height, pgv) = (0.0254 * depth_in, 0.0254 * height_in, factor * ours_m_s);
            let asked = format!("--width {width} --height {height} --pgv {pgv}");
            let row = &evaluated(folder.path(), &asked)[0];
            number(row, "p_overturning")
        });
        assert!(below < 0.5 && above > 0.5, "{depth_in} x {height_in}: {below} {above}");
    }
}
