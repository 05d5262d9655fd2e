//! Objects as they are: bodies, both directions, floors, lists of people, friction, targets.

use serde_json::Value;

use super::common::{HAZARD, evaluated, fail, folder, near, number, objects, succeed};

/// The answer over the hazard, in a folder without files.
#[track_caller]
fn row(arguments: &str) -> Value {
    evaluated(folder(&[]).path(), &format!("{arguments} {HAZARD}")).remove(0)
}

#[track_caller]
fn rate(arguments: &str) -> f64 {
    number(&row(arguments), "overturning_per_year")
}

#[test]
fn an_object_falls_in_either_direction_and_a_lopsided_body_falls_more_often() {
    let [width, depth] = ["--width 0.5 --height 2.2", "--width 0.6 --height 2.2"].map(rate);
    let both = rate("--width 0.5 --depth 0.6 --height 2.2");
    // Both seldom fall under one motion.
    assert!(both > 0.7 * (width + depth) && both < width + depth, "{both}, {width} + {depth}");
    assert!(near(both, rate("--width 0.6 --depth 0.5 --height 2.2"), 1e-9));
    // A side as long as the object is high is no danger.
    assert_eq!(rate("--width 0.5 --depth 3 --height 2.2"), width);
    let [middle, roof] =
        ["0.5", "1"].map(|level| rate(&format!("--width 0.5 --height 2.2 --period 0.6 --level {level}")));
    assert!(width < middle && middle < roof && roof > 2.0 * width, "{width}, {middle}, {roof}");
    let offset = |offset: f64| rate(&format!("--width 0.5 --height 2.2 --centre-offset {offset}"));
    assert!(offset(0.05) > 1.2 * width && offset(0.05) == offset(-0.05));
}

#[test]
fn what_is_uncertain_widens_the_limits_and_nothing_else_of_a_small_error() {
    let plain = row("--width 0.8 --height 2.2");
    let unsure = row("--width 0.8 --height 2.2 --centre-height-sd 0.1 --centre-offset-sd 0.04");
    assert!(plain["error_object"].is_null() && number(&unsure, "error_object") > 0.1);
    assert!(number(&unsure, "overturning_per_year_high") > number(&plain, "overturning_per_year_high"));
    let floor = row("--width 0.8 --height 2.2 --period 0.6 --level 1");
    let surveyed = row("--width 0.8 --height 2.2 --period 0.6 --level 1 --period-sd 0.02");
    assert!(plain["error_floor"].is_null());
    assert!(number(&floor, "error_floor") > 5.0 * number(&surveyed, "error_floor"));
    let tilted = row("--width 0.8 --height 2.2 --alpha-sd 2deg");
    assert!(number(&tilted, "error_object") > 0.3, "{tilted}");
    let [before_wall, soft] =
        ["--wall", "--wall 0.1"].map(|wall| row(&format!("--width 0.8 --height 2.2 {wall}")));
    assert!(number(&before_wall, "error_wall") > 0.1 && soft["error_wall"].is_null());
    let rates = [&soft, &before_wall, &plain].map(|row| number(row, "overturning_per_year"));
    assert!(rates.is_sorted() && rates[0] < rates[2] / 2.0, "{rates:?}");
}

