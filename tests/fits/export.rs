//! Fragility as files of other programs. scripts/check_exports.sh asks these programs themselves.

use std::path::Path;

use crate::paper_model::{equipment, model};
use rockfrag::export::{
    Function, GAP, Model, continuous, discrete, levels, metadata, parameters, plain_id, whole_curve_end,
};
use rockfrag::fragility::{Fragility, Peak, Slice};
use rockfrag::table::fits::planes;
use rockfrag::table::pex::PexRow;
use rockfrag::table::row::ReadRow;

fn slice(peak: Peak) -> Slice {
    Slice { structure: equipment(), peak, ratio: 0.4 }
}

fn reaching(slice: &Slice, intensity: f64) -> [f64; 3] {
    model().limit_states(slice, intensity).unwrap().map(|p| p.value)
}

fn function(peak: Peak, tolerance: f64) -> Function {
    let slice = slice(peak);
    let end =
        whole_curve_end(slice.intensity_at_im4(1.0), tolerance, |intensity| reaching(&slice, intensity));
    let edges = [slice.jumps(&model()), vec![end]].concat();
    let levels = levels(&edges, tolerance, |intensity| reaching(&slice, intensity));
    Function {
        id: "equipment".to_string(),
        peak,
        probabilities: levels.iter().map(|&level| reaching(&slice, level)).collect(),
        levels,
        overturning: slice.overturning(&model().overturning),
        range_of_data: [edges[0], slice.largest_in_data(&model())],
    }
}

fn words() -> Model {
    let limit_states = ["rocking", "too far", "overturning"].map(str::to_string).to_vec();
    Model { id: "m".to_string(), description: "a < b & \"c\"".to_string(), limit_states }
}

/// Straight lines between points, which rise; the last point holds beyond.
fn interpolate(points: &[(f64, f64)], x: f64) -> f64 {
    let after = points.partition_point(|point| point.0 <= x);
    match (after.checked_sub(1).map(|before| points[before]), points.get(after)) {
        (None, _) => 0.0,
        (Some(last), None) => last.1,
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (x - a.0) / (b.0 - a.0),
    }
}

/// The numbers of an element of XML.
fn numbers(xml: &str, opening: &str) -> Vec<f64> {
    let from = xml.find(opening).unwrap();
    let text = xml[from..].split_once('>').unwrap().1.split_once('<').unwrap().0;
    text.split(' ').map(|number| number.parse().unwrap()).collect()
}

