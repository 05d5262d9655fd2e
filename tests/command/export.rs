//! export as a user calls it.

use crate::common::{fail, succeed};
use crate::evaluate::fitted;

#[test]
fn each_program_gets_its_files() {
    let (folder, fits) = fitted();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let export = |rest: &str| {
        succeed(folder.path(), &format!("export {fits} --p 2.5 --alpha 0.2 --tolerance 1e-3 {rest}"))
    };
    let told = export("--to openquake --ratio 0.2,0.4");
    assert!(told.contains("2 functions") && told.contains("fragility.xml"), "{told}");
    assert_eq!(read("fragility.xml").matches("<fragilityFunction ").count(), 2);
    let told = export("--to openquake-continuous --im pgv --ratio 0.3 --model paper --out c.xml");
    assert!(told.contains("1 functions: c.xml"), "a curve has no levels: {told}");
    assert!(read("c.xml").contains("imt=\"PGV\""));
    export("--to pelicun --ratio 0.3 --out p.csv");
    assert!(read("p.csv").contains("p2_5_alpha0_2_eta0_92_ratio0_3,0,Peak Ground Acceleration,g,0,1,"));
    assert!(read("p.json").contains("RangeOfData"));
    succeed(
        folder.path(),
        &format!("export {fits} --p 2.5 --alpha 0.2 --to pelicun --ratio 0.3 --out usual.csv"),
    );
}

#[test]
fn the_levels_are_the_users() {
    let (folder, fits) = fitted();
    let export = |rest: &str| {
        let told = succeed(
            folder.path(),
            &format!("export {fits} --p 2.5 --alpha 0.2 --ratio 0.3 --out f.xml {rest}"),
        );
        let xml = std::fs::read_to_string(folder.path().join("f.xml")).unwrap_or_default();
        (told, xml)
    };
    let (_, xml) = export("--to openquake --levels 0.1,0.4,0.8");
    assert!(xml.contains("\">0.2027100355086725 0.4 0.8</imls>"), "uplift comes first: {xml}");
    let (told, xml) = export("--to openquake --upto 3");
    assert!(xml.contains(" 3</imls>") && told.contains("up to 3.0000 g"), "{told}");
}

#[test]
fn what_cannot_be_exported_is_explained() {
    let (folder, fits) = fitted();
    let export = |rest: &str, expected: &[&str]| {
        fail(folder.path(), &format!("export {fits} --p 2.5 --alpha 0.2 {rest}"), 2, expected);
    };
    export("--to openquak --ratio 0.3", &["did you mean 'openquake'"]);
    export("--to openquake --ratio 0", &["ratio is 0"]);
    export("--to openquake --ratio 0.3 --tolerance 0", &["tolerance is 0"]);
    export("--to pelicun --ratio 0.3 --tolerance 1e-6", &["tolerance is 0.000001", "1e-5", "six digits"]);
    export("--to openquake --ratio 0.3 --levels 0.1,0.2", &["above uplift, 0.2027"]);
    export("--to openquake --ratio 0.3 --model univariate --measure im6", &["use the bivariate model"]);
    export("--to openquake-continuous --ratio 0.3", &["not lognormal", "--model paper"]);
    export("--to openquake --im pgv", &["--ratio", "of PGA are averaged"]);
    export("--to openquake --ratio 0.3 --limit-state 0.3", &["of the universal surface"]);
    assert!(!folder.path().join("fragility.xml").exists());
}

#[test]
fn the_surface_is_exported_where_there_are_no_fits() {
    let folder = tempfile::tempdir().unwrap();
    let block = "export --width 0.5 --height 2.0 --ratio 0.25,0.4 --tolerance 1e-3";
    let told = succeed(folder.path(), &format!("{block} --to openquake"));
    assert!(told.contains("2 functions"), "{told}");
    let xml = std::fs::read_to_string(folder.path().join("fragility.xml")).unwrap();
    assert!(xml.contains("universal fragility surface") && !xml.contains("NaN"), "{xml}");
    fail(folder.path(), &format!("{block} --to openquake-continuous"), 2, &["not lognormal"]);
    succeed(folder.path(), &format!("{block} --to openquake --model universal --suite pulse --out p.xml"));
    fail(folder.path(), &format!("{block} --to openquake --model paper"), 2, &["no pex.parquet"]);
}

#[test]
fn the_two_files_of_pelicun_have_two_names() {
    let folder = tempfile::tempdir().unwrap();
    let block = "export --width 0.5 --height 2.0 --ratio 0.3 --tolerance 1e-3 --to pelicun";
    fail(folder.path(), &format!("{block} --out fr.json"), 2, &["out is fr.json", "ends in .csv"]);
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
    // It needs the whole curve: what is left at the strongest PGA that was ever recorded stands there.
    for (rest, end) in [("", 4.5), ("--upto 3", 3.0)] {
        let told = succeed(
            folder.path(),
            &format!("{block} --ratio 0.2 --out fr.csv --overwrite {rest}").replace("--ratio 0.3 ", ""),
        );
        assert!(!told.contains("warning"), "{told}");
        let csv = std::fs::read_to_string(folder.path().join("fr.csv")).unwrap();
        let (levels, probabilities) = csv.trim_end().rsplit_once('|').unwrap();
        assert!(probabilities.contains(",1\","), "{probabilities}");
        let mut levels =
            levels.rsplit('"').next().unwrap().split(',').map(|level| level.parse::<f64>().unwrap());
        let last = levels.next_back().unwrap();
        assert!((last / end - 1.0).abs() < 1e-4, "{last}, not {end}");
    }
    std::fs::remove_file(folder.path().join("fr.csv")).unwrap();
    for (im, end) in [("pga", 4.5), ("pgv", 100.0 * 0.3 * 4.5 * 9.81 / 2.6717)] {
        let out = format!("--im {im} --out {im}.xml");
        let told = succeed(folder.path(), &format!("{} {out}", block.replace("pelicun", "openquake")));
        assert!(!told.contains("warning"), "{told}");
        let xml = std::fs::read_to_string(folder.path().join(format!("{im}.xml"))).unwrap();
        let levels = xml.split("</imls>").next().unwrap();
        let last: f64 = levels.rsplit([' ', '>']).next().unwrap().parse().unwrap();
        assert!((last / end - 1.0).abs() < 1e-3, "{last} for {end}");
    }
}

#[test]
fn a_ratio_in_other_units_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let block = "export --width 0.5 --height 2.0 --to openquake --tolerance 1e-2";
    fail(folder.path(), &format!("{block} --ratio 23"), 2, &["ratio 23", "usually it is 0.1 to 0.6", "m/s2"]);
    let told = succeed(folder.path(), &format!("{block} --ratio 2"));
    assert!(told.contains("ratio is 2,") && told.contains("is the PGA in g"), "{told}");
    let told = succeed(folder.path(), &format!("{block} --ratio 0.6 --out usual.xml"));
    assert!(!told.contains("ratio is"), "{told}");
}