#[test]
fn the_base_for_a_target_meets_it() {
    let tall = "--height 2.2 --centre-height 1 --depth 0.9";
    let wider = |width: f64| format!("--width {width} --centre-offset {} {tall}", 0.05 * width);
    let larger = |side: f64| format!("--width {side} --depth {side} --height 1.9");
    let by_width = row(&format!("{} --target 1%", wider(0.6)));
    // Where the depth is too small, both sides meet the target.
    let by_both = row("--width 0.5 --depth 0.4 --height 1.9 --target 0.5%");
    let high = |width: f64| format!("--width {width} --height 6");
    let by_high = row(&format!("{} --target 1%", high(1.0)));
    assert!(near(number(&by_high, "target_width_m_high"), 2.03, 0.01));
    let bases: [(_, _, _, &dyn Fn(f64) -> String); 3] = [
        (&by_width, "target_width_m", 0.01, &wider),
        (&by_both, "target_sides_m", 0.005, &larger),
        (&by_high, "target_width_m", 0.01, &high),
    ];
    for (answer, base, target, resized) in bases {
        assert!(number(answer, base) > 0.3);
        for limit in ["", "_high"] {
            let Some(side) = answer[format!("{base}{limit}")].as_f64() else { continue };
            let p = number(&row(&resized(side)), &format!("p_overturning{limit}"));
            assert!(near(p, target, 0.01), "{base}{limit} {p} at {side}");
        }
    }
    assert!(by_both["target_width_m"].is_null() && number(&by_both, "target_sides_m") > 0.4);
    // Where the width is enough, the depth stays.
    let deep = row("--width 0.5 --depth 1.2 --height 1.9 --target 0.5%");
    assert!(deep["target_width_m"].is_f64() && deep["target_sides_m"].is_null());
    // It adds nothing, and so is no reason to doubt.
    assert!(deep["warnings"].is_null(), "{deep}");
    // Equal sides stay equal, and none is smaller than it is.
    let square = row("--width 0.38 --depth 0.38 --height 1.8 --target 1%");
    assert!(square["target_width_m"].is_null() && number(&square, "target_sides_m") > 0.5);
    let safe = row("--width 0.7 --depth 0.9 --height 1.9 --target 50%");
    assert!(near(number(&safe, "target_width_m"), 0.7, 1e-9));
}

#[test]
fn a_search_for_a_base_says_what_ends_it() {
    for (object, by_estimate, by_limit, end) in [
        ("--width 0.5 --height 1.9 --magnitude 6.5 --target 0.1%", true, false, Some("model")),
        ("--width 0.06 --height 0.2 --target 1%", true, false, Some("model")),
        // The search goes inwards.
        ("--width 1.2 --height 2 --target 10%", true, true, None),
        ("--width 0.2 --height 2.2 --target 1e-7%", false, false, Some("model")),
        ("--p 2 --alpha 0.2 --eta 0.9 --target 1%", false, false, None),
    ] {
        let row = row(object);
        let is_found = ["target_width_m", "target_width_m_high"].map(|base| row[base].is_f64());
        assert_eq!(is_found, [by_estimate, by_limit], "{object}: {row}");
        assert_eq!(row.get("target_end").map(Value::as_str), Some(end), "{object}");
    }
}

#[test]
fn a_base_that_is_printed_meets_the_target() {
    let folder = folder(&[]);
    let block = |width: &str| format!("--width {width} --height 1.5");
    let call = format!("evaluate {} --target 1% --out page.html {HAZARD}", block("0.3"));
    let (text, _) = succeed(folder.path(), &call);
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    for printed in [text, page.replace('\u{a0}', " ")] {
        let width = printed.split("Base for 1.0 % in 50 years: ").nth(1).unwrap();
        let width = width.split(' ').next().unwrap();
        let p = number(&row(&block(width)), "p_overturning");
        assert!(p <= 0.01 && near(p, 0.01, 0.02), "{width}: {p}");
    }
}

#[test]
fn a_list_is_answered_and_counted_as_its_objects_are() {
    let list = "Equipment;Brand;Qty;Width (cm);Depth (cm);Height (cm);Anchored;Level;T1 (s)\n\
        Drug cabinet;Acme;3;60;45;190;no;0.5;0.6\nServer rack;;2;60;100;210;yes;1;0,6\n\
        Shelf;;1;30;90;180;-;0;\n;;5;40;40;160;;0;\nShelf;;1;90;;140;no;0;\n";
    let folder = folder(&[("list.csv", list), ("bad.csv", "name,width,height\nwrong,3,2\n")]);
    let here = folder.path();
    fail(here, &format!("evaluate --structures bad.csv {HAZARD}"), 1, &["bad.csv", "wrong"]);
    let all = evaluated(here, &format!("--structures list.csv {HAZARD}"));
    assert_eq!(all.iter().position(|row| row["structure"] == "Server rack"), Some(1), "as listed");
    let of = |name: &str| all.iter().find(|row| row["structure"] == name).unwrap_or_else(|| panic!("{name}"));
    let (cabinet, rack) = (of("Drug cabinet"), of("Server rack"));
    assert!(rack["overturning_per_year"].is_null() && rack["warnings"].is_string());
    for answered in ["Drug cabinet", "Shelf (line 4)", "line 5", "Shelf (line 6)"] {
        assert!(number(of(answered), "overturning_per_year") > 0.0, "{answered}");
    }
    let (text, warnings) = succeed(here, &format!("evaluate --structures list.csv {HAZARD}"));
    assert!(cabinet["Brand"] == "Acme" && !warnings.contains("Brand"), "{warnings}");
    // Of ten objects that rock.
    assert!(number(cabinet, "count") == 3.0 && text.contains("of 10"), "{text}");
    let same = rate("--width 0.6 --depth 0.45 --height 1.9 --period 0.6 --level 0.5");
    assert!(near(number(cabinet, "overturning_per_year"), same, 1e-9));
}

