//! Files as the networks write them, from known samples.

use std::f64::consts::PI;
use std::fmt::Write;

pub const G: f64 = 9.81;
pub const DT: f64 = 0.01;

/// A decaying sine, m/s2: `n` samples that a file can hold with all digits of an f32.
pub fn motion(n: usize) -> Vec<f64> {
    (0..n)
        .map(|k| k as f64 * DT)
        .map(|t| 3.0 * (-0.3 * (t - 2.0).abs()).exp() * (2.0 * PI * 1.7 * t + 0.4).sin())
        .collect()
}

pub fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |peak, value| value.abs().max(peak))
}

/// As Fortran's `Ew.d` writes: no digit before the point, an exponent of two digits, letters of choice.
pub fn fortran_e(value: f64, width: usize, digits: usize, letter: char) -> String {
    if value == 0.0 {
        return format!("{:>width$}", format!(".{}{letter}+00", "0".repeat(digits)));
    }
    let mut exponent = value.abs().log10().floor() as i32 + 1;
    let mut mantissa = (value.abs() * 10f64.powi(digits as i32 - exponent)).round();
    if mantissa >= 10f64.powi(digits as i32) {
        mantissa /= 10.0;
        exponent += 1;
    }
    let sign = if value < 0.0 { "-" } else { "" };
    let text = format!("{sign}.{:0digits$}{letter}{exponent:+03}", mantissa.round() as u64);
    format!("{text:>width$}")
}

/// Rows of `on_line` samples each.
pub fn rows(samples: &[f64], on_line: usize, format: impl Fn(f64) -> String) -> String {
    let line = |row: &[f64]| row.iter().map(|&value| format(value)).collect::<String>() + "\n";
    samples.chunks(on_line).map(line).collect()
}

pub fn at2(samples: &[f64], counts: &str) -> String {
    let in_g: Vec<f64> = samples.iter().map(|a| a / G).collect();
    let body = rows(&in_g, 5, |a| fortran_e(a, 15, 7, 'E'));
    format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\nChi-Chi, Taiwan, 9/20/1999, CHY101, 270\n\
         ACCELERATION TIME SERIES IN UNITS OF G\n{counts}\n{body}"
    )
}

pub fn nga_at2(samples: &[f64]) -> String {
    at2(samples, &format!("NPTS=   {}, DT=   {DT:.4} SEC,", samples.len()))
}

fn integers(values: &[(usize, i64)], count: usize, unknown: i64) -> Vec<i64> {
    let mut all = vec![unknown; count];
    values.iter().for_each(|&(at, value)| all[at] = value);
    all
}

fn reals(values: &[(usize, f64)], count: usize, unknown: f64) -> Vec<f64> {
    let mut all = vec![unknown; count];
    values.iter().for_each(|&(at, value)| all[at] = value);
    all
}

/// One channel of COSMOS V2, in cm/s2, with its velocity after it.
pub fn cosmos(samples: &[f64], azimuth: i64) -> String {
    let in_cm: Vec<f64> = samples.iter().map(|a| a * 100.0).collect();
    let n = samples.len();
    let mut text = String::from("Corrected acceleration    (Format v01.20 with 13 text lines)\n");
    text += "Record of Point MacKenzie Earthquake of Fri Nov 30, 2018 17:29 UTC\n";
    text += "Hypocenter: 61.34640 -149.95520 H= 46km Mw=7.0\nOrigin: 2018/11/30 17:29:29    UTC\n";
    text += "Statn No: 37-000011 Code:AK-BMR     UAF  Bremner River, AK, USA\n";
    text += "Coords: 60.9677 -144.6051  Site geology:\nRecorder: (see cmnt)\nRcrd start time: 2018/11/30 17:29:39.137 UTC\n";
    writeln!(text, "Sta Chan   1:{azimuth:3} deg (Rcrdr Chan  1) Location:").unwrap();
    text += "Raw record length = 210.000 sec, Uncor max =    101730, at  82.680 sec.\nProcessed:\nRecord filtered\n";
    text += "Values used when parameter or data value is unknown/unspecified:   -999, -999.00\n";
    text += " 100 Integer-header values follow on  10 lines, Format= (10I8)\n";
    let header = integers(&[(0, 2), (1, 1), (2, 4), (53, azimuth)], 100, -999);
    text += &rows(&header.iter().map(|&i| i as f64).collect::<Vec<_>>(), 10, |i| format!("{i:8.0}"));
    text += " 100 Real-header values follow on  20 lines, Format= (5F15.6)\n";
    let header =
        reals(&[(33, 0.02), (61, DT * 1000.0), (62, n as f64 * DT), (63, -peak(&in_cm))], 100, -999.0);
    text += &rows(&header, 5, |value| format!("{value:15.6}"));
    text += "   1 Comment line(s) follow, each starting with a \"|\":\n| Recorder: QUANTERRA Q330\n";
    writeln!(text, "   {n} acceleration pts, approx  210 secs, units=cm/sec2(04),Format=(8F10.5)").unwrap();
    text += &rows(&in_cm, 8, |a| format!("{a:10.5}"));
    text += "End-of-data for Chan  1 acceleration\n";
    writeln!(text, "   {n} velocity     pts, approx  210 secs, units=cm/sec(05),Format=(8F10.5)").unwrap();
    text += &rows(&vec![1.0; n], 8, |v| format!("{v:10.5}"));
    text += "End-of-data for Chan  1 velocity\n";
    text
}

