//! What holds for many things, told once.

use crate::records::plausibility::Doubt;

/// Things that a line names; of the others it tells how many there are.
const NAMED: usize = 10;

/// Something for which a reason holds.
pub struct Case {
    pub name: String,
    /// What was found in it.
    pub found: Option<String>,
    pub reason: String,
}

impl Case {
    /// Of what is doubtful about a motion of this name.
    pub fn of_doubt(name: String, Doubt { found, reason, .. }: &Doubt) -> Case {
        Case { name, found: Some(found.clone()), reason: reason.to_string() }
    }
}

/// The first names of so many things, and how many more there are.
pub fn listed(names: &[String], of: usize) -> String {
    let more = match of - names.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    names.join(", ") + &more
}

/// Reasons in the order in which they came first, each with how many things it holds for, and the first of these.
#[derive(Default)]
pub struct Reasons(Vec<Reason>);

struct Reason {
    reason: String,
    count: usize,
    named: Vec<Case>,
}

impl Reasons {
    pub fn add(&mut self, case: Case) {
        let at = self.0.iter().position(|known| known.reason == case.reason).unwrap_or(self.0.len());
        if at == self.0.len() {
            self.0.push(Reason { reason: case.reason.clone(), count: 0, named: Vec::new() });
        }
        let known = &mut self.0[at];
        known.count += 1;
        if known.named.len() < NAMED {
            known.named.push(case);
        }
    }

    /// A line for each reason, which tells of so many `things`.
    pub fn lines(&self, things: &str) -> impl Iterator<Item = String> {
        self.0.iter().map(move |reason| reason.line(things))
    }
}

impl Reason {
    fn line(&self, things: &str) -> String {
        let Reason { reason, count, named } = self;
        if let [Case { name, found, .. }] = &named[..] {
            let found = found.as_ref().map_or(String::new(), |found| format!("{found}; "));
            return format!("{name}: {found}{reason}");
        }
        let each = |Case { name, found, .. }: &Case| match found {
            Some(found) => format!("{name} ({found})"),
            None => name.clone(),
        };
        let names: Vec<String> = named.iter().map(each).collect();
        format!("{count} {things}: {reason}: {}", listed(&names, *count))
    }
}
