//! Answers: a question and objects give a row for each object, in their order.
//!
//! ```text
//! row        the columns of an answer
//! labels     the own columns of the list of the objects
//! at_site    what is drawn of an object at a site
//! ```

mod at_site;
mod labels;
mod row;

use std::collections::BTreeSet;
use std::iter;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch, StringArray};
use rayon::prelude::*;
use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{
    Bases, Budget, Fragility, FragilityPoint, GenericSites, GroundMotion, Hazard, ListProbabilities,
    ListedObject, Lognormal, MotionProbabilities, Site, unusual_motions,
};
use rockfrag_core::object::{Object, RockingObject};
use rockfrag_core::statistics::Interval;
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};

use crate::chart::text::literal;
use crate::inputs::Reading;
use crate::pipeline::context::Progress;
use crate::table::TableError;
use crate::table::file::ParquetTable;
use crate::table::provenance::Provenance;
use crate::table::rows::{self, distinct};
pub use at_site::{AtSite, USUAL_YEARS};
pub use labels::Labels;
pub use row::{
    CurveRow, FragilityColumns, ObjectColumns, RateColumns, StateColumns, TreeColumns, UncertaintyColumns,
};

/// What is asked of an object.
pub enum Question {
    /// What comes of it under one motion.
    Motion(GroundMotion),
    /// How often it rocks and overturns at a site, and in so many years; with a base for a target.
    Hazard { site: Site, years: f64, target: Option<f64> },
    /// The shares of the motions of each intensity, at a site or in general; and over the peak `beside`.
    Curve { general: GenericSites, site: Option<Site>, beside: Option<Peak> },
}

/// What is predicted for an object: a row of the file that evaluate writes.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// What is changed of the object, if it is a variant.
    pub variant: Option<String>,
    pub object: ObjectColumns,
    pub tree: TreeColumns,
    pub p: StateColumns,
    pub rates: RateColumns,
    pub fragility: FragilityColumns,
    pub uncertainty: UncertaintyColumns,
    /// What happens to the objects of the table, where there are several: the same in all rows.
    pub list: ListProbabilities,
    /// What else the list of the object says of it.
    #[serde(skip)]
    pub labels: Labels,
    /// The points of its fragility, of which each is a row of the file.
    #[serde(skip)]
    pub points: Vec<FragilityPoint>,
    /// The same over PGA, beside its fragility over PGV.
    #[serde(skip)]
    pub over_pga: Option<Box<Answer>>,
    /// The name of the file that it was read from.
    #[serde(skip)]
    pub file: String,
    /// Where two tables are compared.
    #[serde(skip)]
    pub before: Option<Box<Before>>,
    /// What each of several files says of the same object under another hazard.
    #[serde(skip)]
    pub alternatives: Vec<Answer>,
}

/// What an object was before.
#[derive(Debug, Clone, PartialEq)]
pub struct Before {
    /// The probability of overturning.
    pub p: Interval<Option<f64>>,
    /// The rate after over the rate before, with limits; none where one has no rate.
    pub ratio: Interval<Option<f64>>,
    pub changes: Vec<String>,
}

/// The answers of a call, or of files, and what made each.
#[derive(Debug, Clone, Default)]
pub struct AnswerTable {
    pub rows: Vec<Answer>,
    /// More of the worst objects, the worst first, as far as it is known.
    pub details: Vec<Detail>,
    pub made: Vec<Provenance>,
    /// The hazard, as far as it is known.
    pub hazard: Option<Hazard>,
}

/// What is told of an object beside its answer.
#[derive(Debug, Clone, Default)]
pub struct Detail {
    /// Its answer as it is, and with one thing changed at a time.
    pub variants: Vec<Answer>,
    pub at_site: Option<AtSite>,
}

/// Joins an object with the models of its directions, and returns the warnings about these.
pub type ModelsOf<'a> = &'a (dyn Fn(&Object) -> anyhow::Result<(RockingObject, Vec<Warning>)> + Sync);

/// Answers a question for each object.
///
/// # Errors
/// If no model can be chosen. An object that cannot rock has a row that says why.
pub fn assess(
    objects: &[Object],
    question: &Question,
    models: ModelsOf,
    progress: &Progress,
) -> anyhow::Result<Vec<Answer>> {
    let answers: Vec<_> = objects
        .par_iter()
        .map(|object| {
            progress.advance(1)?;
            Answer::new(object, question, models)
        })
        .collect();
    // The first error in the order of the objects, whichever thread meets one first.
    let answers: Vec<AnswerOfObject> = answers.into_iter().collect::<anyhow::Result<_>>()?;
    let list = of_list(&answers, question);
    Ok(answers.into_iter().map(|(answer, _)| Answer { list, ..answer }).collect())
}