/// One channel of CSMIP V2, in cm/s2, with velocity after it.
pub fn csmip_v2(samples: &[f64], component: &str) -> String {
    let in_cm: Vec<f64> = samples.iter().map(|a| a * 100.0).collect();
    let n = samples.len();
    let mut text =
        String::from("Corrected accelerogram   58667-L2866-14236.52       Chan  1            from   \n");
    text += "Uncorrected Accelerogram Data             Processed: 08/24/14, CGS  667bv052    \n";
    text += "Rcrd of Sun Aug 24, 2014 03:20:33.0 PDT               (Avol1 v0.8, 5/14 CSMIP)  \nCSMIP\nStart time\n";
    text += "Station No. 58667   37.973N, 122.038W    Etna    s/n 2866  (3 Chns of  3 at Sta)\n";
    text += "Concord - Clayton & Ellis                 CGS   Data: Acceleration              \n";
    writeln!(text, "Chan  1:{component}").unwrap();
    text += &"more text\n".repeat(8);
    writeln!(text, "At equally-spaced intervals of    {DT:.3}  sec.").unwrap();
    writeln!(text, "Peak acceleration = {:9.3}    cm/sec/sec  at   32.570   sec.", -peak(&in_cm)).unwrap();
    text += &"more text\n".repeat(7);
    text += &rows(&[7.0; 100], 16, |value| format!("{value:5.0}"));
    text += &rows(&reals(&[(60, DT)], 100, 0.0), 8, |value| format!("{value:10.7}"));
    writeln!(text, "{n:6} points of accel data equally spaced at  {DT:.3} sec, in cm/sec2. (8f10.5)    ")
        .unwrap();
    text += &rows(&in_cm, 8, |a| format!("{a:10.5}"));
    writeln!(text, "{n:6} points of veloc data equally spaced at  {DT:.3} sec, in cm/sec. (8f10.5)    ")
        .unwrap();
    text += &rows(&vec![1.0; n], 8, |v| format!("{v:10.5}"));
    text += "/&  ----------  End of data for channel  1  ----------\n";
    text
}

/// One channel of CSMIP V1, in g.
pub fn csmip_v1(samples: &[f64]) -> String {
    let in_g: Vec<f64> = samples.iter().map(|a| a / G).collect();
    let n = samples.len();
    let mut text =
        String::from("Uncorrected Accelerogram Data             Processed: 02/13/12, CGS  146be002    \n");
    text += "Record of Mon Feb 13, 2012 13:06:45.0 PST             (Avol1 v9.2,12/11 CSMIP)  \nCSMIP\nStart time\n";
    text += "Station No. 89146   40.941N, 123.633W      Etna  s/n 2500  (3 Chns of  3 at Sta)\n";
    text += "Willow Creek                              CGS                                   \n";
    text += "Chan  1: 360 Deg                                                                \n";
    text += &"more text\n".repeat(4);
    writeln!(
        text,
        "Units of uncor data are sec and g .        Max  = {:6.3} g , at  30.590 sec.",
        peak(&in_g)
    )
    .unwrap();
    text += "RMS\n";
    text += &rows(&[7.0; 100], 16, |value| format!("{value:5.0}"));
    text += &rows(&[0.1; 50], 8, |value| format!("{value:10.7}"));
    writeln!(
        text,
        "{n:6} Accelerogram points at {:.0} pts/sec in units of g .      Format: (8f9.6)",
        1.0 / DT
    )
    .unwrap();
    text + &rows(&in_g, 8, |a| format!("{a:9.6}"))
}

pub fn esm(samples: &[f64]) -> String {
    let in_cm: Vec<f64> = samples.iter().map(|a| a * 100.0).collect();
    format!(
        "EVENT_NAME: NORTHERN_ITALY\nEVENT_ID: IT-2012-0011\nEVENT_DATE_YYYYMMDD: 20120529\nEVENT_TIME_HHMMSS: 070002\n\
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
        "Origin Time       2011/03/11 14:46:00\nLat.              38.103\nLong.             142.860\nDepth. (km)       024\n\
         Mag.              9.0\nStation Code      MYG004\nStation Lat.      38.7292\nStation Long.     141.0217\n\
         Station Height(m) 40\nRecord Time       2011/03/11 14:46:36\nSampling Freq(Hz) {:.0}Hz\nDuration Time(s)  {}\n\
         Dir.              5\nScale Factor      2000(gal)/8388608\nMax. Acc. (gal)   {:.3}\n\
         Last Correction   2011/03/11 14:46:21\nMemo.\n{}",
        1.0 / DT,
        samples.len() as f64 * DT,
        peak(samples) * 100.0,
        rows(&counts, 8, |count| format!("{count:9.0}"))
    )
}

pub fn smc(samples: &[f64]) -> String {
    let in_cm: Vec<f64> = samples.iter().map(|a| a * 100.0).collect();
    let mut text =
        String::from("2 CORRECTED ACCELEROGRAM\n*\nDVD0A\n     1989  10  18    0004 Loma Prieta, CA\n");
    text += "Moment Mag=      7.1 Ms=      7.1 Ml=      7.0\n";
    text += "station = Del Valle Dam, crest           component=     65\n";
    text += "epicentral dist =     66.0       pk acc =    -80.2\ninst type=SMA-1      data source = CDWR/USGS\n*\n*\n*\n";
    let header = integers(&[(12, 90), (13, 65), (15, 2), (16, samples.len() as i64)], 48, -32768);
    text += &rows(&header.iter().map(|&i| i as f64).collect::<Vec<_>>(), 8, |i| format!("{i:10.0}"));
    let header = reals(&[(1, 1.0 / DT), (29, peak(&in_cm)), (31, -0.5)], 50, 1.7e38);
    text += &rows(&header, 5, |value| format!("{value:15.7E}"));
    text += "|\n|Moment Magnitude = 6.94\n";
    text + &rows(&in_cm, 8, |a| format!("{a:10.4}"))
}
