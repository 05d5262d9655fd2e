//! run: all stages of a pipeline file, one after the other.

use std::collections::HashMap;
use std::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context as _;

use crate::pipeline::cache::{self, Freshness};
use crate::pipeline::call::Call;
use crate::pipeline::context::Context;

/// Runs what must run. Returns what the last stages print.
pub fn run(calls: &[Call], context: &Context) -> anyhow::Result<String> {
    calls.iter().try_for_each(|call| call.stage.check())?;
    let (mut printed, mut made) = (String::new(), HashMap::new());
    for call in calls {
        let start = Instant::now();
        let done = cache::run(call, context, &made).with_context(|| call.name.clone())?;
        if !context.quiet {
            let took = if done.ran {
                format!("{:.2} s", start.elapsed().as_secs_f64())
            } else {
                "up to date".to_string()
            };
            eprintln!("{:20} {took}", call.name);
            done.doubts.iter().for_each(|doubt| eprintln!("warning: {doubt}"));
        }
        made.extend(call.stage.outputs().into_iter().map(|path| (path, done.key.clone())));
        printed = done.summary;
    }
    Ok(printed)
}

/// Tells what each stage would do, with which options, and why.
pub fn dry_run(calls: &[Call]) -> anyhow::Result<String> {
    let mut text = String::new();
    let mut planned: HashMap<PathBuf, String> = HashMap::new();
    for call in calls {
        call.stage.check()?;
        let made = call.provenance(&planned)?;
        let would = match cache::freshness(call, &made) {
            Freshness::UpToDate(_) => "up to date".to_string(),
            Freshness::Stale(reason) => format!("run: {reason}"),
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
