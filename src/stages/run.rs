//! run: all stages of a pipeline file, one after the other.

use std::collections::HashMap;
use std::fmt::Write;
use std::io::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context as _;

use crate::pipeline::cache;
use crate::pipeline::call::Call;
use crate::pipeline::context::Context;
use crate::warning::Warnings;

/// Stages whose result is the purpose of a folder; the first one that runs is printed at the end.
const ANSWERS: [&str; 4] = ["evaluate", "compare-paper", "ida", "fit-pro"];
/// Warnings that are printed.
const SHOWN: usize = 3;

/// Runs the stages that are not up to date. Returns the text of the stage above, or of the last stage.
pub fn run(calls: &[Call], context: &Context) -> anyhow::Result<String> {
    let (mut printed, mut warnings, mut made) = (String::new(), Warnings::default(), HashMap::new());
    let place_of = |name: &&str| calls.iter().position(|call| call.name == *name);
    let answer = ANSWERS.iter().find_map(place_of).unwrap_or(calls.len() - 1);
    for (place, call) in calls.iter().enumerate() {
        let start = Instant::now();
        let done = cache::run(call, context, &made).with_context(|| call.name.clone())?;
        if !context.quiet {
            let took = if done.ran {
                format!("{:.2} s", start.elapsed().as_secs_f64())
            } else {
                "up to date".to_string()
            };
            let _ = writeln!(std::io::stderr(), "{:20} {took}", call.name);
        }
        made.extend(call.stage.outputs().into_iter().map(|path| (path, done.key.clone())));
        warnings.join(&done.warnings);
        if place == answer {
            printed = done.summary;
        }
    }
    if !context.quiet {
        warn(&warnings);
    }
    Ok(printed)
}

/// Prints the weightiest warnings.
pub fn warn(warnings: &Warnings) {
    let lines = warnings.lines();
    let more = match lines.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(" ({more} more: rockfrag inspect)"),
    };
    for (place, line) in lines.iter().take(SHOWN).enumerate() {
        let _ = writeln!(std::io::stderr(), "warning: {line}{}", if place + 1 == SHOWN { &more } else { "" });
    }
}

/// Lists what each stage would do, with its options, and why.
pub fn dry_run(calls: &[Call]) -> anyhow::Result<String> {
    let mut text = String::new();
    let mut planned: HashMap<PathBuf, String> = HashMap::new();
    for call in calls {
        let made = call.provenance(&planned)?;
        let would = match cache::freshness(call, &made) {
            Ok(_) => "up to date".to_string(),
            Err(reason) => format!("run: {reason}"),
        };
        writeln!(text, "{}: {would}", call.name)?;
        for (name, values) in &made.arguments {
            writeln!(text, "    --{name} {}", values.join(","))?;
        }
        for (name, paths) in &call.inputs {
            let paths: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
            writeln!(text, "    --{name} {}", paths.join(" "))?;
        }
        planned.extend(call.stage.outputs().into_iter().map(|path| (path, made.key())));
    }
    Ok(text)
}
