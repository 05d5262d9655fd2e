//! What is ranked: sets of measures, and how they enter.

use super::ranking_sample::{RankingSample, Target};
use crate::keyword::keywords;

/// How the measures of a candidate enter. Linear in their logarithms is a power law of their product, each to a power of its
/// own: the fit finds the powers, so that there is no need to try products.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// One power law.
    Single,
    /// One on each side of a break in IM4, as the two planes of Eq. 18; of demands only.
    Broken,
}

keywords!(Form { Single = "single", Broken = "broken" });

/// A set of measures and their form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Candidate {
    /// Their places in the sample, ascending.
    pub measures: Vec<usize>,
    /// How they enter.
    pub form: Form,
}

impl Candidate {
    /// The model that the paper settles on: two planes for the demand, the hybrid measure for overturning.
    pub fn of_paper(sample: &RankingSample) -> Option<Candidate> {
        let measures = sample.target.pair_of_paper().map(|measure| sample.place(measure));
        let measures = measures.into_iter().collect::<Option<Vec<usize>>>()?;
        let form = match sample.target {
            Target::Demand => Form::Broken,
            Target::Overturning => Form::Single,
        };
        Some(Candidate { measures, form })
    }

    /// No measure at all, then all sets of up to `most`.
    pub fn all(sample: &RankingSample, most: usize) -> Vec<Candidate> {
        let forms: &[Form] = match sample.target {
            Target::Demand => &[Form::Single, Form::Broken],
            Target::Overturning => &[Form::Single],
        };
        let mut candidates = vec![Candidate { measures: Vec::new(), form: Form::Single }];
        for terms in 1..=most {
            for measures in subsets(sample.names.len(), terms) {
                candidates.extend(forms.iter().map(|&form| Candidate { measures: measures.clone(), form }));
            }
        }
        candidates
    }

    /// Whether another one has all measures of this one.
    pub fn is_within(&self, other: &Candidate) -> bool {
        self.measures.iter().all(|measure| other.measures.contains(measure))
    }
}

/// All sets of `size` numbers below `count`, in the order of the alphabet.
fn subsets(count: usize, size: usize) -> Vec<Vec<usize>> {
    if size == 0 {
        return vec![Vec::new()];
    }
    let longer = |set: Vec<usize>| {
        let next = set.last().map_or(0, |last| last + 1);
        (next..count).map(move |more| set.iter().copied().chain([more]).collect())
    };
    subsets(count, size - 1).into_iter().flat_map(longer).collect()
}