/// By tag, else by name and size, and never by line; under another hazard nothing has changed.
#[test]
fn the_same_object_is_found_in_two_lists() {
    let row = |line: &str| format!("Ref,Item,W (mm),D (mm),H (mm)\n{line}").replace('|', "\n");
    let books = "A-2,Books,900,300,2000|A-3,Books,900,400,2000|A-4,Books,900,500,2000";
    let all = row(&format!("A-1,Fridge,700,700,2000|{books}"));
    let wider = row(&books.replace(",300", ",350"));
    let no_tags =
        |list: &str| list.replace("A-1", "").replace("A-2", "").replace("A-3", "").replace("A-4", "");
    let folder = folder(&[
        ("a.csv", &*all),
        ("b.csv", &row(books)),
        ("c.csv", &wider),
        ("d.csv", &no_tags(&all)),
        ("f.csv", &no_tags(&row(books))),
    ]);
    let here = folder.path();
    let sa = concat!(env!("CARGO_MANIFEST_DIR"), "/data/hazard_sa.csv");
    for list in ["a", "b", "c", "d", "f"] {
        succeed(here, &format!("evaluate --structures {list}.csv {HAZARD} --out {list}.parquet"));
    }
    succeed(here, &format!("evaluate --structures a.csv {HAZARD},{sa} --out e.parquet"));
    let cases = [
        ("a,b", ["0 of 3 objects changed", "Removed: Fridge."]),
        ("b,c", ["1 of 3 objects changed", "0.30 × 2.00 m → 0.90 × 0.35 × 2.00 m"]),
        ("d,f", ["0 of 3 objects changed", "Removed: Fridge."]),
        ("a,e", ["overturn in 50 years, 2 alternatives", "e.parquet: overturns in 50 years"]),
    ];
    for (files, told) in cases {
        let files = files.split(',').map(|file| format!("{file}.parquet")).collect::<Vec<_>>().join(",");
        succeed(here, &format!("report --in {files} --out page.html"));
        let page = std::fs::read_to_string(here.join("page.html")).unwrap().replace('\u{a0}', " ");
        assert!(told.iter().all(|told| page.contains(told)), "{files}: {told:?}");
        assert_eq!(page.contains("changed"), !page.contains("alternatives"), "{files}");
    }
}

#[test]
fn options_fill_what_a_list_leaves_open_and_each_rock_has_its_years() {
    let list =
        "Rock,p (rad/s),alpha (deg),alpha sd (deg),age (ka),eta\na,2.1,14,2,12.5,\nb,3.4,12,2,18,0.9\n";
    let folder = folder(&[("list.csv", list), ("vase.csv", "name,diameter,height\nvase,0.3,1.6\n")]);
    let call = format!("--structures list.csv {HAZARD}");
    let all = evaluated(folder.path(), &format!("{call} --eta housner"));
    let housner = 1.0 - 1.5 * 14_f64.to_radians().sin().powi(2);
    assert!(near(number(&all[0], "eta"), housner, 1e-9) && number(&all[1], "eta") == 0.9);
    for (row, years) in all.iter().zip([12_500.0, 18_000.0]) {
        let p = 1.0 - (-years * number(row, "overturning_per_year")).exp();
        assert!(number(row, "years") == years && near(number(row, "p_overturning"), p, 1e-9));
    }
    fail(folder.path(), &format!("evaluate {call} --width 0.5"), 2, &["--width", "--structures"]);
    let vase = &evaluated(folder.path(), &format!("--structures vase.csv {HAZARD} --base stone"))[0];
    assert!(vase["base"] == "stone" && vase["warnings"].as_str().is_some_and(|of| of.contains("round")));
}