/// An answer and, if the object has one, the object with what is unknown of it.
type AnswerOfObject = (Answer, Option<(RockingObject, Budget)>);

/// What happens to several objects; nothing of one.
fn of_list(answers: &[AnswerOfObject], question: &Question) -> ListProbabilities {
    let listed = answers.iter().filter_map(|(answer, known)| {
        let (object, budget) = known.as_ref()?;
        let overturning = match question {
            Question::Hazard { .. } => answer.rates.overturning_per_year,
            _ => answer.p.p_overturning,
        };
        let count = answer.object.count.unwrap_or(1.0);
        let years = answer.rates.years.unwrap_or_default();
        Some(ListedObject { object, count, years, overturning, budget })
    });
    let listed: Vec<ListedObject> = listed.collect();
    let are_several = listed.iter().map(|of| of.count).sum::<f64>() > 1.0;
    match question {
        Question::Hazard { site, .. } if are_several => site.list(&listed),
        Question::Motion(motion) if are_several => motion.list(&listed),
        _ => ListProbabilities::default(),
    }
}

impl Answer {
    fn new(object: &Object, question: &Question, models: ModelsOf) -> anyhow::Result<AnswerOfObject> {
        let mut answer = Answer { labels: object.labels.clone(), ..Answer::default() };
        if let Err(reason) = object.sides() {
            answer.object = ObjectColumns::new(object, None);
            answer.uncertainty.warnings = Some(reason.to_string());
            return Ok((answer, None));
        }
        let (rocking, mut warnings) = models(object)?;
        warnings.extend(object.is_round.then_some(Warning::RoundBase));
        let weaker = &rocking.directions[0];
        answer.object = ObjectColumns::new(object, Some(weaker));
        let (budget, magnitude, motion) = match question {
            Question::Motion(motion) => {
                let MotionProbabilities { states, budget, magnitude } = motion.probabilities(&rocking);
                answer.tree = TreeColumns::new(motion, &rocking, states);
                answer.p = StateColumns::new(states);
                warnings.extend(unusual_motions(motion.mw, motion.vs30_m_s));
                (budget, magnitude, motion.peaks(&weaker.model))
            }
            Question::Hazard { site, years, target } => {
                let (rates, years) = (site.rates(&rocking), object.years.unwrap_or(*years));
                (answer.rates, answer.p) = RateColumns::new(&rates, years);
                if let Some(p) = *target {
                    let with_models = |object: &Object| Some(models(object).ok()?.0);
                    let (rate, target) = (rates.states.overturning, -(-p).ln_1p() / years);
                    answer.rates.target = Some(p);
                    answer.rates.bases = site.bases(object, &with_models, rate, target);
                }
                warnings.extend(rates.warnings);
                (rates.budget, rates.magnitude, rates.motion)
            }
            Question::Curve { general, site, beside } => {
                if let Some(over) = *beside {
                    let general = GenericSites { over, ..*general };
                    let other = Question::Curve { general, site: None, beside: None };
                    let (other, _) = Answer::new(object, &other, models)?;
                    answer.over_pga = Some(Box::new(other)).filter(|other| other.is_answered());
                }
                let at_site = site.as_ref().and_then(|site| site.fragility(&rocking));
                let fragility = at_site.unwrap_or_else(|| general.fragility(&rocking));
                answer.fragility = FragilityColumns::new(&fragility);
                answer.points = fragility.points;
                warnings.extend(unusual_motions(general.mw, general.vs30_m_s));
                (fragility.budget, fragility.magnitude, fragility.motion)
            }
        };
        warnings.extend(rocking.warnings(motion));
        answer.uncertainty = UncertaintyColumns::new(warnings, &budget, magnitude, motion);
        Ok((answer, Some((rocking, budget))))
    }

    /// What its list says of it under a heading.
    pub fn label(&self, heading: &str) -> Option<&str> {
        Some(&*self.labels.iter().find(|(other, _)| other == heading)?.1)
    }

    /// Whether it has an answer: a probability or a fragility.
    pub fn is_answered(&self) -> bool {
        self.severity() >= 0.0
    }

