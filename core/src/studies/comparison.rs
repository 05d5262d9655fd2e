//! Each number that the paper publishes, beside ours over seeds and beside that of a run.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::fragility::{CurveFit, DemandFit, DemandModel, Event, Measure};
use crate::fragility::{beta, hybrid_measure, lambda, mu, p_overturning};
use crate::motion::Suite;
use crate::paper::{Published, READINGS, SeedValue, example, published, seed_values, structures};
use crate::rocking::Structure;
use crate::statistics::distributions::f_upper_tail;

/// A published plane or number with a smaller p differs from ours.
const LEVEL: f64 = 0.05;

/// A published number beside ours: a row of paper.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    pub quantity: String,
    pub place: String,
    pub suite: String,
    pub structure: String,
    /// Of a number of a plane, its side of the transition: below or above.
    pub plane: Option<String>,
    pub published: f64,
    /// Mean and number of our values over seeds, in the set-up of the paper.
    pub mean: f64,
    pub seeds: i64,
    /// (published - mean) / standard deviation of this difference.
    pub z: Option<f64>,
    /// Of the number, or of all four of its plane, which depend on each other.
    pub test: Distance,
    /// The number of a run, with its z.
    pub ours: Option<f64>,
    pub ours_z: Option<f64>,
}

/// How far numbers are from a sample of them, and the probability of as much by chance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Distance {
    pub t2: f64,
    pub p: f64,
}

/// Compares all that the paper publishes with our seeds, and with fits of the paper's structures.
pub fn compare(demand: &[DemandFit], curves: &[CurveFit]) -> Vec<Comparison> {
    let (numbers, seeds) = (published(), seed_values());
    let compared = numbers.iter().map(|number| {
        let its = structures().into_iter().find(|structure| structure.name == number.structure);
        let fits = its.map(|structure| GroupFits { suite: &number.suite, structure, demand, curves });
        let ours = fits.and_then(|fits| fits.value(number));
        let tested = numbers.iter().filter(|other| number.is_tested_with(other)).collect::<Vec<_>>();
        let (alone, together) = (of_seeds(&[number], &seeds), of_seeds(&tested, &seeds));
        let printed: Vec<f64> = tested.iter().map(|other| other.published).collect();
        let roundings: Vec<f64> = tested.iter().map(|other| other.rounding()).collect();
        let test = hotelling(&together, &printed, &roundings).expect("more seeds than numbers");
        let mean = alone.iter().map(|sample| sample[0]).sum::<f64>() / alone.len() as f64;
        let z = |value: f64| {
            let distance = hotelling(&alone, &[value], &[number.rounding()])?;
            Some(distance.t2.sqrt().copysign(value - mean))
        };
        let Published { quantity, place, suite, structure, plane, published, .. } = number.clone();
        let (seeds, z, ours_z) = (alone.len() as i64, z(published), ours.and_then(z));
        Comparison { quantity, place, suite, structure, plane, published, mean, seeds, z, test, ours, ours_z }
    });
    compared.collect()
}

/// How many of the paper's planes and of its other numbers could be those of one more of our seeds. What it
/// only implies is no number of its.
pub fn verdict(compared: &[Comparison]) -> String {
    let agree = |is_one: &dyn Fn(&Comparison) -> bool| {
        let its = || compared.iter().filter(|row| is_one(row));
        (its().filter(|row| row.test.p >= LEVEL).count(), its().count())
    };
    let is_plane = |row: &Comparison| row.quantity.ends_with("_b1");
    let of = |suite: Suite| agree(&|row| is_plane(row) && row.suite == <&str>::from(suite));
    let (planes, all_planes) = agree(&is_plane);
    let ((pulse, all_pulse), (csgm, all_csgm)) = (of(Suite::Pulse), of(Suite::Csgm));
    let (others, all_others) = agree(&|row| row.plane.is_none() && !row.quantity.starts_with("implied"));
    format!(
        "{planes} of the paper's {all_planes} planes ({pulse} of {all_pulse} under pulses, {csgm} of \
         {all_csgm} combined) and {others} of {all_others} numbers are not rejected by twenty seeds of \
         rockfrag (p > {LEVEL}), with the best of {READINGS} readings of its text."
    )
}

/// Our values of k numbers, of each seed that has all.
fn of_seeds(numbers: &[&Published], seeds: &[SeedValue]) -> Vec<Vec<f64>> {
    let mut by_seed: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
    for Published { quantity, suite, structure, .. } in numbers.iter().copied() {
        let its = seeds
            .iter()
            .filter(|one| (&one.quantity, &one.suite, &one.structure) == (quantity, suite, structure));
        its.for_each(|one| by_seed.entry(one.seed).or_default().push(one.value));
    }
    by_seed.into_values().filter(|values| values.len() == numbers.len()).collect()
}

