//! Which measures predict best: alone, in pairs and in triples, and by forward selection.

use crate::resampling::folds::{Folds, Gain};
use crate::statistics::FitStatus;
use crate::studies::candidate::{Candidate, Form};
use crate::studies::ranking_sample::{RankingSample, Target};
use crate::studies::rating::Rating;
use crate::studies::rating::rate_overturning;
use crate::studies::rating::{Breaks, rate_demand};

/// Log-likelihoods that differ by less than this share are those of one model in other measures.
const SAME: f64 = 1e-9;

/// What a candidate is to the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OfPaper {
    /// The model that it settles on.
    Model,
    /// The best of its six measures alone, as one power law.
    Scalar,
}

/// A candidate and how it does.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranked {
    pub measures: Vec<String>,
    /// How they enter.
    pub form: Form,
    /// How well it predicts, or why there is no fit.
    pub rating: Result<Rating, FitStatus>,
    /// Measures of the first candidate that is the same model, if it is not itself.
    pub same_as: Option<Vec<String>>,
    /// Its place among the models of as many measures, from 1.
    pub rank: Option<usize>,
    /// Over the best model of as many measures: not above 0.
    pub over_best: Option<Gain>,
    /// Over the model that the paper settles on.
    pub over_paper: Option<Gain>,
    /// What it is to the paper.
    pub of_paper: Option<OfPaper>,
    /// The step of forward selection that arrives here, from 0 for no measure at all.
    pub step: Option<usize>,
    /// Over the step before.
    pub over_step: Option<Gain>,
}

/// All candidates with their ratings.
pub struct RankedCandidates<'a> {
    sample: &'a RankingSample,
    candidates: &'a [Candidate],
    ratings: Vec<Result<Rating, FitStatus>>,
    /// The first candidate that is the same model.
    models: Vec<usize>,
    /// All candidates, the best first.
    order: Vec<usize>,
}

impl<'a> RankedCandidates<'a> {
    /// Of candidates that compete in these cases.
    pub fn new(
        sample: &'a RankingSample,
        candidates: &'a [Candidate],
        ratings: Vec<Result<Rating, FitStatus>>,
    ) -> RankedCandidates<'a> {
        let models = models(candidates, &ratings);
        let key = |k: usize| match &ratings[models[k]] {
            Ok(Rating { held_out: Some(held_out), .. }) => (0, -held_out.log_score()),
            Ok(rating) => (1, rating.aic),
            Err(_) => (2, 0.0),
        };
        let mut order: Vec<(usize, (u8, f64))> = (0..candidates.len()).map(|k| (k, key(k))).collect();
        order.sort_by(|(a, (a_kind, a_score)), (b, (b_kind, b_score))| {
            let by_terms = candidates[*a].measures.len().cmp(&candidates[*b].measures.len());
            let by_score = a_kind.cmp(b_kind).then(a_score.total_cmp(b_score));
            by_terms.then(by_score).then(models[*a].cmp(&models[*b])).then(a.cmp(b))
        });
        let order = order.into_iter().map(|(k, _)| k).collect();
        RankedCandidates { sample, candidates, ratings, models, order }
    }

    /// All of them, as [`MeasureRanking::rank`](crate::studies::MeasureRanking::rank) orders them.
    pub fn ranked(&self) -> Vec<Ranked> {
        let paper = Candidate::of_paper(self.sample);
        let paper = paper.and_then(|paper| self.candidates.iter().position(|of| *of == paper));
        let (scalar, steps) = (self.scalar_of_paper(), self.forward());
        let ranks = self.ranks();
        let ranked = |&k: &usize| {
            let Candidate { measures, form } = &self.candidates[k];
            let best = |&&other: &&usize| self.candidates[other].measures.len() == measures.len();
            let step = steps.iter().position(|&of| of == k);
            Ranked {
                measures: self.names(k),
                form: *form,
                rating: self.ratings[k].clone(),
                same_as: (self.models[k] != k).then(|| self.names(self.models[k])),
                rank: ranks[k],
                over_best: self.order.iter().find(best).and_then(|&best| self.gain(k, best)),
                over_paper: paper.and_then(|paper| self.gain(k, paper)),
                of_paper: match k {
                    k if paper == Some(k) => Some(OfPaper::Model),
                    k if scalar == Some(k) => Some(OfPaper::Scalar),
                    _ => None,
                },
                step,
                over_step: step.and_then(|step| self.gain(k, steps[step.checked_sub(1)?])),
            }
        };
        self.order.iter().map(ranked).collect()
    }

    fn names(&self, k: usize) -> Vec<String> {
        self.candidates[k].measures.iter().map(|&place| self.sample.names[place].clone()).collect()
    }

    fn gain(&self, k: usize, over: usize) -> Option<Gain> {
        let scores = |k: usize| Some(&self.ratings[k].as_ref().ok()?.held_out.as_ref()?.scores);
        // Of the models, so that no rounding tells those apart that are the same.
        Some(scores(self.models[k])?.gain(scores(self.models[over])?))
    }

    fn has_score(&self, k: usize) -> bool {
        self.ratings[k].as_ref().is_ok_and(|rating| rating.held_out.is_some())
    }

    /// The best of the paper's measures alone.
    fn scalar_of_paper(&self) -> Option<usize> {
        let measures = self.sample.target.measures_of_paper();
        let places: Vec<usize> = measures.iter().filter_map(|&measure| self.sample.place(measure)).collect();
        self.order.iter().copied().filter(|&k| self.has_score(k)).find(|&k| {
            let Candidate { measures, form } = &self.candidates[k];
            *form == Form::Single && matches!(measures[..], [place] if places.contains(&place))
        })
    }

    /// The place of each model among those of as many measures.
    fn ranks(&self) -> Vec<Option<usize>> {
        let mut ranks = vec![None; self.candidates.len()];
        let (mut terms, mut rank) = (0, 0);
        for &k in self.order.iter().filter(|&&k| self.has_score(k)) {
            if self.candidates[k].measures.len() != terms {
                (terms, rank) = (self.candidates[k].measures.len(), 0);
            }
            if self.models[k] == k {
                rank += 1;
            }
            ranks[k] = Some(rank);
        }
        ranks
    }

    /// Forward selection: no measure, the best one, then the best that holds those before.
    fn forward(&self) -> Vec<usize> {
        let mut steps: Vec<usize> = Vec::new();
        for terms in 0.. {
            let next = self.order.iter().copied().filter(|&k| self.has_score(k)).find(|&k| {
                let holds_last = |last: &usize| self.candidates[*last].is_within(&self.candidates[k]);
                self.candidates[k].measures.len() == terms && steps.last().is_none_or(holds_last)
            });
            match next {
                Some(next) => steps.push(next),
                None => break,
            }
        }
        steps
    }
}