    /// Whether it is not what it was before.
    pub fn is_news(&self) -> bool {
        let is_new = |before: &Before| before.p != self.p.p_overturning || !before.changes.is_empty();
        self.before.as_deref().is_none_or(is_new)
    }

    /// What sorts answers, the worst first: the probability of overturning, else its upper end, else the
    /// inverse of the intensity that overturns it under half of the motions.
    pub fn severity(&self) -> f64 {
        let p = self.p.p_overturning;
        let fragility = &self.fragility;
        let weakness = || fragility.over.map(|_| fragility.overturning.theta.value.map_or(0.0, f64::recip));
        p.value.or(p.high).or_else(weakness).unwrap_or(f64::NEG_INFINITY)
    }
}

impl Detail {
    /// Of an object at a site. A variant that would not rock, or lies outside the model, has no answer.
    pub fn new(object: &Object, site: &Site, years: f64, models: ModelsOf) -> Detail {
        let question = Question::Hazard { site: site.clone(), years, target: None };
        let changes = object.changes().into_iter().map(|changed| (changed.words, changed.object));
        let all = iter::once(("as it is".to_string(), object.clone())).chain(changes);
        let variants = all.filter_map(|(words, object)| {
            let (answer, _) = Answer::new(&object, &question, models).ok()?;
            Some(Answer { variant: Some(words), ..answer }).filter(Answer::is_answered)
        });
        let at_site = models(object).ok().and_then(|(rocking, _)| AtSite::new(site, &rocking));
        Detail { variants: variants.collect(), at_site }
    }

    /// The variants that differ in their angle or place: others are the same object, known better.
    pub fn remedies(&self) -> impl Iterator<Item = &Answer> {
        let place = |one: &Answer| (one.object.alpha_rad, one.object.floor_level);
        let as_it_is = self.variants.first().map(place);
        self.variants.iter().filter(move |one| Some(place(one)) != as_it_is)
    }
}

impl FragilityColumns {
    pub fn new(fragility: &Fragility) -> FragilityColumns {
        let (_, unit, _) = fragility.over.name_and_unit();
        let [failure, overturning] = [fragility.failure, fragility.overturning].map(|of| {
            let [at_16, theta, at_84] =
                [of.at_16, of.theta, of.at_84].map(|of| of.map(|intensity| intensity / unit));
            Lognormal { at_16, theta, at_84, ..of }
        });
        FragilityColumns { over: Some(fragility.over), failure, overturning }
    }
}

/// The answers, each followed by that over PGA.
pub fn over_all<'a>(answers: impl IntoIterator<Item = &'a Answer>) -> impl Iterator<Item = &'a Answer> {
    answers.into_iter().flat_map(|answer| iter::once(answer).chain(answer.over_pga.as_deref()))
}

/// The answers as a table, without the columns of other questions.
pub fn table(answers: &[Answer], question: &Question) -> anyhow::Result<RecordBatch> {
    let all: Vec<&Answer> = over_all(answers).collect();
    let p = rows::batch(all.iter().map(|answer| &answer.p))?;
    let list = rows::batch(all.iter().map(|answer| &answer.list))?;
    let of_question = match question {
        Question::Motion(_) => vec![rows::batch(all.iter().map(|answer| &answer.tree))?, p, list],
        Question::Hazard { .. } => vec![rows::batch(all.iter().map(|answer| &answer.rates))?, p, list],
        Question::Curve { .. } => vec![rows::batch(all.iter().map(|answer| &answer.fragility))?],
    };
    with_objects(&all, of_question)
}

/// Columns between those of the objects and those of what is not known of them.
fn with_objects(answers: &[&Answer], columns: Vec<RecordBatch>) -> anyhow::Result<RecordBatch> {
    let objects = rows::batch(answers.iter().map(|answer| &answer.object))?;
    let uncertainty = rows::batch(answers.iter().map(|answer| &answer.uncertainty))?;
    let labels = labels::columns(answers)?;
    rows::side_by_side(&[vec![objects], columns, vec![uncertainty], Vec::from_iter(labels)].concat())
}

/// Variants as a table, each named by what is changed.
pub fn variant_table(variants: &[Answer], question: &Question) -> anyhow::Result<RecordBatch> {
    let names = variants.iter().map(|answer| answer.variant.as_deref());
    let names: ArrayRef = Arc::new(StringArray::from_iter(names));
    let names = RecordBatch::try_from_iter_with_nullable([("variant", names, true)])?;
    rows::side_by_side(&[names, table(variants, question)?])
}