#[test]
fn lines_between_the_levels_err_by_no_more_than_the_tolerance() {
    for tolerance in [1e-3, 1e-6] {
        let function = function(Peak::Pga, tolerance);
        let slice = slice(Peak::Pga);
        let jump = slice.intensity_at_im4(1.3);
        for state in 0..3 {
            let points = function.levels.iter().zip(&function.probabilities).map(|(&x, p)| (x, p[state]));
            let points: Vec<_> = points.collect();
            let (first, last) = (points[0].0, points[points.len() - 1].0);
            for k in 1..5000 {
                let x = first * (last / first).powf(f64::from(k) / 5000.0);
                let error = (interpolate(&points, x) - reaching(&slice, x)[state]).abs();
                let in_gap = x < jump && x > jump * (1.0 - GAP);
                assert!(in_gap || error <= 1.5 * tolerance, "LS{}: {error} at {x}", state + 1);
            }
        }
        assert!(function.levels.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(function.probabilities[0][0], 1.0, "the first level is uplift");
    }
}

#[test]
fn nrml_has_the_levels_in_g_or_cm_s_and_a_no_damage_limit() {
    for (peak, imt, unit) in [(Peak::Pga, "PGA", 9.81), (Peak::Pgv, "PGV", 0.01)] {
        let function = function(peak, 1e-3);
        let xml = discrete(&words(), std::slice::from_ref(&function));
        let uplift = slice(peak).intensity_at_im4(1.0) / unit;
        assert!(xml.contains(&format!("<imls imt=\"{imt}\" noDamageLimit=\"{uplift}\">")), "{xml}");
        let levels: Vec<f64> = function.levels.iter().map(|level| level / unit).collect();
        assert_eq!(numbers(&xml, "<imls"), levels);
        let overturning: Vec<f64> = function.probabilities.iter().map(|p| p[2]).collect();
        assert_eq!(numbers(&xml, "<poes ls=\"LS3\""), overturning);
    }
}

#[test]
fn the_continuous_form_has_the_arithmetic_moments() {
    let function = function(Peak::Pga, 1e-3);
    let xml = continuous(&words(), std::slice::from_ref(&function));
    let overturning = function.overturning.unwrap();
    let (mean, sd) = (overturning.mean() / 9.81, overturning.standard_deviation() / 9.81);
    assert!(xml.contains(&format!("<params ls=\"LS3\" mean=\"{mean}\" stddev=\"{sd}\"/>")), "{xml}");
    assert!(xml.contains("<limitStates>LS3</limitStates>") && !xml.contains("LS1"), "{xml}");
}

#[test]
fn signs_that_mean_something_in_xml_are_escaped() {
    let xml = discrete(&words(), &[]);
    assert!(xml.contains("a &lt; b &amp; &quot;c&quot;"), "{xml}");
    assert_eq!(plain_id("p2.5-alpha0.2 \"é\""), "p2_5_alpha0_2____");
}

#[test]
fn a_table_of_pelicun_rises_from_0_to_1_as_it_must() {
    let function = function(Peak::Pgv, 1e-6);
    let csv = parameters(std::slice::from_ref(&function)).unwrap();
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let names = reader.headers().unwrap().clone();
    let row = reader.records().next().unwrap().unwrap();
    let cell = |name: &str| row[names.iter().position(|known| known == name).unwrap()].to_string();
    assert_eq!((cell("Demand-Type").as_str(), cell("Demand-Unit").as_str()), ("Peak Ground Velocity", "mps"));
    assert_eq!(cell("LS1-Theta_0"), slice(Peak::Pgv).intensity_at_im4(1.0).to_string());
    for (state, name) in [(1, "LS2-Theta_0"), (2, "LS3-Theta_0")] {
        let table = cell(name);
        let (x, y) = table.split_once('|').unwrap();
        let parse = |text: &str| text.split(',').map(|v| v.parse::<f64>().unwrap()).collect::<Vec<_>>();
        let points: Vec<_> = parse(x).into_iter().zip(parse(y)).collect();
        assert_eq!((points[0].1, points[points.len() - 1].1), (0.0, 1.0));
        // pelicun keeps six digits, by which neighbours must still differ.
        assert!(points.windows(2).all(|p| p[1].0 / p[0].0 - 1.0 > 1.9e-5 && p[1].1 - p[0].1 > 1.9e-6));
        for k in 1..500 {
            let intensity = slice(Peak::Pgv).intensity_at_im4(1.0 + 0.02 * f64::from(k));
            let expected = reaching(&slice(Peak::Pgv), intensity)[state];
            assert!((interpolate(&points, intensity) - expected).abs() < 1e-5, "{name} at {intensity}");
        }
    }
}

#[test]
fn the_range_of_the_data_stands_beside() {
    let function = function(Peak::Pga, 1e-3);
    let json = metadata(&words(), std::slice::from_ref(&function));
    let range = &json["equipment"]["RangeOfData"];
    assert_eq!(range["To"].as_f64(), Some(function.range_of_data[1] / 9.81));
    assert_eq!(json["equipment"]["LimitStates"]["LS2"]["DS2"]["Description"], "too far");
    assert!(discrete(&words(), &[function]).contains("holds from PGA 0.2027 (uplift) to 1.5001"));
}

#[test]
fn planes_are_told_apart_in_a_file_that_was_sorted_elsewhere() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/files/pex.parquet");
    let mut rows = PexRow::read(file).unwrap();
    rows.retain(|row| row.structure == "electrical-equipment");
    rows.reverse();
    let [below, above] = planes(rows.iter()).unwrap();
    assert!(below.range_low < above.range_low && below.range_high == above.range_low);
}