/// Hotelling's T2 of one more of k numbers, whose errors have further `variances`, about the mean of a sample
/// of n: their covariance is that of the sample, times 1 + 1/n for the error of the mean. T2 (n - k) / (k
/// (n - 1)) is F with k and n - k degrees of freedom (Hotelling 1931, Annals of Mathematical Statistics 2,
/// 360-378). None if n <= k.
pub fn hotelling(sample: &[Vec<f64>], one_more: &[f64], variances: &[f64]) -> Option<Distance> {
    let (n, k) = (sample.len() as f64, one_more.len() as f64);
    let of = DVector::from_column_slice;
    let mean = sample.iter().fold(of(&vec![0.0; one_more.len()]), |sum, one| sum + of(one)) / n;
    let squares = sample.iter().map(|one| of(one) - &mean).map(|away| &away * away.transpose());
    let added = DMatrix::from_diagonal(&of(variances));
    let covariance = squares.fold(added, |sum, square| sum + square * ((1.0 + 1.0 / n) / (n - 1.0)));
    let away = of(one_more) - mean;
    let t2 = away.dot(&covariance.cholesky().filter(|_| n > k)?.solve(&away));
    Some(Distance { t2, p: f_upper_tail(t2 * (n - k) / (k * (n - 1.0)), k, n - k) })
}

/// All fits, and the suite and structure of the paper whose fits are looked up, whatever their name.
struct GroupFits<'a> {
    suite: &'a str,
    structure: Structure,
    demand: &'a [DemandFit],
    curves: &'a [CurveFit],
}

impl GroupFits<'_> {
    /// Our value of a published quantity; none where no fit gives it.
    fn value(&self, number: &Published) -> Option<f64> {
        // The example takes the curve of the equipment for both structures.
        let [_, equipment] = &structures()[..] else { return None };
        let equipment = || self.hybrid(equipment).map(|curve| &curve.coefficients);
        match number.quantity.as_str() {
            "transition" => self.plane("above")?.transition_found,
            "r2_pooled" => self.plane("above")?.r2_pooled,
            "implied_lambda" => Some(lambda(&self.hybrid(&self.structure)?.coefficients).value),
            "im5_theta" => Some(mu(&self.im5()?.coefficients).value.exp()),
            "im5_beta" => Some(beta(&self.im5()?.coefficients).value),
            "example_hybrid" => self.example_hybrid(lambda(equipment()?).value),
            "example_p_ro" => {
                let b = equipment()?;
                Some(p_overturning(self.example_hybrid(lambda(b).value)?, mu(b).value, beta(b).value))
            }
            coefficient_name => {
                let (side, coefficient) = coefficient_name.split_once('_')?;
                let fit = self.plane(side)?;
                match ["ln_a", "b1", "b2"].iter().position(|name| *name == coefficient) {
                    Some(place) => fit.coefficients.get(place).copied(),
                    None => fit.r2.filter(|_| coefficient == "r2"),
                }
            }
        }
    }

    /// Whether a fit to this suite is of a structure.
    fn is_of(&self, of: &Structure, suite: &Option<String>, fitted: &Structure) -> bool {
        suite.as_deref() == Some(self.suite) && fitted.parameters() == of.parameters()
    }

    fn plane(&self, side: &str) -> Option<&DemandFit> {
        let planes = self.demand.iter().filter(|fit| fit.model == DemandModel::Biplanar);
        let mut on_side = planes.filter(|fit| fit.range_high.is_some() == (side == "below"));
        on_side.find(|fit| self.is_of(&self.structure, &fit.suite, &fit.structure))
    }

    fn im5(&self) -> Option<&CurveFit> {
        self.curve(&self.structure, Measure::Im5, None)
    }

    fn hybrid(&self, structure: &Structure) -> Option<&CurveFit> {
        self.curve(structure, Measure::Im4, Some(Measure::Im3Inverse))
    }

    fn curve(&self, of: &Structure, im_x: Measure, im_y: Option<Measure>) -> Option<&CurveFit> {
        let mut fitted = self.curves.iter().filter(|fit| !fit.coefficients.is_empty());
        fitted.find(|fit| {
            self.is_of(of, &fit.suite, &fit.structure)
                && (fit.event, &fit.im_x, &fit.im_y) == (Event::Overturning, &im_x, &im_y)
        })
    }

    /// The hybrid measure of the worked example, of the motion as it meets the structure.
    fn example_hybrid(&self, lambda: f64) -> Option<f64> {
        let measures = example(&self.structure);
        Some(hybrid_measure(measures.im4, 1.0 / measures.im3?, lambda))
    }
}
