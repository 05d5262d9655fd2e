//! What a run says while it works: on stderr, and progress only where someone watches.

use std::collections::BTreeMap;
use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::terminal::{Terminal, Weight};

/// How much is said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Console {
    /// Only errors.
    pub quiet: bool,
    /// Progress bars, where stderr is a terminal.
    pub progress: bool,
}

impl Console {
    /// A line that tells what was done.
    pub fn note(&self, line: &str) {
        if !self.quiet {
            eprintln!("{line}");
        }
    }

    /// A line that tells what a stage did.
    pub fn stage(&self, name: &str, summary: &str, weight: Weight) {
        let terminal = Terminal::stderr();
        let name = format!("{name:20}");
        self.note(&format!("{} {}", terminal.set(&name, Weight::Strong), terminal.set(summary, weight)));
    }

    /// A line for each reason, with all that it holds for.
    pub fn warn_each(&self, warnings: impl Iterator<Item = (String, String)>) {
        let mut by_reason: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (reason, what) in warnings {
            by_reason.entry(reason).or_default().push(what);
        }
        for (reason, what) in by_reason {
            self.note(&format!("warning: {reason}: {}", what.join(", ")));
        }
    }

    /// A bar over `total` steps.
    pub fn bar(&self, what: &str, total: u64) -> ProgressBar {
        if self.quiet || !self.progress || !std::io::stderr().is_terminal() {
            return ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        }
        let style = ProgressStyle::with_template("{msg:20} {bar:40} {human_pos}/{human_len}  {eta} left");
        let bar = ProgressBar::new(total).with_message(what.to_string());
        style.map_or(bar.clone(), |style| bar.with_style(style))
    }
}
