//! Files of records with common mistakes: each is read as intended, or refused for the right reason.

use rockfrag::inputs::InputError;

use crate::writers::*;

/// Lines of the fields that `row` makes of sample number and acceleration, in units of `unit` m/s2.
fn lines(heading: &str, unit: f64, row: impl Fn(usize, f64) -> String) -> String {
    let rows = motion(1600).into_iter().enumerate().map(|(k, a)| row(k, a / unit) + "\n");
    heading.to_string() + "\n" + &rows.collect::<String>()
}

fn time(k: usize) -> f64 {
    k as f64 * DT
}

/// A CSV file of times and samples with this heading.
fn csv(heading: &str, unit: f64) -> String {
    lines(heading, unit, |k, a| format!("{:.2},{a:.6}", time(k)))
}

/// Reads with options such as `unit=g dt=0.01 column=acc`.
fn read(text: &str, options: &str) -> Result<(f64, Vec<f64>), InputError> {
    let motion = read_with(text, options)?.remove(0);
    Ok((motion.dt_s, motion.acceleration_m_s2))
}

#[test]
fn what_is_meant_is_read() {
    let row = |row: &[f64]| row.iter().map(|a| format!("{a:10.6}")).collect::<String>() + "\n";
    let wrapped: String = motion(1600).chunks(8).map(row).collect();
    let sample = |_: usize, a: f64| format!("{a:.6}");
    for (text, options) in [
        (csv("time,acc (%g)", 0.01 * G), ""),
        (csv("Zeit,\"acc 90\u{b0}, cm/sec\u{b2}\"", 0.01), ""),
        (csv("# acceleration in cm/s2", 0.01), ""),
        (csv("Station,ABC\n\ntime,acc_g", G), ""),
        (lines("time_ms,acc_g", G, |k, a| format!("{},{a:.6}", 10 * k)), ""),
        (lines("acc_g,time,vel", G, |k, a| format!("{a:.6},{:.2},1", time(k))), ""),
        (lines("n,time,x", G, |k, a| format!("{k},{:.2},{a:.6}", time(k))), "unit=g column=x"),
        (lines("# time acc_g", G, |k, a| format!("{:.2} {a:.6}", time(k))), ""),
        (lines("# dt = 0.01 s", G, |_, a| format!("{a:.6}")), "unit=g"),
        (format!("matched\n1600 0.01 656\n{wrapped}"), "unit=m/s2 column=all"),
        (wrapped, "unit=m/s2 dt=0.01 column=all"),
        (lines("n,acc_g", G, |k, a| format!("{k},{a:.6}")), "dt=0.01"),
        (lines("# sampling rate: 100 sps\nacc (g)", G, sample), ""),
        (
            lines("SAMPLING INTERVAL (sec) : 0.01\nN-S  E-W", 1.0, |_, a| format!("{a:.6} {a:.6}")),
            "unit=m/s2 column=1",
        ),
        (csv("time,acc_g", G).replace(',', ";").replace('.', ",").replace('-', "\u{2212}"), ""),
        (csv("time (s),acc (g)", G).replace(',', " ").replace('.', ",").replace('\n', "\r\n"), ""),
        (lines("time,acc_g", G, |k, a| format!("{:.1},{a:.6}", time(k))), "dt=0.01"),
        // A time step and a number of samples above them.
        (lines("0.01", 1.0, sample), "unit=m/s2 dt=0.01"),
        (lines("1600\n0.01", 1.0, sample), "unit=m/s2 dt=0.01"),
        (lines("1600", 1.0, sample), "unit=m/s2 dt=0.01"),
        (csv("time (s),acc (x10 m/s2)", 1.0), "unit=m/s2"),
    ] {
        let beginning = text.get(..60).unwrap_or_default();
        let (dt_s, samples) = read(&text, options).unwrap_or_else(|why| panic!("{why}: {beginning}"));
        assert!((dt_s - DT).abs() < 1e-15 && samples.len() == 1600, "{beginning}");
        let off = samples.iter().zip(motion(1600)).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(off < 1e-5, "{off}: {beginning}");
    }
}

