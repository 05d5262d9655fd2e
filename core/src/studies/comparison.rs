//! Each number that the paper publishes, beside ours.

use std::f64::consts::SQRT_2;

use serde::{Deserialize, Serialize};

use crate::fragility::{CurveFit, DemandFit, DemandModel, Event, Group, Measure};
use crate::fragility::{beta, hybrid_measure, lambda, mu, p_overturning};
use crate::paper::{EXAMPLE_LAMBDA, Published, SeedValue, example, published, seed_values};
use crate::rocking::Structure;
use crate::statistics::normal;

/// A published number beside ours: a row of paper.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    pub quantity: String,
    pub place: String,
    pub suite: String,
    pub structure: String,
    pub published: Option<f64>,
    pub ours: Option<f64>,
    /// Mean, standard deviation and number of our values over seeds, in the set-up of the paper.
    pub mean: Option<f64>,
    pub sd: Option<f64>,
    pub seeds: i64,
    /// (published - ours) / sd; none where ours is within the rounding of the print, wider than two sds.
    pub z: Option<f64>,
    pub t2: Option<f64>,
    pub t2_p: Option<f64>,
}

/// Compares fits of the paper's structures with all that the paper publishes.
///
/// ```
/// use rockfrag_core::studies::comparison::{Comparison, compare};
/// // Without fits of ours, what is published stands alone.
/// let compared: Vec<Comparison> = compare(&[], &[]);
/// assert!(compared.iter().any(|row| row.quantity == "low_b1" && row.ours.is_none()));
/// ```
pub fn compare(demand: &[DemandFit], curves: &[CurveFit]) -> Vec<Comparison> {
    let seeds = seed_values();
    let compared = published().into_iter().map(|number| {
        let group = Group { suite: Some(&number.suite), structure: &number.structure };
        let ours = GroupFits { group, demand, curves }.value(&number.quantity);
        comparison(number, ours, &seeds)
    });
    compared.collect()
}

fn comparison(number: Published, ours: Option<f64>, seeds: &[SeedValue]) -> Comparison {
    let of_number = seeds.iter().filter(|seed| {
        (&seed.quantity, &seed.suite, &seed.structure) == (&number.quantity, &number.suite, &number.structure)
    });
    let values: Vec<f64> = of_number.map(|seed| seed.value).collect();
    let n = values.len() as f64;
    let mean = Some(values.iter().sum::<f64>() / n).filter(|_| n > 1.0);
    let sd = mean.map(|mean| (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt());
    let z = z(&number, ours, sd);
    let Published { quantity, place, suite, structure, published, t2, t2_p, .. } = number;
    let seeds = values.len() as i64;
    Comparison { quantity, place, suite, structure, published, ours, mean, sd, seeds, z, t2, t2_p }
}

fn z(number: &Published, ours: Option<f64>, sd: Option<f64>) -> Option<f64> {
    let (ours, sd, low, high) = (ours?, sd?, number.print_low?, number.print_high?);
    let is_open = (low..=high).contains(&ours) && high - low > 2.0 * sd;
    (sd > 0.0 && !is_open).then_some((number.published? - ours) / sd)
}

/// All fits, and the suite and structure whose fits are looked up.
struct GroupFits<'a> {
    group: Group<'a>,
    demand: &'a [DemandFit],
    curves: &'a [CurveFit],
}

impl GroupFits<'_> {
    /// Our value of a published quantity; none where no fit gives it.
    fn value(&self, quantity: &str) -> Option<f64> {
        // The example takes the curve of the equipment for both structures.
        let equipment = || self.hybrid("electrical-equipment").map(|curve| &curve.coefficients);
        match quantity {
            "transition" => self.plane("high")?.transition_found,
            "r2_pooled" => self.plane("high")?.r2_pooled,
            "hybrid_lambda" => Some(lambda(&self.hybrid(self.group.structure)?.coefficients).value),
            "im5_theta" => Some(mu(&self.im5()?.coefficients).value.exp()),
            "im5_beta" => Some(beta(&self.im5()?.coefficients).value),
            "example_hybrid" => self.example_hybrid(lambda(equipment()?).value),
            "example_p_ro" => {
                let b = equipment()?;
                Some(p_overturning(self.example_hybrid(lambda(b).value)?, mu(b).value, beta(b).value))
            }
            // 1/2 (1 + erf(ln IM)): Eq. 24 with mu and beta sqrt 2 left out gives what is printed.
            "example_half_erf" => Some(normal::cdf(SQRT_2 * self.example_hybrid(EXAMPLE_LAMBDA)?.ln())),
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

    fn plane(&self, side: &str) -> Option<&DemandFit> {
        let planes = self.demand.iter().filter(|fit| fit.model == DemandModel::Biplanar);
        let mut on_side = planes.filter(|fit| fit.range_high.is_some() == (side == "low"));
        on_side.find(|fit| fit.group() == self.group)
    }

    fn im5(&self) -> Option<&CurveFit> {
        self.curve(self.group.structure, Measure::Im5, None)
    }

    fn hybrid(&self, structure: &str) -> Option<&CurveFit> {
        self.curve(structure, Measure::Im4, Some(Measure::Im3Inverse))
    }

    fn curve(&self, structure: &str, im_x: Measure, im_y: Option<Measure>) -> Option<&CurveFit> {
        let mut fitted = self.curves.iter().filter(|fit| !fit.coefficients.is_empty());
        fitted.find(|fit| {
            fit.group() == Group { structure, ..self.group }
                && (fit.event, &fit.im_x, &fit.im_y) == (Event::Overturning, &im_x, &im_y)
        })
    }

    /// The hybrid measure of the worked example, of the motion as it meets the structure.
    fn example_hybrid(&self, lambda: f64) -> Option<f64> {
        let fit = self.curves.iter().find(|fit| fit.group() == self.group)?;
        let structure = Structure::new(&fit.structure, fit.p_rad_s, fit.alpha_rad, fit.eta).ok()?;
        let measures = example(&structure);
        Some(hybrid_measure(measures.im4, 1.0 / measures.im3?, lambda))
    }
}
