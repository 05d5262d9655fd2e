//! Writers of files in the formats of the networks.

use std::f64::consts::PI;

use rockfrag::inputs::InputError;
use rockfrag::inputs::records::{ReadOptions, read_records};
use rockfrag_core::records::RecordedMotion;
use rockfrag_core::units::Unit;

pub const G: f64 = 9.81;
pub const DT: f64 = 0.01;

/// A motion of about 0.3 g and 0.28 m/s that begins and ends at rest, m/s2.
pub fn motion(n: usize) -> Vec<f64> {
    let time = |k: usize| (k as f64 - 0.5 * n as f64) * DT;
    (0..n).map(time).map(|t| 3.0 * (-(t / 3.0).powi(2)).exp() * (2.0 * PI * 1.7 * t + 0.4).sin()).collect()
}

pub fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |peak, value| value.abs().max(peak))
}

/// Rows of `on_line` samples each.
fn rows(samples: &[f64], on_line: usize, format: impl Fn(f64) -> String) -> String {
    let line = |row: &[f64]| row.iter().map(|&value| format(value)).collect::<String>() + "\n";
    samples.chunks(on_line).map(line).collect()
}

fn in_cm(samples: &[f64]) -> Vec<f64> {
    samples.iter().map(|a| a * 100.0).collect()
}

/// AT2 with a third and a fourth line.
pub fn at2(samples: &[f64], unit: &str, counts: &str) -> String {
    let in_g: Vec<f64> = samples.iter().map(|a| a / G).collect();
    format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\nChi-Chi, Taiwan, 9/20/1999, CHY101, 270\n{unit}\n{counts}\n{}",
        rows(&in_g, 5, |a| format!("{a:15.7E}"))
    )
}

pub const IN_G: &str = "ACCELERATION TIME SERIES IN UNITS OF G";

pub fn nga_at2(samples: &[f64]) -> String {
    at2(samples, IN_G, &format!("NPTS=   {}, DT=   {DT:.4} SEC,", samples.len()))
}

/// One channel of COSMOS V2, in cm/s2, with its velocity after it.
pub fn cosmos(samples: &[f64], azimuth: i64) -> String {
    let (in_cm, n) = (in_cm(samples), samples.len());
    let (mut integers, mut reals) = (vec![-999.0; 100], vec![-999.0; 100]);
    integers[53] = azimuth as f64;
    (reals[61], reals[63]) = (DT * 1000.0, -peak(&in_cm));
    format!(
        "Corrected acceleration    (Format v01.20 with 13 text lines)\n\
         Record of Point MacKenzie Earthquake of Fri Nov 30, 2018 17:29 UTC\n\
         Statn No: 37-000011 Code:AK-BMR     UAF  Bremner River, AK, USA\n\
         Sta Chan   1:{azimuth:3} deg (Rcrdr Chan  1) Location:\n\
         Raw record length = 210.000 sec, Uncor max =    101730, at  82.680 sec.\n \
         100 Integer-header values follow on  10 lines, Format= (10I8)\n{} \
         100 Real-header values follow on  20 lines, Format= (5F15.6)\n{}   \
         1 Comment line(s) follow, each starting with a \"|\":\n| Recorder: QUANTERRA Q330\n   \
         {n} acceleration pts, approx  210 secs, units=cm/sec2(04),Format=(8F10.5)\n{}\
         End-of-data for Chan  1 acceleration\n   \
         {n} velocity     pts, approx  210 secs, units=cm/sec(05),Format=(8F10.5)\n{}\
         End-of-data for Chan  1 velocity\n",
        rows(&integers, 10, |i| format!("{i:8.0}")),
        rows(&reals, 5, |value| format!("{value:15.6}")),
        rows(&in_cm, 8, |a| format!("{a:10.5}")),
        rows(&vec![1.0; n], 8, |v| format!("{v:10.5}"))
    )
}

pub fn esm(samples: &[f64]) -> String {
    let in_cm = in_cm(samples);
    format!(
        "EVENT_NAME: NORTHERN_ITALY\nEVENT_ID: IT-2012-0011\nEVENT_DATE_YYYYMMDD: 20120529\nEVENT_TIME_HHMMSS: 070002\nMAGNITUDE_W: 6.0\n\
         NETWORK: IT\nSTATION_CODE: MRN\nSTATION_NAME: MIRANDOLA\nVS30_M/S:\nSAMPLING_INTERVAL_S: {DT:.6}\nNDATA: {}\n\
         STREAM: HNE\nUNITS: cm/s^2\nPGA_CM/S^2: {:.6}\nDATA_TYPE: ACCELERATION\nUSER5:\n{}",
        samples.len(),
        -peak(&in_cm),
        rows(&in_cm, 1, |a| format!("{a:.6}"))
    )
}

/// KiK-net at the surface: counts of 2000 gal / 8388608 about an offset.
pub fn knet(samples: &[f64]) -> String {
    let counts: Vec<f64> =
        samples.iter().map(|a| (a * 100.0 * 8_388_608.0 / 2000.0).round() + 12_345.0).collect();
    format!(
        "Origin Time       2011/03/11 14:46:00\nLat.              38.103\nMag.              9.0\n\
         Station Code      MYG004\nSampling Freq(Hz) {:.0}Hz\nDuration Time(s)  {}\nDir.              5\n\
         Scale Factor      2000(gal)/8388608\nMax. Acc. (gal)   {:.3}\n\
         Last Correction   2011/03/11 14:46:21\nMemo.\n{}",
        1.0 / DT,
        samples.len() as f64 * DT,
        peak(samples) * 100.0,
        rows(&counts, 8, |count| format!("{count:9.0}"))
    )
}

/// Reads with options such as `unit=g dt=0.01 column=acc`.
pub fn read_with(text: &str, options: &str) -> Result<Vec<RecordedMotion>, InputError> {
    let value = |key: &str| options.split(' ').find_map(|option| option.strip_prefix(key)?.strip_prefix('='));
    let options = ReadOptions {
        dt_s: value("dt").map(|dt| dt.parse().unwrap()),
        unit: value("unit").map(|unit| Unit::parse_acceleration(unit).unwrap()),
        column: value("column").map(str::to_string),
        ..ReadOptions::default()
    };
    read_records(text.as_bytes(), &options)
}