#[test]
fn what_is_wrong_is_refused_for_its_reason() {
    let at2 = |unit: &str, counts: &str| at2(&motion(103), unit, counts);
    let timed = |time: &dyn Fn(usize) -> f64| lines("time,acc_g", G, |k, a| format!("{:.2},{a:.6}", time(k)));
    let bare = |heading: &str| lines(heading, G, |_, a| format!("{a:.6}"));
    let gap = timed(&|k| time(k + usize::from(k > 200)));
    for (text, options, kind) in [
        // Contradictory units, unknown units, and units of other quantities.
        (csv("time,acc_cm_s2", 0.01), "unit=g", "Contradiction { line: 2, field: \"unit\""),
        (csv("time,acc", G), "", "Missing { line: 2, field: \"unit\""),
        (csv("time,acc (furlong)", G), "", "Missing { line: 2, field: \"unit\""),
        (at2("IN UNITS OF FURLONGS", "NPTS= 103, DT= .01"), "", "Value { line: 3, field: \"unit\""),
        (cosmos(&motion(103), 90).replace("cm/sec2(04)", "counts (50)"), "", "Value"),
        (esm(&motion(103)).replace("PGA_CM/S^2: ", "PGA_CM/S^2: 9"), "", "Peak"),
        (csv("# Units: m/s2\ntime,acc (g)", G), "", "Units"),
        (csv("time,acc (g) x 10", G), "", "Missing { line: 2, field: \"unit\""),
        (csv("# PGA = 0.9 g\ntime,acc (g)", G), "", "Peak"),
        // Velocity, displacement, times.
        (csv("time,vel", G), "unit=g", "NotAcceleration"),
        (bare("# velocity in cm/s"), "dt=0.01 unit=g", "Value"),
        (at2("VELOCITY TIME SERIES IN UNITS OF CM/S", "NPTS= 103, DT= .01"), "", "NotAcceleration { line: 3"),
        (cosmos(&motion(103), 90).replace("acceleration pts", "velocity pts"), "", "NotAcceleration"),
        (esm(&motion(103)).replace(": ACCELERATION", ": VELOCITY"), "", "NotAcceleration"),
        (lines("acc_g,time", G, |k, a| format!("{:.2},{a:.6}", time(k))), "", "UnevenTime"),
        // Time steps.
        (csv("time,acc_g", G), "dt=0.005", "Contradiction"),
        (timed(&|k| -time(k)), "", "Value { line: 2, field: \"time step\""),
        (gap.clone(), "", "UnevenTime { line: 203"),
        (gap, "dt=0.01", "UnevenTime { line: 203"),
        (lines("time,acc_g", G, |k, a| format!("{:.1},{a:.6}", time(k))), "", "UnevenTime"),
        (bare(""), "unit=g", "Missing { line: 2, field: \"time step\""),
        (at2(IN_G, "NPTS= 103"), "", "Missing { line: 4, field: \"time step\""),
        (csv("# dt = 0.005 s\ntime,acc_g", G), "", "Contradiction { line: 3, field: \"time step\""),
        (csv("Period (s),PSA (g)", G), "", "NotAcceleration { line: 2, found: \"'Period (s)'"),
        // Columns, cells and counts.
        (lines("time,N,E,Z", G, |k, a| format!("{:.2},{a:.6},1,1", time(k))), "unit=g", "Column"),
        (csv("time,acc_g", G).replacen("0.30", "NaN", 1), "", "Cell { line: 32"),
        (lines("time,acc_g", G, |k, _| format!("{:.2},", time(k))), "", "Cell { line: 2"),
        (csv("time,acc_g", G).replace('.', ","), "", "Cells"),
        (at2(IN_G, "NPTS= 104, DT= .01"), "", "Count { announced: 104, found: 103 }"),
        (nga_at2(&motion(103)).replace("E-", "X-"), "", "Value { line: "),
        (knet(&motion(100)).replace("/8388608", "/0"), "", "Value { line: 8"),
        // Two series, two instruments, and a first line that says otherwise than the call.
        (bare("0.1\n"), "unit=g dt=0.01", "ShortLine { line: 2, found: 0"),
        ("0.1\n0.2\n0.1 0.2\n0.3\n".to_string(), "unit=g dt=0.01", "ShortLine { line: 3, found: 2"),
        (bare("0.005"), "unit=g dt=0.01", "Contradiction { line: 1"),
        (bare("# sampling rate: 200 sps\nacc (g)"), "dt=0.01", "Contradiction { line: 3"),
        (lines("n,acc_g", G, |k, a| format!("{k},{a:.6}")), "", "Missing { line: 2, field: \"time step\""),
        (csv("#SamplingFrequency(Hz)\n#200\ntime,acc_g", G), "", "Contradiction { line: 4, field: \"time"),
        // Not a record.
        ("Dear colleague,\nplease find attached\n".to_string(), "", "Unrecognised"),
        ("PK\u{3}\u{4}\u{14}\0\u{6}\0".to_string(), "", "Damaged"),
    ] {
        let found = match read(&text, options) {
            Ok((dt_s, samples)) => format!("{} samples of {dt_s} s", samples.len()),
            Err(refusal) => format!("{refusal:?}"),
        };
        assert!(found.starts_with(kind), "{kind}: {found}: {}", text.get(..60).unwrap_or(&text));
    }
    // A record in one row takes no time.
    let row = motion(1600).repeat(25).iter().map(|a| format!("{a:.6}")).collect::<Vec<_>>().join(",");
    assert!(matches!(read(&row, "unit=g dt=0.01"), Err(InputError::Column { .. })));
    assert_eq!(read(&row, "unit=g dt=0.01 column=all").unwrap().1.len(), 40_000);
    // Padding of the last line.
    assert_eq!(read(&at2(IN_G, "NPTS= 101, DT= .01"), "").unwrap().1.len(), 101);
}
