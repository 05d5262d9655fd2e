//! run: all stages of a pipeline file, one after the other.

use std::collections::HashMap;
use std::fmt::Write;
use std::time::Instant;

use anyhow::Context as _;
use rockfrag_core::warning::Warnings;

use crate::number::{LONGEST_TEXT, shown};
use crate::pipeline::cache;
use crate::pipeline::call::{Call, Planned};
use crate::pipeline::context::Context;
use crate::pipeline::paths::Read;
use crate::pipeline::terminal::{print, tell};
use crate::table::provenance::text_of;

/// Stages whose text is what people make a folder for.
const STAGES_WITH_ANSWER: [&str; 4] = ["ida", "fit-pro", "compare-paper", "evaluate"];
/// Warnings that are printed.
const SHOWN: usize = 3;

/// Runs the stages that are not up to date, and prints the text of the last answer, or else of the last stage.
pub fn run(calls: &[Call], context: &Context) -> anyhow::Result<()> {
    let (mut printed, mut warnings, mut made) = (String::new(), Warnings::default(), HashMap::new());
    let answer =
        calls.iter().rposition(|call| STAGES_WITH_ANSWER.contains(&&*call.name)).unwrap_or(calls.len() - 1);
    for (place, call) in calls.iter().enumerate() {
        let start = Instant::now();
        let done = cache::run(call, context, &mut made).with_context(|| call.name.clone())?;
        if !context.common.quiet {
            let seconds = start.elapsed().as_secs_f64();
            let took = if done.ran { format!("{seconds:.2} s") } else { "up to date".to_string() };
            tell(&format!("{:20} {took}", call.name));
        }
        warnings.join(&done.warnings);
        if place == answer {
            printed = done.summary;
        }
    }
    warn(&warnings);
    print(&printed, calls[answer].stage.format())
}

/// Prints the weightiest warnings.
pub fn warn(warnings: &Warnings) {
    let lines = warnings.lines();
    let more = match lines.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(" ({more} more: rockfrag inspect)"),
    };
    for (place, line) in lines.iter().take(SHOWN).enumerate() {
        tell(&format!("warning: {line}{}", if place + 1 == SHOWN { &more } else { "" }));
    }
}

/// Lists what each stage would do, with its options, and why; and whether any would run.
pub fn dry_run(calls: &[Call], context: &Context) -> anyhow::Result<(String, bool)> {
    let (mut text, mut is_due) = (String::new(), false);
    let mut planned = Planned::new();
    for call in calls {
        let plan = call.plan(&planned)?;
        let would = match cache::freshness(call, &plan) {
            Ok(_) if !context.common.force => "up to date".to_string(),
            fresh => {
                is_due |= plan.outputs.iter().any(|path| !cache::is_view(path) || !path.exists());
                let reason = fresh.err().unwrap_or("--force".to_string());
                let refused = cache::expect_replaceable(&plan.outputs, &context.begin(plan.clone())).err();
                refused.map_or(format!("run: {reason}"), |refused| format!("cannot run: {refused}"))
            }
        };
        writeln!(text, "{}: {}", call.name, shown(&would, LONGEST_TEXT))?;
        for (name, value) in &call.options {
            writeln!(text, "    --{name} {}", shown(&text_of(value), LONGEST_TEXT))?;
        }
        for Read { flag, paths, .. } in call.stage.inputs().iter().filter(|read| !read.paths.is_empty()) {
            let paths: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
            writeln!(text, "    --{flag} {}", shown(&paths.join(" "), LONGEST_TEXT))?;
        }
        planned.extend(plan.keys());
    }
    Ok((text, is_due))
}
