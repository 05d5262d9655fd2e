//! What a run says while it works: on stderr, and progress only where someone watches; or to the program that called.

use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::sync::Arc;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::terminal::{Terminal, Weight};
use crate::table::store::provenance::Warnings;

/// A program that calls a stage and wants to know how it goes, in place of a terminal.
pub trait Listener: Send + Sync {
    /// Takes a line that tells what was done.
    fn note(&self, line: &str);

    /// Takes a warning.
    fn warn(&self, warning: &str);

    /// Takes that a stage begins, of so many steps.
    fn begin(&self, steps: u64);

    /// Takes that so many further steps are done.
    ///
    /// # Errors
    /// If the stage is to stop.
    fn advance(&self, steps: u64) -> anyhow::Result<()>;
}

/// How much is said, and to whom.
#[derive(Clone, Default)]
pub struct Console {
    /// Only errors.
    pub quiet: bool,
    /// Progress bars, where stderr is a terminal.
    pub progress: bool,
    /// Who hears it, if not whoever reads stderr.
    pub listener: Option<Arc<dyn Listener>>,
    /// Where warnings are kept besides.
    pub warnings: Warnings,
    /// Where warnings go that nobody needs to see one by one.
    pub expected: Option<Warnings>,
}

/// What is to be said of a suite and structure.
pub struct OfGroup {
    /// In which `{}` stands for the group.
    pub words: String,
    pub group: String,
    /// What differs from group to group, at the end.
    pub counts: String,
}

/// Of more suites and structures than this a warning tells how many they are,
const MOST_GROUPS: usize = 10;
/// and names these first ones.
const NAMED: usize = 3;

/// Progress through the steps of a stage.
pub struct Progress {
    bar: ProgressBar,
    listener: Option<Arc<dyn Listener>>,
}

impl Progress {
    /// So many further steps are done.
    ///
    /// # Errors
    /// If whoever listens wants the stage to stop.
    pub fn inc(&self, steps: u64) -> anyhow::Result<()> {
        self.bar.inc(steps);
        self.listener.as_ref().map_or(Ok(()), |listener| listener.advance(steps))
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// What each reason holds for.
fn by_reason(warnings: impl Iterator<Item = (String, String)>) -> BTreeMap<String, Vec<String>> {
    let mut by_reason: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (reason, what) in warnings {
        let known = by_reason.entry(reason).or_default();
        // Two planes, for example, are one fit.
        if known.last() != Some(&what) {
            known.push(what);
        }
    }
    by_reason
}

/// Writes a line to stderr in one call, so that lines of several processes do not mix.
pub fn say(line: &str) {
    // Where nobody listens, nothing is lost.
    let _ = std::io::stderr().write_all(format!("{line}\n").as_bytes());
}

impl Console {
    /// A line that tells what was done.
    pub fn note(&self, line: &str) {
        match &self.listener {
            Some(listener) => listener.note(line),
            None if self.quiet => {}
            None => say(line),
        }
    }

    /// A warning: a result to be looked at twice.
    pub fn warn(&self, warning: &str) {
        self.warnings.push(warning);
        self.tell(warning);
    }

    /// Tells a warning that the file has already, or has in more words.
    pub fn tell(&self, warning: &str) {
        match (&self.expected, &self.listener) {
            (Some(expected), _) => expected.push(warning),
            (None, Some(listener)) => listener.warn(warning),
            (None, None) => self.note(&format!("warning: {warning}")),
        }
    }

    /// A line that tells what a stage did.
    pub fn stage(&self, name: &str, summary: &str, weight: Weight) {
        let terminal = if self.listener.is_some() { Terminal::PLAIN } else { Terminal::stderr() };
        let name = format!("{name:20}");
        self.note(&format!("{} {}", terminal.set(&name, Weight::Strong), terminal.set(summary, weight)));
    }

    /// A line for each reason, with all that it holds for.
    pub fn warn_each(&self, warnings: impl Iterator<Item = (String, String)>) {
        for (reason, what) in by_reason(warnings) {
            self.warn(&format!("{reason}: {}", what.join(", ")));
        }
    }

    /// The same where they may be many: the file keeps all names, and the first ones are told.
    pub fn warn_of_many(&self, warnings: impl Iterator<Item = (String, String)>) {
        for (reason, what) in by_reason(warnings) {
            let all = what.join("; ");
            self.warnings.push(&format!("{reason}: {all}"));
            match what.len() {
                ..=MOST_GROUPS => self.tell(&format!("{reason}: {all}")),
                count => self.tell(&format!(
                    "{reason}: {}; and {} more, which the file written names",
                    what[..NAMED].join("; "),
                    count - NAMED
                )),
            }
        }
    }

    /// The same of suites and structures: one line for all where it would be many.
    pub fn warn_each_group(&self, warnings: impl Iterator<Item = (OfGroup, String)>) {
        let warnings: Vec<(OfGroup, String)> = warnings.collect();
        let mut groups: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for (OfGroup { words, group, .. }, _) in &warnings {
            let known = groups.entry(words).or_default();
            if !known.contains(&group.as_str()) {
                known.push(group);
            }
        }
        let are_few = |words: &str| groups[words].len() <= MOST_GROUPS;
        let few = warnings.iter().filter(|(reason, _)| are_few(&reason.words));
        self.warn_each(few.map(|(OfGroup { words, group, counts }, what)| {
            (words.replace("{}", group) + counts, what.clone())
        }));
        for (words, groups) in groups.iter().filter(|(words, _)| !are_few(words)) {
            let words = words.replace("{}", &format!("{} suites and structures", groups.len()));
            let (named, more) = (groups[..NAMED].join("; "), groups.len() - NAMED);
            self.warn(&format!("{words}: {named}; and {more} more (the rows of the file tell of each)"));
        }
    }

    /// Progress over `total` steps.
    pub fn bar(&self, what: &str, total: u64) -> Progress {
        if let Some(listener) = &self.listener {
            listener.begin(total);
        }
        Progress { bar: self.terminal_bar(what, total), listener: self.listener.clone() }
    }

    fn terminal_bar(&self, what: &str, total: u64) -> ProgressBar {
        if self.listener.is_some() || self.quiet || !self.progress || !std::io::stderr().is_terminal() {
            return ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        }
        let style = ProgressStyle::with_template("{msg:20} {bar:40} {human_pos}/{human_len}  {eta} left");
        let bar = ProgressBar::new(total).with_message(what.to_string());
        style.map_or(bar.clone(), |style| bar.with_style(style))
    }
}