/// The points of the fragilities, each with the columns of its answer; a row of an object without an answer.
pub fn points(answers: &[Answer]) -> anyhow::Result<RecordBatch> {
    let all = over_all(answers).flat_map(|answer| iter::repeat_n(answer, answer.points.len().max(1)));
    let points = over_all(answers).flat_map(|Answer { points, fragility, .. }| {
        let empty = points.is_empty().then(CurveRow::default);
        points.iter().map(|point| CurveRow::new(fragility.over, point)).chain(empty)
    });
    let (all, points) = (all.collect::<Vec<_>>(), points.collect::<Vec<_>>());
    let fragilities = rows::batch(all.iter().map(|answer| &answer.fragility))?;
    with_objects(&all, vec![rows::batch(&points)?, fragilities])
}

impl AnswerTable {
    /// Reads the answers of a file, and the variants beside it.
    pub fn read(path: &Path, made: Option<&Provenance>) -> Result<AnswerTable, TableError> {
        let (file, mut rows) = (path.file_name().unwrap_or_default().to_string_lossy(), Vec::new());
        for batch in ParquetTable::open(path)?.batches(|_| true) {
            let batch = batch?;
            let points = rows::from_batch::<CurveRow>(&batch)?.into_iter().zip(labels::read(&batch)?);
            for (answer, (point, labels)) in rows::from_batch::<Answer>(&batch)?.into_iter().zip(points) {
                add(&mut rows, Answer { labels, file: file.to_string(), ..answer }, &point);
            }
        }
        let (beside, made) = (variants_beside(path), made.cloned().unwrap_or_default());
        let variants: Vec<Answer> = if made.is_beside(&beside) { rows::read(&beside)? } else { Vec::new() };
        let of_objects = variants.chunk_by(|a, b| a.object.structure == b.object.structure);
        let details = of_objects.map(|its| Detail { variants: its.to_vec(), ..Detail::default() }).collect();
        Ok(AnswerTable { rows, details, made: vec![made], ..AnswerTable::default() })
    }

    /// The answers of several files, without a target that is not that of all.
    pub fn joined(all: &[AnswerTable]) -> AnswerTable {
        let mut rows: Vec<Answer> = all.iter().flat_map(|table| table.rows.clone()).collect();
        let details = all.iter().flat_map(|table| table.details.clone()).collect();
        let made = all.iter().flat_map(|table| table.made.clone()).collect();
        let target = rows.iter().find_map(|answer| answer.rates.target);
        if rows.iter().any(|answer| answer.is_answered() && answer.rates.target != target) {
            rows.iter_mut()
                .for_each(|answer| (answer.rates.target, answer.rates.bases) = (None, Bases::default()));
        }
        AnswerTable { rows, details, made, ..AnswerTable::default() }
    }

    /// The name of its file; none of a call's own answers.
    pub fn file(&self) -> String {
        self.rows.first().map_or(String::new(), |answer| literal(&answer.file))
    }

    /// How the files of people were read, each once.
    pub fn readings(&self) -> Vec<&Reading> {
        distinct(self.made.iter().flat_map(|made| &made.readings))
    }

    /// What answers are for, after a place: `; hazard: pga.csv`.
    pub fn conditions(&self) -> String {
        let over = self.rows.iter().find_map(|answer| answer.fragility.over);
        let hazards: BTreeSet<String> = self.made.iter().filter_map(|made| made.names("hazard")).collect();
        match hazards.is_empty() {
            true => over.map_or(String::new(), |_| "; at generic sites".to_string()),
            false => format!("; hazard: {}", literal(&Vec::from_iter(hazards).join("; "))),
        }
    }
}

pub fn variants_beside(path: &Path) -> PathBuf {
    path.with_extension("variants.parquet")
}

/// Adds a row of a file: of a fragility it is a point, that over PGA beside the same object over PGV.
fn add(answers: &mut Vec<Answer>, row: Answer, point: &CurveRow) {
    let Some(over) = row.fragility.over else { return answers.push(row) };
    let row = Answer { p: StateColumns::default(), tree: TreeColumns::default(), ..row };
    let before = answers.last_mut().filter(|before| before.object.structure == row.object.structure);
    let answer = match before.and_then(|before| Some((before.fragility.over?, before))) {
        Some((peak, before)) if peak == over => before,
        Some((Peak::Pgv, before)) => before.over_pga.get_or_insert_with(|| Box::new(row)),
        _ => answers.push_mut(row),
    };
    answer.points.extend(point.point());
}