/// For each candidate the first one that is the same model: of as many measures, each a product of powers of those of the other,
/// so that both fit equally well.
fn models(candidates: &[Candidate], ratings: &[Result<Rating, FitStatus>]) -> Vec<usize> {
    let mut models: Vec<usize> = (0..candidates.len()).collect();
    let likelihood = |k: usize| ratings[k].as_ref().map_or(f64::NAN, |rating| rating.log_likelihood);
    let kind = |k: usize| (candidates[k].measures.len(), candidates[k].form == Form::Broken);
    let mut fitted: Vec<usize> = (0..candidates.len()).filter(|&k| likelihood(k).is_finite()).collect();
    fitted.sort_by(|&a, &b| kind(a).cmp(&kind(b)).then(likelihood(a).total_cmp(&likelihood(b))));
    let same = |a: usize, b: usize| {
        let difference = likelihood(b) - likelihood(a);
        kind(a) == kind(b) && difference <= SAME * (1.0 + likelihood(a).abs())
    };
    for equal in fitted.chunk_by(|&a, &b| same(a, b)) {
        let first = equal.iter().copied().min();
        equal.iter().for_each(|&k| models[k] = first.unwrap_or(k));
    }
    models
}

/// How measures are ranked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankingRules {
    /// The most folds of cross-validation.
    pub folds: usize,
    /// The most measures of a candidate.
    pub terms: usize,
    /// The IM4 at which the demand breaks, if not where the pooled residual of two planes is least.
    pub transition: Option<f64>,
}

/// All sets of measures that compete in some cases.
pub struct MeasureRanking {
    sample: RankingSample,
    folds: Option<Folds>,
    breaks: Breaks,
    pub candidates: Vec<Candidate>,
}

impl MeasureRanking {
    /// In these cases, by these rules.
    pub fn new(sample: RankingSample, rules: &RankingRules) -> MeasureRanking {
        let folds = Folds::new(&sample.clusters, rules.folds);
        let breaks = Breaks::new(&sample, folds.as_ref(), rules.transition);
        let candidates = Candidate::all(&sample, rules.terms);
        MeasureRanking { sample, folds, breaks, candidates }
    }

    /// How well a candidate predicts.
    ///
    /// # Errors
    /// With the status that says why there is no fit.
    pub fn rate(&self, candidate: &Candidate) -> Result<Rating, FitStatus> {
        let (sample, folds) = (&self.sample, self.folds.as_ref());
        match sample.target {
            Target::Demand => rate_demand(sample, candidate, folds, &self.breaks),
            Target::Overturning => rate_overturning(sample, candidate, folds),
        }
    }

    /// The candidates with the rating of each, by the number of their measures, then by cross-validated log score, the best
    /// first. Those without a score come after them, those without a fit last.
    pub fn rank(&self, ratings: Vec<Result<Rating, FitStatus>>) -> Vec<Ranked> {
        RankedCandidates::new(&self.sample, &self.candidates, ratings).ranked()
    }
}