#[test]
fn what_a_list_says_in_words_of_its_own_stays_and_what_is_not_understood_is_told() {
    let list = "name,model,Value,width,height,storey\na,X-1,80,0.5,2,G\nb,,90,0.6,2,2.5\n";
    let folder = folder(&[("list.csv", list), ("low.csv", "name,width\na,0.5\n")]);
    let here = folder.path();
    let call = format!("evaluate --structures list.csv {HAZARD} --out");
    let (text, _) = succeed(here, &format!("{call} a.parquet"));
    let gaps = "Not understood in list.csv: column 'Value'.";
    assert_eq!(text.lines().nth(1), Some(gaps));
    succeed(here, &format!("{call} own.html"));
    succeed(here, "report --in a.parquet --out read.html");
    for page in ["own.html", "read.html"] {
        let page = std::fs::read_to_string(here.join(page)).unwrap();
        assert!([gaps, "X-1", "How the files were read"].iter().all(|told| page.contains(told)), "{page}");
    }
    // An answer has a column called model.
    assert_eq!(objects(here, "a.parquet")[0]["model (list)"], "X-1");
    let read = &succeed(here, "inspect list.csv --format json").0;
    let read: Value = serde_json::from_str(read).unwrap();
    assert!(read["kind"] == "list" && read["columns"][3]["meaning"] == "width", "{read}");
    let told = "low.csv: headings name, width; expected name, width, depth and height";
    fail(here, "inspect low.csv", 1, &[told]);
}

#[test]
fn slips_are_named() {
    let folder = folder(&[]);
    for (arguments, named) in [
        ("--level 3 --period 0.5", ["level", "storey"]),
        ("--level 1", ["level", "period"]),
        ("--period 0.6", ["period", "level"]),
        ("--centre-height 2.5", ["centre-height", "exchanged"]),
        ("--inertia 300", ["inertia", "mass"]),
        ("--depth 10 --centre-height-sd 20", ["centre-height-sd", "cm"]),
        ("--beam-mass-ratio 2 --depth 1", ["depth", "beam-mass-ratio"]),
        ("--beam-mass-ratio 50", ["beam-mass-ratio", "50"]),
        ("--base wood", ["base", "timber"]),
        ("--base stone --eta 0.9", ["base", "eta"]),
        ("--wall 2", ["wall", "rebound"]),
        ("--target 0.5", ["--target", "percent"]),
        ("--pga 0.4 --pgv 0.5", ["--pga", "--hazard"]),
    ] {
        let call = format!("evaluate --width 0.8 --height 2.2 {arguments} {HAZARD}");
        fail(folder.path(), &call, 2, &named);
    }
    for twice in ["name=a,p=1,p=2", "name=a,centre-height=1,centre_height=1"] {
        let call = format!("evaluate --structure {twice},alpha=0.2,eta=0.9 --pga 0.5");
        fail(folder.path(), &call, 2, &["twice"]);
    }
}

#[test]
fn what_is_squat_or_has_too_little_friction_slides() {
    let list = "name,width,height,friction\na,0.8,2.2,0.3\nb,0.8,2.2,0.6\nc,0.8,2.2,\n";
    let folder = folder(&[("list.csv", list)]);
    let here = folder.path();
    let all = evaluated(here, &format!("--structures list.csv {HAZARD} --quiet"));
    let is_known = |name: &str| {
        all.iter().find(|row| row["structure"] == name).unwrap()["overturning_per_year"].is_f64()
    };
    assert_eq!(["a", "b", "c"].map(is_known), [false, true, true]);
    let squat = succeed(here, &format!("evaluate --width 1.6 --height 2 --centre-height 0.4 {HAZARD}")).0;
    assert!(squat.contains("squat"), "{squat}");
    let wide = rate("--width 0.8 --height 2.2 --friction 0.5");
    assert_eq!(wide, rate("--width 0.8 --height 2.2"));
    // It slides along its depth, and rocks along its width.
    assert_eq!(wide, rate("--width 0.8 --depth 1.2 --height 2.2 --friction 0.5"));
}
